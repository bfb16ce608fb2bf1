#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/dfg_table.h"

/// @file
/// The tables that renderers read, as their shaders look them up (docs/brdf-tables.md).
namespace welkin::brdf {

/// One renderer's table.
struct EngineTable {
  std::string name;         ///< `filament`
  std::string description;  ///< one line: channels, and how the shader combines them
  std::string source;       ///< the files of the renderer that say so
  DfgTable table;           ///< axes and contents
  std::string type;         ///< of a texel, by the name of a pixel type: `half`, `uint16`, `uint8`
};

/// All of them, by name.
WELKIN_API const std::vector<EngineTable>& engine_tables();

/// The one of that name. Throws Error (bad_request) for another, which suggests the nearest.
WELKIN_API const EngineTable& engine_table(std::string_view name);

}  // namespace welkin::brdf
