#pragma once

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"

/// @file
/// The cone that holds a share of a lobe's energy.
namespace welkin::lobe {

/// The energy cone angle: the angle from the axis, radians, 0…π, within which the lobe has this share, 0…1,
/// of its energy ∫ w dω. Relative error 1e-9 in the energy. 0 for a mirror.
WELKIN_API double energy_cone_angle(const AnyLobe& lobe, double share);

}  // namespace welkin::lobe
