#include "welkin/render/hybrid.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/backdrop.h"
#include "welkin/render/picture_tiles.h"
#include "welkin/render/shading/shading_look_ups.h"
#include "welkin/render/shading/sheen.h"
#include "welkin/render/shading/smooth_layers.h"

namespace welkin::scene {
namespace {

/// Surfaces that don't cover all, behind one another.
constexpr int kMostLayers = 64;
/// Parts of a pixel's light that aren't worth a ray.
constexpr float kLeast = 2e-3f;

/// A ray on its way, and what its radiance counts.
struct Way {
  RaySpread ray;
  Rgb weight;
  std::uint32_t pixel;
  float near = 0;
  int depth = 0;
  int layers = 0;
  double variance = 0;         // radians², of lobes that it has been reflected by
  std::uint32_t instance = 0;  // that it comes from
  Vec3d towards = {0, 0, 0};   // along which the map is looked up
};

/// Surfaces, and where their radiance goes.
struct ToShade {
  std::vector<Surface> surfaces;
  std::vector<Rgb> weights;
  std::vector<std::uint32_t> pixels;

  void add(const Surface& at, const Rgb& weight, std::uint32_t pixel) {
    surfaces.push_back(at);
    weights.push_back(weight);
    pixels.push_back(pixel);
  }
};

/// One tile of a picture.
class Tile {
 public:
  Tile(const TracedScene& scene, const CameraRays& camera, const Worlds& worlds, const Shading& shading,
       const HybridOptions& options)
      : scene_(scene), camera_(camera), worlds_(worlds), shading_(shading), options_(options) {}

  /// R G B A of a tile to `out`.
  void make(const PictureTile& tile, ImageView<float> out);

 private:
  void trace();
  void meet(const Way& way, const Hit& hit);
  void go_on(const Surface& at, const Way& way, const RayDifferential& along, const Rgb& weight);
  void miss(const Way& way);
  void add(std::uint32_t pixel, const Rgb& radiance) { sums_[pixel] = sums_[pixel] + radiance; }

