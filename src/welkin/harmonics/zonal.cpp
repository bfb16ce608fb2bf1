#include "welkin/harmonics/zonal.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/harmonics/extrema.h"
#include "welkin/lobe/zonal.h"
#include "welkin/map/luminance.h"

namespace welkin::harmonics {

std::vector<double> irradiance_factors(int degree) {
  require(degree >= 0 && degree <= kMaxDegree, "spherical harmonics have degrees 0 to 96");
  std::vector<double> factors(static_cast<std::size_t>(degree) + 1);
  factors[0] = kPi;
  if (degree > 0) factors[1] = 2 * kPi / 3;
  // A_2 = π/4; P_l−1(0)/P_l−3(0) = −(l − 3)… makes A_l = −A_l−2 (l − 3)/(l + 2).
  for (std::size_t l = 2; l < factors.size(); l += 2)
    factors[l] =
        l == 2 ? kPi / 4 : -factors[l - 2] * (static_cast<double>(l) - 3) / (static_cast<double>(l) + 2);
  return factors;
}

std::vector<double> lobe_factors(const lobe::AnyLobe& lobe, int degree) {
  require(degree >= 0 && degree <= kMaxDegree, "spherical harmonics have degrees 0 to 96");
  return lobe::zonal_coefficients(lobe, degree);
}

SphericalHarmonics convolved(const SphericalHarmonics& harmonics, std::span<const double> factors) {
  require(factors.size() > static_cast<std::size_t>(harmonics.degree()),
          "there is one factor for each degree");
  SphericalHarmonics result = harmonics;
  for (int l = 0; l <= result.degree(); ++l) {
    for (int m = -l; m <= l; ++m) {
      for (int c = 0; c < result.channels(); ++c) result.at(l, m, c) *= factors[static_cast<std::size_t>(l)];
    }
  }
  return result;
}

Window window_from_name(std::string_view name) {
  const std::vector<std::string> names{"none", "hann", "lanczos"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(ErrorKind::bad_request, unknown_name("window", name, names));
  constexpr Window kWindows[] = {Window::none, Window::hann, Window::lanczos};
  return kWindows[found - names.begin()];
}

std::vector<double> window_factors(Window window, int degree) {
  require(degree >= 0 && degree <= kMaxDegree, "spherical harmonics have degrees 0 to 96");
  std::vector<double> factors;
  for (int l = 0; l <= degree; ++l) {
    const double angle = kPi * l / (degree + 1);
    factors.push_back(window == Window::none || l == 0 ? 1
                      : window == Window::hann         ? 0.5 + 0.5 * std::cos(angle)
                                                       : std::sin(angle) / angle);
  }
  return factors;
}

SphericalHarmonics luminance_of(const SphericalHarmonics& harmonics) {
  const TexelLuminance luminance(harmonics.channel_names);
  SphericalHarmonics result(harmonics.degree(), 1);
  result.channel_names = {"Y"};
  for (std::size_t i = 0; i < result.values().size(); ++i)
    result.values()[i] =
        luminance.of_sums(&harmonics.values()[i * static_cast<std::size_t>(harmonics.channels())]);
  return result;
}

LinearPart linear_part(const SphericalHarmonics& harmonics, int channel) {
  require(channel >= 0 && channel < harmonics.channels(), "there is no such channel");
  LinearPart part;
  const double constant = harmonics.at(0, 0, channel);
  part.mean = constant / std::sqrt(4 * kPi);
  if (harmonics.degree() == 0) return part;
  const Vec3d vector{harmonics.at(1, 1, channel), harmonics.at(1, -1, channel), harmonics.at(1, 0, channel)};
  const double size = length(vector);
  if (size > 0) part.direction = (1 / size) * vector;
  if (constant != 0) part.ratio = size / (std::sqrt(3.0) * std::fabs(constant));
  return part;
}

ZonalFit fit_zonal(const SphericalHarmonics& harmonics, int degree) {
  require(degree >= 0 && degree <= harmonics.degree(), "a zonal fit has no more degrees than the function");
  const SphericalHarmonics f = with_degree(harmonics, degree);
  const std::size_t channels = static_cast<std::size_t>(f.channels()),
                    degrees = static_cast<std::size_t>(degree) + 1;
  // A degree's value along an axis is √((2l + 1)/4π) times the coefficient of Y_l0 with that pole.
  const auto zonal_along = [&](const Vec3d& axis, double* out) {
    std::vector<double> functions(static_cast<std::size_t>(f.count()));
    evaluate_functions(degree, axis, functions);
    std::fill_n(out, degrees * channels, 0.0);
    for (int l = 0; l <= degree; ++l) {
      const double scale = std::sqrt(4 * kPi / (2 * l + 1));
      for (int m = -l; m <= l; ++m) {
        for (std::size_t c = 0; c < channels; ++c)
          out[static_cast<std::size_t>(l) * channels + c] +=
              scale * functions[static_cast<std::size_t>(index_of(l, m))] * f.at(l, m, static_cast<int>(c));
      }
    }
  };
  ZonalFit fit;
  fit.coefficients.resize(degrees * channels);
  const auto kept = [&](std::span<const Vec3d> axes, std::span<double> values) {
    std::vector<double> zonal(degrees * channels);
    for (std::size_t i = 0; i < axes.size(); ++i) {
      zonal_along(axes[i], zonal.data());
      values[i] = 0;
      for (const double each : zonal) values[i] -= each * each;
    }
  };
  if (degree > 0) fit.axis = minimum_on_sphere(kept, 2 * degree).direction;
  zonal_along(fit.axis, fit.coefficients.data());
  // Both ends of an axis fit alike; more comes from the one that is named.
  double toward = 0;
  for (std::size_t c = 0; degree > 0 && c < channels; ++c) toward += fit.coefficients[channels + c];
  if (toward < 0) {
    fit.axis = -1.0 * fit.axis;
    zonal_along(fit.axis, fit.coefficients.data());
  }
  const double all = f.norm();
  double squares = 0;
  for (const double each : fit.coefficients) squares += each * each;
  fit.error = all > 0 ? std::sqrt(std::max(0.0, 1 - squares / (all * all))) : 0;
  return fit;
}

}  // namespace welkin::harmonics
