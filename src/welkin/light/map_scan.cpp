#include "welkin/light/map_scan.h"

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/row_bands.h"
#include "welkin/map/texel_points.h"

namespace welkin {

MapScan::MapScan(const Map& map, const Monitor& monitor)
    : map_(map),
      luminance_(map.channel_names),
      by_row_(map.parameterization.full_charts() && map.parameterization.density_by_row()),
      width_(map.width()),
      segments_((width_ + kSegment - 1) / kSegment) {
  const std::size_t rows = static_cast<std::size_t>(map.charts()) * static_cast<std::size_t>(map.height()),
                    channels = static_cast<std::size_t>(map.channels());
  omega_.resize(by_row_ ? rows : rows * static_cast<std::size_t>(width_));
  maxima_.resize(rows * static_cast<std::size_t>(segments_));
  const RowBands bands(static_cast<int>(rows));
  struct Sums {
    std::vector<double> channels;
    double shown = 0;
    std::uint64_t faults = 0;
  };
  std::vector<Sums> found(static_cast<std::size_t>(bands.count));
  parallel_for(
      bands.count,
      [&](int band) {
        Sums& sums = found[static_cast<std::size_t>(band)];
        sums.channels.resize(channels);
        for (int row = bands.first(band); row < bands.first(band + 1); ++row)
          scan_row(row, sums.channels.data(), sums.shown, sums.faults);
      },
      monitor);
  sums_.resize(channels);
  std::uint64_t faults = 0;
  for (const Sums& each : found) {
    for (std::size_t c = 0; c < channels; ++c) sums_[c] += each.channels[c];
    shown_ += each.shown;
    faults += each.faults;
  }
  if (faults > 0) {
    throw Error(ErrorKind::bad_value, std::to_string(faults) +
                                          " texels have NaN or infinite values, which no light can be "
                                          "measured by; repair them first");
  }
}

double MapScan::mean() const {
  return shown_ > 0 ? luminance_.of_sums(sums_.data()) / shown_ : 0;
}

void MapScan::scan_row(int row, double* sums, double& shown, std::uint64_t& faults) {
  const int height = map_.height(), channels = map_.channels();
  const std::size_t width = static_cast<std::size_t>(width_);
  std::vector<float> weights(width);
  centred_solid_angles(map_.parameterization, {width_, height}, row / height, row % height, weights.data());
  float* const omega = omega_.data() + static_cast<std::size_t>(row) * (by_row_ ? 1 : width);
  std::copy_n(weights.data(), by_row_ ? 1 : width, omega);
  const float* texel = map_.level.chart(row / height).row(row % height);
  float* maximum = maxima_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(segments_);
  for (int first = 0; first < width_; first += kSegment, ++maximum) {
    float highest = 0;
    for (int x = first; x < std::min(first + kSegment, width_); ++x, texel += channels) {
      const double weight = static_cast<double>(weights[static_cast<std::size_t>(x)]);
      if (!(weight > 0)) continue;
      shown += weight;
      float zero = 0;
      for (int c = 0; c < channels; ++c) {
        sums[c] += weight * static_cast<double>(texel[c]);
        zero += texel[c] * 0.0f;
      }
      faults += zero == 0 ? 0 : 1;
      highest = std::max(highest, luminance_(texel));
    }
    *maximum = highest;
  }
}

}  // namespace welkin
