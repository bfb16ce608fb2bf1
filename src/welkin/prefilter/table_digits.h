#pragma once

#include <cmath>

namespace welkin::prefilter {

/// A number of a table as it is stored: to a millionth, so that tables are short as text and the same there.
inline double table_digits(double value) {
  return std::round(value * 1e6) / 1e6;
}

}  // namespace welkin::prefilter
