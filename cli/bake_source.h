#pragma once

#include <string>

#include "command.h"

namespace welkin::cli {

/// What becomes of NaN and infinite values.
enum class Faults { refused, repaired };

/// A map to be filtered. Says on stderr what is unusual about it: values that were repaired, negative ones,
/// places it doesn't show. Throws Error for values that can't be filtered.
Map read_bake_source(const std::string& in, const ReadFlags& flags, Faults faults);

}  // namespace welkin::cli
