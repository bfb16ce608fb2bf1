#include "welkin/plot/polyline.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace welkin {
namespace {

double distance(const PlotPoint& p, const PlotPoint& a, const PlotPoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

void draw_polyline(Image& picture, std::span<const PlotPoint> points, double width, const Rgb& color,
                   const Box& box) {
  const double half_width = 0.5 * width;
  const auto stride = static_cast<std::size_t>(picture.width());
  std::vector<float> cover(stride * static_cast<std::size_t>(picture.height()));
  for (std::size_t i = 0; i + 1 < points.size() && points[i + 1].x <= box.x + box.width; ++i) {
    const PlotPoint &a = points[i], &b = points[i + 1];
    const int right = std::min(static_cast<int>(b.x + half_width + 1), box.x + box.width);
    const int low = std::min(static_cast<int>(std::max(a.y, b.y) + half_width + 1), box.y + box.height);
    for (int y = std::max(static_cast<int>(std::min(a.y, b.y) - half_width - 1), 0); y <= low; ++y) {
      for (int x = static_cast<int>(a.x - half_width - 1); x <= right; ++x) {
        const double here = half_width + 0.5 - distance({x + 0.5, y + 0.5}, a, b);
        float& maximum = cover[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
        maximum = std::max(maximum, static_cast<float>(here));
      }
    }
  }
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x)
      blend(picture, x, y, color, cover[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)]);
  }
}

}  // namespace welkin
