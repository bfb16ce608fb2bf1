#pragma once

#include "welkin/sphere/parameterization.h"

namespace welkin::sphere {

/// Continues a chart past its edges where no formula of its own does: the direction at (u, v) is the one at
/// the position mirrored at the edge, reflected through the edge's own direction e: out = 2 (in · e) e − in,
/// so the great circle from `in` through e continues as far beyond. Continuous for (u, v) ∈ [−1, 2]², with
/// the first derivatives across an edge's own continued; inside the chart it is the chart itself. `inside(u,
/// v)` gives unit directions on [0, 1]².
template <class T, class Inside>
Vec3<T> reflect_past_edge(T u, T v, const Inside& inside) {
  const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2);
  const T edge_u = clamp(u, zero, one), edge_v = clamp(v, zero, one);
  const Vec3<T> edge = inside(edge_u, edge_v);
  const Vec3<T> in = inside(two * edge_u - u, two * edge_v - v);
  const Vec3<T> out = two * dot(in, edge) * edge - in;
  // The same inside, but for rounding.
  const auto in_columns = u == edge_u, in_rows = v == edge_v;
  const auto inside_chart = in_columns & in_rows;
  return {select(inside_chart, in.x, out.x), select(inside_chart, in.y, out.y),
          select(inside_chart, in.z, out.z)};
}

}  // namespace welkin::sphere
