#pragma once

#include <optional>
#include <string>

#include "welkin/map/face_edges.h"
#include "welkin/map/map.h"
#include "welkin/map_file/layout.h"

/// Whether the faces of a cube join, and how they do: files of faces seldom say in which order, from which
/// side and which way up they are.
namespace welkin::map_file {

/// A way to read six faces, as the options of reading have it.
struct FaceReading {
  std::string convention = "native";  ///< of the world; else that of textures, whose +X is to the right of +Z
  Matrix3 orientation;                ///< the convention's
  std::string faces = {};             ///< as with_faces; empty: the layout's own
  double step = 0;                    ///< across the edges, as FaceEdges::across
  double next_step = 0;               ///< of the best reading that joins otherwise
  bool ordered = false;               ///< whether the faces lie in another order than any usual one

  /// `the world of three.js, the faces being …`.
  std::string text() const;
  /// Whether another reading would join about as well.
  bool is_unsure() const;
};

/// How faces join.
struct Joining {
  FaceEdges edges;                    ///< as they were read
  std::optional<FaceReading> better;  ///< a reading whose faces join where these don't
};

/// Measures a map of cube faces that was read with this layout, which was turned by an orientation and faces
/// already. Where its faces don't join, tries both worlds, the top and bottom in each quarter turn, and all
/// faces upside down or mirrored; then all orders and turns.
Joining measure_joining(const Map& map, const Layout& layout);

}  // namespace welkin::map_file
