#include "welkin/harmonics/dering.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/harmonics/zonal.h"

namespace welkin::harmonics {
namespace {

/// Convolved values are held this share of the mean above 0 at the minima that are found, so that between
/// them they don't go below.
constexpr double kMargin = 1e-7;

/// Minima that are found at most, and rounds over them.
constexpr int kMostMinima = 200, kRounds = 2000;

/// Σ_l parts[l] (1 − cut[l]) ≥ 0, of the values of each degree along a direction, degree 0 first.
using Parts = std::vector<double>;

/// The cuts 0 … 1 of degrees 1, 2, … with the least Σ weights[l] cut[l]², by coordinate ascent over the
/// multipliers of the constraints (Hildreth 1957).
class LeastCuts {
 public:
  explicit LeastCuts(std::vector<double> weights) : weights_(std::move(weights)), sums_(weights_.size()) {}

  void add(const Parts& parts) {
    double limit = 0;
    for (const double part : parts) limit += part;
    constraints_.push_back({parts, limit - kMargin * parts[0], 0});
  }

  /// 1 − cut of each degree.
  std::vector<double> solve() {
    for (int round = 0; round < kRounds; ++round) {
      double largest = 0;
      for (Constraint& each : constraints_) {
        const double before = each.multiplier;
        satisfy(each);
        largest =
            std::max(largest, std::fabs(each.multiplier - before) / (1e-300 + std::fabs(each.multiplier)));
      }
      if (largest < 1e-12) break;
    }
    std::vector<double> factors{1};
    for (std::size_t l = 1; l < weights_.size(); ++l) factors.push_back(1 - cut(l, 0, 0));
    return factors;
  }

 private:
  /// Σ parts · cut ≤ limit.
  struct Constraint {
    Parts parts;
    double limit, multiplier;
  };

  /// From the derivative of Σ weights cut² + multiplier (parts · cut − limit), with a multiplier smaller by
  /// `more`.
  double cut(std::size_t l, double part, double more) const {
    return weights_[l] > 0 ? std::clamp((sums_[l] + more * part) / (2 * weights_[l]), 0.0, 1.0) : 0;
  }

  /// Sets a multiplier so that the constraint holds with the others as they are; 0 where it holds without.
  void satisfy(Constraint& each) {
    const auto excess = [&](double multiplier) {
      double sum = -each.limit;
      for (std::size_t l = 1; l < weights_.size(); ++l)
        sum += each.parts[l] * cut(l, each.parts[l], each.multiplier - multiplier);
      return sum;
    };
    // It falls as the multiplier grows: cuts go along −parts.
    double low = 0, high = 0;
    if (excess(0) > 0) {
      // Linear as long as no cut is at its limits.
      double slope = 0;
      for (std::size_t l = 1; l < weights_.size(); ++l)
        if (weights_[l] > 0) slope += each.parts[l] * each.parts[l] / (2 * weights_[l]);
      high = std::max(each.multiplier + excess(each.multiplier) / slope, 1e-30);
      if (std::fabs(excess(high)) > 1e-14) {
        while (excess(high) > 0 && high < 1e300) high *= 4;
        for (int step = 0; step < 200; ++step) {
          const double middle = low + (high - low) / 2;
          if (middle <= low || middle >= high) break;
          (excess(middle) > 0 ? low : high) = middle;
        }
      }
    }
    for (std::size_t l = 1; l < weights_.size(); ++l) sums_[l] -= (high - each.multiplier) * each.parts[l];
    each.multiplier = high;
  }

