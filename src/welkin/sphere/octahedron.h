#pragma once

#include "welkin/sphere/parameterization.h"

namespace welkin::sphere {

/// The planar projection p' = p/(|x| + |y| + |z|) (Engelhardt & Dachsbacher 2008, eq. 1).
template <class T>
Vec3<T> octahedron_point(const Vec3<T>& d) {
  return (constant<T>(1) / (abs(d.x) + abs(d.y) + abs(d.z))) * d;
}

/// 1/|p'|³: solid angle per area of the octahedron seen along y. A side's plane has x + y + z = 1, so it is
/// √3 larger than its projection and seen at the cosine 1/(√3 |p'|), and dω = √3 dA · 1/(√3 |p'|) / |p'|².
template <class T>
T octahedron_density(const Vec3<T>& p) {
  const T r2 = dot(p, p);
  return constant<T>(1) / (r2 * sqrt(r2));
}

/// Mirrored at ±1: s inside, 2 − s above, −2 − s below.
template <class T>
T mirror_at_one(T s) {
  const T edge = clamp(s, constant<T>(-1), constant<T>(1));
  return edge + edge - s;
}

/// The square unfolding, both coordinates in [−1, 1], is continued past its edges by folding it back: the
/// point beyond an edge is the point mirrored at the edge with the other coordinate negated. Exact for
/// |s|, |t| ≤ 3.
template <class T>
struct SquarePoint {
  T s, t;
};

template <class T>
SquarePoint<T> fold_square(T s, T t) {
  const T one = constant<T>(1);
  const T inside_s = mirror_at_one(s), inside_t = mirror_at_one(t);
  return {select(abs(t) > one, -inside_s, inside_s), select(abs(s) > one, -inside_t, inside_t)};
}

/// The height y of the point (a, b) of a half octahedron turned by 45° to fill a square, x = (a ± b)/2: 1 −
/// max(|a|, |b|). Past an edge the square continues, mirrored, over the other half; `a` and `b` are changed
/// to the mirrored point.
template <class T>
T fold_half(T& a, T& b) {
  const T one = constant<T>(1);
  const auto one_over = (abs(a) > one) ^ (abs(b) > one);
  a = mirror_at_one(a);
  b = mirror_at_one(b);
  const T height = one - max(abs(a), abs(b));
  return select(one_over, -height, height);
}

}  // namespace welkin::sphere
