#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/light/light_set.h"

/// @file
/// Lights as other programs take them. docs/lights.md has each program's units and where they are defined.
namespace welkin {

/// A program, or a file format, that lights are written for.
struct LightFormat {
  std::string name;         ///< `three.js`, `gltf`…
  std::string extension;    ///< of a file, without the dot
  std::string convention;   ///< of the world whose coordinates are written (convention.h)
  std::string description;  ///< one line: what is written, and in which unit
};

/// All formats: three.js, gltf, bevy, blender, pbrt, mitsuba, usd.
WELKIN_API const std::vector<LightFormat>& light_formats();

/// The format of that name. Throws Error (bad_request), suggesting the nearest.
WELKIN_API const LightFormat& light_format_from_name(std::string_view name);

/// Source text or a file for a program: its lights at infinity, with the directions in its world, the
/// strongest first.
///
/// `unit` is what 1 in the map stands for, finite and above 0: cd/m² where the program counts in lux,
/// W/(m²·sr) where it counts in W/m²; whatever the program's environment map is multiplied with. Where a
/// program has discs (Blender, USD), the light is the disc of its solid angle and irradiance; where it has
/// none, or the light is a region, it comes from one direction. Negative irradiance is written as 0.
///
/// Throws Error (bad_request) for a unit out of range, and as LightSet::rgb.
WELKIN_API std::string light_text(const LightFormat& format, const LightSet& lights, double unit = 1);

}  // namespace welkin
