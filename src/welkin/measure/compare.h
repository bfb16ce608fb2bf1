#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/filter/resample.h"
#include "welkin/map/map.h"
#include "welkin/measure/energy.h"

/// @file
/// The error between two maps.
namespace welkin {

/// How maps are compared.
struct CompareOptions {
  /// How the coarser map is read between its texels; `automatic` counts as `bicubic`. Not used for maps of
  /// one shape.
  Filter filter = Filter::bilinear;
  /// What PSNR is relative to; 0: 1 when the reference's maximum is at most 1, else that maximum.
  double peak = 0;
  /// Width of the heat map, texels, 2 … 32768; it is half as high.
  int heat_width = 1024;
  int lights = 3;        ///< whose energy is compared, at most
  Monitor monitor = {};  ///< progress and cancelling
};

/// The error of b against the reference a, in one channel or in all; every mean is weighted by solid angle.
struct ErrorMeasures {
  std::string name;   ///< the channel's
  double mean_a = 0;  ///< of the reference
  double mean_b = 0;  ///< of what is compared with it
  /// ∫ b dω / ∫ a dω over what both show, each by its own texels: EnergyChange. Of A mean_b / mean_a.
  double energy_ratio = 1;
  double rms_a = 0;          ///< root of the mean of a²
  double rmse = 0;           ///< root of the mean of (b − a)²
  double relative_rmse = 0;  ///< rmse / rms_a; 0 when rmse is 0
  /// Root of the mean of (ln(1 + b) − ln(1 + a))², negative values counted as 0: what HDR textures are judged
  /// by, since bright texels don't outweigh all others.
  double rmsle = 0;
  double mean_absolute = 0;                   ///< mean of |b − a|
  double maximum_absolute = 0;                ///< the largest |b − a|
  Vec3d maximum_absolute_direction{0, 0, 1};  ///< in the world
  /// The largest |b − a| / |a| of a texel, where |a| counts as at least kRelativeFloor·rms_a.
  double maximum_relative = 0;
  Vec3d maximum_relative_direction{0, 0, 1};  ///< in the world
  double psnr = 0;                            ///< 20 log10(peak / rmse), dB; infinite when rmse is 0
};
/// The share of rms_a that a relative error is relative to at least.
inline constexpr double kRelativeFloor = 1e-3;

/// What compare found.
struct Comparison {
  /// Channels that both maps have, by name; where no name agrees and both have as many, by position.
  std::vector<ErrorMeasures> channels;
  /// Over these channels except alpha (unless there is no other): squares and absolutes are averaged,
  /// `maximum_absolute` is the largest, `maximum_relative` is of the root mean square over a texel's
  /// channels.
  ErrorMeasures all;
  double peak = 1;              ///< that PSNR is relative to
  bool texel_by_texel = false;  ///< both have one shape, and no texel was interpolated
  std::uint64_t texels = 0;     ///< compared
  double solid_angle = 0;       ///< compared, sr
  std::uint64_t skipped = 0;    ///< not compared because a or b is NaN or infinite there
  EnergyComparison energy;      ///< of the whole, and of a's brightest lights
};

/// Compares b with the reference a, over the sphere. Goes through the texels of the map that has more of
/// them, of `a` when both have as many, and looks up the other at their centres; its borders must be filled.
/// Where one of them shows nothing, nothing is compared. Maps of one parameterization, size and orientation
/// are compared texel by texel, without interpolation. Positions are exact to 1e-6 of a chart's side.
///
/// `heat`, if given, becomes a lat-long map (RGB, linear sRGB, no orientation) of the relative error: root
/// mean square over the channels of b − a by that of a, with the floor of maximum_relative, averaged over
/// each new texel. A colour scale over its logarithm, dark violet at kHeatMinimum to light yellow at
/// kHeatMaximum; grey where nothing was compared.
///
/// Throws Error when the maps have no channels in common or options are out of range, and Cancelled.
WELKIN_API Comparison compare(const Map& a, const Map& b, const CompareOptions& options = {},
                              Map* heat = nullptr);
/// The relative error at the heat map's dark end.
inline constexpr double kHeatMinimum = 1e-5;
/// The relative error at the heat map's light end.
inline constexpr double kHeatMaximum = 1;

}  // namespace welkin
