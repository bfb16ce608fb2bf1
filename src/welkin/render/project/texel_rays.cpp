#include "welkin/render/project/texel_rays.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/proxy_rays.h"
#include "welkin/sphere/kernels.h"

namespace welkin::scene {
namespace {

/// Surfaces behind one another that a ray goes through.
constexpr int kMostLayers = 32;
/// Normals and distances of what is shaded once: the cosine, and the ratio.
constexpr float kOneSide = 0.9f, kOneDistance = 1.25f;
/// Texels of a sky as rays see it.
constexpr std::int64_t kMostSkyTexels = 1 << 22;
/// Rays of a block: what is known of them stays in a processor's second cache.
constexpr int kBlockSide = 16, kBlockRays = 128;

}  // namespace

std::vector<TexelBlock> texel_blocks(int charts, ChartSize size, int samples) {
  const int side = std::clamp(kBlockRays / samples, 1, kBlockSide);
  std::vector<TexelBlock> blocks;
  for (int chart = 0; chart < charts; ++chart)
    for (int y = 0; y < size.height; y += side)
      for (int x = 0; x < size.width; x += side)
        blocks.push_back({chart, x, y, std::min(side, size.width - x), std::min(side, size.height - y)});
  return blocks;
}

TexelRays texel_rays(const MapFrame& frame, const TexelBlock& block, int samples) {
  const auto per_texel = static_cast<std::uint32_t>(samples * samples);
  const auto texels = static_cast<std::size_t>(block.width) * static_cast<std::size_t>(block.height);
  std::vector<PicturePlace> places;
  places.reserve(texels * per_texel);
  for (int y = 0; y < block.height; ++y) {
    for (int x = 0; x < block.width; ++x) {
      for (int row = 0; row < samples; ++row) {
        for (int column = 0; column < samples; ++column) {
          const double right = (column + (row + 0.5) / samples) / samples,
                       down = (row + (column + 0.5) / samples) / samples;
          places.push_back(
              {static_cast<float>(block.x + x + right), static_cast<float>(block.y + y + down), block.chart});
        }
      }
    }
  }
  TexelRays made;
  made.block = block;
  made.samples = samples;
  made.per_texel = per_texel;
  std::vector<bool> valid;
  const CameraRays camera(frame, {0, 0, 0});
  camera.rays(places, 1.0 / samples, made.rays, valid);
  for (const RaySpread& ray : made.rays) made.directions.push_back(to_float(ray.direction));

  std::vector<PicturePlace> centres;
  for (std::size_t i = 0; i < texels; ++i) {
    const auto k = static_cast<int>(i);
    centres.push_back({static_cast<float>(block.x + k % block.width) + 0.5f,
                       static_cast<float>(block.y + k / block.width) + 0.5f, block.chart});
  }
  std::vector<RaySpread> unused;
  camera.rays(centres, 1, unused, made.valid);

  const std::size_t padded = sphere::padded(places.size());
  std::vector<float> u(padded), v(padded), density(padded);
  for (std::size_t i = 0; i < padded; ++i) {
    const PicturePlace& place = places[std::min(i, places.size() - 1)];
    u[i] = place.x / static_cast<float>(frame.size.width);
    v[i] = place.y / static_cast<float>(frame.size.height);
  }
  const sphere::AnyParameterization& p = frame.parameterization;
  p.kernels().density(p.self(), block.chart, u.data(), v.data(), density.data(), places.size());
  made.weights.assign(places.size(), 0);
  for (std::size_t texel = 0; texel < texels; ++texel) {
    if (!made.valid[texel]) continue;
    const std::size_t first = texel * per_texel;
    double sum = 0;
    for (std::size_t i = first; i < first + per_texel; ++i)
      if (valid[i] && density[i] > 0) sum += static_cast<double>(density[i]);
    made.valid[texel] = sum > 0;
    for (std::size_t i = first; sum > 0 && i < first + per_texel; ++i)
      if (valid[i] && density[i] > 0)
        made.weights[i] = static_cast<float>(static_cast<double>(density[i]) / sum);
  }
  return made;
}

TexelEye::TexelEye(const ShadedScene& seen, const FineSky* sky, double farthest, bool shade_once)
    : seen_(seen), sky_(sky), farthest_(farthest), shade_once_(shade_once) {
  const Scene& scene = seen.scene.scene();
  for (const Instance& instance : scene.instances) {
    const Material& material = material_of(scene, instance);
    opaque_.push_back(!material.masked && !material.blended);
    two_sided_.push_back(material.two_sided);
  }
}

/// Whether a hit is of a surface that its texel has met before, whose weight then grows.
bool TexelEye::joins_group(const Hit& hit, const Vec3<float>& across, float weight) {
  for (const Group& group : groups_) {
    if (group.instance != hit.instance || dot(group.across, across) < kOneSide) continue;
    if (hit.distance > kOneDistance * group.distance || group.distance > kOneDistance * hit.distance)
      continue;
    weights_[group.surface] += weight;
    return true;
  }
  return false;
}

void TexelEye::trace(const TexelRays& texels, const Vec3d& position, bool first, std::span<SeenTexel> out) {
  const Vec3<float> origin = to_float(position);
  traced_.clear();
  for (const Way& way : ways_) traced_.push_back({origin, texels.directions[way.ray], way.near});
  hits_.resize(traced_.size());
  seen_.scene.closest(traced_, hits_, Coherence::close);
  const auto farthest = static_cast<float>(farthest_);
  std::size_t left = 0;
  std::uint32_t last_texel = 0;
  groups_.clear();
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    Way way = ways_[i];
    const Hit& hit = hits_[i];
    if (!hit) {
      missed_.push_back(way);
      continue;
    }
    const std::uint32_t texel = way.ray / texels.per_texel;
    if (texel != last_texel) groups_.clear();
    last_texel = texel;
    SeenTexel& to = out[texel];
    const float ray_weight = texels.weights[way.ray];
    if (first && !two_sided_[hit.instance] && dot(hit.across, traced_[i].direction) > 0)
      to.behind += ray_weight;
    const auto covered = [&](float weight) {
      const float distance = std::min(hit.distance, farthest);
      to.coverage += weight;
      to.depth += weight * distance;
      to.depth_square += weight * distance * distance;
    };
    if (shade_once_ && opaque_[hit.instance]) {
      const float weight = way.through * ray_weight;
      const Vec3<float> across = normalize(hit.across);
      covered(weight);
      if (joins_group(hit, across, weight)) continue;
      groups_.push_back({hit.instance, across, hit.distance, surfaces_.size()});
      RaySpread ray = texels.rays[way.ray];
      ray.origin = position;
      ray.direction_change.right = static_cast<double>(texels.samples) * ray.direction_change.right;
      ray.direction_change.down = static_cast<double>(texels.samples) * ray.direction_change.down;
      surfaces_.push_back(seen_.scene.surface(ray, hit));
      weights_.push_back(weight);
      texels_.push_back(texel);
      continue;
    }
    RaySpread ray = texels.rays[way.ray];
    ray.origin = position;
    const Surface at = seen_.scene.surface(ray, hit);
    const float alpha = at.material.alpha;
    way.near = hit.distance + static_cast<float>(seen_.scene.clearance(at.position));
    if (alpha > 0) {
      const float weight = alpha * way.through * ray_weight;
      covered(weight);
      surfaces_.push_back(at);
      weights_.push_back(weight);
      texels_.push_back(texel);
    }
    way.through *= 1 - alpha;
    if (way.through > 1e-4f) ways_[left++] = way;
  }
  ways_.resize(left);
}

