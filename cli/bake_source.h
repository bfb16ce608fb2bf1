#pragma once

#include <string>

#include "command.h"
#include "sanitize_flags.h"

namespace welkin::cli {

/// A map to be filtered. Warns on stderr of repaired values, negative ones,
/// and directions that it doesn't show. Throws Error for values that can't be filtered.
Map read_bake_source(const std::string& in, const ReadFlags& flags, const SanitizeFlags& repair,
                     const SanitizeOptions& repairs);

}  // namespace welkin::cli
