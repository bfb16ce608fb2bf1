#pragma once

#include <optional>
#include <string>

#include "welkin/light/light_set.h"

/// @file
/// What a set was asked for with, told in its manifest and on its page.
namespace welkin {

/// Where a set comes from.
struct SetRequest {
  std::string command = {};           ///< that made it, as it was typed; empty: a program's own
  std::string source = {};            ///< the map's file, without its folder
  std::string parameterization = {};  ///< of the source
  int width = 0;                      ///< of the source's charts
  int height = 0;                     ///< of the source's charts
  double tolerance = 1e-3;            ///< SetOptions::tolerance
  std::optional<LightSet> sun =
      {};  ///< that was taken out of the source first, where that was asked: it, or none
};

}  // namespace welkin
