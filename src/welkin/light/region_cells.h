#pragma once

#include <cstdint>
#include <vector>

#include "welkin/light/map_scan.h"
#include "welkin/map/map.h"

/// A map as a list of small cells: what regions consist of. Internal to light.
namespace welkin {

struct RegionCell {
  float x, y, z;      ///< centroid of its light, in the map's frame
  float light;        ///< ∫ luminance dω, at least 0
  float solid_angle;  ///< sr
};

/// Squares of side × side texels of each chart; one texel where that makes few enough. Squares of one small
/// bright light are one cell, through which nothing cuts.
class RegionCells {
 public:
  RegionCells(const Map& map, const MapScan& scan, const Monitor& monitor);

  const std::vector<RegionCell>& cells() const { return cells_; }
  /// Of each row of texels, where in cell_of_square they lie: square_of_row + x / side.
  std::size_t square_of_row(int chart, int y) const {
    return static_cast<std::size_t>(chart * down_ + y / side_) * static_cast<std::size_t>(across_);
  }
  int side() const { return side_; }
  std::uint32_t cell_of_square(std::size_t square) const { return cell_of_square_[square]; }

 private:
  void merge_spots(const Map& map, const MapScan& scan);

  static constexpr double kMostCells = 1 << 20;
  int side_, across_, down_;
  std::vector<RegionCell> cells_;
  std::vector<std::uint32_t> cell_of_square_;
};

}  // namespace welkin
