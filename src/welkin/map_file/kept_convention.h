#pragma once

#include <optional>
#include <string>

#include "welkin/base/export.h"
#include "welkin/map_file/map_file.h"

/// @file
/// The worlds of other programs, from file to file.
namespace welkin {

/// A convention that a map keeps when it goes from one file to another.
struct KeptConvention {
  std::string name;     ///< of one that has the orientation: `three.js`
  Matrix3 orientation;  ///< of the map that is written
};

/// The convention that the map's file declares, for a map of parameterization `to`. A file names it
/// (WriteMapOptions::convention), or has an orientation that is one's; where several have that, but lay `to`
/// differently, none. None too where the file declares none, is native, or is read with another orientation
/// than it declares. The file's shape must be known. Never throws otherwise.
WELKIN_API std::optional<KeptConvention> kept_convention(const MapFileInfo& from,
                                                         const sphere::AnyParameterization& to);

/// Whether the file declares an orientation that is that of some conventions. With kept_convention's none:
/// which one is unknown.
WELKIN_API bool declares_convention(const MapFileInfo& from);

}  // namespace welkin