void TexelEye::shade(std::span<SeenTexel> out) {
  if (surfaces_.empty()) return;
  radiance_.assign(surfaces_.size(), Rgb{});
  seen_.shading.shade(surfaces_, radiance_);
  for (std::size_t i = 0; i < surfaces_.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) out[texels_[i]].radiance[c] += weights_[i] * radiance_[i][c];
}

void TexelEye::add_background(const TexelRays& texels, const Vec3d& position, std::span<SeenTexel> out) {
  const auto farthest = static_cast<float>(farthest_);
  const World* world = seen_.background;
  const bool far = world != nullptr && world->proxy().shape == Proxy::Shape::far;
  std::vector<EllipticalCone> cones;
  std::vector<std::uint32_t> from;
  for (std::uint32_t i = 0; i < missed_.size(); ++i) {
    const Way& way = missed_[i];
    SeenTexel& to = out[way.ray / texels.per_texel];
    const float weight = way.through * texels.weights[way.ray];
    to.depth += weight * farthest;
    to.depth_square += weight * farthest * farthest;
    if (world == nullptr || (far && to.all_sky)) continue;
    if (sky_ != nullptr && sky_->rays) {
      const auto texel = static_cast<int>(way.ray / texels.per_texel),
                 cell = static_cast<int>(way.ray % texels.per_texel);
      const int x = texels.block.x + texel % texels.block.width,
                y = texels.block.y + texel / texels.block.width;
      const Map& sky = *sky_->rays;
      const float* value =
          sky.level.chart(texels.block.chart)
              .at(x * texels.samples + cell % texels.samples, y * texels.samples + cell / texels.samples);
      for (std::size_t c = 0; c < 3; ++c) to.radiance[c] += weight * value[sky.channels() >= 3 ? c : 0];
      continue;
    }
    cones.push_back(cone_of(seen_from(world->proxy(), {position}, direction_of(texels.rays[way.ray]))));
    from.push_back(i);
  }
  if (cones.empty()) return;
  const int channels = world->cones().channels();
  std::vector<float> values(cones.size() * static_cast<std::size_t>(channels));
  world->cones().look_up(cones, values);
  for (std::size_t k = 0; k < cones.size(); ++k) {
    const Way& way = missed_[from[k]];
    const float* value = values.data() + k * static_cast<std::size_t>(channels);
    SeenTexel& to = out[way.ray / texels.per_texel];
    for (std::size_t c = 0; c < 3; ++c)
      to.radiance[c] += way.through * texels.weights[way.ray] * value[channels >= 3 ? c : 0];
  }
}

