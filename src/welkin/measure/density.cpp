#include "welkin/measure/density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/map/map.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// Steps of the grid over a chart that finds the neighbourhood of the extremes.
constexpr int kSteps = 128;

struct Extreme {
  double density;
  int chart = 0;
  double u = 0.5, v = 0.5;
};

class LimitSearch {
 public:
  explicit LimitSearch(const AnyParameterization& p) : p_(p) {}

  DensityLimits run() {
    double area = 0;
    for (int chart = 0; chart < p_.charts(); ++chart) {
      const bool has_rim = scan(chart);
      area += has_rim ? valid_area(chart) : 1;
    }
    refine(minimum_);
    refine(maximum_);
    return {minimum_.density, maximum_.density, area};
  }

 private:
  void take(int chart, double u, double v) {
    if (!p_.valid(chart, u, v)) return;
    const double density = p_.solid_angle_density(chart, u, v);
    if (density < minimum_.density) minimum_ = {density, chart, u, v};
    if (density > maximum_.density) maximum_ = {density, chart, u, v};
  }

  /// The last valid position on the way from a valid position to one that isn't.
  template <class IsValid>
  static double rim(double inside, double outside, const IsValid& is_valid) {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (is_valid(middle) ? inside : outside) = middle;
    }
    return inside;
  }

  /// Calls body(rim) for every change between valid and not along the line t ∈ [0, 1].
  template <class IsValid, class Body>
  static void for_each_rim(const IsValid& is_valid, const Body& body) {
    for (int i = 0; i < kSteps; ++i) {
      const double from = static_cast<double>(i) / kSteps, to = (i + 1.0) / kSteps;
      if (is_valid(from) != is_valid(to)) {
        body(is_valid(from) ? rim(from, to, is_valid) : rim(to, from, is_valid), is_valid(from));
      }
    }
  }

  /// The grid with its edges, and the rim where it crosses the grid's lines. Returns whether it does.
  bool scan(int chart) {
    bool has_rim = false;
    const auto take_rim = [&](double u, double v) {
      take(chart, u, v);
      has_rim = true;
    };
    for (int j = 0; j <= kSteps; ++j) {
      const double line = static_cast<double>(j) / kSteps;
      for (int i = 0; i <= kSteps; ++i) take(chart, static_cast<double>(i) / kSteps, line);
      for_each_rim([&](double u) { return p_.valid(chart, u, line); },
                   [&](double u, bool) { take_rim(u, line); });
      for_each_rim([&](double v) { return p_.valid(chart, line, v); },
                   [&](double v, bool) { take_rim(line, v); });
    }
    return has_rim;
  }

  /// ∫ of the valid length of rows. With v = ½ − ½ cos πs the chord of a disc is a smooth periodic function
  /// of s, which the midpoint rule integrates to many digits.
  double valid_area(int chart) const {
    constexpr int kRows = 4096;
    double area = 0;
    for (int j = 0; j < kRows; ++j) {
      const double s = (j + 0.5) / kRows;
      const double v = 0.5 - 0.5 * std::cos(kPi * s);
      const auto is_valid = [&](double u) { return p_.valid(chart, u, v); };
      double chord = is_valid(1) ? 1 : 0;
      for_each_rim(is_valid, [&](double u, bool leaves) { chord += leaves ? u : -u; });
      area += chord * 0.5 * kPi * std::sin(kPi * s) / kRows;
    }
    return area;
  }

  /// Looks closer and closer around an extreme; what is found on the way replaces it.
  void refine(const Extreme& extreme) {
    constexpr int kRounds = 48, kSide = 4;
    double reach = 1.0 / kSteps;
    for (int round = 0; round < kRounds; ++round, reach *= 0.5) {
      const Extreme centre = extreme;
      for (int j = -kSide; j <= kSide; ++j) {
        for (int i = -kSide; i <= kSide; ++i) {
          take(centre.chart, std::clamp(centre.u + reach * i / kSide, 0.0, 1.0),
               std::clamp(centre.v + reach * j / kSide, 0.0, 1.0));
        }
      }
    }
  }

  const AnyParameterization& p_;
  Extreme minimum_{std::numeric_limits<double>::infinity()};
  Extreme maximum_{-std::numeric_limits<double>::infinity()};
};

/// The density at the centres of a row's texels, as sr per texel; 0 where a centre is not valid.
void densities_at_centres(const AnyParameterization& p, ChartSize size, int chart, int row,
                          std::vector<float>& out) {
  constexpr int kBatch = 256;
  alignas(64) float u[kBatch], v[kBatch], density[kBatch], valid[kBatch];
  const float area = 1.0f / (static_cast<float>(size.width) * static_cast<float>(size.height));
  std::fill(std::begin(v), std::end(v), (static_cast<float>(row) + 0.5f) / static_cast<float>(size.height));
  for (int start = 0; start < size.width; start += kBatch) {
    const int count = std::min(kBatch, size.width - start);
    for (int i = 0; i < kBatch; ++i) {
      u[i] =
          (static_cast<float>(std::min(start + i, size.width - 1)) + 0.5f) / static_cast<float>(size.width);
    }
    p.kernels().density(p.self(), chart, u, v, density, static_cast<std::size_t>(count));
    p.kernels().valid(p.self(), chart, u, v, valid, static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      out[static_cast<std::size_t>(start + i)] = valid[i] > 0 ? density[i] * area : 0.0f;
  }
}

}  // namespace

DensityLimits density_limits(const AnyParameterization& parameterization) {
  return LimitSearch(parameterization).run();
}

DensityReport density_of(const AnyParameterization& parameterization, int size) {
  constexpr int kMaxTexels = 16384;
  if (size < 2 || size > kMaxTexels) {
    throw Error(ErrorKind::bad_request, "the density of charts can be shown for 2 to " +
                                            std::to_string(kMaxTexels) + " texels across, not " +
                                            std::to_string(size));
  }
  DensityReport report;
  report.width = size;
  report.height = std::max(1, static_cast<int>(std::lround(size / parameterization.aspect())));

  const ChartSize chart_size{size, report.height};
  std::vector<float> row(static_cast<std::size_t>(size));
  double minimum = std::numeric_limits<double>::infinity(), maximum = 0, texels = 0;
  for (int chart = 0; chart < parameterization.charts(); ++chart) {
    for (int y = 0; y < report.height; ++y) {
      densities_at_centres(parameterization, chart_size, chart, y, row);
      for (const float value : row) {
        if (!(value > 0)) continue;
        minimum = std::min(minimum, static_cast<double>(value));
        maximum = std::max(maximum, static_cast<double>(value));
        ++texels;
      }
    }
  }
  report.average = parameterization.coverage() / texels;
  report.minimum = minimum / report.average;
  report.maximum = maximum / report.average;
  report.ratio = maximum / minimum;

  // At infinite resolution.
  const DensityLimits limits = density_limits(parameterization);
  const double average_density = parameterization.coverage() / limits.valid_area;
  report.limit_minimum = limits.minimum / average_density;
  report.limit_maximum = limits.maximum / average_density;
  report.unbounded = !(limits.maximum <= kUnboundedRatio * limits.minimum);
  report.limit_ratio =
      report.unbounded ? std::numeric_limits<double>::infinity() : limits.maximum / limits.minimum;
  return report;
}

}  // namespace welkin
