#include "welkin/render/path/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/camera_rays.h"
#include "welkin/render/path/bsdf.h"
#include "welkin/render/path/emitters.h"
#include "welkin/render/path/path_light.h"
#include "welkin/render/shading/sheen.h"
#include "welkin/render/shading/split_sums.h"

namespace welkin::scene {
namespace {

constexpr int kTile = 8;
/// Independent batches of a pixel's paths, at most.
constexpr int kBatches = 16;
/// Surfaces that don't cover all, behind one another.
constexpr int kMostLayers = 64;
/// From here on paths end by chance.
constexpr int kRouletteDepth = 4;

const std::vector<std::string>& sampling_names() {
  static const std::vector<std::string> names{"mis", "bsdf", "light"};
  return names;
}

/// What a path brings.
struct PathSum {
  Radiance radiance{};
  double alpha = 0;
};

/// Follows paths.
class Paths {
 public:
  Paths(const TracedScene& scene, const PathLight& light, const PathOptions& options)
      : scene_(scene), light_(light), options_(options), emitters_(scene.scene()) {
    for (const Material& material : scene.scene().materials)
      transparent_ = transparent_ || material.blended || material.masked;
  }

  PathSum follow(RaySpread ray, PathNumbers& numbers) const;

 private:
  /// What a ray meets, and how far it is.
  struct Met {
    Surface at;
    double distance;
  };
  std::optional<Met> next_surface(const RaySpread& ray, PathNumbers& numbers) const;
  double unobstructed(const Vec3d& from, const Vec3d& direction, double distance) const;
  Radiance direct(const Surface& at, const Bsdf& bsdf, PathNumbers& numbers) const;
  Radiance from_emitter(const Surface& at, const Bsdf& bsdf, PathNumbers& numbers) const;
  double emission_weight(const Met& met, bool mirror, double pdf) const;
  Vec3d off_surface(const Surface& at, const Vec3d& direction) const;