void TexelEye::see(const TexelRays& texels, const Vec3d& position, std::span<SeenTexel> out) {
  std::fill(out.begin(), out.end(), SeenTexel{});
  ways_.clear();
  missed_.clear();
  surfaces_.clear();
  weights_.clear();
  texels_.clear();
  for (std::uint32_t i = 0; i < texels.rays.size(); ++i)
    if (texels.weights[i] > 0) ways_.push_back({i, 1, 0});
  for (int layer = 0; layer < kMostLayers && !ways_.empty(); ++layer)
    trace(texels, position, layer == 0, out);
  shade(out);
  const bool far = seen_.background == nullptr || seen_.background->proxy().shape == Proxy::Shape::far;
  for (SeenTexel& texel : out) texel.all_sky = far && !(texel.coverage > 0);
  add_background(texels, position, out);
}

std::optional<FineSky> sky_of(const World* background, const MapFrame& frame, int samples,
                              const Monitor& monitor) {
  if (background == nullptr || background->proxy().shape != Proxy::Shape::far) return std::nullopt;
  const auto made = [&](int finer, const Monitor& part) {
    Map sky(frame.parameterization, finer * frame.size.width, finer * frame.size.height,
            background->map().channels());
    sky.orientation = frame.orientation;
    ResampleOptions options;
    options.monitor = part;
    resample(background->map(), sky, options);
    return sky;
  };
  FineSky sky{made(1, part_of(monitor, 0, 0.3)), std::nullopt};
  const std::int64_t texels = static_cast<std::int64_t>(frame.parameterization.charts()) * frame.size.width *
                              frame.size.height * samples * samples;
  if (texels <= kMostSkyTexels) sky.rays = made(samples, part_of(monitor, 0.3, 1));
  return sky;
}

}  // namespace welkin::scene
