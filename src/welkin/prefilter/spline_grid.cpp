#include "welkin/prefilter/spline_grid.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace welkin::prefilter {

void to_spline_columns(Level& grid, int first, int last) {
  const float z = static_cast<float>(std::sqrt(3.0) - 2);
  constexpr int kReach = 14;  // |z|^14 = 1e-8
  const ImageView<float> chart = grid.chart(0);
  const int height = grid.height(), n = grid.channels();
  const int count = (last - first) * n;
  const std::ptrdiff_t near = static_cast<std::ptrdiff_t>(first) * n;
  const std::ptrdiff_t far = near + static_cast<std::ptrdiff_t>(grid.width() / 2) * n;
  // Row k of the circle: down the near meridian, then up the far one.
  const auto row = [&](int k) {
    const int around = (k % (2 * height) + 2 * height) % (2 * height);
    return around < height ? chart.row(around) + near : chart.row(2 * height - 1 - around) + far;
  };
  std::vector<float> state(static_cast<std::size_t>(count));
  float* s = state.data();
  float power = z;
  for (int k = 1; k <= kReach; ++k, power *= z) {
    const float* from = row(-k);
    for (int i = 0; i < count; ++i) s[i] += power * from[i];
  }
  for (int k = 0; k < 2 * height; ++k) {
    float* at = row(k);
    for (int i = 0; i < count; ++i) at[i] += k == 0 ? s[i] : 0.0f;
    if (k == 0) continue;
    const float* before = row(k - 1);
    for (int i = 0; i < count; ++i) at[i] += z * before[i];
  }
  // Backward: c[k] = z (c[k + 1] − c⁺[k]), beginning with −z Σ zʲ c⁺[j − 1].
  std::fill(state.begin(), state.end(), 0.0f);
  power = -z;
  for (int j = 0; j <= kReach; ++j, power *= z) {
    const float* from = row(j - 1);
    for (int i = 0; i < count; ++i) s[i] += power * from[i];
  }
  std::memcpy(row(-1), s, static_cast<std::size_t>(count) * sizeof(float));
  for (int k = 2 * height - 2; k >= 0; --k) {
    float* at = row(k);
    const float* after = row(k + 1);
    for (int i = 0; i < count; ++i) at[i] = z * (after[i] - at[i]);
  }
}

void to_splines(std::span<Level> grids, const Monitor& monitor) {
  constexpr int kColumns = 16;
  struct Strip {
    std::size_t grid;
    int first, last;
  };
  std::vector<Strip> strips;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const int half = grids[i].width() / 2;
    for (int x = 0; x < half; x += kColumns) strips.push_back({i, x, std::min(half, x + kColumns)});
  }
  parallel_for(
      static_cast<int>(strips.size()),
      [&](int k) {
        const Strip& strip = strips[static_cast<std::size_t>(k)];
        to_spline_columns(grids[strip.grid], strip.first, strip.last);
      },
      monitor);
  const auto latlong = sphere::AnyParameterization::make("latlong");
  for (Level& grid : grids) fill_borders(latlong, grid);
}

void store_lanes(const float* lanes, const std::array<float*, 16>& rows, const Level& grid) {
  const std::ptrdiff_t channels = grid.channels(), width = grid.width();
  // So many columns at a time stay in the nearest cache.
  constexpr std::ptrdiff_t kColumns = 64;
  for (std::ptrdiff_t first = 0; first < width; first += kColumns) {
    const std::ptrdiff_t last = std::min(width, first + kColumns);
    for (std::size_t lane = 0; lane < rows.size(); ++lane) {
      if (rows[lane] == nullptr) continue;
      const float* from = lanes + lane;
      float* row = rows[lane];
      for (std::ptrdiff_t x = first; x < last; ++x) row[x * channels] = from[x * 16];
    }
  }
}

}  // namespace welkin::prefilter
