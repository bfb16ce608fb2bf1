#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Cameras: what part of the world a picture shows, and how.
namespace welkin {

/// Where a camera looks. All 0: along +Z, the centre of a lat-long, with +Y up and −X on the right. Degrees
/// (docs/conventions.md): as `yaw` grows the camera turns to its right, as `pitch` grows it looks higher, and
/// as `roll` grows it tilts to its right, so that the horizon turns counterclockwise in the picture. Roll
/// comes first, then pitch, then yaw.
struct Look {
  double yaw = 0;    ///< about the world's up
  double pitch = 0;  ///< about the camera's right
  double roll = 0;   ///< about the camera's axis
};

/// The rotation from the camera (right −X, up +Y, ahead +Z) to the world.
WELKIN_API Matrix3 rotation_of(const Look& look);

/// Between which edges a field of view is measured.
enum class FovAxis {
  horizontal,  ///< left and right
  vertical,    ///< top and bottom
  diagonal,    ///< two opposite corners
};

/// `horizontal`, `vertical`, `diagonal`. Throws Error (bad_request) for another name.
WELKIN_API FovAxis fov_axis_from_name(std::string_view name);

/// A camera at the centre of the world.
struct Camera {
  /// Any parameterization with its parameters: `perspective`, `pannini,d=0.5`, `fisheye-equisolid`,
  /// `latlong`… (docs/parameterizations.md); or one of camera_names, which are these looking elsewhere.
  std::string lens = "perspective";
  std::optional<double> fov = {};      ///< field of view, degrees; none: the lens's own
  FovAxis axis = FovAxis::horizontal;  ///< of `fov`
  ChartSize size = {1920, 1080};       ///< of the picture, pixels, which are square
  Matrix3 rotation = {};               ///< from the camera to the world: rotation_of
  double shift_right = 0;              ///< of the frame before the lens, in its widths
  double shift_up = 0;                 ///< the same, in its heights
};

/// A name for a lens that is mounted so that it looks elsewhere than ahead.
struct CameraName {
  std::string name;         ///< `dome`
  std::string description;  ///< one line
};
/// `dome`, `little-planet`.
WELKIN_API std::vector<CameraName> camera_names();

/// The picture as a map: its parameterization, size, and orientation. Throws Error (bad_request): an unknown
/// lens or parameter, a field of view that the lens doesn't have, or that is given twice, a size below 1, a
/// shift of a lens without a frame, a rotation that isn't orthonormal.
WELKIN_API MapFrame frame_of(const Camera& camera);

}  // namespace welkin
