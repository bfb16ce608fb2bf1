#pragma once

#include <array>
#include <span>
#include <string_view>

#include "welkin/base/export.h"
#include "welkin/render/probes/probe_grid.h"

/// @file
/// Light looked up between the probes of a grid.
namespace welkin::scene {

/// How probes are weighted.
struct ProbeLookUp {
  bool visibility = true;  ///< by Chebyshev's test of the distances, where the grid has them
  bool facing = true;      ///< by the side of the surface on which they are
  /// A place is taken to be so far off its surface, along the normal, in shares of the shortest spacing.
  double normal_bias = 0.1;
};

/// A probe's part in a look-up.
struct ProbeWeight {
  int index = 0;      ///< ProbeBox::index
  double weight = 0;  ///< all eight add up to 1
};

/// Looks a grid up: the eight probes about a place, trilinearly, each weighted besides by ((1 + n·p)/2)² +
/// 0.2, p the way to the probe, and by the chance that it sees the place, from the mean and variance of its
/// distances that way, cubed and at least 0.05. Probes inside bodies count only where all eight are.
/// Beyond the outermost probes, as at them. Majercik, Guertin, Nowrouzezahrai & McGuire 2019, §5.
///
/// Refers to the grid, which must outlive it. Never changes; safe from many threads.
class WELKIN_API ProbeLight {
 public:
  /// Throws Error (bad_request) for a bias that isn't finite.
  explicit ProbeLight(const ProbeGrid& grid, const ProbeLookUp& how = {});

  /// The parts of the eight probes at a place whose normal is of unit length.
  std::array<ProbeWeight, 8> weights(const Vec3d& position, const Vec3d& normal) const;

  /// Diffuse light, irradiance over π. Throws Error (bad_request) where the grid has none.
  Rgb diffuse(const Vec3d& position, const Vec3d& normal) const;
  /// GGX's along a direction, between the levels of roughness that there are; below the first, between it and
  /// `radiance`, where the grid has that. Throws Error (bad_request) where the grid has no roughness.
  Rgb specular(const Vec3d& position, const Vec3d& normal, const Vec3d& direction, double roughness) const;
  /// Of one atlas along a direction, all of its channels, bilinearly; `values` has room for them.
  void look_up(const ProbeAtlas& atlas, std::span<const ProbeWeight> weights, const Vec3d& direction,
               std::span<float> values) const;

 private:
  double seen(int index, const Vec3d& from, double distance) const;

  const ProbeGrid& grid_;
  ProbeLookUp how_;
  double bias_;
  sphere::AnyParameterization octahedral_;
  const ProbeAtlas *diffuse_, *depth_;
  struct Level {
    double roughness;
    const ProbeAtlas* atlas;
  };
  std::vector<Level> levels_;
};

}  // namespace welkin::scene
