#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/filter/sampler.h"
#include "welkin/lookup/elliptical_sum.h"
#include "welkin/lookup/texel_shape.h"
#include "welkin/map/pyramid.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

/// Of a Gaussian in texels, along any axis: that of bilinear interpolation, 2/12. A cone that is narrower
/// than this is read between texels as bilinear interpolation reads it.
constexpr double kLeastVariance = 1.0 / 6;

/// Hybrid: σ of the narrow side in texels of the finer level, at least, where there is a finer one.

constexpr double kTexelsPerSigma = 3.5;
/// Hybrid: of the wide side over the narrow one, at most. Longer cones are blurred across as well.
constexpr double kLongest = 16;
/// Hybrid: texels along a chart's side of its coarsest level, at least.
constexpr int kCoarsest = 8;

/// A cone as a Gaussian in texels of level 0.
struct TexelGaussian {
  TangentPlane plane;
  TexelSides sides;
  Covariance texels;

  TexelGaussian(const Map& map, const AimedCone& cone, double wide, double narrow)
      : plane(normalize(to_double(cone.direction)), to_double(cone.axis)),
        sides(texel_sides(map.parameterization, {map.width(), map.height()}, plane)),
        texels(sides.to_texels(Covariance{wide * wide, 0, narrow * narrow})) {}

  /// σ along the narrow side.
  double narrow() const { return ellipse_of(texels).narrow; }

  /// Σ of the weights for the centres of texels of a level, such that the weights of level 0's areas have
  /// that of the cone: less what the position of a texel within the level's adds, (4ˡ − 1)/12, plus that of a
  /// texel's own area, 1/12.
  Covariance at_level(int level) const {
    const double coarser = std::ldexp(1.0, 2 * level);
    const double more = (2 - coarser) / 12, least = kLeastVariance * coarser;
    const auto changed = [&](double sigma) { return std::sqrt(std::max(sigma * sigma + more, least)); };
    const Ellipse own = ellipse_of(texels);
    return sides.to_plane(covariance_of({changed(own.wide), changed(own.narrow), own.angle}));
  }
};

/// Bilinear, at the finest level: for where no texel is within reach, as at rims that a map is singular at.
class Fallback {
 public:
  explicit Fallback(const SharedMap& map) : sampler_(map) {}

  void add(const AimedCone& cone, double share, double* mean) const {
    std::array<float, kMaxChannels> values;
    sampler_.look_up(cone.world, values);
    for (int c = 0; c < sampler_.channels(); ++c) {
      mean[c] += share * static_cast<double>(values[static_cast<std::size_t>(c)]);
    }
  }

 private:
  Sampler sampler_;
};

class EwaLookUp final : public ConeLookUp {
 public:
  explicit EwaLookUp(const SharedMap& map)
      : map_(map), sum_(map->parameterization, map->level), fallback_(map) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    const int channels = map_->channels();
    for (const AimedCone& cone : cones) {
      const TexelGaussian gaussian(*map_, cone, static_cast<double>(cone.wide),
                                   static_cast<double>(cone.narrow));
      std::array<double, kMaxChannels> mean{};
      if (!sum_.add(gaussian.plane, gaussian.at_level(0), 1, mean.data()))
        fallback_.add(cone, 1, mean.data());
      for (int c = 0; c < channels; ++c) radiance[c] = static_cast<float>(mean[static_cast<std::size_t>(c)]);
      radiance += channels;
    }
  }

 private:
  SharedMap map_;
  EllipticalSum sum_;
  Fallback fallback_;
};

class HybridLookUp final : public ConeLookUp {
 public:
  explicit HybridLookUp(const SharedMap& map) : map_(map), fallback_(map) {
    int levels = 0;
    while ((std::min(map->width(), map->height()) >> (levels + 1)) >= kCoarsest) ++levels;
    pyramid_ = make_pyramid(*map, levels);
    sums_.emplace_back(map->parameterization, map->level);
    for (const Level& level : pyramid_) sums_.emplace_back(map->parameterization, level);
  }

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    const int channels = map_->channels();
    for (const AimedCone& cone : cones) {
      const double wide = static_cast<double>(cone.wide);
      const double narrow = std::max(static_cast<double>(cone.narrow), wide / kLongest);
      const TexelGaussian gaussian(*map_, cone, wide, narrow);
      const double last = static_cast<double>(pyramid_.size());
      const double level = std::clamp(std::log2(gaussian.narrow() / kTexelsPerSigma), 0.0, last);
      const int finer = static_cast<int>(level);
      const double share = level - finer;
      std::array<double, kMaxChannels> mean{};
      add(cone, gaussian, finer, 1 - share, mean.data());
      if (share > 0) add(cone, gaussian, finer + 1, share, mean.data());
      for (int c = 0; c < channels; ++c) radiance[c] = static_cast<float>(mean[static_cast<std::size_t>(c)]);
      radiance += channels;
    }
  }

 private:
  void add(const AimedCone& cone, const TexelGaussian& gaussian, int level, double share,
           double* mean) const {
    const EllipticalSum& sum = sums_[static_cast<std::size_t>(level)];
    if (!sum.add(gaussian.plane, gaussian.at_level(level), share, mean)) fallback_.add(cone, share, mean);
  }

  SharedMap map_;
  std::vector<Level> pyramid_;
  std::vector<EllipticalSum> sums_;
  Fallback fallback_;
};

}  // namespace

ConeLookUpPtr make_ewa(const SharedMap& map, const ConeSamplerOptions&) {
  return std::make_unique<EwaLookUp>(map);
}

ConeLookUpPtr make_hybrid(const SharedMap& map, const ConeSamplerOptions&) {
  return std::make_unique<HybridLookUp>(map);
}

}  // namespace welkin
