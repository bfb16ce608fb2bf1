#pragma once

#include <vector>

/// Associated Legendre functions along latitudes, for spherical harmonics.
///
/// P̄ₗᵐ(x), x = cos θ, are normalised so that Yₗᵐ = P̄ₗᵐ(cos θ) e^{imφ} is orthonormal over the sphere; the
/// sign (−1)ᵐ is left out. With eₗ = √((l² − m²)/(4l² − 1)), x P̄ₗ = eₗ₊₁ P̄ₗ₊₁ + eₗ P̄ₗ₋₁; used twice,
///
///   eₗ₊₁ eₗ₊₂ P̄ₗ₊₂ = (x² − eₗ₊₁² − eₗ²) P̄ₗ − eₗ eₗ₋₁ P̄ₗ₋₂.
///
/// Writing P̄ₗ = sₗ Qₗ with sₗ₊₂ = 1/(eₗ₊₁ eₗ₊₂ sₗ) leaves two multiplications per degree:
///
///   Qₗ₊₂ = sₗ² (x² − eₗ₊₁² − eₗ²) Qₗ − Qₗ₋₂.
///
/// Degrees with l − m even are symmetric about the equator, the others antisymmetric, so a northern latitude
/// and its mirror image are done together.
namespace welkin::prefilter {

/// Northern latitudes in packs of eight, from the pole to the equator. Lanes past the last latitude repeat
/// it.
struct Latitudes {
  /// Rows at colatitudes (i + ½)π/rows; `rows` is even. `degree`: the largest that will be asked for.
  Latitudes(int rows, int degree);

  /// At any latitudes: cosines of colatitudes, 0 … 1.
  Latitudes(const std::vector<double>& cosines, int degree);

  int count;  ///< rows / 2
  int packs;
  std::vector<float> cosine_squared;  ///< packs × 8
  std::vector<double> cosine;
  std::vector<double> log_sine;
  std::vector<int> last_order;  ///< of each pack: for larger m, no P̄ₗᵐ up to the degree passes 2e-6
};

/// The recurrence of one order m for degrees m … degree + 1.
struct Recurrence {
  Recurrence(int m, int degree);

  int m;
  std::vector<double> center;  ///< eₗ₊₁² + eₗ², index l − m
  std::vector<double> factor;  ///< sₗ²
  std::vector<double> scale;   ///< sₗ
  std::vector<float> center32, factor32;
  double log_first;   ///< ln P̄ₘᵐ at the equator: P̄ₘᵐ = e^log_first sinᵐ θ
  double next_ratio;  ///< P̄ₘ₊₁ᵐ = next_ratio · x · P̄ₘᵐ
};

}  // namespace welkin::prefilter
