#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"

/// @file
/// Lobes in zonal harmonics.
namespace welkin::lobe {

/// Σ_i weights[i] P_l(1 − s[i]) for l = 0 … degree, P_l the Legendre polynomials; 0 ≤ s ≤ 1, as many weights
/// as s, degree ≥ 0; nothing checks. Keeps the precision of small s.
WELKIN_API std::vector<double> legendre_sums(std::vector<double> s, std::vector<double> weights, int degree);

/// Zonal coefficients of the normalised lobe, degrees 0 … degree, degree ≥ 0: λ_l = 2π ∫ w(s) P_l(1 − s) ds /
/// ∫ w dω, so λ_0 = 1. Convolving a map with the lobe multiplies its harmonics of degree l by λ_l
/// (Funk–Hecke). Absolute error 1e-10. Gauss–Legendre over panels that shrink toward the axis and end at the
/// lobe's breakpoints; a call costs well under a millisecond for a degree of a few hundred. 1 everywhere for
/// a mirror.
WELKIN_API std::vector<double> zonal_coefficients(const AnyLobe& lobe, int degree);

/// Truncation errors of a lobe of which degrees 0 … L alone are kept, for every L that its coefficients
/// reach; what lies beyond the coefficients given is not seen. `largest[L]` is the largest |λ_l| of l > L:
/// the RMS truncation error of a convolved map is at most that times the map's RMS. `sum[L]` is Σ (2l + 1)
/// |λ_l|/4π over l > L: the lobe, normalised to ∫ = 1, is nowhere off by more than that, sr⁻¹.
struct ZonalTail {
  std::vector<double> largest;  ///< max |λ_l| over l > L, for each L
  std::vector<double> sum;      ///< Σ (2l + 1) |λ_l|/4π over l > L, sr⁻¹, for each L
};
/// The tail of coefficients as zonal_coefficients gives them.
WELKIN_API ZonalTail zonal_tail(const std::vector<double>& coefficients);

/// The least degree L such that no |λ_l| of L < l ≤ 2L + 16 is above `tolerance` > 0; `max_degree` where that
/// is smaller. A lobe cut at the horizon decays as l^−2.5 there, a smooth one exponentially.
WELKIN_API int degree_for(const AnyLobe& lobe, double tolerance, int max_degree);

}  // namespace welkin::lobe
