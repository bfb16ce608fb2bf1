#pragma once

#include <string>
#include <vector>

namespace welkin::lobe {

/// The points of a table lobe as a file has them.
struct TablePoints {
  std::vector<double> degrees, values;
};

/// Reads a table of angle and value: a pair a line, separated by blanks or a comma; angles in degrees,
/// ascending from 0; `#` begins a comment. Throws Error, with file and line: no such file, over 1 MiB, over
/// kMaxTablePoints points, what isn't two numbers, angles that don't ascend from 0 to at most 180, values
/// that are negative.
TablePoints read_table_file(const std::string& path);

}  // namespace welkin::lobe
