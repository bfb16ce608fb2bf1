#pragma once

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Whether the faces of a cube continue each other.
namespace welkin {

/// Mean steps of log₂(luminance), stops, about the edges of a cube's faces. The darkest texels, below a
/// sixteenth of the mean, count for little.
struct FaceEdges {
  double across = 0;  ///< between texels that face each other across an edge
  double beside = 0;  ///< between a face's outermost texels and those next to them, inside of it

  /// Whether the faces continue each other: the step across edges is about as small as beside them.
  WELKIN_API bool join() const;
};

/// Measures at most 64 places along each edge. Throws Error (bad_request) unless the map's charts are the
/// faces of a cube (Traits::cube_faces).
WELKIN_API FaceEdges measure_face_edges(const Map& map);

}  // namespace welkin
