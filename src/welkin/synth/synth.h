#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/math/vec.h"

/// @file
/// The built-in maps, as functions of direction, with hard edges, and detail as fine as a sun. `render`
/// (render_synth.h) makes antialiased maps of them.
namespace welkin::synth {

/// Linear sRGB radiance along a unit direction, finite and never negative. May be called from many threads at
/// once.
using Radiance = std::function<std::array<float, 3>(const Vec3d& d)>;

/// What the maps can be asked for. Each map reads some of these and leaves the others alone. Without
/// a value the map has its own default, in brackets here. Angles are in degrees. Azimuth turns about +Y from
/// +Z toward +X, as positive yaw does; elevation rises from the horizon toward +Y.
struct SynthOptions {
  /// lamps: which ones.
  std::uint64_t seed = 1;
  /// checker: cells around, an even whole number (36). lines: meridians, a whole number (24).
  /// zoneplate: cycles per radian at −Z (64). lamps: how many, a whole number up to 1,000,000 (3000).
  std::optional<double> frequency = {};
  /// sun, sky: the sun's angular diameter, for sky 0.01…30 (0.5331). lines: their width (0.5). lamps:
  /// their diameter, up to 3 (0.5).
  std::optional<double> angle = {};
  /// sun: radiance of the disc (100,000). lamps: their median radiance (50). Others: a factor on all of the
  /// map (1).
  std::optional<double> intensity = {};
  /// sun, sky: the sun's elevation, −90…90 for sun and 0…90 for sky.
  double elevation = 40;
  /// sun, sky: the sun's azimuth.
  double azimuth = 35;
  /// sun, lamps: radiance of the sky around them; may be 0.
  double background = 0.1;
  /// sky: Linke's turbidity, 2 (very clear) to 10 (haze).
  double turbidity = 3;
  /// sky: reflectance of the ground, 0…1.
  double albedo = 0.2;
};

/// Names of the built-in maps, in the order they are best shown.
WELKIN_API std::vector<std::string> names();

/// One line about a map. Throws Error (bad_request) for a name that names() lacks.
WELKIN_API std::string description(std::string_view name);

/// The map of that name. Throws Error (bad_request) for a name that names() lacks, and for an option that the
/// map reads and that is out of its range; the message names the map and the option.
WELKIN_API Radiance make(std::string_view name, const SynthOptions& options = {});

}  // namespace welkin::synth
