#pragma once

#include <limits>
#include <optional>
#include <string>

#include "welkin/assemble/piece.h"
#include "welkin/base/export.h"

/// @file
/// Photographs of a mirror ball as pieces of a world.
namespace welkin {

/// How a photograph of a mirror ball was taken. The ball is on the camera's axis, so that its outline is a
/// circle.
struct BallPhotographOptions {
  Look look = {};  ///< where the camera looks: to the ball
  /// From the camera to the ball's centre, ball radii, from 1.01 on; infinity: so far away that rays are
  /// parallel.
  double distance = std::numeric_limits<double>::infinity();
  /// In place of the distance: the photograph's horizontal field of view, degrees. The distance follows from
  /// the size of the ball in it.
  std::optional<double> fov = {};
  std::optional<PictureCircle> circle = {};  ///< none: the circle inscribed in the photograph
  /// Half angle of the cone around the direction to the camera that is left out, degrees, below 90: what the
  /// camera and who holds it hide.
  double camera = 0;
  double rim = 1.5;    ///< texels at the ball's outline that are left out: there ball and background mix
  double feather = 5;  ///< PanelOptions::feather, at the camera's cone and at the rim
  int layer = 0;       ///< Piece::layer
  double gain = 1;     ///< times its radiance, positive
};

/// A photograph of a mirror ball as a piece, and what it does not show.
struct BallPiece {
  Piece piece;          ///< unwrapped when it is read: its map is the photograph
  double distance = 0;  ///< of the camera, ball radii
  /// Half angle of the cone straight behind the ball that no ray of the camera reaches, radians:
  /// asin(1/distance).
  double blind = 0;
  double left_out = 0;  ///< the same cone with the rim that is left out, radians
};

/// The photograph's directions are found by reflecting the rays of a perspective camera in the ball
/// (sphere/mirror_ball.h); the pixels are those of the map's one chart, whatever its parameterization. Throws
/// Error about the photograph: (bad_request) for options out of range, a circle that isn't inside the
/// photograph, a field of view in which a ball of that size can't be; and as Piece.
WELKIN_API BallPiece make_ball_piece(std::string name, Map photograph, const BallPhotographOptions& options);

}  // namespace welkin
