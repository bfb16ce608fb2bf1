#include "project_grid.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>

#include "progress.h"
#include "welkin/io/output_file.h"
#include "welkin/render/probes/rtxgi_probes.h"

namespace welkin::cli {
namespace {

int whole(std::string_view option, double number) {
  if (!(number >= 1 && number <= 1 << 20) || number != std::floor(number))
    throw UsageError(fmt::format("{}: {} is not a whole number from 1 on", option, number));
  return static_cast<int>(number);
}

/// `probes.exr` and `diffuse`: `probes_diffuse.exr`.
std::filesystem::path file_of(const std::filesystem::path& out, const std::string& name) {
  std::filesystem::path file = out.parent_path() / out.stem();
  file += "_" + name;
  file += out.extension();
  return file;
}

/// A picture for a file; of a texture array, a slice of it.
struct Piece {
  std::filesystem::path file;
  ImageView<const float> image;
  std::vector<std::string> channels;
  int slices = 1;
};

void write_all(const std::vector<Piece>& pieces, const WriteFlags& write) {
  const io::WriteOptions how = write.parse().image;
  const io::WriteReport report = io::write_set(
      pieces.size(),
      [&](std::size_t i) {
        const Piece& piece = pieces[i];
        io::WriteFile file{piece.file, {}};
        const bool array = io::capabilities_for(piece.file).texture && piece.slices > 1;
        const int slices = array ? piece.slices : 1, height = piece.image.height / slices;
        for (int slice = 0; slice < slices; ++slice)
          file.parts.push_back({.name = {},
                                .image = piece.image.part(0, slice * height, piece.image.width, height),
                                .channels = piece.channels,
                                .layer = slice});
        return file;
      },
      how);
  report_losses(pieces.front().file.string(), report);
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  io::OutputFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace

void GridFlags::add(Command command) {
  command.add_option(
      "--grid", counts,
      "NX,NY,NZ: project at so many places of a grid, into atlases: OUT's name with _radiance, _diffuse… "
      "before the extension, and a .json that describes them");
  command.add_option(
      "--box", box,
      "X0,Y0,Z0,X1,Y1,Z1 around the grid, cut into as many cells, a probe in the middle of each. "
      "Default: the scene's");
  command
      .add_option("--layout", layout,
                  "Of the grid's files: welkin, or rtxgi, the textures of NVIDIA's RTXGI-DDGI")
      .show_default();
  command
      .add_option("--diffuse-size", diffuse_size,
                  "Texels along a side of a probe's diffuse light; 0: none. Default: 8, of rtxgi 6")
      .within(0, 1024);
  command
      .add_option("--depth-size", depth_size,
                  "Texels along a side of a probe's distances; 0: none. Default: 16, of rtxgi 14")
      .within(0, 1024);
  command.add_option("--roughness", roughness, "Of the grid: also GGX at these, 0.25,0.5,1. Default: none");
}

namespace {

/// Whether the files can be written, before there is anything to write.
void check_files(const GridFlags::Request& request, const std::string& out, const WriteFlags& write) {
  const scene::ProbeGridOptions& options = request.options;
  const std::vector<std::string> rgb{"R", "G", "B"}, rgba{"R", "G", "B", "A"};
  const io::WriteOptions how = write.parse().image;
  const auto check = [&](const std::string& name, int size, const std::vector<std::string>& channels) {
    const double pitch = size + 2 * options.border, width = pitch * request.counts[0],
                 height = pitch * request.counts[1] * request.counts[2];
    // What is larger is refused by the grid itself.
    if (size == 0 || width > 1 << 20 || height > 1 << 20) return;
    try {
      io::check_write(file_of(out, name), static_cast<int>(width), static_cast<int>(height), channels, how);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::unsupported || error.kind() == ErrorKind::bad_request)
        throw UsageError(error.what());
      throw;
    }
  };
  if (request.rtxgi) {
    check("irradiance", options.diffuse_size, rgba);
    check("distance", options.depth_size, {"R", "G"});
    return;
  }
  check("radiance", options.size, rgb);
  check("diffuse", options.diffuse_size, rgb);
  check("depth", options.depth_size, {"Z", "Z2"});
}

}  // namespace

void GridFlags::check_unused() const {
  const auto unused = [](const char* option, bool given) {
    if (given) throw UsageError(std::string(option) + ": goes with --grid");
  };
  unused("--box", !box.empty());
  unused("--layout", layout != "welkin");
  unused("--diffuse-size", diffuse_size.has_value());
  unused("--depth-size", depth_size.has_value());
  unused("--roughness", !roughness.empty());
}

GridFlags::Request GridFlags::parse(const std::string& out, const std::string& size, int samples,
                                    const WriteFlags& write) const {
  Request request;
  const std::vector<double> n = parse_numbers("--grid", counts);
  if (n.size() != 3) throw UsageError("--grid: '" + counts + "' is not NX,NY,NZ");
  for (std::size_t i = 0; i < 3; ++i) request.counts[i] = whole("--grid", n[i]);
  if (!box.empty()) {
    const std::vector<double> b = parse_numbers("--box", box);
    if (b.size() != 6) throw UsageError("--box: '" + box + "' is not X0,Y0,Z0,X1,Y1,Z1");
    request.box = scene::Bounds{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
  }
  const std::vector<std::string> layouts{"welkin", "rtxgi"};
  if (layout != "welkin" && layout != "rtxgi")
    throw UsageError("--layout: " + unknown_name("layout", layout, layouts));
  request.rtxgi = layout == "rtxgi";
  if (request.rtxgi && !roughness.empty())
    throw UsageError("--roughness: the layout rtxgi has no reflections");
  if (request.rtxgi && write.border > 1) throw UsageError("--border: the layout rtxgi has a border of 1");
  scene::ProbeGridOptions& options = request.options;
  if (request.rtxgi) options = scene::rtxgi_options();
  if (!size.empty()) options.size = whole("--size", parse_numbers("--size", size).at(0));
  options.samples = samples;
  options.border = std::max(1, write.border);
  if (diffuse_size) options.diffuse_size = *diffuse_size;
  if (depth_size) options.depth_size = *depth_size;
  if (request.rtxgi && (options.diffuse_size == 0 || options.depth_size == 0))
    throw UsageError("--layout: rtxgi needs diffuse light and distances");
  if (!roughness.empty()) options.roughness = parse_numbers("--roughness", roughness);
  check_files(request, out, write);
  return request;
}

void GridFlags::run(const Request& request, const scene::ShadedScene& seen, const std::string& out,
                    const WriteFlags& write) const {
  const scene::ProbeBox probes =
      request.box
          ? scene::ProbeBox{*request.box, request.counts}
          : parse_option("--box", [&] { return scene::probes_in(seen.scene.scene(), request.counts); });
  scene::ProbeGridOptions options = request.options;
  options.monitor = progress_monitor("project");
  const scene::ProbeGrid grid = [&] {
    try {
      return scene::project_grid(seen, probes, options);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::bad_request || error.kind() == ErrorKind::too_large)
        throw UsageError(std::string("--grid: ") + error.what());
      throw;
    }
  }();
  end_progress();
  std::vector<Piece> pieces;
  std::vector<std::string> names;
  std::vector<scene::RtxgiTexture> textures;
  if (request.rtxgi) {
    textures = scene::rtxgi_textures(grid);
    for (const scene::RtxgiTexture& texture : textures)
      pieces.push_back({file_of(out, texture.name), texture.image.view(), texture.channels, texture.slices});
  } else {
    for (const scene::ProbeAtlas& atlas : grid.atlases)
      pieces.push_back({file_of(out, atlas.name), atlas.image.view(), atlas.channels});
  }
  for (const Piece& piece : pieces) names.push_back(piece.file.filename().string());
  write_all(pieces, write);
  const std::string text =
      request.rtxgi ? scene::rtxgi_json(grid, names) : scene::probe_grid_json(grid, names);
  write_text(std::filesystem::path(out).replace_extension(".json"), text);
  if (const int inside = grid.inside_count())
    print_warning(out,
                  fmt::format("{} of {} probes see the backs of triangles, so they are taken to be inside "
                              "bodies, and look-ups leave them out",
                              inside, probes.count()));
}

}  // namespace welkin::cli
