#include "welkin/plot/draw_density.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "welkin/base/parallel.h"
#include "welkin/image/color_ramp.h"
#include "welkin/image/drawing.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

constexpr int kGap = 2;          // between charts
constexpr double kOctaves = 2;   // of the scale on either side of the average
constexpr int kNarrowest = 200;  // pictures leave room for the scale

double scale_position(double octave) {
  return (octave + kOctaves) / (2 * kOctaves);
}

class ChartPainter {
 public:
  ChartPainter(const AnyParameterization& p, int width, int height, double average)
      : p_(p), width_(width), height_(height), texels_over_average_(1 / (average * width * height)) {}

  void paint(Image& picture, int left, int chart) const {
    parallel_for(height_, [&](int y) {
      for (int x = 0; x < width_; ++x) paint_texel(picture, left + x, chart, x, y);
    });
  }

 private:
  double octave(int chart, double x, double y) const {
    return std::log2(p_.solid_angle_density(chart, x / width_, y / height_) * texels_over_average_);
  }

  void paint_texel(Image& picture, int left, int chart, int x, int y) const {
    const double u = x + 0.5, v = y + 0.5;
    if (!p_.valid(chart, u / width_, v / height_)) {
      blend(picture, left, y, neutral_color(), 1);
      return;
    }
    const double here = octave(chart, u, v);
    const double position = scale_position(here);
    blend(picture, left, y, color_ramp(position), 1);
    blend(picture, left, y, position < 0.6 ? kWhite : kBlack, contour_cover(chart, u, v, here));
  }

  /// How much of the texel centred on (u, v) the nearest contour line covers; none where lines would run
  /// together.
  double contour_cover(int chart, double u, double v, double here) const {
    constexpr double kFlat = 1e-5, kCrowded = 0.35, kReach = 0.25;
    const double right = octave(chart, u + kReach, v) - octave(chart, u - kReach, v);
    const double down = octave(chart, u, v + kReach) - octave(chart, u, v - kReach);
    const double gradient = std::hypot(right, down) / (2 * kReach);
    if (!(gradient > kFlat) || gradient > kCrowded) return 0;
    const double nearest = std::round(here);
    const double half_width = nearest == 0 ? 1.1 : 0.6;
    const double cover = half_width + 0.5 - std::fabs(here - nearest) / gradient;
    return cover > 0 && crosses(chart, u, v, nearest) ? cover : 0;
  }

  /// Whether the density passes through an octave close by, and doesn't just touch it with an extreme.
  bool crosses(int chart, double u, double v, double level) const {
    constexpr double kReach = 2, kRounding = 1e-9;
    bool below = false, above = false;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const double value = octave(chart, std::clamp(u + kReach * i, 0.0, static_cast<double>(width_)),
                                    std::clamp(v + kReach * j, 0.0, static_cast<double>(height_)));
        below = below || value < level - kRounding;
        above = above || value > level + kRounding;
      }
    }
    return below && above;
  }

  const AnyParameterization& p_;
  const int width_, height_;
  const double texels_over_average_;
};

/// 1/denominator, written as a fraction `size` pixels high when `denominator` isn't empty; else `whole`.
struct Label {
  double octave;
  std::string_view whole, denominator;
};
constexpr Label kLabels[] = {{-2, "1", "4"}, {-1, "1", "2"}, {0, "1", ""}, {1, "2", ""}, {2, "4", ""}};

struct ScaleSize {
  int text, bar, height;

  explicit ScaleSize(int picture_width)
      : text(std::clamp(picture_width / 40, 12, 40)), bar(text), height(5 * text) {}
};

/// The bar with its ticks and labels, from row `top` of the picture on.
void draw_scale(Image& picture, int top, const ScaleSize& size) {
  const int width = picture.width() * 3 / 5, left = (picture.width() - width) / 2, bar_top = top + size.text;
  for (int x = 0; x < width; ++x) {
    fill_box(picture, {left + x, bar_top, 1, size.bar}, color_ramp((x + 0.5) / width));
  }
  const int tick = std::max(1, size.text / 12);
  for (const Label& label : kLabels) {
    const double x = left + width * scale_position(label.octave);
    const double y = bar_top + size.bar + 1.9 * size.text;
    const int tick_left = static_cast<int>(std::lround(x - 0.5 * tick));
    fill_box(picture, {tick_left, bar_top + size.bar, tick, size.text / 2}, kBlack);
    if (label.denominator.empty()) {
      draw_text(picture, {label.whole, x, y - 0.4 * size.text, 1.0 * size.text});
    } else {
      draw_text(picture, {label.whole, x, y - 0.7 * size.text, 0.75 * size.text});
      fill_box(picture,
               {static_cast<int>(x - 0.4 * size.text), static_cast<int>(y - 0.15 * size.text),
                static_cast<int>(0.8 * size.text), tick},
               kBlack);
      draw_text(picture, {label.denominator, x, y + 0.45 * size.text, 0.75 * size.text});
    }
  }
}

}  // namespace

Image draw_density(const AnyParameterization& parameterization, const DensityReport& report) {
  const int width = report.width, height = report.height;
  const double average = parameterization.coverage() / density_limits(parameterization).valid_area /
                         (static_cast<double>(width) * height);
  const int charts_width = parameterization.charts() * (width + kGap) - kGap;
  const int picture_width = std::max(charts_width, kNarrowest);
  const ScaleSize scale(picture_width);
  Image picture(picture_width, height + scale.height, 3);
  fill_box(picture, {0, 0, picture.width(), picture.height()}, kWhite);
  const ChartPainter painter(parameterization, width, height, average);
  const int left = (picture_width - charts_width) / 2;
  for (int chart = 0; chart < parameterization.charts(); ++chart) {
    painter.paint(picture, left + chart * (width + kGap), chart);
  }
  draw_scale(picture, height, scale);
  return picture;
}

}  // namespace welkin
