#include "welkin/plot/draw_distortion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"
#include "welkin/image/drawing.h"
#include "welkin/prefilter/paraboloid_convolution.h"

namespace welkin {
namespace {

constexpr Rgb kGrid{0.75f, 0.75f, 0.75f};
constexpr double kTop = 0.25;
constexpr int kCurves = 5;

/// Where the axes lie in the picture.
struct Frame {
  int text;
  Box box;

  explicit Frame(int width) : text(std::clamp(width / 45, 9, 40)) {
    box = {5 * text, 2 * text, width - 13 * text, width / 2};
  }
  double x(double distance) const { return box.x + box.width * distance; }
  double y(double distortion) const { return box.y + box.height * (1 - distortion / kTop); }
};

void draw_frame(Image& picture, const Frame& frame) {
  const Box& box = frame.box;
  for (int i = 0; i <= 5; ++i) {
    const double x = frame.x(i / 5.0), y = frame.y(i * kTop / 5);
    fill_box(picture, {static_cast<int>(x), box.y, 1, box.height}, kGrid);
    fill_box(picture, {box.x, static_cast<int>(y), box.width, 1}, kGrid);
    const std::string tenths = i == 5 ? "1" : "0." + std::to_string(2 * i);
    draw_text(picture, {i == 0 ? "0" : tenths, x, box.y + box.height + 1.5 * frame.text, 1.0 * frame.text});
    draw_text(picture, {std::to_string(5 * i) + "%", box.x - 2.0 * frame.text, y, 1.0 * frame.text});
  }
  fill_box(picture, {box.x, box.y, 2, box.height}, kBlack);
  fill_box(picture, {box.x, box.y + box.height - 1, box.width, 2}, kBlack);
}

/// A pixel is covered by how near it is to the curve, by its height and slope there.
void draw_curve(Image& picture, const Frame& frame, double radius, const Rgb& color) {
  const Box& box = frame.box;
  const double half_width = frame.text / 9.0;
  for (int column = box.x; column < box.x + box.width; ++column) {
    const double at = (column + 0.5 - box.x) / box.width, step = 1.0 / box.width;
    const double y = frame.y(circle_distortion(radius, at));
    const double slope = frame.y(circle_distortion(radius, at + step)) - y;
    const double steepness = std::hypot(1.0, slope);
    const int reach = static_cast<int>((half_width + 1) * steepness) + 1;
    for (int row = std::max(static_cast<int>(y) - reach, 0); row <= static_cast<int>(y) + reach; ++row)
      blend(picture, column, row, color, half_width + 0.5 - std::fabs(row + 0.5 - y) / steepness);
  }
}

}  // namespace

Image draw_circle_distortion(int width) {
  require(width >= 200, "a plot of distortion is at least 200 pixels wide");
  const Frame frame(width);
  Image picture(width, frame.box.height + 6 * frame.text, 3);
  fill_box(picture, {0, 0, picture.width(), picture.height()}, kWhite);
  draw_frame(picture, frame);
  const int right = frame.box.x + frame.box.width;
  for (int i = 0; i < kCurves; ++i) {
    // The ramp's end is too light for white paper.
    const Rgb color = color_ramp(0.82 * i / (kCurves - 1.0));
    draw_curve(picture, frame, (i + 1) / 10.0, color);
    const int y = frame.box.y + frame.text + (kCurves - 1 - i) * 2 * frame.text;
    fill_box(picture, {right + frame.text, y - frame.text / 6, 3 * frame.text / 2, frame.text / 3}, color);
    draw_text(picture, {"0." + std::to_string(i + 1), right + 4.6 * frame.text, static_cast<double>(y),
                        1.0 * frame.text});
  }
  return picture;
}

}  // namespace welkin
