#include "welkin/plot/draw_lobes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"
#include "welkin/image/drawing.h"
#include "welkin/lobe/angle.h"
#include "welkin/lobe/panels.h"
#include "welkin/plot/polyline.h"

namespace welkin {
namespace {

using lobe::AnyLobe;

constexpr Rgb kGrid{0.75f, 0.75f, 0.75f};
constexpr int kDecades = 6;

/// Where the figure's axes lie in the picture.
class Frame {
 public:
  explicit Frame(const LobePlot& plot)
      : plot_(plot),
        text_(std::clamp(plot.width / 45, 9, 40)),
        box_{5 * text_, 2 * text_, plot.width - 10 * text_, plot.width / 2} {}

  int text() const { return text_; }
  const Box& box() const { return box_; }
  int height() const { return box_.height + 6 * text_; }

  double x(double degrees) const { return box_.x + box_.width * degrees / plot_.degrees; }
  double degrees(double x) const { return (x - box_.x) / box_.width * plot_.degrees; }
  /// Of a share of the largest weight. Below the logarithmic axis' end it continues below the frame.
  double y(double share) const {
    double position = share;
    if (plot_.axis == WeightAxis::logarithmic) {
      position = share > 0 ? std::max(1 + std::log10(share) / kDecades, -0.1) : -0.1;
    }
    return box_.y + box_.height * (1 - position);
  }

 private:
  const LobePlot& plot_;
  int text_;
  Box box_;
};

/// A whole number of degrees between labels, so that there are about six.
int degree_step(int degrees) {
  for (const int step : {1, 2, 5, 10, 15}) {
    if (degrees <= 7 * step) return step;
  }
  return 30;
}

void draw_frame(Image& picture, const Frame& frame, const LobePlot& plot) {
  const Box& box = frame.box();
  const double text = frame.text();
  for (int degrees = 0; degrees <= plot.degrees; degrees += degree_step(plot.degrees)) {
    const double x = frame.x(degrees);
    fill_box(picture, {static_cast<int>(x), box.y, 1, box.height}, kGrid);
    draw_text(picture, {std::to_string(degrees) + "o", x, box.y + box.height + 1.5 * text, text});
  }
  const bool logarithmic = plot.axis == WeightAxis::logarithmic;
  const int lines = logarithmic ? kDecades : 2;
  for (int i = 0; i <= lines; ++i) {
    const double y = frame.y(logarithmic ? std::pow(10.0, -i) : 1 - 0.5 * i);
    fill_box(picture, {box.x, static_cast<int>(y), box.width, 1}, kGrid);
    if (i == 0 || (!logarithmic && i == lines)) {
      draw_text(picture, {i == 0 ? "1" : "0", box.x - 1.2 * text, y, text});
    } else if (logarithmic) {
      draw_text(picture, {"10", box.x - 2.6 * text, y, text});
      draw_text(picture, {std::to_string(-i), box.x - 1.1 * text, y - 0.45 * text, 0.7 * text});
    }
  }
  fill_box(picture, {box.x, box.y, 2, box.height}, kBlack);
  fill_box(picture, {box.x, box.y + box.height - 1, box.width, 2}, kBlack);
}

/// Angles in degrees, ascending: four for every column, and where the lobe is narrower than those.
std::vector<double> curve_angles(const AnyLobe& lobe, const Frame& frame) {
  constexpr int kSteps = 16;
  std::vector<double> angles;
  const Box& box = frame.box();
  for (int i = 0; i <= 4 * box.width; ++i) angles.push_back(frame.degrees(box.x + 0.25 * i));
  const std::vector<double> edges = lobe::panel_edges(lobe);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    for (int step = 0; step < kSteps; ++step) {
      angles.push_back((edges[i] + (edges[i + 1] - edges[i]) * step / kSteps) * 180 / kPi);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

void draw_curve(Image& picture, const AnyLobe& lobe, const Frame& frame, const Rgb& color) {
  if (lobe.is_mirror()) return;
  const std::vector<double> angles = curve_angles(lobe, frame);
  std::vector<double> weights;
  for (const double angle : angles) weights.push_back(lobe.weight(lobe::s_of_angle(angle / 180 * kPi)));
  const double largest = *std::max_element(weights.begin(), weights.end());
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < angles.size(); ++i)
    points.push_back({frame.x(angles[i]), frame.y(weights[i] / largest)});
  draw_polyline(picture, points, 2 * frame.text() / 9.0, color, frame.box());
}

}  // namespace

Image draw_lobes(std::span<const AnyLobe> lobes, const LobePlot& plot) {
  require(plot.width >= 200 && plot.degrees >= 1 && plot.degrees <= 180,
          "a plot of lobes is at least 200 pixels wide, and shows 1 to 180 degrees");
  const Frame frame(plot);
  Image picture(plot.width, frame.height(), 3);
  fill_box(picture, {0, 0, picture.width(), picture.height()}, kWhite);
  draw_frame(picture, frame, plot);
  const int text = frame.text(), right = frame.box().x + frame.box().width;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    // The ramp's end is too light for white paper.
    const Rgb color = color_ramp(0.82 * static_cast<double>(i) /
                                 (std::max<double>(2, static_cast<double>(lobes.size())) - 1));
    draw_curve(picture, lobes[i], frame, color);
    const int y = frame.box().y + text + static_cast<int>(i) * 2 * text;
    fill_box(picture, {right + text, y - text / 6, 3 * text / 2, text / 3}, color);
    draw_text(picture, {std::to_string(i + 1), right + 3.6 * text, static_cast<double>(y), 1.0 * text});
  }
  return picture;
}

}  // namespace welkin
