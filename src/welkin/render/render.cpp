#include "welkin/render/render.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/backdrop.h"
#include "welkin/render/picture_tiles.h"

namespace welkin::scene {
namespace {

/// Surfaces behind one another that a ray goes through.
constexpr int kMostLayers = 32;

/// One tile of a picture.
class Tile {
 public:
  Tile(const TracedScene& scene, const CameraRays& camera, const Shading& shading,
       const RenderOptions& options)
      : scene_(scene),
        camera_(camera),
        shading_(shading),
        reflection_(options.reflection),
        samples_(options.samples) {}

  /// R G B A of a tile to `out`.
  void make(const PictureTile& tile, ImageView<float> out);

 private:
  /// A ray on its way.
  struct Way {
    std::uint32_t ray;
    float through;  ///< what is left of the light behind
    float near;
  };

  void trace(std::vector<Way>& ways);

  const TracedScene& scene_;
  const CameraRays& camera_;
  const Shading& shading_;
  Reflection reflection_;
  int samples_;
  std::vector<RaySpread> rays_;
  std::vector<bool> valid_;
  std::vector<Surface> surfaces_;
  std::vector<float> weights_;
  std::vector<std::uint32_t> pixels_;  // of each surface
  std::vector<Ray> traced_;
  std::vector<Hit> hits_;
};

void Tile::trace(std::vector<Way>& ways) {
  traced_.clear();
  for (const Way& way : ways) {
    const RaySpread& ray = rays_[way.ray];
    traced_.push_back({to_float(ray.origin), to_float(ray.direction), way.near});
  }
  hits_.resize(traced_.size());
  scene_.closest(traced_, hits_, Coherence::close);
  const auto per_pixel = static_cast<std::uint32_t>(samples_ * samples_);
  if (surfaces_.empty()) {
    surfaces_.reserve(ways.size());
    weights_.reserve(ways.size());
    pixels_.reserve(ways.size());
  }
  std::size_t left = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (!hits_[i]) continue;
    Way way = ways[i];
    Surface at = scene_.surface(rays_[way.ray], hits_[i], reflection_);
    const float alpha = at.material.alpha;
    way.near = hits_[i].distance + static_cast<float>(scene_.clearance(at.position));
    if (alpha > 0) {
      surfaces_.push_back(at);
      weights_.push_back(alpha * way.through / static_cast<float>(per_pixel));
      pixels_.push_back(way.ray / per_pixel);
    }
    way.through *= 1 - alpha;
    if (way.through > 1e-4f) ways[left++] = way;
  }
  ways.resize(left);
}

void Tile::make(const PictureTile& tile, ImageView<float> out) {
  camera_.rays(places_of(tile, samples_), 1.0 / samples_, rays_, valid_);
  std::vector<Way> ways;
  for (std::uint32_t i = 0; i < rays_.size(); ++i)
    if (valid_[i]) ways.push_back({i, 1, 0});
  surfaces_.clear();
  weights_.clear();
  pixels_.clear();
  for (int layer = 0; layer < kMostLayers && !ways.empty(); ++layer) trace(ways);
  std::vector<Rgb> radiance(surfaces_.size());
  if (!surfaces_.empty()) shading_.shade(surfaces_, radiance);
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const auto pixel = static_cast<int>(pixels_[i]);
    float* to = out.at(tile.x + pixel % tile.width, tile.y + pixel / tile.width);
    for (int c = 0; c < 3; ++c) to[c] += weights_[i] * radiance[i][static_cast<std::size_t>(c)];
    to[3] += weights_[i];
  }
}

}  // namespace

Image render(const TracedScene& scene, const PlacedCamera& camera, const World& background,
             const Shading& shading, const RenderOptions& options) {
  require(options.samples >= 1 && options.samples <= kMostSamples,
          "a pixel has 1 to 64 samples along each axis");
  const MapFrame frame = frame_of(camera.camera);
  const CameraRays rays(frame, camera.position);
  Image picture(frame.size.width, frame.size.height, 4);
  for_each_tile(
      frame.size, part_of(options.monitor, 0, options.background ? 0.9 : 1),
      [&](const PictureTile& tile) { Tile(scene, rays, shading, options).make(tile, picture.view()); });
  if (!options.background) return picture;
  show_behind(picture, camera, background, part_of(options.monitor, 0.9, 1));
  return picture;
}

PlacedCamera camera_that_sees(const Scene& scene, const Camera& like) {
  PlacedCamera placed{like, {0, 0, 0}};
  const auto box = bounds_of(scene);
  if (!box) return placed;
  const Vec3d middle = 0.5 * (box->least + box->most), half = 0.5 * (box->most - box->least);
  const MapFrame frame = frame_of(like);
  const Vec3d ahead = transpose(frame.orientation) * Vec3d{0, 0, 1};
  // The narrowest angle from the middle of the picture to its sides: those of a lens of over 120° see all.
  double angle = kPi / 3;
  for (const auto& [u, v] : {std::array{0.0, 0.5}, std::array{0.5, 0.0}}) {
    if (!frame.parameterization.valid(0, u, v)) continue;
    angle = std::min(angle, std::acos(std::clamp(frame.parameterization.to_sphere(0, u, v).z, -1.0, 1.0)));
  }
  placed.position = middle - (1.05 * length(half) / std::sin(std::max(angle, 1e-3))) * ahead;
  return placed;
}

}  // namespace welkin::scene
