#include "welkin/plot/draw_cone_sheet.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/sampler.h"
#include "welkin/image/drawing.h"
#include "welkin/lookup/cone_shapes.h"

namespace welkin {
namespace {

constexpr int kColumns = 4, kGap = 6, kCaption = 20;
/// Rays along a pixel's side.
constexpr int kRays = 16;

/// A pixel's cone; at a rim where its corners see everywhere, a circle as large as the pixel's solid angle.
EllipticalCone cone_of_pixel(const MapFrame& camera, int x, int y) {
  const auto& p = camera.parameterization;
  const double u = (x + 0.5) / camera.size.width, v = (y + 0.5) / camera.size.height;
  QuadCone quad;
  const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    quad.corners[i] = p.to_sphere(0, static_cast<double>(x + corners[i][0]) / camera.size.width,
                                  static_cast<double>(y + corners[i][1]) / camera.size.height);
  }
  if (fault_of(quad).empty()) return cone_of(quad);
  const double area = p.solid_angle_density(0, u, v) / (camera.size.width * camera.size.height);
  return isotropic_cone(p.to_sphere(0, u, v), std::sqrt(clamp(area, 0.0, 4 * kPi) / 12));
}

/// Writes pixels of the map's channels into a tile, brightened; grey where there is one channel.
void draw_pixel(const float* radiance, int channels, float scale, float* to) {
  for (int c = 0; c < 3; ++c) to[c] = scale * radiance[channels >= 3 ? c : 0];
}

bool is_shown(const MapFrame& camera, int x, int y) {
  return camera.parameterization.valid(0, (x + 0.5) / camera.size.width, (y + 0.5) / camera.size.height);
}

void draw_rays(const Map& map, const MapFrame& camera, float scale, ImageView<float> tile) {
  const Sampler sampler = Sampler::borrow(map, {.filter = Filter::nearest});
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  parallel_for(tile.height, [&](int y) {
    std::vector<Vec3d> rays(kRays * kRays);
    std::vector<float> radiance(rays.size() * channels);
    for (int x = 0; x < tile.width; ++x) {
      if (!is_shown(camera, x, y)) continue;
      for (int k = 0; k < kRays * kRays; ++k) {
        rays[static_cast<std::size_t>(k)] =
            camera.parameterization.to_sphere(0, (x + (k % kRays + 0.5) / kRays) / camera.size.width,
                                              (y + (k / kRays + 0.5) / kRays) / camera.size.height);
      }
      sampler.look_up(rays, radiance);
      std::vector<float> mean(channels);
      for (std::size_t i = 0; i < radiance.size(); ++i) mean[i % channels] += radiance[i] / (kRays * kRays);
      draw_pixel(mean.data(), map.channels(), scale, tile.at(x, y));
    }
  });
}

void draw_filter(const Map& map, const MapFrame& camera, ConeFilter filter, float scale,
                 ImageView<float> tile) {
  const ConeSampler sampler = ConeSampler::borrow(map, {.filter = filter});
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  parallel_for(tile.height, [&](int y) {
    std::vector<EllipticalCone> cones;
    std::vector<int> columns;
    for (int x = 0; x < tile.width; ++x) {
      if (!is_shown(camera, x, y)) continue;
      cones.push_back(cone_of_pixel(camera, x, y));
      columns.push_back(x);
    }
    std::vector<float> radiance(cones.size() * channels);
    sampler.look_up(cones, radiance);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      draw_pixel(radiance.data() + i * channels, map.channels(), scale, tile.at(columns[i], y));
    }
  });
}

}  // namespace

std::vector<ConeFilter> usable_cone_filters(const sphere::AnyParameterization& parameterization) {
  std::vector<ConeFilter> filters;
  for (const std::string& name : cone_filter_names()) {
    const ConeFilter filter = cone_filter_from_name(name);
    if (is_usable(filter, parameterization)) filters.push_back(filter);
  }
  return filters;
}

Image draw_cone_sheet(const Map& map, const ConeSheet& sheet) {
  const auto camera = sphere::AnyParameterization::make(sheet.camera);
  require(camera.charts() == 1, "a camera's picture is one chart");
  require(sheet.size >= 16 && sheet.size <= 2048, "a tile is 16 to 2048 pixels large");
  require(std::isfinite(sheet.exposure), "an exposure is not a number of stops");
  const double aspect = camera.aspect();
  const ChartSize size{std::max(1, static_cast<int>(std::lround(sheet.size * std::min(1.0, aspect)))),
                       std::max(1, static_cast<int>(std::lround(sheet.size / std::max(1.0, aspect))))};
  const MapFrame frame(camera, size);
  const std::vector<ConeFilter> filters =
      sheet.filters.empty() ? usable_cone_filters(map.parameterization) : sheet.filters;
  const float scale = static_cast<float>(std::exp2(sheet.exposure));

  const int tiles = static_cast<int>(filters.size()) + 1, columns = std::min(kColumns, tiles),
            rows = (tiles + columns - 1) / columns;
  Image picture(columns * (size.width + kGap) + kGap, rows * (size.height + kCaption + kGap) + kGap, 3);
  fill_box(picture, {0, 0, picture.width(), picture.height()}, kWhite);
  for (int i = 0; i < tiles; ++i) {
    const int left = kGap + i % columns * (size.width + kGap),
              top = kGap + i / columns * (size.height + kCaption + kGap);
    fill_box(picture, {left, top, size.width, size.height}, kBlack);
    const ImageView<float> tile = picture.view().part(left, top, size.width, size.height);
    if (i == 0) {
      draw_rays(map, frame, scale, tile);
    } else {
      draw_filter(map, frame, filters[static_cast<std::size_t>(i - 1)], scale, tile);
    }
    draw_text(picture, {std::to_string(i), left + 0.5 * size.width, top + size.height + 0.5 * kCaption, 9});
  }
  return picture;
}

}  // namespace welkin
