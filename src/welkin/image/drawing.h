#pragma once

#include <array>
#include <string_view>

#include "welkin/image/image.h"

/// Drawing for figures. Colours are linear sRGB; x and y are in pixels from the top left
/// corner; what lies outside the picture is clipped.
namespace welkin {

using Rgb = std::array<float, 3>;

inline constexpr Rgb kWhite{1, 1, 1}, kBlack{0, 0, 0};

/// Sets a pixel to `color` where `cover` is 1, leaves it where that is 0, and mixes between.
void blend(Image& picture, int x, int y, const Rgb& color, double cover);

/// What a rectangle covers.
struct Box {
  int x, y, width, height;
};
void fill_box(Image& picture, const Box& box, const Rgb& color);

/// Text in the letters of image/font.h, capitals `size` pixels high, black.
struct Text {
  std::string_view text;
  double x, y;  ///< its middle
  double size;
};
void draw_text(Image& picture, const Text& text);

}  // namespace welkin
