#pragma once

#include "welkin/render/world.h"

namespace welkin::scene {

/// A place, and how it changes from pixel to pixel.
struct SpreadPlace {
  Vec3d position;
  Change change = {};
};

/// seen_from of a ray with its differentials.
inline RayDifferential seen_from(const Proxy& proxy, const SpreadPlace& from, const RayDifferential& ray) {
  if (proxy.shape == Proxy::Shape::far) return ray;
  const Vec3d middle = seen_from(proxy, from.position, ray.direction);
  const auto moved = [&](const Vec3d& position, const Vec3d& direction) {
    return seen_from(proxy, from.position + position, ray.direction + direction) - middle;
  };
  return {middle, moved(from.change.right, ray.right), moved(from.change.down, ray.down)};
}

/// A camera's ray as a direction that changes.
inline RayDifferential direction_of(const RaySpread& ray) {
  return {ray.direction, ray.direction_change.right, ray.direction_change.down};
}

}  // namespace welkin::scene
