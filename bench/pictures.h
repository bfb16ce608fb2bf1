#pragma once

#include <string>

#include "welkin/map/map.h"

/// The maps that the benchmarks work on. All are lat-long, three channels, borders filled.
namespace welkin::bench {

/// Values between 0 and 1 without pattern: for timing only.
Map noise_picture(int width, int height);

/// Three pictures at once, in texels of the map (pixels), made to alias. All lie in [0, 1].
///   R  zone plate ½ + ½ cos(πr²/width), r pixels from the middle: r/width cycles per pixel, ½ at the left
///   and right edges G  checker of 5 × 5 pixels B  vertical lines, 3 pixels wide, one every 64
Map aliasing_patterns(int width);

struct HighDynamicRange {
  std::string name;  ///< for a table
  bool is_forest;    ///< the map that the targets were set for
  Map map;
};

/// The file that WELKIN_BENCH_HDRI names; without it, a built-in studio of 1024×512 under a noise of ±10 %.
HighDynamicRange high_dynamic_range();

/// The same, enlarged to width × width/2 and with a grain of ±5 % from texel to texel, as a photograph has.
Map detailed_picture(int width);

}  // namespace welkin::bench
