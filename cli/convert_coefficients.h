#pragma once

#include <string>

#include "command.h"

namespace welkin::cli {

/// `convert` of a file of coefficients: the map with these harmonics, scaled and rotated.
struct CoefficientsToMap {
  std::string in, out, to, size, rotation, convention;
  double factor = 1;
  WriteFlags write;

  /// Throws UsageError, Error.
  void run() const;
};

/// UsageError for an option of `convert` that is given and is about texels, of which coefficients have none.
void check_coefficients_options(const Command& convert);

}  // namespace welkin::cli
