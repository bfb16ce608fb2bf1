#pragma once

#include <string_view>

namespace welkin {

/// A small stroke font, for labels drawn by distance. Text is centred on the origin, x right and y down as
/// the reader sees it, capitals one unit high from y = −½ to ½. It has `+ - . % X Y Z °` and digits; ° is
/// written as `o`.

/// Distance from (x, y) to the middle line of the nearest stroke. Ink is where it is below half of the wanted
/// stroke's weight.
double text_distance(std::string_view text, double x, double y);

/// From the left edge of the first glyph's middle line to the right edge of the last's.
double text_width(std::string_view text);

}  // namespace welkin
