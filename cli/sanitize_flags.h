#pragma once

#include <string>

#include "command.h"
#include "welkin/map/adjust.h"

namespace welkin::cli {

/// Options of the commands that repair values: `--sanitize` and `--clamp`.
struct SanitizeFlags {
  std::string sanitize, clamp;

  void add(Command command);
  /// Whether there is anything to do.
  bool any() const { return !sanitize.empty() || !clamp.empty(); }
  /// `largest`: what infinite values become by default. Throws UsageError.
  SanitizeOptions parse(double largest = 1) const;
  /// Tells on stderr what was done to the map of a file.
  void print(const std::string& in, const SanitizeReport& report, const SanitizeOptions& options) const;
};

/// Whether a file of that name and type holds values below 0.
bool holds_negative(const std::string& out, std::optional<io::PixelType> type);

/// What an infinite value becomes in a file of that name and type, whose values are then multiplied by
/// `factor`: the largest that the type holds, but no more than 65504, the largest of half floats, of which
/// infinite values mostly come; sums of many times more overflow.
double largest_value(const std::string& out, std::optional<io::PixelType> type, double factor = 1);

}  // namespace welkin::cli
