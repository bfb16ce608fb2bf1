#pragma once

#include <string>

#include "command.h"

namespace welkin::cli {

/// What becomes of NaN and infinite values.
enum class Faults { refused, repaired };

/// A map to be filtered. Warns on stderr of repaired values, negative ones,
/// and directions that it doesn't show. Throws Error for values that can't be filtered.
Map read_bake_source(const std::string& in, const ReadFlags& flags, Faults faults);

}  // namespace welkin::cli
