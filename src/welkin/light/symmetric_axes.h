#pragma once

#include <array>
#include <cmath>

#include "welkin/math/vec.h"

/// The longest axis of a cloud of points. Internal to light.
namespace welkin {

/// Σ weight · d dᵀ.
struct SymmetricMatrix {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  void add(double weight, const Vec3d& d) {
    xx += weight * d.x * d.x;
    yy += weight * d.y * d.y;
    zz += weight * d.z * d.z;
    xy += weight * d.x * d.y;
    xz += weight * d.x * d.z;
    yz += weight * d.y * d.z;
  }
  Vec3d operator*(const Vec3d& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
};

/// The eigenvector of the largest eigenvalue of a positive matrix, by powers. Where several are alike, as of
/// a whole sphere, one of them: any will do.
inline Vec3d longest_axis(const SymmetricMatrix& m) {
  Vec3d v{0.48, 0.6, 0.64};
  for (int i = 0; i < 64; ++i) {
    const Vec3d next = m * v;
    const double size = length(next);
    if (!(size > 1e-30)) break;
    v = (1 / size) * next;
  }
  return v;
}

}  // namespace welkin
