#pragma once

#include <memory>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/view_lobe.h"

/// @file
/// A lobe as a sum of a few symmetric ones along the plane of incidence, so that a few look-ups in one
/// ordinary chain make up what no single one can: long narrow lobes, and those that end at the horizon.
namespace welkin::brdf {

/// One of a sum of lobes: one look-up in a chain.
struct LobeTerm {
  double weight = 0;  ///< those of a sum add up to 1; not negative
  double level = 0;   ///< of the chain, a real number: between two levels linear
  double tilt = 0;    ///< of its axis, as in view_lobe.h
};

/// The lobes that a chain's levels are filtered with, prepared for fits. Cheap to copy; never changes; safe
/// from many threads.
class WELKIN_API LobeBasis {
 public:
  /// `levels`, from the narrowest to the widest; a mirror among them is taken as a lobe `texel` radians wide,
  /// as look-ups of a level's texels are. Throws Error (bad_request): none, or over 32.
  explicit LobeBasis(const std::vector<lobe::AnyLobe>& levels, double texel = 0.006);

  /// How many levels there are.
  int levels() const;

  /// @cond INTERNAL
  struct Tables;
  const Tables& tables() const { return *tables_; }
  /// @endcond

 private:
  std::shared_ptr<const Tables> tables_;
};

/// The sum of at most `count` of the basis's lobes, 1 … 16, that is closest to the BRDF's lobe at n·v, in the
/// mean square over lights whose power falls with the degree as surroundings' does
/// (docs/view-dependent-lobes.md). Strongest first; fewer where more don't help. The same on every machine to
/// rounding. Throws as lobe_points does.
WELKIN_API std::vector<LobeTerm> fit_lobe_sum(const AnyBrdf& brdf, double view_cosine, const LobeBasis& basis,
                                              int count);

}  // namespace welkin::brdf
