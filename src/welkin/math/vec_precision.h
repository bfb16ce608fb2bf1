#pragma once

#include "welkin/math/vec.h"

/// Vectors between float, as cones have them, and double..
namespace welkin {

inline Vec3<float> to_float(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline Vec3d to_double(const Vec3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace welkin
