#pragma once

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"

namespace welkin::lobe {

/// The angle from the axis, radians, within which the lobe has this share, 0 … 1, of its energy ∫ w dω.
/// Relative error 1e-9 in the energy. 0 for a mirror.
WELKIN_API double energy_cone_angle(const AnyLobe& lobe, double share);

}  // namespace welkin::lobe