  const TracedScene& scene_;
  const CameraRays& camera_;
  const Worlds& worlds_;
  const Shading& shading_;
  const HybridOptions& options_;
  std::vector<Way> ways_, next_;
  ToShade rough_, diffuse_;
  ToShade far_;  // places from which the map is seen
  std::vector<SurfaceCone> cones_;
  std::vector<Rgb> sums_;
  std::vector<float> alphas_;
};

void Tile::miss(const Way& way) {
  if (way.depth == 0) return;
  Surface from{};
  from.position = way.ray.origin;
  from.position_change = way.ray.origin_change;
  from.instance = way.instance;
  cones_.push_back({static_cast<std::uint32_t>(far_.surfaces.size()),
                    {way.towards, way.ray.direction_change.right, way.ray.direction_change.down},
                    std::sqrt(way.variance)});
  far_.add(from, way.weight, way.pixel);
}

void Tile::go_on(const Surface& at, const Way& way, const RayDifferential& along, const Rgb& weight) {
  const float most = std::max({weight[0], weight[1], weight[2]});
  if (!(most > 0)) return;
  Way next = way;
  next.weight = weight;
  next.near = 0;
  next.depth = way.depth + 1;
  next.layers = 0;
  next.instance = at.instance;
  next.towards = normalize(along.direction);
  const double alpha = at.material.roughness * at.material.roughness;
  next.variance += 4 * at.normal_variance + 2 * alpha * alpha;
  const bool through = dot(along.direction, at.normal) < 0;
  const Vec3d side = through ? -1.0 * at.flat_normal : at.flat_normal;
  // Interpolated normals can send a ray into the triangle's plane: it is traced above it.
  const double depth = std::min(0.0, dot(next.towards, side));
  next.ray = {at.position + scene_.clearance(at.position) * side,
              normalize(next.towards - (2 * depth) * side),
              at.position_change,
              {along.right, along.down}};
  if (most * static_cast<float>(options_.samples * options_.samples) < kLeast) {
    miss(next);
  } else {
    next_.push_back(next);
  }
}

void Tile::meet(const Way& way, const Hit& hit) {
  const Surface at = scene_.surface(way.ray, hit);
  const float alpha = at.material.alpha;
  if (alpha < 1 && way.layers < kMostLayers) {
    Way behind = way;
    behind.weight = (1.0 - alpha) * way.weight;
    behind.near = hit.distance + static_cast<float>(scene_.clearance(at.position));
    ++behind.layers;
    next_.push_back(behind);
  }
  const Rgb weight = alpha * way.weight;
  if (way.depth == 0) alphas_[way.pixel] += weight[0];
  if (alpha == 0) return;
  // Cloth and brushed metal are no mirrors, however smooth they are.
  const bool mirrors = at.material.anisotropy == 0 && !is_cloth(at.material);
  if (way.depth >= options_.depth || at.material.roughness > options_.smooth || !mirrors) {
    rough_.add(at, weight, way.pixel);
    return;
  }
  const SmoothLayers layers(at);
  add(way.pixel, weight * at.material.emission);
  diffuse_.add(at, weight * layers.diffuse, way.pixel);
  go_on(at, way, reflected(at), weight * layers.reflected);
  if (layers.refracted[0] + layers.refracted[1] + layers.refracted[2] > 0)
    go_on(at, way, refracted(at, layers.eta), weight * layers.refracted);
}

void Tile::trace() {
  std::vector<Ray> rays;
  for (const Way& way : ways_)
    rays.push_back({to_float(way.ray.origin), to_float(way.ray.direction), way.near});
  std::vector<Hit> hits(rays.size());
  scene_.closest(rays, hits, Coherence::close);
  next_.clear();
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    if (hits[i]) {
      meet(ways_[i], hits[i]);
    } else {
      miss(ways_[i]);
    }
  }
  std::swap(ways_, next_);
}

void Tile::make(const PictureTile& tile, ImageView<float> out) {
  const int samples = options_.samples;
  const auto per_pixel = static_cast<std::uint32_t>(samples * samples);
  std::vector<RaySpread> rays;
  std::vector<bool> valid;
  camera_.rays(places_of(tile, samples), 1.0 / samples, rays, valid);
  sums_.assign(static_cast<std::size_t>(tile.width * tile.height), {});
  alphas_.assign(sums_.size(), 0);
  const float share = 1 / static_cast<float>(per_pixel);
  for (std::uint32_t i = 0; i < rays.size(); ++i)
    if (valid[i]) ways_.push_back({rays[i], {share, share, share}, i / per_pixel});
  while (!ways_.empty()) trace();

  std::vector<Rgb> radiance;
  const auto collect = [&](const ToShade& shaded) {
    for (std::size_t i = 0; i < shaded.surfaces.size(); ++i)
      add(shaded.pixels[i], shaded.weights[i] * radiance[i]);
  };
  radiance.resize(std::max({rough_.surfaces.size(), diffuse_.surfaces.size(), far_.surfaces.size()}));
  if (!rough_.surfaces.empty()) shading_.shade(rough_.surfaces, radiance);
  collect(rough_);
  look_up_filtered(worlds_, diffuse_.surfaces, diffuse_light(), radiance);
  collect(diffuse_);
  look_up_cones(worlds_, far_.surfaces, cones_, {}, radiance);
  collect(far_);
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const auto i = static_cast<std::size_t>(y * tile.width + x);
      float* to = out.at(tile.x + x, tile.y + y);
      std::copy(sums_[i].begin(), sums_[i].end(), to);
      to[3] = alphas_[i];
    }
  }
}

}  // namespace

Image render_hybrid(const TracedScene& scene, const PlacedCamera& camera, const Worlds& worlds,
                    const Shading& shading, const HybridOptions& options) {
  require(options.samples >= 1 && options.samples <= kMostSamples,
          "a pixel has 1 to 64 samples along each axis");
  require(options.depth >= 0 && options.depth <= 100, "rays go on at 0 to 100 surfaces");
  require(options.smooth >= 0 && options.smooth <= 1, "a roughness is of 0 to 1");
  const MapFrame frame = frame_of(camera.camera);
  const CameraRays rays(frame, camera.position);
  prepare_smooth_layers();
  for_each_world(worlds, [](const World& world) {
    world.cones();
    world.diffuse();
  });
  Image picture(frame.size.width, frame.size.height, 4);
  for_each_tile(frame.size, part_of(options.monitor, 0, options.background ? 0.9 : 1),
                [&](const PictureTile& tile) {
                  Tile(scene, rays, worlds, shading, options).make(tile, picture.view());
                });
  if (options.background) show_behind(picture, camera, worlds.whole, part_of(options.monitor, 0.9, 1));
  return picture;
}

}  // namespace welkin::scene
