#pragma once

#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/math/rotation.h"
#include "welkin/math/vec.h"

/// @file
/// Functions on the sphere as sums of real spherical harmonics.
///
/// Y_lm of degree l and order m, −l ≤ m ≤ l, orthonormal over the sphere, without the sign (−1)^m: with
/// azimuth φ = atan2(y, x) and P̄ the normalised Legendre functions,
/// Y_l0 = P̄_l0(z), Y_lm = √2 P̄_lm(z) cos mφ, Y_l,−m = √2 P̄_lm(z) sin mφ. So Y_1,−1 ∝ +y, Y_10 ∝ +z, Y_11 ∝
/// +x, of the native world (docs/conventions.md). Coefficients stand at l(l + 1) + m (docs/harmonics.md).
namespace welkin::harmonics {

/// The largest degree that anything here takes: rotation is exact so far.
inline constexpr int kMaxDegree = 96;

/// Where Y_lm stands among all.
constexpr int index_of(int l, int m) {
  return l * (l + 1) + m;
}

/// How many there are up to a degree: (degree + 1)².
constexpr int count_of(int degree) {
  return (degree + 1) * (degree + 1);
}

/// Y_lm along a unit direction, count_of(degree) values, to 1e-13. Throws Error (bad_request) for a degree
/// outside 0 … kMaxDegree and for spans of another size.
WELKIN_API void evaluate_functions(int degree, const Vec3d& direction, std::span<double> out);

/// A function on the sphere with several channels, as coefficients. A value, copied freely.
class WELKIN_API SphericalHarmonics {
 public:
  /// All 0, with the channel names of default_channel_names. Throws Error (bad_request) for a degree outside
  /// 0 … kMaxDegree, and for channels outside 1 … kMaxChannels.
  SphericalHarmonics(int degree, int channels);

  int degree() const { return degree_; }           ///< the largest l
  int channels() const { return channels_; }       ///< values of a coefficient
  int count() const { return count_of(degree_); }  ///< coefficients of a channel

  /// The coefficient of Y_lm, 0 ≤ l ≤ degree, −l ≤ m ≤ l, in a channel; nothing checks.
  /// @{
  double& at(int l, int m, int channel) { return values_[place(index_of(l, m), channel)]; }
  double at(int l, int m, int channel) const { return values_[place(index_of(l, m), channel)]; }
  /// @}

  /// All of them, coefficient by coefficient, the channels of each side by side; valid as long as this.
  /// @{
  std::span<double> values() { return values_; }
  std::span<const double> values() const { return values_; }
  /// @}

  /// The value along a unit direction, one for each channel. Throws Error (bad_request) for a span of another
  /// size.
  void evaluate(const Vec3d& direction, std::span<double> out) const;
  /// The same along many: out[i·channels + channel]. In parallel.
  void evaluate(std::span<const Vec3d> directions, std::span<double> out) const;

  /// Root of the sum of all squares: 4π times the mean square over the sphere, over all channels.
  double norm() const;
  /// The same of the coefficients of one degree in a channel.
  double norm(int l, int channel) const;

  /// Adds another function of as many channels; the degree becomes the larger one. Throws Error (mismatch).
  SphericalHarmonics& operator+=(const SphericalHarmonics& other);
  /// Scales all.
  SphericalHarmonics& operator*=(double factor);

  /// One name for each channel, as of a Map.
  std::vector<std::string> channel_names;

 private:
  std::size_t place(int index, int channel) const {
    return static_cast<std::size_t>(index) * static_cast<std::size_t>(channels_) +
           static_cast<std::size_t>(channel);
  }

  int degree_, channels_;
  std::vector<double> values_;
};

/// The same function with the coefficients up to another degree; those that it lacks are 0.
WELKIN_API SphericalHarmonics with_degree(const SphericalHarmonics& harmonics, int degree);

/// The function g with g(rotation·d) = f(d): what was seen along d is seen along rotation·d. The matrix may
/// reflect. To 1e-12 of the norm up to degree 64, 1e-9 up to 96: the recurrence loses digits beyond. Throws
/// Error (bad_request) for a matrix that isn't orthonormal. By the recurrence of Ivanic & Ruedenberg (J.
/// Phys. Chem. 100, 1996, 6342, with the corrections of 102, 1998, 9099), O(degree³).
WELKIN_API SphericalHarmonics rotated(const SphericalHarmonics& harmonics, const Matrix3& rotation);

}  // namespace welkin::harmonics
