#pragma once

#include <vector>

#include "welkin/lobe/lobe.h"

/// Ewald's split of narrow lobes, whose harmonics would be too many (P. Ewald, "Die Berechnung optischer und
/// elektrostatischer Gitterpotentiale", 1921). With χ = e^(−u)(1 + u), u = S(s + c), the far part w(1 − χ) is
/// smooth, and computed by harmonics up to a moderate degree L; the near part w χ vanishes beyond a small
/// angle, and is summed over the rows within reach: along each row, a convolution, so orders multiply. c is
/// the core of a lobe that falls as (s + c)⁻², as GGX does: its far part is the integral of x e^(−x(s + c))
/// over x from 0 to S. The derivation: docs/prefiltering-derivation.md.
namespace welkin::prefilter {

/// The near part of a lobe on a grid of rows, for orders 0 … last.
///
/// The order m of a result's row θ is Σ over rows θ′ of K_m(θ, θ′) times the order m of its points, with
/// K_m = 1/2π ∫ near(s) cos mφ dφ, s = 1 − cos(θ − θ′) + sin θ sin θ′ (1 − cos φ).
///
/// K is sharpened across the rows by as much as spreading and splines attenuate there: see kSharpening in the
/// source.
struct NearField {
  /// `rows` is a multiple of 16. `degree`: of the harmonics that do the far part.
  NearField(const lobe::AnyLobe& lobe, const std::vector<double>& zonal, int rows, int degree,
            double tolerance);

  /// K for eight northern rows. The southern rows mirror them.
  struct Pack {
    int last;              ///< largest order; beyond, K is negligible
    int stride;            ///< a power of two: orders are tabulated at this step, cubic between
    std::ptrdiff_t begin;  ///< in `table`: [1 + m/stride][reach + offset][8] from m = −stride on
  };

  int rows;
  int reach;  ///< rows to either side
  int last;   ///< largest order

  /// Coefficients of the far part, degrees 0 … degree.
  std::vector<double> far;

  std::vector<Pack> packs;  ///< of the rows/2 northern rows, from the pole to the equator
  std::vector<float> table;
};

}  // namespace welkin::prefilter
