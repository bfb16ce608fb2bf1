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
/// The order m of a result's row θ is Σ over rows θ′ of K_m(θ, θ′) times the order m of its points, with
/// K_m = 1/2π ∫ near(s) cos mφ dφ, s = 1 − cos(θ − θ′) + sin θ sin θ′ (1 − cos φ).
///
/// K makes up for the fine detail across rows that is lost on the way: see kSharpening in the source.
struct NearField {
  /// `rows` is a multiple of 16. `degree`: of the harmonics that do the far part.
  NearField(const lobe::AnyLobe& lobe, const std::vector<double>& zonal, int rows, int degree,
            double tolerance);

  /// K for eight northern rows. The southern rows mirror them.
  struct Pack {
    int last;              ///< order; beyond, K is nothing
    int stride;            ///< K of every so manieth order, cubic between; a power of two
    std::ptrdiff_t begin;  ///< in `table`: [1 + m/stride][reach + offset][8] from m = −stride on
  };

  int rows;
  int reach;  ///< rows to either side
  int last;   ///< order

  /// Coefficients of the far part, degrees 0 … degree.
  std::vector<double> far;

  std::vector<Pack> packs;  ///< of rows/2 rows, from the pole to the equator
  std::vector<float> table;
};

}  // namespace welkin::prefilter
