#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/math/vec.h"

/// @file
/// Lights by direction and irradiance, as renderers take them. docs/lights.md has the definitions.
namespace welkin {

/// What a light looks like from the middle of its map.
enum class LightShape {
  point,    ///< too small for the map's texels: its solid angle is not measurable, only that it isn't larger
  disc,     ///< round
  ellipse,  ///< longer than wide: lamps of any shape too
  region,   ///< a part of the sphere, with all its light
};

/// `point`, `disc`, `ellipse`, `region`.
WELKIN_API std::string_view name_of(LightShape shape);

/// A light at infinity.
struct ExtractedLight {
  /// Toward the light, in the world: where a fitted disc or ellipse has its centre, else the centroid of its
  /// radiance. Of unit length.
  Vec3d direction{0, 0, 1};
  /// ∫ L dω of the light's radiance, one value for each of LightSet::channels, radiance·sr. That is the
  /// irradiance of a surface that faces a light as small as the sun, to 6e-6; a surface that faces a disc of
  /// radius ρ receives cos²(ρ/2) of it.
  std::vector<double> irradiance;
  double luminance = 0;                  ///< of `irradiance`, as LuminanceStatistics has it
  LightShape shape = LightShape::point;  ///< of what is fitted to it
  double solid_angle = 0;                ///< of that, sr; of a point, at most
  /// From the direction to the edge of a disc or ellipse along the longer axis and across, radians; 0 of a
  /// region.
  std::array<double, 2> half_axes{0, 0};
  Vec3d axis{1, 0, 0};  ///< the longer axis, in the world: of unit length, perpendicular to the direction
  /// Radiance of its brightest texel, surroundings included, one value for each of LightSet::channels; of a
  /// region the mean.
  std::vector<double> peak;
  std::size_t texels = 0;       ///< that hold it
  std::size_t flat_texels = 0;  ///< of these, that have exactly the largest value of a channel: over 3, it
                                ///< may have been clipped (flat_topped)
  bool cut = false;             ///< reaches the end of what the map shows: there may be more of it
  double restored = 1;          ///< `irradiance` is what the map holds times this

  /// Whether its top is flat, as clipping leaves it, and as an even disc is.
  bool flat_topped() const { return flat_texels > 3; }
};

/// Lights, the strongest (by luminance) first.
struct WELKIN_API LightSet {
  std::vector<std::string> channels;   ///< those of the map, but for A, unless there is no other
  std::vector<ExtractedLight> lights;  ///< by falling luminance

  /// Irradiance of a light as red, green and blue: the channels R, G, B; of a map without them Y, or its only
  /// channel, thrice. Throws Error (bad_request) for a light that there isn't, (unsupported) for other
  /// channels.
  std::array<double, 3> rgb(std::size_t light) const;
};

}  // namespace welkin