  const TracedScene& scene_;
  const PathLight& light_;
  const PathOptions& options_;
  Emitters emitters_;
  bool transparent_ = false;
};

Vec3d Paths::off_surface(const Surface& at, const Vec3d& direction) const {
  const double side = dot(direction, at.flat_normal) < 0 ? -1 : 1;
  return at.position + (side * scene_.clearance(at.position)) * at.flat_normal;
}

std::optional<Paths::Met> Paths::next_surface(const RaySpread& ray, PathNumbers& numbers) const {
  Ray traced{to_float(ray.origin), to_float(ray.direction)};
  for (int layer = 0; layer < kMostLayers; ++layer) {
    const Hit hit = scene_.closest(traced);
    if (!hit) return std::nullopt;
    Surface at = scene_.surface(ray, hit);
    // A surface that covers a part is met by that part of the paths.
    const float alpha = at.material.alpha;
    if (alpha >= 1 || (alpha > 0 && numbers.single() < alpha)) return Met{at, hit.distance};
    traced.near = hit.distance + static_cast<float>(scene_.clearance(at.position));
  }
  return std::nullopt;
}

double Paths::unobstructed(const Vec3d& from, const Vec3d& direction, double distance) const {
  Ray ray{to_float(from), to_float(direction), 0, static_cast<float>(distance)};
  if (!transparent_) return scene_.occluded(ray) ? 0 : 1;
  double through = 1;
  for (int layer = 0; layer < kMostLayers && through > 0; ++layer) {
    const Hit hit = scene_.closest(ray);
    if (!hit) return through;
    const Surface at = scene_.surface({from, direction, {}, {}}, hit);
    through *= 1 - at.material.alpha;
    ray.near = hit.distance + static_cast<float>(scene_.clearance(at.position));
  }
  return through;
}

Radiance Paths::direct(const Surface& at, const Bsdf& bsdf, PathNumbers& numbers) const {
  Radiance sum{};
  if (!bsdf.scatters()) return sum;
  if (light_.is_drawn()) {
    if (const auto drawn = light_.draw(at.position, numbers)) {
      const Radiance f = bsdf.evaluate(drawn->direction);
      if (largest(f) > 0 && largest(drawn->radiance) > 0) {
        const double open = unobstructed(off_surface(at, drawn->direction), drawn->direction,
                                         std::numeric_limits<double>::infinity());
        const double cosine = std::abs(dot(at.normal, drawn->direction));
        const double weight = open * cosine * light_.light_weight(drawn->pdf, bsdf.pdf(drawn->direction));
        sum = sum + (weight / drawn->pdf) * (f * drawn->radiance);
      }
    }
  }
  if (!emitters_.empty() && options_.sampling != LightSampling::bsdf)
    sum = sum + from_emitter(at, bsdf, numbers);
  for (const PointLight& lamp : scene_.scene().lights) {
    const auto light = lamp_at(lamp, at.position);
    if (!light) continue;
    const Radiance f = bsdf.evaluate(light->direction);
    if (!(largest(f) > 0)) continue;
    const double open = unobstructed(off_surface(at, light->direction), light->direction, light->distance);
    sum = sum + (open * std::abs(dot(at.normal, light->direction))) * (f * light->irradiance);
  }
  return sum;
}

Radiance Paths::from_emitter(const Surface& at, const Bsdf& bsdf, PathNumbers& numbers) const {
  const double which = numbers.single();
  const auto [u1, u2] = numbers.pair();
  Emitters::Drawn drawn = emitters_.draw(which, u1, u2);
  const Vec3d towards = drawn.position - at.position;
  const double distance = length(towards);
  if (!(distance > 0)) return {};
  const Vec3d direction = (1 / distance) * towards;
  const Radiance f = bsdf.evaluate(direction);
  if (!(largest(f) > 0)) return {};
  drawn.hit.distance = static_cast<float>(distance);
  const Surface glow = scene_.surface({at.position, direction, {}, {}}, drawn.hit);
  const double facing = std::abs(dot(glow.flat_normal, direction));
  const double pdf = emitters_.density(glow.instance) * distance * distance / std::max(facing, 1e-9);
  const double reach = distance - 2 * scene_.clearance(glow.position) / std::max(facing, 1e-3);
  if (!(facing > 1e-9) || !(reach > 0)) return {};
  const double open = unobstructed(off_surface(at, direction), direction, reach);
  const double cosine = std::abs(dot(at.normal, direction)), alpha = glow.material.alpha;
  const double weight = open * alpha * cosine * light_.light_weight(pdf, bsdf.pdf(direction)) / pdf;
  return weight * (f * to_radiance(glow.material.emission));
}

double Paths::emission_weight(const Met& met, bool mirror, double pdf) const {
  if (mirror || emitters_.empty() || options_.sampling == LightSampling::bsdf) return 1;
  if (options_.sampling == LightSampling::light) return 0;
  const double facing = std::abs(dot(met.at.flat_normal, met.at.view));
  const double drawn =
      emitters_.density(met.at.instance) * met.distance * met.distance / std::max(facing, 1e-9);
  return pdf / (pdf + drawn);
}

PathSum Paths::follow(RaySpread ray, PathNumbers& numbers) const {
  PathSum sum;
  Radiance through{1, 1, 1};
  bool mirror = true;
  double pdf = 0;
  for (int bounce = 0;; ++bounce) {
    const auto met = next_surface(ray, numbers);
    if (!met) {
      if (bounce == 0 && !options_.background) return sum;
      const double weight = mirror ? 1 : light_.surface_weight(ray.direction, pdf);
      if (weight > 0)
        sum.radiance = sum.radiance + weight * (through * light_.seen(ray.origin, ray.direction));
      break;
    }
    const Surface& at = met->at;
    if (largest(to_radiance(at.material.emission)) > 0)
      sum.radiance =
          sum.radiance + emission_weight(*met, mirror, pdf) * (through * to_radiance(at.material.emission));
    if (bounce == options_.depth) break;
    const Bsdf bsdf(at);
    sum.radiance = sum.radiance + through * direct(at, bsdf, numbers);
    const double lobe = numbers.single();
    const auto [u1, u2] = numbers.pair();
    const auto next = bsdf.sample(lobe, u1, u2);
    if (!next) break;
    through = through * next->weight;
    if (!(largest(through) > 0)) break;
    if (bounce >= kRouletteDepth) {
      const double stay = std::clamp(largest(through), 0.05, 1.0);
      if (stay < 1 && numbers.single() >= stay) break;
      through = (1 / stay) * through;
    }
    mirror = next->mirror;
    pdf = next->pdf;
    ray = {off_surface(at, next->direction), next->direction, {}, {}};
  }
  sum.alpha = 1;
  if (options_.clamp > 0)
    for (double& value : sum.radiance) value = std::min(value, options_.clamp);
  return sum;
}

/// Means of batches, and what they spread by.
class PixelSum {
 public:
  void add(int batch, const PathSum& path) {
    auto& sums = sums_[static_cast<std::size_t>(batch)];
    for (std::size_t c = 0; c < 3; ++c) sums[c] += path.radiance[c];
    sums[3] += path.alpha;
  }

