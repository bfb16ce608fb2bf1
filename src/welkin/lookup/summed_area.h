#pragma once

#include <cstdint>
#include <vector>

#include "welkin/base/large_memory.h"
#include "welkin/map/map.h"

/// Sums over rectangles of a map in constant time (Crow 1984). Internal to lookup.
namespace welkin {

/// A rectangle of a chart, texels: 0 ≤ left ≤ right ≤ width, 0 ≤ top ≤ bottom ≤ height.
struct ChartRectangle {
  int chart;
  double left, top, right, bottom;
};

/// Sums of radiance × solid angle, and of solid angle, in 64-bit fixed point: a channel's unit is 2⁻⁶¹ of the
/// sum of its absolute values. Differences of such sums are exact, so the sum over N whole texels is that of
/// their values rounded to units: at most N/2 units off, however wide the table and wherever the rectangle.
/// (Sums in 32-bit floats are off by 2⁻²⁴ of *all* that is above and to the left.)
class SummedArea {
 public:
  explicit SummedArea(const Map& map);

  int channels() const { return channels_; }
  /// What one unit of a channel is; `channels()` is the solid angle.
  double unit(int channel) const { return units_[static_cast<std::size_t>(channel)]; }

  /// Adds share × the sums over a rectangle to channels() + 1 values, the last the solid angle. A texel that
  /// it cuts counts by the part of its area.
  void add(const ChartRectangle& rectangle, double share, double* sums) const;

 private:
  const std::uint64_t* entry(int chart, int x, int y) const {
    return entries_ +
           ((static_cast<std::ptrdiff_t>(chart) * (height_ + 1) + y) * (width_ + 1) + x) * (channels_ + 1);
  }

  int width_, height_, channels_;
  std::vector<double> units_;
  LargeMemory memory_;
  std::uint64_t* entries_;
};

}  // namespace welkin
