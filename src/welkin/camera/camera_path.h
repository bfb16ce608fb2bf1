#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/camera/camera.h"

/// @file
/// Cameras that move from key frame to key frame.
namespace welkin {

/// Where a camera looks at one frame.
struct CameraKey {
  double frame = 0;                ///< its number, which need not be whole
  Look look = {};                  ///< degrees, of any size
  std::optional<double> fov = {};  ///< field of view, degrees; none: whatever the camera has
};

/// A camera's key frames, and where it looks between them.
///
/// The rotations at the keys are joined by a curve on the rotation group whose velocity has no jumps: cubic
/// Hermite in the sense of Kim, Kim & Shin (1995), the velocity at a key the mean of those on either side,
/// weighted by how near they are and at most three times the slower one, so that a camera that stands still
/// between two keys stands still. Between two keys a camera turns the shortest way, by at most half a turn;
/// but where yaw or roll differ by more, it turns as many times more, about the world's up and its own axis:
/// from yaw 0 to 360 once around to the right, from 0 to −200 by 200° to the left. Of two keys alone the
/// velocity is constant. Field of view is interpolated likewise in its logarithm, so that a zoom is even.
///
/// Before the first key and after the last the camera stands still. Immutable; safe from many threads.
class WELKIN_API CameraPath {
 public:
  /// What there is at a frame.
  struct Pose {
    Matrix3 rotation = {};           ///< from the camera to the world, for Camera::rotation
    std::optional<double> fov = {};  ///< none where the keys have none
  };

  /// Throws Error (bad_request), counting keys from 1: none, frames that don't ascend, values that aren't
  /// finite, fields of view that aren't in 0 … 360, or that only some of the keys have.
  explicit CameraPath(std::vector<CameraKey> keys);

  /// As given.
  const std::vector<CameraKey>& keys() const { return keys_; }
  /// At any frame, between whole ones too. Throws Error (bad_request) for NaN.
  Pose at(double frame) const;

 private:
  struct Vec {
    double x = 0, y = 0, z = 0;
  };
  struct Quaternion {
    double w = 1, x = 0, y = 0, z = 0;
  };
  /// A key, the rotation from it to the next, and the velocities there, per frame: of the rotation in the
  /// camera's frame, of the whole turns about up and about the axis, of the logarithm of the field of view.
  struct Knot {
    double frame = 0;
    Quaternion rotation;
    Vec way, turning;
    double up_turns = 0, up_speed = 0, axis_turns = 0, axis_speed = 0, zoom = 0, zoom_speed = 0;
  };
  static Quaternion product(const Quaternion& a, const Quaternion& b);
  static Quaternion exponential(const Vec& v);
  static Vec between(const Quaternion& a, const Quaternion& b, const Vec& hint);
  void find_speeds();

  std::vector<CameraKey> keys_;
  std::vector<Knot> knots_;
  bool zooms_ = false;
};

/// Key frames from text: a table of comma-separated values whose first line names its columns, `frame` and
/// any of `yaw`, `pitch`, `roll`, `fov`, in any order; or JSON, an array of objects with these members. What
/// isn't given is 0, and the field of view none. Empty lines, and those that begin with #, are left out.
/// Throws Error about `name`: (damaged) what isn't of either form, with the line; (bad_request) as
/// CameraPath.
WELKIN_API CameraPath parse_camera_path(std::string_view text, const std::string& name);
/// The same of a file of at most 16 MiB. Throws also (not_found, denied, system, too_large).
WELKIN_API CameraPath read_camera_path(const std::filesystem::path& path);

}  // namespace welkin
