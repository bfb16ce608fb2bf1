#pragma once

#include <cstddef>
#include <span>

#include "welkin/io/exr/header.h"

namespace welkin::io::exr {

/// Stores floats as `type`, little-endian, and counts in `report` what the type cannot hold (see write_exr).
void convert_from_float(std::span<const float> from, StoredType type, std::byte* to, WriteReport& report);

}  // namespace welkin::io::exr
