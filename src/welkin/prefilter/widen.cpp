#include "welkin/prefilter/widen.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/number_text.h"
#include "welkin/lobe/angle.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/scalar.h"

namespace welkin::prefilter {
namespace {

/// −ln of the coefficient that a lobe may have at most at the degree of the texels.
constexpr double kDecay = 1.25;

constexpr int kMaxDegree = 32768;

/// Σ (2l + 1) λ_l P_l(1 − s) / 4π for each s. Eight at a time.
std::vector<double> series(const std::vector<double>& zonal, const std::vector<double>& positions) {
  std::vector<double> keep, bend, terms;
  for (std::size_t l = 0; l < zonal.size(); ++l) {
    const double n = static_cast<double>(l);
    keep.push_back(n / (n + 1));
    bend.push_back((2 * n + 1) / (n + 1));
    terms.push_back((2 * n + 1) * zonal[l] / (4 * kPi));
  }
  std::vector<double> sums(positions.size());
  for (std::size_t first = 0; first < positions.size(); first += 8) {
    const std::size_t count = std::min<std::size_t>(8, positions.size() - first);
    double s[8] = {}, p[8], difference[8] = {}, sum[8] = {};
    std::fill_n(p, 8, 1.0);
    std::copy_n(&positions[first], count, s);
    // D_l = P_l − P_(l−1): (l+1) D_(l+1) = l D_l − (2l+1) s P_l keeps the precision of a small s.
    for (std::size_t l = 0; l < terms.size(); ++l) {
      for (int i = 0; i < 8; ++i) {
        sum[i] += terms[l] * p[i];
        difference[i] = keep[l] * difference[i] - bend[l] * s[i] * p[i];
        p[i] += difference[i];
      }
    }
    std::copy_n(sum, count, &sums[first]);
  }
  return sums;
}

/// The lobe blurred by a Gaussian of variance `square` about its axis. `zonal`: its coefficients, up to where
/// the Gaussian's are negligible.
WidenedLobe blurred(const lobe::AnyLobe& lobe, std::vector<double> zonal, double square, double tolerance) {
  for (std::size_t l = 0; l < zonal.size(); ++l) {
    zonal[l] *= std::exp(-0.5 * square * static_cast<double>(l) * (static_cast<double>(l) + 1));
  }
  const int degree = degree_of(zonal, 1e-9);
  zonal.resize(static_cast<std::size_t>(degree) + 1);
  // The lobe's values, from its axis outward, dense where it is steep. Far out of a narrow lobe, where the
  // series would be all rounding errors, by the Gaussian's first moment: w + σ²/2 ∇²w. That leaves cusps and
  // edges as they are; wide lobes, which may have some there, have few degrees and values that don't get
  // lost.
  constexpr int kWideDegree = 768;
  std::vector<double> angles, near_nodes, degrees, values;
  constexpr int kPoints = 1500;
  const double sigma = std::sqrt(square), core = std::max(sigma, lobe.width()), scale = 1 / lobe.integral();
  const auto weight = [&](double angle) { return scale * lobe.weight(lobe::s_of_angle(angle)); };
  for (int i = 0; i <= kPoints; ++i) {
    const double part = static_cast<double>(i) / kPoints;
    angles.push_back(std::min(kPi, core * std::sinh(part * std::asinh(kPi / core))));
    if (degree <= kWideDegree || angles.back() < 12 * core)
      near_nodes.push_back(lobe::s_of_angle(angles.back()));
  }
  const std::vector<double> near_values = series(zonal, near_nodes);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double angle = angles[i];
    double value = 0;
    if (i < near_values.size()) {
      value = near_values[i];
    } else {
      const double step = std::min(angle, kPi - angle) / 64;
      const double before = weight(angle - step), at = weight(angle), after = weight(angle + step);
      value = at;
      // Across the horizon's kink the difference means nothing.
      if (std::fabs(angle - kPi / 2) > 2 * step && step > 0) {
        value +=
            square / 2 *
            ((after - 2 * at + before) / (step * step) + (after - before) / (2 * step) / std::tan(angle));
      }
    }
    degrees.push_back(angle * 180 / kPi);
    values.push_back(std::max(0.0, value));
  }
  degrees.back() = 180;
  zonal.resize(static_cast<std::size_t>(degree_of(zonal, tolerance)) + 1);
  return {
      lobe::AnyLobe::from_table(lobe.spec() + " widened by " + number_text(sigma) + " rad", degrees, values),
      std::move(zonal), sigma};
}

}  // namespace

