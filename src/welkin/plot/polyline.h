#pragma once

#include <span>

#include "welkin/image/drawing.h"

namespace welkin {

/// A place in a picture, in pixels from the top left corner.
struct PlotPoint {
  double x, y;
};

/// Draws a curve through `points`, of ascending x, `width` pixels wide with soft edges, and nothing of it
/// outside `box`'s left, right and bottom. A pixel is covered by the most that one of its segments covers, so
/// that joints don't show.
void draw_polyline(Image& picture, std::span<const PlotPoint> points, double width, const Rgb& color,
                   const Box& box);

}  // namespace welkin
