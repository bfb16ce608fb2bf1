#pragma once

#include <optional>
#include <string>

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
  double step = 0;                    ///< across the edges, as Joining::step
};

/// How faces join.
struct Joining {
  /// The mean step between texels that face each other across an edge of the cube, and between neighbours
  /// beside it: of log₂(luminance), stops.
  double step = 0, inner_step = 0;
  std::optional<FaceReading> better;  ///< a reading whose faces join where these don't
  /// Whether they join as they were read: the step is about as small as it is inside of faces.
  bool joins() const;
};

/// Measures a map of cube faces that was read with this layout, which was turned by `orientation` and
/// `faces` already. Where its faces don't join, tries both worlds, the top and bottom in each quarter turn,
/// and all faces upside down or mirrored.
Joining measure_joining(const Map& map, const Layout& layout);

}  // namespace welkin::map_file
