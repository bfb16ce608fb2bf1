#pragma once

#include "welkin/base/export.h"
#include "welkin/math/rotation.h"

/// @file
/// Where a camera looks.
namespace welkin {

/// Where a camera looks. All 0: along +Z, the centre of a lat-long, with +Y up and −X on the right. Degrees
/// (docs/conventions.md). Roll comes first, then pitch, then yaw.
struct Look {
  double yaw = 0;    ///< about the world's up: as it grows the camera turns to its right
  double pitch = 0;  ///< about the camera's right: as it grows it looks higher
  double roll = 0;  ///< about the camera's axis: as it grows it tilts to its right, so that the horizon turns
                    ///< counterclockwise in the picture
};

/// The rotation from the camera (right −X, up +Y, ahead +Z) to the world: the inverse of its pictures'
/// Map::orientation. Throws Error (bad_request) for angles that aren't finite.
WELKIN_API Matrix3 rotation_of(const Look& look);

}  // namespace welkin
