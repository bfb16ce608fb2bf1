#pragma once

#include <algorithm>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/io/image_file.h"

/// Cubes that tests of `.env` and `.glb` write.
namespace welkin::io::test {

/// A cube with levels; each value says where it is.
struct Cube {
  std::vector<Image> images;
  std::vector<WritePart> parts;
};

inline float value_at(int level, int face, int x, int y, int channel) {
  return 0.01f + static_cast<float>(level) + 10.0f * static_cast<float>(face) +
         0.05f * static_cast<float>(x + 3 * y) + 0.2f * static_cast<float>(channel);
}

inline Cube cube(int side, int levels) {
  Cube made;
  for (int level = 0; level < levels; ++level) {
    for (int face = 0; face < 6; ++face) {
      const int size = std::max(1, side >> level);
      Image& image = made.images.emplace_back(size, size, 3);
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          for (int c = 0; c < 3; ++c) image.at(x, y)[c] = value_at(level, face, x, y, c);
        }
      }
    }
  }
  std::size_t i = 0;
  for (int level = 0; level < levels; ++level) {
    for (int face = 0; face < 6; ++face)
      made.parts.push_back({"", made.images[i++].view(), {"R", "G", "B"}, level, 0, face});
  }
  return made;
}

}  // namespace welkin::io::test
