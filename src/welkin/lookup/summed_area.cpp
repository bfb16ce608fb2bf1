#include "welkin/lookup/summed_area.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// 2⁶¹ units: sums of rounded values stay below 2⁶³.
constexpr double kUnits = 2305843009213693952.0;

/// Where an interval is cut at texels: up to three runs of whole texels, and how much of each texel counts.
struct Runs {
  int count = 0;
  int edge[4];
  double part[3];

  Runs(double from, double to, int size) {
    const int first = std::clamp(static_cast<int>(std::floor(from)), 0, size - 1);
    const int last = std::clamp(static_cast<int>(std::ceil(to)) - 1, first, size - 1);
    edge[0] = first;
    if (first == last) {
      push(first + 1, to - from);
      return;
    }
    push(first + 1, first + 1 - from);
    if (last > first + 1) push(last, 1);
    push(last + 1, to - last);
  }

 private:
  void push(int end, double each) {
    part[count] = each;
    edge[++count] = end;
  }
};

}  // namespace

SummedArea::SummedArea(const Map& map)
    : width_(map.width()), height_(map.height()), channels_(map.channels()) {
  const std::size_t values = static_cast<std::size_t>(channels_) + 1;
  std::vector<float> solid_angles(static_cast<std::size_t>(width_));
  const auto for_each_row = [&](const auto& body) {
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < height_; ++y) {
        texel_solid_angles(map.parameterization, width_, height_, chart, y, solid_angles.data());
        body(chart, y, map.level.chart(chart).row(y));
      }
    }
  };
  // Units.
  std::vector<double> totals(values);
  for_each_row([&](int, int, const float* texel) {
    for (const float each : solid_angles) {
      const double solid_angle = static_cast<double>(each);
      for (std::size_t c = 0; c + 1 < values; ++c)
        totals[c] += std::fabs(static_cast<double>(texel[c])) * solid_angle;
      totals[values - 1] += solid_angle;
      texel += values - 1;
    }
  });
  for (const double total : totals) units_.push_back(total > 0 ? total / kUnits : 1);
  // Sums of all to the left and above: an empty row and column first.
  const std::size_t entries = static_cast<std::size_t>(map.charts()) * static_cast<std::size_t>(width_ + 1) *
                              static_cast<std::size_t>(height_ + 1);
  memory_ = LargeMemory(entries * values * sizeof(std::uint64_t), LargeMemory::Contents::zero);
  entries_ = reinterpret_cast<std::uint64_t*>(memory_.data());
  std::vector<std::uint64_t> row(values);
  for_each_row([&](int chart, int y, const float* texel) {
    std::fill(row.begin(), row.end(), 0);
    const std::uint64_t* above = entry(chart, 1, y);
    std::uint64_t* at = entries_ + (entry(chart, 1, y + 1) - entries_);
    for (const float each : solid_angles) {
      const double solid_angle = static_cast<double>(each);
      for (std::size_t c = 0; c < values; ++c) {
        const double value = c + 1 < values ? static_cast<double>(texel[c]) * solid_angle : solid_angle;
        row[c] += static_cast<std::uint64_t>(std::llround(value / units_[c]));
        at[c] = above[c] + row[c];
      }
      texel += values - 1;
      above += values;
      at += values;
    }
  });
}

void SummedArea::add(const ChartRectangle& r, double share, double* sums) const {
  const Runs columns(r.left, r.right, width_), rows(r.top, r.bottom, height_);
  const int values = channels_ + 1;
  for (int j = 0; j < rows.count; ++j) {
    for (int i = 0; i < columns.count; ++i) {
      const double part = share * rows.part[j] * columns.part[i];
      const std::uint64_t* a = entry(r.chart, columns.edge[i], rows.edge[j]);
      const std::uint64_t* b = entry(r.chart, columns.edge[i + 1], rows.edge[j]);
      const std::uint64_t* c = entry(r.chart, columns.edge[i], rows.edge[j + 1]);
      const std::uint64_t* d = entry(r.chart, columns.edge[i + 1], rows.edge[j + 1]);
      for (int k = 0; k < values; ++k) {
        // Modulo 2⁶⁴, exact: only the result need be in range.
        const auto whole = static_cast<std::int64_t>(d[k] - c[k] - b[k] + a[k]);
        sums[k] += part * units_[static_cast<std::size_t>(k)] * static_cast<double>(whole);
      }
    }
  }
}

}  // namespace welkin
