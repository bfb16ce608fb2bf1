#include "welkin/plot/draw_fresnel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"
#include "welkin/math/scalar.h"
#include "welkin/plot/polyline.h"

namespace welkin {
namespace {

constexpr Rgb kGrid{0.75f, 0.75f, 0.75f};

void draw_axes(Image& picture, const Box& box, int text) {
  for (int degrees = 0; degrees <= 90; degrees += 15) {
    const int x = box.x + box.width * degrees / 90;
    fill_box(picture, {x, box.y, 1, box.height}, kGrid);
    draw_text(picture, {std::to_string(degrees) + "o", static_cast<double>(x),
                        box.y + box.height + 1.5 * text, static_cast<double>(text)});
  }
  for (const int half : {0, 1, 2}) {
    const int y = box.y + box.height * (2 - half) / 2;
    fill_box(picture, {box.x, y, box.width, 1}, kGrid);
    if (half != 1) {
      draw_text(picture, {half == 0 ? "0" : "1", box.x - 1.2 * text, static_cast<double>(y),
                          static_cast<double>(text)});
    }
  }
  fill_box(picture, {box.x, box.y, 2, box.height}, kBlack);
  fill_box(picture, {box.x, box.y + box.height - 1, box.width, 2}, kBlack);
}

}  // namespace

Image draw_fresnel(std::span<const brdf::Boundary> boundaries, int width) {
  require(width >= 200 && width <= 4096, "a plot of reflectances is 200 to 4096 pixels wide");
  for (const brdf::Boundary& boundary : boundaries) brdf::check(boundary);
  const int text = std::clamp(width / 45, 9, 40);
  const Box box{5 * text, 2 * text, width - 10 * text, width / 2};
  Image picture(width, box.height + 6 * text, 3);
  fill_box(picture, {0, 0, picture.width(), picture.height()}, kWhite);
  draw_axes(picture, box, text);
  const int right = box.x + box.width;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    // The ramp's end is too light for white paper.
    const Rgb color = color_ramp(0.82 * static_cast<double>(i) /
                                 (std::max<double>(2, static_cast<double>(boundaries.size())) - 1));
    std::vector<PlotPoint> points;
    for (int step = 0; step <= 4 * box.width; ++step) {
      const double cosine = std::cos(0.5 * kPi * step / (4 * box.width));
      points.push_back(
          {box.x + 0.25 * step,
           box.y + box.height * (1 - brdf::fresnel(std::clamp(cosine, 0.0, 1.0), boundaries[i]))});
    }
    draw_polyline(picture, points, 2 * text / 9.0, color, box);
    const int y = box.y + text + static_cast<int>(i) * 2 * text;
    fill_box(picture, {right + text, y - text / 6, 3 * text / 2, text / 3}, color);
    draw_text(picture, {std::to_string(i + 1), right + 3.6 * text, static_cast<double>(y), 1.0 * text});
  }
  return picture;
}

}  // namespace welkin
