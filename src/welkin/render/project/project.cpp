#include "welkin/render/project/project.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"
#include "welkin/render/project/texel_rays.h"

namespace welkin::scene {
namespace {

constexpr int kMostSamples = 64;
constexpr double kFarthestPlace = 1e30;

std::vector<std::string> channels_of(const ProjectOptions& options) {
  std::vector<std::string> names{"R", "G", "B"};
  if (options.coverage) names.emplace_back("A");
  if (options.depth != DepthChannels::none) names.emplace_back("Z");
  if (options.depth == DepthChannels::moments) names.emplace_back("Z2");
  return names;
}

void store(const SeenTexel& texel, const ProjectOptions& options, const float* sky, int sky_channels,
           float* to) {
  for (int c = 0; c < 3; ++c) {
    to[c] = texel.radiance[static_cast<std::size_t>(c)];
    if (texel.all_sky && sky != nullptr) to[c] += sky[sky_channels >= 3 ? c : 0];
  }
  to += 3;
  if (options.coverage) *to++ = texel.coverage;
  if (options.depth != DepthChannels::none) *to++ = texel.depth;
  if (options.depth == DepthChannels::moments) *to = texel.depth_square;
}

}  // namespace

double farthest_distance(const Scene& scene, const Vec3d& position) {
  const auto box = bounds_of(scene);
  if (!box) return 1;
  const auto side = [](double at, double least, double most) {
    return std::max(std::abs(at - least), std::abs(at - most));
  };
  return length(Vec3d{side(position.x, box->least.x, box->most.x),
                      side(position.y, box->least.y, box->most.y),
                      side(position.z, box->least.z, box->most.z)});
}

Map project(const ShadedScene& seen, const Vec3d& position, const MapFrame& to,
            const ProjectOptions& options) {
  require(options.samples >= 1 && options.samples <= kMostSamples,
          "a texel has 1 to 64 samples along each axis");
  require(std::abs(position.x) <= kFarthestPlace && std::abs(position.y) <= kFarthestPlace &&
              std::abs(position.z) <= kFarthestPlace,
          "a world is projected from a finite place, at most 1e30 from the origin");
  require(!options.farthest || (*options.farthest > 0 && *options.farthest <= kFarthestPlace),
          "the farthest distance is over 0, and at most 1e30");
  require(is_orthonormal(to.orientation), "the orientation of a map must be a rotation or a reflection");
  const std::vector<std::string> names = channels_of(options);
  Map map(to.parameterization, to.size.width, to.size.height, static_cast<int>(names.size()));
  map.channel_names = names;
  map.orientation = to.orientation;
  const std::optional<FineSky> sky =
      sky_of(seen.background, to, options.samples, part_of(options.monitor, 0, 0.1));
  const double farthest = options.farthest.value_or(farthest_distance(seen.scene.scene(), position));

  const std::vector<TexelBlock> blocks = texel_blocks(map.charts(), to.size, options.samples);
  const Monitor monitor = part_of(options.monitor, sky ? 0.1 : 0, 1);
  parallel_for(
      static_cast<int>(blocks.size()),
      [&](int index) {
        const TexelBlock& block = blocks[static_cast<std::size_t>(index)];
        const TexelRays rays = texel_rays(to, block, options.samples);
        std::vector<SeenTexel> texels(rays.rays.size() / rays.per_texel);
        TexelEye(seen, sky ? &*sky : nullptr, farthest, options.shade_once).see(rays, position, texels);
        const ImageView<float> out = map.level.chart(block.chart);
        for (std::size_t i = 0; i < texels.size(); ++i) {
          if (!rays.valid[i]) continue;
          const int x = block.x + static_cast<int>(i) % block.width,
                    y = block.y + static_cast<int>(i) / block.width;
          store(texels[i], options, sky ? sky->texels.level.chart(block.chart).at(x, y) : nullptr,
                sky ? sky->texels.channels() : 0, out.at(x, y));
        }
      },
      monitor);
  fill_borders(map);
  return map;
}

}  // namespace welkin::scene
