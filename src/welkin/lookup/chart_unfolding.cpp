#include "welkin/lookup/chart_unfolding.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/lookup/square_octahedron.h"

namespace welkin {
namespace {

struct Interval {
  double from, to;
  int past;  ///< −1 before the chart, 1 after it
};

/// An interval's parts before, within and after 0 … size.
struct Intervals {
  int count = 0;
  Interval list[3];

  Intervals(double from, double to, double size) {
    add(from, std::min(to, 0.0), -1);
    add(std::max(from, 0.0), std::min(to, size), 0);
    add(std::max(from, size), to, 1);
  }

 private:
  void add(double from, double to, int past) {
    if (from < to) list[count++] = {from, to, past};
  }
};

void push(ChartUnfolding::Parts& parts, int chart, double left, double top, double right, double bottom) {
  parts.list[parts.count++] = {chart, left, top, right, bottom};
}

}  // namespace

ChartUnfolding::ChartUnfolding(const sphere::AnyParameterization& p, ChartSize size)
    : width_(size.width), height_(size.height) {
  if (p.traits().latlong_grid) {
    kind_ = Kind::latlong;
  } else if (is_square_octahedron(p)) {
    kind_ = Kind::octahedron;
  } else if (p.traits().cube_faces) {
    kind_ = Kind::cube;
    for (int chart = 0; chart < p.charts(); ++chart) {
      for (const Side side : {left, right, top, bottom}) neighbours_.push_back(neighbour(p, chart, side));
    }
  } else {
    throw Error(ErrorKind::unsupported,
                "look-up: summed areas are for latlong, cube, eac, openexr-cube, octahedral and "
                "octahedral-equal-area maps, not for " +
                    p.name());
  }
}

ChartUnfolding::Neighbour ChartUnfolding::neighbour(const sphere::AnyParameterization& p, int chart,
                                                    Side side) const {
  // Just past the edge, at a quarter along it.
  constexpr double kPast = 1e-3, kAlong = 0.25;
  const double across = side == left || side == top ? -kPast : 1 + kPast;
  const Vec3d d =
      side == left || side == right ? p.to_sphere(chart, across, kAlong) : p.to_sphere(chart, kAlong, across);
  const auto at = p.from_sphere(d);
  const double to_edge[4] = {at.u, 1 - at.u, at.v, 1 - at.v};
  const auto nearest = std::min_element(to_edge, to_edge + 4) - to_edge;
  const Side edge = static_cast<Side>(nearest);
  const double along = edge == left || edge == right ? at.v : at.u;
  return {static_cast<int>(at.chart), edge, along > 0.5};
}

ChartUnfolding::Parts ChartUnfolding::parts_of(const ChartRectangle& r) const {
  Parts parts;
  switch (kind_) {
    case Kind::latlong:
      add_latlong(r, parts);
      break;
    case Kind::octahedron:
      add_octahedron(r, parts);
      break;
    case Kind::cube:
      add_cube(r, parts);
      break;
  }
  return parts;
}

void ChartUnfolding::add_latlong(const ChartRectangle& r, Parts& parts) const {
  const Intervals rows(r.top, r.bottom, height_);
  for (int j = 0; j < rows.count; ++j) {
    Interval row = rows.list[j];
    double from = r.left, to = r.right;
    if (row.past != 0) {
      // Past a pole, up the opposite meridian.
      const double twice = row.past < 0 ? 0 : 2 * height_;
      row = {twice - row.to, twice - row.from, 0};
      from += 0.5 * width_;
      to += 0.5 * width_;
    }
    const double turns = std::floor(from / width_) * width_;
    const Intervals columns(from - turns, to - turns, width_);
    for (int i = 0; i < columns.count; ++i) {
      const Interval& column = columns.list[i];
      const double back = column.past > 0 ? width_ : 0;
      push(parts, 0, column.from - back, row.from, column.to - back, row.to);
    }
  }
}

void ChartUnfolding::add_octahedron(const ChartRectangle& r, Parts& parts) const {
  const Intervals columns(r.left, r.right, width_), rows(r.top, r.bottom, height_);
  for (int j = 0; j < rows.count; ++j) {
    for (int i = 0; i < columns.count; ++i) {
      // Folded about the middle of the edge that it is past, of both where it is past a corner.
      Interval x = columns.list[i], y = rows.list[j];
      const auto fold = [](Interval& past, double size, Interval& along, double length) {
        const double twice = past.past < 0 ? 0 : 2 * size;
        past = {twice - past.to, twice - past.from, 0};
        along = {length - along.to, length - along.from, -along.past};
      };
      if (x.past != 0) fold(x, width_, y, height_);
      if (y.past != 0) fold(y, height_, x, width_);
      push(parts, 0, x.from, y.from, x.to, y.to);
    }
  }
}

void ChartUnfolding::add_cube(const ChartRectangle& r, Parts& parts) const {
  const Intervals columns(r.left, r.right, width_), rows(r.top, r.bottom, height_);
  for (int j = 0; j < rows.count; ++j) {
    for (int i = 0; i < columns.count; ++i) {
      const Interval &x = columns.list[i], &y = rows.list[j];
      if (x.past != 0 && y.past != 0) continue;
      if (x.past == 0 && y.past == 0) {
        push(parts, r.chart, x.from, y.from, x.to, y.to);
        continue;
      }
      const bool sideways = x.past != 0;
      const Side side = sideways ? (x.past < 0 ? left : right) : (y.past < 0 ? top : bottom);
      const Neighbour& other = neighbours_[static_cast<std::size_t>(4 * r.chart + side)];
      // In parts of a side: along the edge, and how far past it.
      const double length = sideways ? height_ : width_, depth_unit = sideways ? width_ : height_;
      const Interval& run = sideways ? y : x;
      double from = run.from / length, to = run.to / length;
      if (other.reversed) {
        const double first = 1 - to;
        to = 1 - from;
        from = first;
      }
      const Interval& past = sideways ? x : y;
      const double depth = (past.to - past.from) / depth_unit;
      switch (other.edge) {
        case left:
          push(parts, other.chart, 0, from * height_, depth * width_, to * height_);
          break;
        case right:
          push(parts, other.chart, (1 - depth) * width_, from * height_, width_, to * height_);
          break;
        case top:
          push(parts, other.chart, from * width_, 0, to * width_, depth * height_);
          break;
        case bottom:
          push(parts, other.chart, from * width_, (1 - depth) * height_, to * width_, height_);
          break;
      }
    }
  }
}

}  // namespace welkin
