#pragma once

#include <vector>

#include "welkin/lobe/lobe.h"

/// Narrow lobes, whose harmonics would be too many: split in two (after P. Ewald, "Die Berechnung optischer
/// und elektrostatischer Gitterpotentiale", 1921). With χ = e^(−u)(1 + u), u = S(s + c), the far part w(1 −
/// χ) is smooth, and done by harmonics of a moderate degree L; the near part w χ is nothing beyond a small
/// angle, and is summed over the rows that near: along each row, the sum is a product of orders. c is the
/// core of a lobe that falls as (s + c)⁻², as GGX does: its far part is the integral of x e^(−x(s + c)) over
/// x from 0 to S.
namespace welkin::prefilter {

/// The near part of a lobe on a grid of rows, for orders 0 … last.
///
/// The order m of a result's row θ is Σ over rows θ′ of K_m(θ, θ′) times the order m of the masses, with
/// K_m = 1/2π ∫ near(s) cos mφ dφ, s = 1 − cos(θ − θ′) + sin θ sin θ′ (1 − cos φ).
struct NearField {
  /// `rows` is a multiple of 16. `degree`: of the harmonics that do the far part.
  NearField(const lobe::AnyLobe& lobe, const std::vector<double>& zonal, int rows, int degree,
            double tolerance);

  int rows;
  int reach;  ///< rows to either side
  int last;   ///< order

  /// Coefficients of the far part, degrees 0 … degree.
  std::vector<double> far;

  /// K of every eighth order from −8 on, cubic between: [1 + m/8][reach + offset][row], offset of the masses'
  /// row. Where it changes too fast for that, near the poles, every order has its own: see `polar`.
  std::vector<float> table;
  /// For packs of eight rows near a pole: where its own table begins in `polar_table`, [m][reach +
  /// offset][8]; −1 elsewhere.
  std::vector<std::ptrdiff_t> polar;
  std::vector<float> polar_table;
  std::vector<int> last_order;  ///< of each pack: beyond, K is nothing
};

}  // namespace welkin::prefilter
