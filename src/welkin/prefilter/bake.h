#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/lobe/roughness_curve.h"
#include "welkin/map/chain.h"
#include "welkin/prefilter/paraboloid_convolution.h"
#include "welkin/prefilter/prefilter.h"

/// @file
/// From a map to the chain that a renderer loads: which levels there are, how large, filtered with what, and
/// what is noted of them.
namespace welkin {

/// How levels are filtered.
enum class BakeMethod {
  exact,                   ///< by PrefilterPlan
  paraboloid_convolution,  ///< approximately: by convolve_paraboloid (paraboloid_convolution.h)
};

/// `exact`, `paraboloid-convolution`. Throws Error (bad_request) for another name.
WELKIN_API BakeMethod bake_method_from_name(std::string_view name);

/// What is baked.
struct BakeOptions {
  /// What the levels are filtered with; of a chain, its roughness is each level's.
  lobe::AnyLobe lobe = lobe::AnyLobe::make("ggx");
  /// true: a chain over the lobe's roughness, where it has one. false: one level, filtered with the lobe as
  /// it is.
  bool chain = true;
  /// Which roughness each level of a chain has.
  lobe::RoughnessCurve curve = lobe::RoughnessCurve::from_name("linear");
  /// Of the results.
  sphere::AnyParameterization target = sphere::AnyParameterization::make("cube");
  /// Charts of level 0. Default: faces of 256 texels, of 64 for one wide lobe; about as many texels in other
  /// parameterizations; 40×20 for lambert in a latlong (Greene 1986).
  std::optional<ChartSize> size = {};
  /// Levels of a chain. 0: as many as the curve lists, or as the size has down to one texel.
  int levels = 0;
  /// Level 0 is the source resampled, whatever the curve says.
  bool mirror_level0 = false;
  /// Filter a channel A of R G B A too; otherwise it is left out, being no light.
  bool keep_alpha = false;
  /// Tolerance, orientation and borders of the results.
  PrefilterOptions prefilter = {};
  /// How levels are filtered. `paraboloid_convolution` makes paraboloid maps only, all levels from the source
  /// resampled to level 0; no tolerance holds.
  BakeMethod method = BakeMethod::exact;
  /// Of that method.
  ParaboloidConvolutionOptions paraboloid = {};
};

/// Charts of level 0: BakeOptions::size, or its default.
WELKIN_API ChartSize default_bake_size(const BakeOptions& options);

/// How many levels a chain of these options has, by BakeOptions::levels; 1 for one lobe.
WELKIN_API int bake_level_count(const BakeOptions& options);

/// The levels that bake makes. Throws Error (bad_request): more levels than the size has; a curve's list for
/// another number of levels; levels, a curve's list or mirror_level0 for a lobe without roughness; a method
/// that doesn't make maps of the target; and as roughness_levels does.
WELKIN_API std::vector<PrefilterLevel> bake_levels(const BakeOptions& options);

/// What is noted of them: lobe, roughness, curve, normalisation, software.
WELKIN_API ChainNotes bake_notes(const BakeOptions& options);

/// All of a bake that depends on sizes and lobes alone, kept for any number of maps. Never changes; safe from
/// many threads.
class WELKIN_API BakePlan {
 public:
  /// For sources of this shape; its channels are those that are filtered: 3 of R G B A, unless alpha is kept.
  /// Throws as bake_levels and PrefilterPlan do.
  BakePlan(const PrefilterShape& source, const BakeOptions& options = {});
  /// For maps like this one.
  BakePlan(const Map& source, const BakeOptions& options = {});

  /// The chain of a map, whose borders are filled; those of the chain's levels are too, unless the options
  /// say otherwise. Throws as PrefilterPlan::run does.
  Chain run(const Map& source, const Monitor& monitor = {}) const;
  /// The same, and what faults_of says of the source (of what is filtered of it), as PrefilterPlan::run does.
  Chain run(const Map& source, SourceFaults& faults, const Monitor& monitor = {}) const;

  /// Size and lobe of each level; valid as long as the plan.
  const std::vector<PrefilterLevel>& levels() const { return levels_; }
  /// How each level is computed; valid as long as the plan.
  const std::vector<PrefilterMethod>& methods() const { return methods_; }

 private:
  BakeOptions options_;
  std::vector<PrefilterLevel> levels_;
  ChainNotes notes_;
  std::optional<PrefilterPlan> plan_;  // of BakeMethod::exact
  std::vector<PrefilterMethod> methods_;
};

/// Plans and runs once. Throws as BakePlan does.
WELKIN_API Chain bake(const Map& source, const BakeOptions& options = {}, const Monitor& monitor = {});

}  // namespace welkin
