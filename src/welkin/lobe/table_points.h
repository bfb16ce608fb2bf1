#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/lobe/table.h"

namespace welkin::lobe {

/// Throws Error, which begins with `where`, unless this point may follow those at the angles `before`,
/// degrees.
void check_point(const std::string& where, const std::vector<double>& before, double degrees, double value);

/// The lobe of these points; `name` begins the errors. See AnyLobe::from_table.
Table make_table(std::string_view name, std::span<const double> degrees, std::span<const double> values);

}  // namespace welkin::lobe
