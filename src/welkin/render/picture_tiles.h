#pragma once

#include <algorithm>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/render/camera_rays.h"

/// Pictures that are made tile by tile.
namespace welkin::scene {

/// The most rays along each axis of a pixel.
inline constexpr int kMostSamples = 64;

/// A rectangle of a picture's pixels.
struct PictureTile {
  int x, y, width, height;
};

/// make(tile) for all tiles of a picture, on TBB's workers.
template <class Make>
void for_each_tile(ChartSize size, const Monitor& monitor, const Make& make) {
  constexpr int kSide = 16;
  const int columns = (size.width + kSide - 1) / kSide, rows = (size.height + kSide - 1) / kSide;
  parallel_for(
      columns * rows,
      [&](int index) {
        const int x = index % columns * kSide, y = index / columns * kSide;
        make(PictureTile{x, y, std::min(kSide, size.width - x), std::min(kSide, size.height - y)});
      },
      monitor);
}

/// samples² places of each of a tile's pixels, pixel by pixel, row by row.
inline std::vector<PicturePlace> places_of(const PictureTile& tile, int samples) {
  const auto middle = [&](int index) {
    return (static_cast<float>(index) + 0.5f) / static_cast<float>(samples);
  };
  std::vector<PicturePlace> places;
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x)
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i)
          places.push_back(
              {static_cast<float>(tile.x + x) + middle(i), static_cast<float>(tile.y + y) + middle(j)});
  return places;
}

}  // namespace welkin::scene
