#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "welkin/filter/sampler.h"
#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/texel_shape.h"

/// Trilinear look-ups whose level is real, and goes on past the coarsest to the mean. Internal to lookup.
namespace welkin {

/// A level that is looked up, and how much of the mean over the sphere is put in its place.
struct MeanLevel {
  float level, mean;
};

class Trilinear {
 public:
  explicit Trilinear(const SharedMap& map);

  std::size_t channels() const { return channels_; }
  float last_level() const { return last_; }

  /// The level whose variance is that of an isotropic Gaussian of σ² = `variance`, at texels of `area`
  /// (TexelSquares).
  MeanLevel level_of(float variance, float area) const;

  /// Whether the map shows a direction of the world.
  bool covers(const Vec3<float>& direction) const { return sampler_.covers(direction); }

  /// The areas of texels about cones.
  void areas_of(std::span<const AimedCone> cones, float* areas) const;

  /// Along directions of the world, at most kConeTile, each at its level.
  void look_up(std::span<const Vec3<float>> directions, std::span<const MeanLevel> levels,
               float* radiance) const;

 private:
  TexelSquares squares_;
  Sampler sampler_;
  std::size_t channels_;
  float last_;
  std::vector<float> mean_;
};

}  // namespace welkin
