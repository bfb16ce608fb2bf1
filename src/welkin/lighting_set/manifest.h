#pragma once

#include <string>

#include "welkin/base/export.h"
#include "welkin/lighting_set/lighting_set.h"
#include "welkin/lighting_set/set_request.h"

/// @file
/// `manifest.json`: what each file of a set is (docs/engines.md).
namespace welkin {

/// The name of the file that lists a set's files.
inline constexpr const char* kManifestName = "manifest.json";

/// JSON, indented, ending with a line break.
WELKIN_API std::string manifest_text(const LightingSet& set, const SetRequest& request);

}  // namespace welkin
