#include "welkin/filter/overlap.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// Cuts an edge at whole numbers of its first coordinate: body(whole number below, from a, from b, to a, to
/// b) for each piece. An edge that starts on one goes on into what lies ahead.
template <class Body>
void walk(double from_a, double from_b, double to_a, double to_b, const Body& body) {
  const double slope = from_a == to_a ? 0 : (to_b - from_b) / (to_a - from_a);
  const int step = to_a >= from_a ? 1 : -1;
  int cell = static_cast<int>(step > 0 ? std::floor(from_a) : std::ceil(from_a) - 1);
  double a = from_a, b = from_b;
  for (;;) {
    const double border = step > 0 ? cell + 1 : cell;
    const bool last = step > 0 ? to_a <= border : to_a >= border;
    const double next_a = last ? to_a : border, next_b = last ? to_b : from_b + slope * (border - from_a);
    body(cell, a, b, next_a, next_b);
    if (last) return;
    a = next_a;
    b = next_b;
    cell += step;
  }
}

}  // namespace

void PolygonOverlap::start(int x, int y, int width, int height) {
  x_ = x;
  y_ = y;
  width_ = width;
  height_ = height;
  const std::size_t cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (cells_.size() < cells) cells_.resize(cells);
  touched_.assign(cells, 0);
  rows_.assign(static_cast<std::size_t>(height), {width, -1});
}

double PolygonOverlap::stretched(int row, double within) const {
  if (bend_ == nullptr) return within;
  const double bend = static_cast<double>((*bend_)[static_cast<std::size_t>(y_ + row)]);
  return within * (1 - bend + bend * within);
}

void PolygonOverlap::add_edge(double from_x, double from_y, double to_x, double to_y) {
  if (from_y == to_y) return;
  walk(from_y - y_, from_x - x_, to_y - y_, to_x - x_,
       [&](int row, double y, double x, double next_y, double next_x) {
         const int inside = std::clamp(row, 0, height_ - 1);
         add_row(inside, x, stretched(inside, std::clamp(y - inside, 0.0, 1.0)), next_x,
                 stretched(inside, std::clamp(next_y - inside, 0.0, 1.0)));
       });
}

void PolygonOverlap::add_row(int row, double from_x, double from_y, double to_x, double to_y) {
  if (from_y == to_y) return;
  walk(from_x, from_y, to_x, to_y, [&](int column, double x, double y, double next_x, double next_y) {
    add_cell(std::clamp(column, 0, width_ - 1), row, x, y, next_x, next_y);
  });
}

void PolygonOverlap::add_cell(int column, int row, double from_x, double from_y, double to_x, double to_y) {
  const std::size_t k = index(column, row);
  Cell& cell = cells_[k];
  if (touched_[k] == 0) {
    touched_[k] = 1;
    cell = {};
    Rows& r = rows_[static_cast<std::size_t>(row)];
    r.first = std::min(r.first, column);
    r.last = std::max(r.last, column);
  }
  const double x0 = from_x - column - 0.5, x1 = to_x - column - 0.5;
  const double y0 = from_y - 0.5, y1 = to_y - 0.5;
  const double dy = y1 - y0;
  // Gauss's two points integrate these cubics exactly.
  constexpr double kGauss = 0.28867513459481288;
  const double middle_x = 0.5 * (x0 + x1), middle_y = 0.5 * (y0 + y1);
  for (const double side : {-kGauss, kGauss}) {
    const double x = middle_x + side * (x1 - x0), y = middle_y + side * dy, w = 0.5 * dy;
    const double right = 0.5 - x, first = 0.125 - 0.5 * x * x, second = (0.125 - x * x * x) / 3;
    cell.own.area += w * right;
    cell.own.x += w * first;
    cell.own.y += w * y * right;
    cell.own.xx += w * second;
    cell.own.xy += w * y * first;
    cell.own.yy += w * y * y * right;
    cell.right_y += w * y;
    cell.right_yy += w * y * y;
  }
  cell.right_area += dy;
}

}  // namespace welkin
