#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "welkin/assemble/edges.h"
#include "welkin/base/export.h"
#include "welkin/map/map.h"
#include "welkin/math/look.h"

/// @file
/// Pictures of parts of the world, from which one is assembled (assemble.h).
namespace welkin {

/// The layer of what lies behind all pieces and isn't one: a background.
inline constexpr int kBackdrop = std::numeric_limits<int>::min();

/// A picture of part of the world. Its directions, and those of `edges`, are its map's; the map's orientation
/// says where in the world they lie.
struct WELKIN_API Piece {
  std::string name;        ///< for messages: a file, for instance
  Map map;                 ///< R G B A, colours multiplied by alpha, borders filled
  std::vector<Cap> edges;  ///< the piece is what these have in common
  double feather = 0;      ///< radians inside each edge over which the piece fades in
  int layer = 0;           ///< pieces of a layer are blended, a higher layer lies over the lower ones
  double gain = 1;         ///< times its radiance

  /// The map's channels are made R G B A: of Y, Y A or R G B too. Throws Error: (unsupported) other channels,
  /// (bad_value) values that are NaN or infinite, alpha outside 0 … 1.
  Piece(std::string name, Map map);
};

/// A circle in a picture, texels from its top left corner; texel centres lie at +½.
struct PictureCircle {
  double x = 0;       ///< of the centre, to the right
  double y = 0;       ///< of the centre, down
  double radius = 0;  ///< of the circle, at least 2
};

/// Throws Error (bad_request) about the picture when the circle isn't inside it, to half a texel, or isn't
/// one.
WELKIN_API void check_circle(const std::string& name, const Map& picture, const PictureCircle& circle);

/// How a picture is placed in the world.
struct PanelOptions {
  Look look = {};      ///< where its centre looks
  double feather = 0;  ///< degrees inside its edges over which it fades in, 0 … 90
  int layer = 0;       ///< Piece::layer
  double gain = 1;     ///< times its radiance, positive
};

/// A piece of a map whose parameterization shows part of the world, or all of it: the orientation becomes
/// that of the look. Throws Error (bad_request) for options out of range, (unsupported) for edges that can't
/// be feathered (edges_of), and as Piece.
WELKIN_API Piece make_panel(std::string name, Map map, const PanelOptions& options = {});

/// The same of a flat picture, as a camera or a painter sees it: the map's pixels are what counts, whatever
/// its parameterization of one chart; `fov` is its horizontal field of view, degrees, 0.001 … 179.
WELKIN_API Piece make_flat_panel(std::string name, Map picture, double fov, const PanelOptions& options = {});

/// The same of a picture that holds the disc of a parameterization, a fish-eye's or a mirror ball's, in a
/// circle: its pixels are what counts. None: the circle inscribed in it. Throws also Error (bad_request) for
/// a circle that isn't inside it, and a parameterization that isn't a disc.
WELKIN_API Piece make_disc_panel(std::string name, Map picture, const sphere::AnyParameterization& disc,
                                 const std::optional<PictureCircle>& circle = {},
                                 const PanelOptions& options = {});

/// A map with the pixels of another's single chart. Its borders are filled. Throws Error (bad_request) when
/// either has more charts.
WELKIN_API Map with_parameterization(const sphere::AnyParameterization& parameterization, Map map);

}  // namespace welkin