int degree_of(const std::vector<double>& zonal, double tolerance) {
  double total = 0;
  for (std::size_t l = 0; l < zonal.size(); ++l)
    total += (2 * static_cast<double>(l) + 1) * zonal[l] * zonal[l];
  double rest = 0;
  for (std::size_t l = zonal.size(); l-- > 1;) {
    rest += (2 * static_cast<double>(l) + 1) * zonal[l] * zonal[l];
    if (rest > tolerance * tolerance * total) return static_cast<int>(l);
  }
  return 1;
}

WidenedLobe widen(const lobe::AnyLobe& lobe, double texel, double tolerance) {
  const int finest = std::clamp(static_cast<int>(kPi / texel), 1, kMaxDegree / 4);
  const int max_degree = std::clamp(static_cast<int>(24 / lobe.width()), 192, kMaxDegree);
  int known = std::min(max_degree, 4 * finest + 192);
  std::vector<double> zonal = lobe::zonal_coefficients(lobe, known);
  // A lobe with a step or a kink falls off slowly: degrees up to where it is negligible, or up to a limit of
  // cost.
  while (known < 768 && degree_of(zonal, tolerance) > known * 9 / 10) {
    known *= 2;
    zonal = lobe::zonal_coefficients(lobe, known);
  }
  if (static_cast<std::size_t>(finest) >= zonal.size() ||
      std::fabs(zonal[static_cast<std::size_t>(finest)]) <= std::exp(-kDecay)) {
    const int needed = degree_of(zonal, tolerance);
    const int degree = std::max(needed, std::min(kCheapDegree, degree_of(zonal, tolerance / 20)));
    // Float's own rounding is about 1e-7 of the light.
    const bool smooth = degree_of(zonal, 1e-7) <= kCheapDegree;
    zonal.resize(static_cast<std::size_t>(smooth ? degree_of(zonal, 1e-7) : degree) + 1);
    return {lobe, std::move(zonal), 0, smooth};
  }
  const double square = 2 * (kDecay + std::log(std::fabs(zonal[static_cast<std::size_t>(finest)]))) /
                        (static_cast<double>(finest) * (finest + 1));
  return blurred(lobe, std::move(zonal), square, tolerance);
}

lobe::AnyLobe without_finer_than(const lobe::AnyLobe& lobe, double texel, double tolerance) {
  if (lobe.is_mirror()) return lobe;
  constexpr int kFew = 64, kFewCheap = 96;
  const int most = std::clamp(static_cast<int>(kPi / texel), kFew, kMaxDegree / 8);
  const int known = std::max(768, 4 * most);
  std::vector<double> zonal = lobe::zonal_coefficients(lobe, known);
  // All of the degrees that widen chooses by; on coarse texels the last, of smooth lobes, is the cheapest.
  const bool coarse = most == kFew;
  const auto few_with = [&](double square) {
    std::vector<double> less = zonal;
    for (std::size_t l = 0; l < zonal.size(); ++l) {
      const double n = static_cast<double>(l);
      less[l] *= std::exp(-0.5 * square * n * (n + 1));
    }
    return degree_of(less, tolerance) <= most &&
           degree_of(less, coarse ? 1e-7 : tolerance / 20) <= std::max(kFewCheap, most * 5 / 4);
  };
  if (few_with(0)) return lobe;
  // The least Gaussian that suffices; at the last degree known even the smallest leaves e^−20.
  double low = 40.0 / (static_cast<double>(known) * known), high = 40.0 / (static_cast<double>(most) * most);
  if (few_with(low)) high = low;
  while (high > 1.02 * low) {
    const double middle = std::sqrt(low * high);
    (few_with(middle) ? high : low) = middle;
  }
  return blurred(lobe, std::move(zonal), high, tolerance).lobe;
}

}  // namespace welkin::prefilter
