#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/render/shading/shading_look_ups.h"

namespace welkin::scene {
namespace {

/// Colours by elevation, straight down to straight up, with their sums, so that the mean between two
/// elevations is a difference.
class ElevationTable {
 public:
  explicit ElevationTable(std::vector<Rgb> colours) : colours_(std::move(colours)), sums_(1) {
    for (const Rgb& colour : colours_) {
      sums_.push_back(sums_.back());
      for (std::size_t c = 0; c < 3; ++c) sums_.back()[c] += colour[c];
    }
  }

  /// The mean between two elevations, −π/2 … π/2.
  Rgb mean(double low, double high) const {
    const auto last = static_cast<double>(colours_.size());
    const auto place = [&](double elevation) {
      return std::clamp((elevation / kPi + 0.5) * last, 0.0, last);
    };
    double a = place(low), b = place(high);
    // At least a texel wide: linear between them.
    if (b - a < 1) {
      const double middle = std::clamp((a + b) / 2, 0.5, last - 0.5);
      a = middle - 0.5;
      b = middle + 0.5;
    }
    const auto from = integral(a), to = integral(b);
    Rgb value{};
    for (std::size_t c = 0; c < 3; ++c) value[c] = static_cast<float>((to[c] - from[c]) / (b - a));
    return value;
  }

 private:
  std::array<double, 3> integral(double x) const {
    const auto i = std::min(static_cast<std::size_t>(x), colours_.size() - 1);
    const double f = x - static_cast<double>(i);
    std::array<double, 3> sum = sums_[i];
    for (std::size_t c = 0; c < 3; ++c) sum[c] += f * colours_[i][c];
    return sum;
  }

  std::vector<Rgb> colours_;
  std::vector<std::array<double, 3>> sums_;
};

/// A desert under a sky: dark at the horizon's lower side, bright above it.
std::vector<Rgb> desert() {
  std::vector<Rgb> colours;
  constexpr int kCount = 256;
  const auto mix = [](const Rgb& a, const Rgb& b, double t) { return (1 - t) * a + t * b; };
  for (int i = 0; i < kCount; ++i) {
    const double t = (i + 0.5) / kCount * 2 - 1;  // −1 down … 1 up
    if (t < 0) {
      colours.push_back(mix({0.05f, 0.03f, 0.02f}, {0.45f, 0.3f, 0.16f}, std::pow(-t, 0.6)));
    } else {
      colours.push_back(mix({1, 1, 1}, {0.05f, 0.14f, 0.45f}, std::pow(t, 0.5)));
    }
  }
  return colours;
}

/// `chrome`: the colour of the elevations that the reflected cone covers, and highlights of point lights
/// (Greene 1986: cheap chrome).
class ChromeShading : public Shading {
 public:
  ChromeShading(ElevationTable table, const ShadingOptions& options)
      : table_(std::move(table)), lights_(options.lights), exponent_(options.exponent) {}

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& at = surfaces[i];
      const RayDifferential ray = reflected(at);
      const Vec3d r = normalize(ray.direction);
      const double elevation = std::asin(std::clamp(r.y, -1.0, 1.0));
      // The elevation changes by the part of the pixel's sides along the meridian.
      const double cosine = std::max(std::sqrt(std::max(0.0, 1 - r.y * r.y)), 1e-3);
      const auto rise = [&](const Vec3d& d) { return std::abs((d.y - dot(d, r) * r.y) / cosine); };
      const double half = std::min((rise(ray.right) + rise(ray.down)) / 2 + normal_spread(at), kPi);
      radiance[i] = at.material.base_color * table_.mean(elevation - half, elevation + half);
      for (const PointLight& light : lights_) radiance[i] = radiance[i] + highlight(at, r, light);
    }
  }

 private:
  Rgb highlight(const Surface& at, const Vec3d& r, const PointLight& light) const {
    const bool far = light.kind == PointLight::Kind::directional;
    const Vec3d way = far ? -1.0 * light.direction : light.position - at.position;
    const double distance = length(way);
    if (!(distance > 0)) return {};
    const double cosine = dot(r, way) / distance;
    if (cosine <= 0 || dot(at.normal, way) <= 0) return {};
    // Phong's lobe, normalised, so that the light's energy is kept.
    const double lobe = (exponent_ + 1) / (2 * kPi) * std::pow(cosine, exponent_);
    return (far ? lobe : lobe / (distance * distance)) * Rgb(light.intensity);
  }

  ElevationTable table_;
  std::vector<PointLight> lights_;
  double exponent_;
};

}  // namespace

std::unique_ptr<Shading> make_chrome(const Worlds&, const ShadingOptions& options) {
  if (!options.picture) return std::make_unique<ChromeShading>(ElevationTable(desert()), options);
  // The middle column, the lowest row straight down.
  const Image& picture = *options.picture;
  std::vector<Rgb> colours;
  for (int y = picture.height() - 1; y >= 0; --y) {
    const float* value = picture.at(picture.width() / 2, y);
    colours.push_back(picture.channels() >= 3 ? Rgb{value[0], value[1], value[2]}
                                              : Rgb{value[0], value[0], value[0]});
  }
  return std::make_unique<ChromeShading>(ElevationTable(std::move(colours)), options);
}

}  // namespace welkin::scene
