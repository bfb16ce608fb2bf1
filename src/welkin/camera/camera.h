#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/map.h"
#include "welkin/math/look.h"

/// @file
/// Cameras: what part of the world a picture shows, and how.
namespace welkin {

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
