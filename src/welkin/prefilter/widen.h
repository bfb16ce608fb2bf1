#pragma once

#include <vector>

#include "welkin/lobe/lobe.h"

/// Lobes that are narrower than texels.
///
/// Neither a source nor a level has detail finer than its texels, and a lobe much narrower
/// than both would show the texels' edges, or alias. So such a lobe is blurred by a Gaussian just wide
/// enough: at the degree π/h of the texel size h, its coefficient becomes e^−5⁄4, as a Gaussian of σ = h/2
/// alone has it. Wider lobes are unchanged.
namespace welkin::prefilter {

struct WidenedLobe {
  lobe::AnyLobe lobe;         ///< a table when it was widened
  std::vector<double> zonal;  ///< its coefficients, as far as they matter
  int degree() const { return static_cast<int>(zonal.size()) - 1; }
  double sigma = 0;     ///< of the Gaussian, radians; 0 when the lobe is unchanged
  bool smooth = false;  ///< what is left out is negligible even beside the brightest light
};

/// The lobe as wide as texels of `texel` radians need it. `tolerance`: degrees whose coefficients matter less
/// are left out (see degree_of). Not for mirrors.
WidenedLobe widen(const lobe::AnyLobe& lobe, double texel, double tolerance);

/// The lobe itself, or where it has finer details than texels of `texel` radians can show (a cusp, a ring, an
/// edge), blurred by the least Gaussian that takes them away: then no more than π/texel degrees matter, or 64
/// where that is more (see degree_of). Unlike widen, of lobes that are wide as a whole too.
lobe::AnyLobe without_finer_than(const lobe::AnyLobe& lobe, double texel, double tolerance);

/// Degrees that are cheap: up to here coefficients are kept that matter twenty times less, since a cut at the
/// horizon falls off slowly and bright lights show in dark directions.
inline constexpr int kCheapDegree = 160;

/// The least degree for which what is left out of the lobe is, in the mean square over the sphere, a
/// `tolerance` of it.
int degree_of(const std::vector<double>& zonal, double tolerance);

}  // namespace welkin::prefilter
