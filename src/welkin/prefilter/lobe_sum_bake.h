#pragma once

#include <array>
#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/brdf.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/lobe_sums.h"
#include "welkin/prefilter/bake.h"

/// @file
/// A BRDF's lobes as sums of a few look-ups in an ordinary chain (docs/view-dependent-lobes.md).
namespace welkin {

/// Which sums are fitted.
struct LobeSumOptions {
  /// What reflects.
  brdf::AnyBrdf brdf = brdf::AnyBrdf::make("ggx");
  /// n·v of each, ascending, over 0 and at most 1.
  std::vector<double> view_cosines = default_view_cosines(16);
  /// Roughness of each, ascending; empty: that of the chain's levels. Not used of a BRDF without roughness.
  std::vector<double> roughness = {};
  /// Look-ups of a sum, 1 … 16: at most as many are used.
  int count = 4;
  /// The chain that is looked up. Its lobe has a roughness.
  BakeOptions bake = {};
};

/// The table alone, which doesn't depend on a map. The same whatever the number of threads. Throws as
/// bake_levels and brdf::fit_lobe_sum do, and Error (bad_request) for cosines or roughness that don't ascend.
WELKIN_API LobeSums fit_lobe_sums(const LobeSumOptions& options, const Monitor& monitor = {});

/// The chain, and the table to look it up with. Throws as bake and fit_lobe_sums do.
WELKIN_API LobeSumChain bake_lobe_sums(const Map& source, const LobeSumOptions& options = {},
                                       const Monitor& monitor = {});

/// Look-ups of such a chain: what a surface reflects, seen from any direction. Never changes after it is
/// made; all of it can be used from many threads at once. Cheap to copy but for the table.
class WELKIN_API LobeSumSampler {
 public:
  /// Move the chain in; the borders of its levels are filled. Throws as LobeSumChain::check does.
  explicit LobeSumSampler(LobeSumChain chain, const SamplerOptions& options = {});

  /// Values of a look-up.
  int channels() const { return sampler_.channels(); }

  /// The mean radiance in the lobe, channels() values: sums at the nearest two angles of view and the nearest
  /// two roughnesses, between them linear in √(n·v) and in the roughness. The radiance seen is this times
  /// albedo(). `normal` and `view` as ViewStack has them. Throws Error: a roughness out of the table's range,
  /// too little room.
  void look_up(const Vec3d& normal, const Vec3d& view, double roughness, std::span<float> radiance) const;
  /// The first three channels. Throws Error when there are fewer.
  std::array<float, 3> rgb(const Vec3d& normal, const Vec3d& view, double roughness) const;
  /// The share of light from all around that is reflected. Throws as look_up does.
  double albedo(double view_cosine, double roughness) const;

  /// What is looked up.
  const LobeSums& sums() const { return sums_; }

 private:
  LobeSums sums_;
  Sampler sampler_;
};

}  // namespace welkin
