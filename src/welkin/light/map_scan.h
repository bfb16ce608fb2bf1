#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "welkin/base/monitor.h"
#include "welkin/map/luminance.h"
#include "welkin/map/texel_grid.h"

/// One pass over a map: what it adds up to, and where it is bright. Internal to light.
namespace welkin {

class MapScan {
 public:
  /// Throws Error (bad_value) for values of valid texels that aren't finite; Cancelled.
  MapScan(const Map& map, const Monitor& monitor);

  /// Of a texel, sr; 0 where its centre isn't valid.
  double solid_angle(TexelGrid::Index texel) const {
    return static_cast<double>(omega_[static_cast<std::size_t>(by_row_ ? texel / width_ : texel)]);
  }
  double shown() const { return shown_; }
  /// ∫ of each channel of the map, dω.
  const std::vector<double>& sums() const { return sums_; }
  /// Mean luminance of what is shown.
  double mean() const;
  /// body(texel, luminance) for the valid texels of at least that luminance, which is above 0, in order.
  template <class Body>
  void for_bright(float least, const Body& body) const {
    for (std::size_t segment = 0; segment < maxima_.size(); ++segment) {
      if (!(maxima_[segment] >= least)) continue;
      const TexelGrid::Index row = static_cast<TexelGrid::Index>(segment) / segments_;
      const int first = static_cast<int>(static_cast<TexelGrid::Index>(segment) % segments_) * kSegment;
      const int chart = static_cast<int>(row / map_.height()), y = static_cast<int>(row % map_.height());
      const float* texel = map_.level.chart(chart).at(first, y);
      for (int x = first; x < std::min(first + kSegment, width_); ++x, texel += map_.channels()) {
        const TexelGrid::Index number = row * width_ + x;
        const float value = luminance_(texel);
        if (value >= least && solid_angle(number) > 0) body(number, value);
      }
    }
  }

 private:
  static constexpr int kSegment = 64;
  void scan_row(int row, double* sums, double& shown, std::uint64_t& faults);

  const Map& map_;
  const TexelLuminance luminance_;
  const bool by_row_;
  const int width_, segments_;
  std::vector<float> omega_;   ///< of each row's texels, or of each texel
  std::vector<float> maxima_;  ///< of luminance, in each segment of each row
  std::vector<double> sums_;
  double shown_ = 0;
};

}  // namespace welkin
