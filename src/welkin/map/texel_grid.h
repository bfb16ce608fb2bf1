#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "welkin/map/map.h"

namespace welkin {

/// The texels of a map by number, charts one under the other, row by row, and which lie beside which on the
/// sphere: across the edges of charts, the date line and the poles too.
class TexelGrid {
 public:
  using Index = std::int64_t;

  explicit TexelGrid(const Map& map)
      : p_(map.parameterization),
        full_(p_.full_charts()),
        charts_(map.charts()),
        width_(map.width()),
        height_(map.height()) {}

  Index size() const { return Index{charts_} * height_ * width_; }
  Index chart_size() const { return Index{height_} * width_; }

  struct Place {
    int chart, x, y;
  };
  Place place(Index texel) const {
    const Index row = texel / width_;
    return {static_cast<int>(row / height_), static_cast<int>(texel % width_),
            static_cast<int>(row % height_)};
  }
  Index number(int chart, int x, int y) const { return (Index{chart} * height_ + y) * width_ + x; }

  bool valid(Index texel) const {
    if (full_) return true;
    const auto [chart, x, y] = place(texel);
    return p_.valid(chart, (x + 0.5) / width_, (y + 0.5) / height_);
  }

  /// Up to eight, on the sphere; the same one may come twice, at poles.
  struct Neighbours {
    std::array<Index, 8> list;
    std::size_t count = 0;
    const Index* begin() const { return list.data(); }
    const Index* end() const { return list.data() + count; }
  };

  /// What is past the rim of a disc, where the map goes on elsewhere.
  enum class Rim { closed, open };

  /// Of a texel; of one inside a disc those inside it and, with an open rim, those that the map shows beyond.
  /// A texel's neighbour across an edge need not have it as its own.
  Neighbours neighbours(Index texel, Rim rim = Rim::closed) const {
    const auto [chart, x, y] = place(texel);
    const bool inside = valid(texel);
    Neighbours found;
    for (int j = y - 1; j <= y + 1; ++j) {
      for (int i = x - 1; i <= x + 1; ++i) {
        const bool in_chart = i >= 0 && i < width_ && j >= 0 && j < height_;
        Index other = in_chart ? number(chart, i, j) : across_edge(chart, i, j);
        if (in_chart && rim == Rim::open && inside && !valid(other)) other = across_edge(chart, i, j);
        if (other < 0 || other == texel || (inside && !valid(other))) continue;
        found.list[found.count++] = other;
      }
    }
    return found;
  }

 private:
  /// The texel that holds the direction of one past a chart's edge; −1 where the map shows nothing.
  Index across_edge(int chart, int x, int y) const {
    const double u = (x + 0.5) / width_, v = (y + 0.5) / height_;
    const Vec3d d = p_.to_sphere(chart, clamp(u, -1.0, 2.0), clamp(v, -1.0, 2.0));
    if (!p_.covers(d)) return -1;
    const auto position = p_.from_sphere(d);
    return number(static_cast<int>(position.chart),
                  std::clamp(static_cast<int>(position.u * width_), 0, width_ - 1),
                  std::clamp(static_cast<int>(position.v * height_), 0, height_ - 1));
  }

  const sphere::AnyParameterization& p_;
  const bool full_;
  const int charts_, width_, height_;
};

}  // namespace welkin