  std::vector<double> weights_, sums_;
  std::vector<Constraint> constraints_;
};

/// Values of each degree of a channel along a direction.
Parts parts_along(const SphericalHarmonics& f, int channel, const Vec3d& direction) {
  std::vector<double> functions(static_cast<std::size_t>(f.count()));
  evaluate_functions(f.degree(), direction, functions);
  Parts parts(static_cast<std::size_t>(f.degree()) + 1);
  for (int l = 0; l <= f.degree(); ++l) {
    for (int m = -l; m <= l; ++m)
      parts[static_cast<std::size_t>(l)] +=
          functions[static_cast<std::size_t>(index_of(l, m))] * f.at(l, m, channel);
  }
  return parts;
}

/// The channels from … to − 1 as a function of their own.
SphericalHarmonics channels_of(const SphericalHarmonics& f, int from, int to) {
  SphericalHarmonics result(f.degree(), to - from);
  for (int l = 0; l <= f.degree(); ++l) {
    for (int m = -l; m <= l; ++m) {
      for (int c = from; c < to; ++c) result.at(l, m, c - from) = f.at(l, m, c);
    }
  }
  return result;
}

/// The factors of convolved channels.
std::vector<double> factors_of(const SphericalHarmonics& f) {
  std::vector<double> weights(static_cast<std::size_t>(f.degree()) + 1);
  for (int l = 1; l <= f.degree(); ++l) {
    for (int c = 0; c < f.channels(); ++c)
      weights[static_cast<std::size_t>(l)] += f.norm(l, c) * f.norm(l, c);
  }
  // Of one scale, whatever the radiance's.
  double scale = 0;
  for (const double weight : weights) scale = std::max(scale, weight);
  for (double& weight : weights) weight = scale > 0 ? weight / scale : 0;
  LeastCuts cuts(weights);
  std::vector<double> factors(weights.size(), 1.0);
  for (int found = 0; found < kMostMinima; ++found) {
    const SphericalHarmonics now = convolved(f, factors);
    bool negative = false;
    for (int c = 0; c < f.channels(); ++c) {
      const Extremum least = minimum_of(now, c);
      if (least.value >= 0) continue;
      negative = true;
      Parts parts = parts_along(f, c, least.direction);
      const double mean = parts[0];
      for (double& part : parts) part /= mean;
      cuts.add(parts);
    }
    if (!negative) return factors;
    factors = cuts.solve();
  }
  // What rounding leaves below 0: a share of the mean instead of all but the mean.
  for (double shrink = 1 - kMargin; shrink > 0; shrink = 1 - 4 * (1 - shrink)) {
    std::vector<double> less = factors;
    for (std::size_t l = 1; l < less.size(); ++l) less[l] *= shrink;
    const SphericalHarmonics now = convolved(f, less);
    bool negative = false;
    for (int c = 0; c < f.channels(); ++c) negative = negative || minimum_of(now, c).value < 0;
    if (!negative) return less;
  }
  std::fill(factors.begin() + 1, factors.end(), 0.0);
  return factors;
}

}  // namespace

Deringing dering(const SphericalHarmonics& harmonics, std::span<const double> zonal,
                 DeringChannels channels) {
  const SphericalHarmonics f = convolved(harmonics, zonal);
  Deringing result{harmonics, {}, {}, {}, 0};
  std::vector<int> dark;
  for (int c = 0; c < f.channels(); ++c) {
    result.before.push_back(minimum_of(f, c));
    result.after.push_back(result.before.back());
    result.factors.emplace_back(static_cast<std::size_t>(f.degree()) + 1, 1.0);
    if (result.before.back().value < 0 && f.at(0, 0, c) <= 0)
      throw Error(ErrorKind::bad_value, "channel " + f.channel_names[static_cast<std::size_t>(c)] +
                                            " has no positive mean: no window keeps it from being negative");
  }
  const bool each = channels == DeringChannels::each;
  for (int from = 0; from < f.channels(); from += each ? 1 : f.channels()) {
    const int to = each ? from + 1 : f.channels();
    const bool negative = std::any_of(result.before.begin() + from, result.before.begin() + to,
                                      [](const Extremum& least) { return least.value < 0; });
    if (!negative) continue;
    std::vector<double> factors = factors_of(channels_of(f, from, to));
    for (std::size_t l = 1; l < factors.size(); ++l) {
      if (zonal[l] == 0) factors[l] = 1;
    }
    for (int c = from; c < to; ++c) {
      result.factors[static_cast<std::size_t>(c)] = factors;
      for (int l = 0; l <= f.degree(); ++l) {
        for (int m = -l; m <= l; ++m) result.harmonics.at(l, m, c) *= factors[static_cast<std::size_t>(l)];
      }
    }
  }
  const SphericalHarmonics now = convolved(result.harmonics, zonal);
  double change = 0;
  for (std::size_t i = 0; i < now.values().size(); ++i)
    change += std::pow(now.values()[i] - f.values()[i], 2);
  result.change = change > 0 ? std::sqrt(change) / f.norm() : 0;
  for (int c = 0; c < now.channels(); ++c) result.after[static_cast<std::size_t>(c)] = minimum_of(now, c);
  return result;
}

}  // namespace welkin::harmonics
