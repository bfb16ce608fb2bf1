#pragma once

#include <vector>

#include "welkin/assemble/piece.h"
#include "welkin/base/export.h"

/// @file
/// What lies below the horizon of a sky.
namespace welkin {

/// What is made of a sky for the directions below its horizon.
enum class Ground {
  mirrored,   ///< the sky, upside down
  stretched,  ///< the row of texels just above the horizon, down to straight below
};

/// Adds pieces that show what is below the horizon, y < 0, to those of a sky; pieces of kBackdrop don't
/// count. Where a piece ends at the horizon or above it, they are of its layer and join it there; where it
/// reaches farther down, they lie below all others. Throws Error (unsupported): stretched, where the pieces
/// don't show all of the horizon; and as assemble().
WELKIN_API void add_ground(std::vector<Piece>& pieces, Ground how);

}  // namespace welkin
