#include "welkin/prefilter/source_faults.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/map/row_bands.h"

namespace welkin {
namespace {

/// Whether all values are in 0…kMaxRadiance, or −0.
bool is_faultless(const float* values, std::ptrdiff_t count) {
  int faults = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) faults |= values[i] >= 0 && values[i] <= kMaxRadiance ? 0 : 1;
  return faults == 0;
}

void count_faults(const float* texel, int channels, SourceFaults& faults) {
  bool finite = true, excessive = false, negative = false;
  for (int c = 0; c < channels; ++c) {
    finite = finite && std::isfinite(texel[c]);
    excessive = excessive || std::fabs(texel[c]) > kMaxRadiance;
    negative = negative || texel[c] < 0;
  }
  if (!finite) {
    ++faults.not_finite;
  } else if (excessive) {
    ++faults.excessive;
  } else if (negative) {
    ++faults.negative;
  }
}

}  // namespace

SourceFaults faults_of(const Map& map, const Monitor& monitor) {
  const int width = map.width(), height = map.height(), channels = map.channels();
  const RowBands bands(map.charts() * height);
  SourceFaults total;
  std::mutex mutex;
  const auto count = [&](int band) {
    SourceFaults faults;
    std::vector<float> omega(static_cast<std::size_t>(width));
    for (int row = bands.first(band); row < bands.first(band + 1); ++row) {
      const float* texel = map.level.chart(row / height).row(row % height);
      if (is_faultless(texel, std::ptrdiff_t{width} * channels)) continue;
      texel_solid_angles(map.parameterization, width, height, row / height, row % height, omega.data());
      for (int x = 0; x < width; ++x, texel += channels) {
        if (omega[static_cast<std::size_t>(x)] > 0) count_faults(texel, channels, faults);
      }
    }
    const std::scoped_lock lock(mutex);
    total.not_finite += faults.not_finite;
    total.excessive += faults.excessive;
    total.negative += faults.negative;
  };
  parallel_for(bands.count, count, monitor);
  return total;
}

}  // namespace welkin
