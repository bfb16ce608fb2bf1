#include "welkin/lookup/bright_tiles.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"

namespace welkin {

BrightTiles::BrightTiles(const FaceGrid& masses, const std::array<float, 3>& inverse)
    : side_(masses.side()), tiles_(((side_ + 1) / 2 + kTile - 1) / kTile) {
  const std::size_t tiles = static_cast<std::size_t>(tiles_);
  most_.resize(tiles * tiles);
  const float inverses[FaceGrid::kPair] = {inverse[0], inverse[1], inverse[2], 0,
                                           inverse[0], inverse[1], inverse[2], 0};
  const double step = 2 * std::atan(1.0) / masses.size();
  const auto tangent = [&](int tile) { return std::tan(((tile + 0.5) * kTile - 0.5 * side_) * step); };
  parallel_for(tiles_, [&](int tile_y) {
    const int most_y = std::min((tile_y + 1) * kTile, side_ - tile_y * kTile);
    // Both images above and below the middle, then those left and right of it.
    std::vector<float> lanes(static_cast<std::size_t>(side_) * FaceGrid::kPair);
    const auto add_row = [&](int y) {
      for (int pair = 0; pair < 3; ++pair) {
        const float* from = masses.pair(pair) + static_cast<std::size_t>(y) * lanes.size();
        for (std::size_t i = 0; i < lanes.size(); i += FaceGrid::kPair) {
          for (std::size_t k = 0; k < FaceGrid::kPair; ++k)
            lanes[i + k] = std::max(lanes[i + k], std::fabs(from[i + k]) * inverses[k]);
        }
      }
    };
    for (int y = tile_y * kTile; y < most_y; ++y) {
      add_row(y);
      add_row(side_ - 1 - y);
    }
    for (int x = 0; x < side_; ++x) {
      const float* lane = lanes.data() + static_cast<std::size_t>(x) * FaceGrid::kPair;
      const int tile_x = std::min(x, side_ - 1 - x) / kTile;
      float& most = most_[static_cast<std::size_t>(tile_y * tiles_ + tile_x)];
      most = std::max(most, *std::max_element(lane, lane + FaceGrid::kPair));
    }
  });
  // From masses to radiance, by the solid angle of a texel in the tile's middle.
  for (int y = 0; y < tiles_; ++y) {
    for (int x = 0; x <= y; ++x) {
      const double s = tangent(x), t = tangent(y), r2 = 1 + s * s + t * t;
      const double area = step * step * (1 + s * s) * (1 + t * t) / (r2 * std::sqrt(r2));
      float& here = most_[static_cast<std::size_t>(y * tiles_ + x)];
      float& mirrored = most_[static_cast<std::size_t>(x * tiles_ + y)];
      here = mirrored = std::max(here, mirrored) / static_cast<float>(area);
    }
  }
}

float BrightTiles::most(int first_x, int last_x, int first_y, int last_y) const {
  struct Range {
    int from, to;
  };
  // By the distance from the nearer edge; a range over the middle goes on to it.
  const auto folded = [&](int first, int last) -> Range {
    const int end = side_ - 1, middle = end / 2;
    const int nearest = std::clamp(std::min(first, end - last), 0, middle);
    const int farthest = std::clamp(std::min(last, end - first), nearest, middle);
    return {nearest / kTile, farthest / kTile};
  };
  const Range x_range = folded(first_x, last_x), y_range = folded(first_y, last_y);
  float most = 0;
  for (int y = y_range.from; y <= y_range.to; ++y) {
    const float* row = most_.data() + static_cast<std::size_t>(y * tiles_);
    most = std::max(most, *std::max_element(row + x_range.from, row + x_range.to + 1));
  }
  return most;
}

}  // namespace welkin
