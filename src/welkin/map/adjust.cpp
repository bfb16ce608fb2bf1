#include "welkin/map/adjust.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"
#include "welkin/map/row_bands.h"

namespace welkin {
namespace {

bool is_finite_row(const float* values, std::ptrdiff_t count) {
  float zero = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) zero += values[i] * 0.0f;
  return zero == 0;
}

/// The mean of the finite values at x−1, x, x+1 of three rows (null where there is none), else `replacement`.
float mean_of_neighbours(const float* const (&rows)[3], int x, int width, int channels, int channel,
                         float replacement) {
  double sum = 0;
  int count = 0;
  for (const float* row : rows) {
    if (row == nullptr) continue;
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
      const float value = row[static_cast<std::ptrdiff_t>(i) * channels + channel];
      if (std::isfinite(value)) {
        sum += static_cast<double>(value);
        ++count;
      }
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : replacement;
}

/// Replaces in `row`; `rows` are the ones above, at and below it as they were.
std::uint64_t sanitize_row(const float* const (&rows)[3], float* row, int width, int channels,
                           float replacement) {
  std::uint64_t replaced = 0;
  for (int x = 0; x < width; ++x) {
    bool bad = false;
    for (int c = 0; c < channels; ++c) {
      float& value = row[static_cast<std::ptrdiff_t>(x) * channels + c];
      if (std::isfinite(value)) continue;
      value = mean_of_neighbours(rows, x, width, channels, c, replacement);
      bad = true;
    }
    replaced += bad ? 1 : 0;
  }
  return replaced;
}

}  // namespace

std::uint64_t sanitize(Map& map, float replacement) {
  map.check();
  const int width = map.width(), height = map.height(), channels = map.channels();
  const std::ptrdiff_t values = static_cast<std::ptrdiff_t>(width) * channels;

  // Find the rows that need it.
  const RowBands bands(map.charts() * height);
  std::vector<std::uint8_t> finite(static_cast<std::size_t>(bands.rows));
  parallel_for(bands.count, [&](int band) {
    for (int row = bands.first(band); row < bands.first(band + 1); ++row) {
      finite[static_cast<std::size_t>(row)] =
          is_finite_row(map.level.chart(row / height).row(row % height), values);
    }
  });

  // Replace from the values as they were: a row that has been changed leaves a copy for the next one.
  std::vector<float> above(static_cast<std::size_t>(values)), here(static_cast<std::size_t>(values));
  std::uint64_t replaced = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    const ImageView<float> view = map.level.chart(chart);
    bool above_changed = false;
    for (int y = 0; y < height; ++y) {
      const bool change = !finite[static_cast<std::size_t>(chart * height + y)];
      if (change) {
        std::copy_n(view.row(y), values, here.data());
        const float* const untouched_above = y == 0          ? nullptr
                                             : above_changed ? above.data()
                                                             : view.row(y - 1);
        const float* const rows[3] = {untouched_above, here.data(),
                                      y + 1 < height ? view.row(y + 1) : nullptr};
        replaced += sanitize_row(rows, view.row(y), width, channels, replacement);
        std::swap(above, here);
      }
      above_changed = change;
    }
  }
  if (replaced > 0) fill_borders(map);
  return replaced;
}

void scale(Map& map, float factor) {
  map.check();
  std::vector<float> factors;
  for (const std::string& name : map.channel_names) factors.push_back(name == "A" ? 1.0f : factor);
  // The borders too: what lies past an edge is a weighted sum of texels.
  const int rows = map.height() + 2 * kBorder, columns = map.width() + 2 * kBorder;
  parallel_for(map.charts() * rows, [&](int i) {
    float* value = map.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    for (int x = 0; x < columns; ++x) {
      for (const float each : factors) *value++ *= each;
    }
  });
}

void turn_world(Map& map, const Matrix3& rotation) {
  require(is_orthonormal(rotation), "a world is turned by a rotation or a reflection");
  map.orientation = map.orientation * transpose(rotation);
}

Map without_alpha(const Map& map) {
  require(map.channel_names == std::vector<std::string>{"R", "G", "B", "A"},
          "alpha is dropped of a map of R G B A");
  Map rgb(map.parameterization, map.width(), map.height(), 3);
  rgb.orientation = map.orientation;
  const int rows = map.height() + 2 * kBorder, columns = map.width() + 2 * kBorder;
  parallel_for(map.charts() * rows, [&](int i) {
    const float* from = map.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    float* to = rgb.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    for (int x = 0; x < columns; ++x) std::copy_n(from + 4 * x, 3, to + 3 * x);
  });
  return rgb;
}

}  // namespace welkin
