#pragma once

#include <string>

#include "welkin/sphere/registry.h"

namespace welkin {

/// Whether a map is an octahedron unfolded to a square with +Y at its centre, whose edges are folded about
/// their middles: past the right one, (u, v) is (2 − u, 1 − v).
inline bool is_square_octahedron(const sphere::AnyParameterization& p) {
  const std::string name = p.name();
  return name == "octahedral" || name == "octahedral-equal-area";
}

}  // namespace welkin
