#pragma once

#include <vector>

#include "welkin/lobe/lobe.h"

namespace welkin::lobe {

/// Zonal coefficients of the normalised lobe, degrees 0 … degree: λ_l = 2π ∫ w(s) P_l(1 − s) ds / ∫ w dω, so
/// λ_0 = 1. Convolving a map with the lobe multiplies its harmonics of degree l by λ_l (Funk–Hecke). Absolute
/// error 1e-10. Gauss–Legendre over panels that shrink toward the axis and end at the lobe's breakpoints; a
/// call costs well under a millisecond for a degree of a few hundred. 1 everywhere for a mirror.
std::vector<double> zonal_coefficients(const AnyLobe& lobe, int degree);

}  // namespace welkin::lobe
