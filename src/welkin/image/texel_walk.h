#pragma once

#include <cstddef>

#include "welkin/image/image.h"

namespace welkin {

/// How an image lies in a picture that shows it turned by quarters, mirrored, or both: texel (x, y) of the
/// picture is the image's texel (start_x + right_x·x + down_x·y, start_y + right_y·x + down_y·y). A step is
/// −1 or 1 along one side of the image, and 0 along the other.
struct TexelWalk {
  int start_x = 0, start_y = 0;
  int right_x = 1, right_y = 0;
  int down_x = 0, down_y = 1;

  bool on_its_side() const { return right_x == 0; }
  bool as_it_is() const { return right_x == 1 && down_y == 1; }

  int image_x(int x, int y) const { return start_x + right_x * x + down_x * y; }
  int image_y(int x, int y) const { return start_y + right_y * x + down_y * y; }

  /// For the part of the picture that begins at (x, y).
  TexelWalk from(int x, int y) const {
    return {image_x(x, y), image_y(x, y), right_x, right_y, down_x, down_y};
  }
};

/// The image's texels that a picture of width × height shows: a rectangle of it.
struct TexelRectangle {
  int x, y, width, height;
};
TexelRectangle texels_of(const TexelWalk& walk, int width, int height);

/// Fills the picture with the image's texels, of as many channels.
void copy_walked(ImageView<const float> image, const TexelWalk& walk, ImageView<float> picture);
/// The reverse: fills the image's texels that the picture shows.
void copy_unwalked(ImageView<const float> picture, const TexelWalk& walk, ImageView<float> image);

}  // namespace welkin
