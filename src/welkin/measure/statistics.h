#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/map/map.h"

/// @file
/// The numbers of a map.
namespace welkin {

/// The numbers of a channel.
struct ChannelStatistics {
  std::string name;              ///< the channel's
  double minimum = 0;            ///< of the finite values; 0 when there are none, as are all numbers here
  double maximum = 0;            ///< of the finite values
  double mean = 0;               ///< of the finite values, each weighted by its texel's solid angle
  double integral = 0;           ///< ∫ value dω over texels with finite values, value·sr
  std::uint64_t nan_texels = 0;  ///< NaN
  std::uint64_t infinite_texels = 0;  ///< infinite, either sign
  std::uint64_t negative_texels = 0;  ///< finite and below 0
};

/// Luminance is 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709) of the channels named R, G and B; without
/// these, the channel Y, or the first. Texels where it isn't finite are left out.
struct LuminanceStatistics {
  double minimum = 0;            ///< of all texels
  double smallest_positive = 0;  ///< of those above 0; 0 when there are none
  double maximum = 0;            ///< of all texels
  double mean = 0;               ///< weighted by solid angle
  double integral = 0;           ///< ∫ L dω, luminance·sr
  /// Luminance below which this percentage of the solid angle lies. From a histogram with 64 bins to the
  /// octave, so within 1/64 of the value; 0 where it falls among texels that aren't positive.
  double percentile_1 = 0;
  double percentile_50 = 0;    ///< the median; as percentile_1
  double percentile_99 = 0;    ///< as percentile_1
  double percentile_99_9 = 0;  ///< as percentile_1
  double dynamic_range = 0;    ///< log2(maximum / smallest_positive), stops
};

/// The texel of the highest luminance and the light that it belongs to: the texels with at least half its
/// luminance that lie within kLightReach of it.
struct BrightestLight {
  int chart = 0;                  ///< of the brightest texel, the first of equals
  int x = 0;                      ///< its column
  int y = 0;                      ///< its row
  double peak = 0;                ///< its luminance
  Vec3d peak_direction{0, 0, 1};  ///< its centre, in the world
  Vec3d direction{0, 0, 1};       ///< the light's centroid in the world, weighted by luminance·solid angle
  double solid_angle = 0;         ///< sr
  std::vector<double> radiance;   ///< mean over the light, one for each channel
  double luminance = 0;           ///< mean over the light
  double share = 0;               ///< of the whole map's ∫ L dω
};
/// The radius of a light about its brightest texel, radians.
inline constexpr double kLightReach = 5 * kPi / 180;

/// What measure found.
struct MapStatistics {
  /// Valid texels: the corners of a disc aren't counted here, nor anywhere below.
  std::uint64_t texels = 0;
  double solid_angle = 0;                   ///< that they cover together, sr: the parameterization's coverage
  std::vector<ChannelStatistics> channels;  ///< one for each of the map's
  LuminanceStatistics luminance;            ///< over the channels
  std::optional<BrightestLight> light;      ///< none when no luminance is positive
};

/// Reads the charts, not their borders. Solid angles are the density at the texel's centre times its area,
/// scaled so that all together make the coverage. The same numbers whatever the number of threads. Throws
/// Cancelled.
WELKIN_API MapStatistics measure(const Map& map, const Monitor& monitor = {});

}  // namespace welkin
