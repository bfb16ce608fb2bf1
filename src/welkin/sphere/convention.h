#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/math/rotation.h"
#include "welkin/sphere/registry.h"

/// @file
/// The worlds of other programs.
namespace welkin {

/// How another program's world lies in a file. Each matrix takes a direction
/// of the native world (docs/conventions.md, which also lists how each program's axes are identified with
/// ours) to the direction that the parameterization's formulas are given: it is a Map's `orientation`. All
/// are orthonormal, and hold only 0, 1 and −1.
struct Convention {
  std::string name;         ///< `unreal`
  std::string description;  ///< one line
  /// For panoramas (Projection::panorama): a rotation about +Y, since up stays up and a picture is never
  /// mirrored.
  Matrix3 latlong;
  /// For maps that shaders look up by coordinates (Projection::lookup: cubes, octahedra, paraboloids…): to
  /// the coordinates by which the program samples a cube map. A reflection (determinant −1) where they are
  /// left-handed; identity for a program without cube maps.
  Matrix3 lookup;
  /// For angular and fisheye pictures (Projection::disc): a rotation, as `latlong`.
  Matrix3 disc;
  /// To the coordinates of the program's own world, in which its lights and objects lie. A reflection where
  /// that is left-handed.
  Matrix3 world;
  /// Where the look-up can be read: file names and functions, or a document.
  std::string source;
  /// The parameterization that the program's lat-longs have, where it isn't `latlong`: `mitsuba-latlong`.
  std::string latlong_as = "latlong";
};

/// All presets, immutable. The first is `native`: identity.
WELKIN_API const std::vector<Convention>& conventions();

/// The preset of that name. Throws Error (bad_request) for a name that conventions() lacks; the message
/// suggests the nearest.
WELKIN_API const Convention& convention_from_name(std::string_view name);

/// The orientation of a map of this parameterization in a file of this convention. Identity for those that
/// no program has a convention for (Projection::unturned: photographs of balls, the half-cube).
WELKIN_API Matrix3 orientation_for(const Convention& convention,
                                   const sphere::AnyParameterization& parameterization);

/// What a map of this parameterization is in a file of this convention: Convention::latlong_as of a `latlong`
/// that is no window, and any other as it is.
WELKIN_API sphere::AnyParameterization parameterization_for(
    const Convention& convention, const sphere::AnyParameterization& parameterization);

}  // namespace welkin
