#include "welkin/filter/overlap.h"

#include <algorithm>
#include <cmath>

namespace welkin {

void Overlap::start(int x, int y, int width, int height) {
  x_ = x;
  y_ = y;
  width_ = width;
  height_ = height;
  const std::size_t cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (cells_.size() < cells) cells_.resize(cells);
  touched_.assign(cells, 0);
  rows_.assign(static_cast<std::size_t>(height), {width, -1});
}

double Overlap::stretched(int row, double within) const {
  if (bend_ == nullptr) return within;
  const double bend = static_cast<double>((*bend_)[static_cast<std::size_t>(y_ + row)]);
  return within * (1 - bend + bend * within);
}

void Overlap::add_edge(double from_x, double from_y, double to_x, double to_y) {
  from_x -= x_;
  to_x -= x_;
  from_y -= y_;
  to_y -= y_;
  if (from_y == to_y) return;
  const double slope = (to_x - from_x) / (to_y - from_y);
  const int step = to_y > from_y ? 1 : -1;
  // The row in which it starts: an edge that starts on a border goes into the row ahead.
  int row = static_cast<int>(step > 0 ? std::floor(from_y) : std::ceil(from_y) - 1);
  double x = from_x, y = from_y;
  for (;;) {
    const double border = step > 0 ? row + 1 : row;
    const bool last = step > 0 ? to_y <= border : to_y >= border;
    const double next_y = last ? to_y : border, next_x = last ? to_x : from_x + slope * (border - from_y);
    const int inside = std::clamp(row, 0, height_ - 1);
    add_row(inside, x, stretched(inside, std::clamp(y - inside, 0.0, 1.0)), next_x,
            stretched(inside, std::clamp(next_y - inside, 0.0, 1.0)));
    if (last) return;
    x = next_x;
    y = next_y;
    row += step;
  }
}

void Overlap::add_row(int row, double from_x, double from_y, double to_x, double to_y) {
  if (from_y == to_y) return;
  const double slope = from_x == to_x ? 0 : (to_y - from_y) / (to_x - from_x);
  const int step = to_x >= from_x ? 1 : -1;
  int column = static_cast<int>(step > 0 ? std::floor(from_x) : std::ceil(from_x) - 1);
  double x = from_x, y = from_y;
  for (;;) {
    const double border = step > 0 ? column + 1 : column;
    const bool last = step > 0 ? to_x <= border : to_x >= border;
    const double next_x = last ? to_x : border, next_y = last ? to_y : from_y + slope * (border - from_x);
    add_cell(std::clamp(column, 0, width_ - 1), row, x, y, next_x, next_y);
    if (last) return;
    x = next_x;
    y = next_y;
    column += step;
  }
}

void Overlap::add_cell(int column, int row, double from_x, double from_y, double to_x, double to_y) {
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
