#pragma once

#include <string>

#include "welkin/base/export.h"
#include "welkin/lighting_set/lighting_set.h"
#include "welkin/lighting_set/set_request.h"

/// @file
/// `index.html`: a set's pictures, errors and bytes, and a viewer of it in WebGL2, in one file that needs no
/// network (docs/engines.md).
namespace welkin {

/// The name of a set's page.
inline constexpr const char* kPageName = "index.html";

/// The page, UTF-8. Throws as resample and io::write.
WELKIN_API std::string page_text(const LightingSet& set, const SetRequest& request,
                                 const Monitor& monitor = {});

}  // namespace welkin
