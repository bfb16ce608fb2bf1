#include "welkin/render/probes/rtxgi_probes.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin::scene {
namespace {

const ProbeAtlas& needed(const ProbeGrid& grid, std::string_view name) {
  const ProbeAtlas* atlas = grid.atlas(name);
  if (atlas == nullptr)
    throw Error(ErrorKind::bad_request, "RTXGI's textures need the grid's atlas '" + std::string(name) + "'");
  require(atlas->border == 1, "RTXGI's tiles have a border of one texel");
  return *atlas;
}

void check(const ProbeGrid& grid, double gamma) {
  require(grid.orientation == rtxgi_orientation(), "RTXGI's octahedra have +Z at their centre");
  require(gamma >= 1 && gamma <= 100, "RTXGI's gamma is of 1 to 100");
}

template <class Store>
RtxgiTexture converted(const ProbeGrid& grid, const ProbeAtlas& atlas, std::string name,
                       std::vector<std::string> channels, const Store& store) {
  RtxgiTexture made{std::move(name), std::move(channels), grid.probes.counts[1], Image()};
  const int width = atlas.image.width(), height = atlas.image.height();
  made.image = Image(width, height, static_cast<int>(made.channels.size()), PixelContents::unset);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) store(atlas.image.at(x, y), made.image.at(x, y));
  return made;
}

std::string three(double x, double y, double z) {
  return "[" + number_text(x) + ", " + number_text(y) + ", " + number_text(z) + "]";
}

}  // namespace

Matrix3 rtxgi_orientation() {
  return {{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}}};
}

ProbeGridOptions rtxgi_options() {
  ProbeGridOptions options;
  options.radiance = false;
  options.diffuse_size = 6;
  options.depth_size = 14;
  options.orientation = rtxgi_orientation();
  return options;
}

std::vector<RtxgiTexture> rtxgi_textures(const ProbeGrid& grid, double gamma) {
  check(grid, gamma);
  std::vector<RtxgiTexture> textures;
  // E = π times the mean that `diffuse` holds.
  textures.push_back(converted(grid, needed(grid, "diffuse"), "irradiance", {"R", "G", "B", "A"},
                               [gamma](const float* from, float* to) {
                                 for (int c = 0; c < 3; ++c)
                                   to[c] = static_cast<float>(
                                       std::pow(std::max(0.0, static_cast<double>(from[c])) / 2, 1 / gamma));
                                 to[3] = 1;
                               }));
  textures.push_back(
      converted(grid, needed(grid, "depth"), "distance", {"R", "G"}, [](const float* from, float* to) {
        to[0] = from[0] / 2;
        to[1] = from[1] / 2;
      }));
  RtxgiTexture data{"data", {"R", "G", "B", "A"}, grid.probes.counts[1], Image()};
  const int columns = grid.probes.counts[0];
  data.image = Image(columns, grid.probes.counts[1] * grid.probes.counts[2], 4);
  for (int i = 0; i < grid.probes.count(); ++i)
    data.image.at(i % columns, i / columns)[3] = grid.inside(i) ? 1.0f : 0.0f;
  textures.push_back(std::move(data));
  return textures;
}

std::string rtxgi_json(const ProbeGrid& grid, const std::vector<std::string>& files, double gamma) {
  check(grid, gamma);
  require(files.size() == 3, "RTXGI's textures are three");
  const ProbeBox& probes = grid.probes;
  const Vec3d middle = 0.5 * (probes.box.least + probes.box.most), spacing = probes.spacing();
  const ProbeAtlas &diffuse = needed(grid, "diffuse"), &depth = needed(grid, "depth");
  const auto line = [](const std::string& name, const std::string& value) {
    return "  \"" + name + "\": " + value + ",\n";
  };
  std::string json = "{\n";
  json += line("coordinateSystem", "\"RTXGI_COORDINATE_SYSTEM_RIGHT\"");
  json += line("origin", three(middle.x, middle.y, middle.z));
  json += line("probeSpacing", three(spacing.x, spacing.y, spacing.z));
  json += line("probeCounts", three(probes.counts[0], probes.counts[1], probes.counts[2]));
  json += line("probeNumIrradianceTexels", std::to_string(diffuse.pitch()));
  json += line("probeNumIrradianceInteriorTexels", std::to_string(diffuse.size));
  json += line("probeNumDistanceTexels", std::to_string(depth.pitch()));
  json += line("probeNumDistanceInteriorTexels", std::to_string(depth.size));
  json += line("probeDistanceExponent", depth.lobe.substr(depth.lobe.find('=') + 1));
  json += line("probeIrradianceEncodingGamma", number_text(gamma));
  json += line("probesInside", std::to_string(grid.inside_count()));
  json += line("slices", std::to_string(probes.counts[1]));
  json += "  \"files\": {\"irradiance\": \"" + files[0] + "\", \"distance\": \"" + files[1] +
          "\", \"data\": \"" + files[2] + "\"}\n}\n";
  return json;
}

}  // namespace welkin::scene