  void write(int samples, float* mean, float* error) const {
    const int batches = std::min(samples, kBatches);
    for (std::size_t c = 0; c < 4; ++c) {
      double all = 0, squares = 0;
      for (const auto& sums : sums_) all += sums[c];
      const double middle = all / samples;
      for (int b = 0; b < batches; ++b) {
        const int paths = (samples - b + batches - 1) / batches;
        const double apart = sums_[static_cast<std::size_t>(b)][c] / paths - middle;
        squares += paths * apart * apart;
      }
      mean[c] = static_cast<float>(middle);
      error[c] = batches > 1 ? static_cast<float>(std::sqrt(squares / (batches - 1) / samples))
                             : std::numeric_limits<float>::infinity();
    }
  }

 private:
  std::array<std::array<double, 4>, kBatches> sums_{};
};

}  // namespace

LightSampling light_sampling_from_name(std::string_view name) {
  for (std::size_t i = 0; i < sampling_names().size(); ++i)
    if (name == sampling_names()[i]) return static_cast<LightSampling>(i);
  throw Error(ErrorKind::bad_request, unknown_name("sampling", name, sampling_names()));
}

std::string_view name_of(LightSampling sampling) {
  return sampling_names().at(static_cast<std::size_t>(sampling));
}

PathPicture path_trace(const TracedScene& scene, const PlacedCamera& camera, const World& world,
                       const PathOptions& options) {
  require(options.samples >= 1 && options.samples <= 1 << 20, "a pixel has 1 to 1,048,576 paths");
  require(options.depth >= 0 && options.depth <= 1000, "a path has a depth of 0 to 1000");
  require(options.clamp >= 0, "a bound of radiance is not negative");
  const MapFrame frame = frame_of(camera.camera);
  const CameraRays rays(frame, camera.position);
  const int width = frame.size.width, height = frame.size.height, samples = options.samples;
  split_sums();
  if (has_sheen(scene.scene())) sheen_sums();
  const PathLight light(world, options.sampling, without_progress(options.monitor));
  const Paths paths(scene, light, options);
  PathPicture made{Image(width, height, 4), Image(width, height, 4)};
  const int batches = std::min(samples, kBatches);
  // Of a pixel's many paths so many at once.
  constexpr int kAtOnce = 256;

  const auto make_pixel = [&](int x, int y) {
    PixelSum sum;
    const std::uint64_t pixel = scattered(options.seed) ^ scattered((static_cast<std::uint64_t>(y) << 32) |
                                                                    static_cast<std::uint32_t>(x));
    std::vector<PicturePlace> places;
    std::vector<PathNumbers> numbers;
    std::vector<RaySpread> spread;
    std::vector<bool> valid;
    for (int first = 0; first < samples; first += kAtOnce) {
      const int count = std::min(kAtOnce, samples - first);
      places.clear();
      numbers.clear();
      for (int k = first; k < first + count; ++k) {
        numbers.emplace_back(scattered(pixel + static_cast<std::uint64_t>(k % batches)),
                             static_cast<std::uint32_t>(k / batches));
        const auto [u, v] = numbers.back().pair();
        places.push_back({static_cast<float>(x + u), static_cast<float>(y + v)});
      }
      rays.rays(places, 1 / std::sqrt(samples), spread, valid);
      for (int k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (valid[i]) sum.add((first + k) % batches, paths.follow(spread[i], numbers[i]));
      }
    }
    sum.write(samples, made.picture.at(x, y), made.standard_error.at(x, y));
  };

  const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
  parallel_for(
      columns * rows,
      [&](int index) {
        const int x0 = index % columns * kTile, y0 = index / columns * kTile;
        for (int y = y0; y < std::min(y0 + kTile, height); ++y)
          for (int x = x0; x < std::min(x0 + kTile, width); ++x) make_pixel(x, y);
      },
      options.monitor);
  return made;
}

}  // namespace welkin::scene
