#pragma once

#include <string>
#include <vector>

#include "bake_levels.h"
#include "welkin/prefilter/verify.h"

namespace welkin::cli {

/// What `bake` reports.
struct BakeReport {
  std::string in, out;
  const BakeLevels* made = nullptr;
  ChainNotes notes;
  std::vector<PrefilterMethod> methods;
  std::vector<LevelVerification> verification;  ///< empty, or one for each level
  double read_seconds = 0, plan_seconds = 0, compute_seconds = 0, verify_seconds = 0, write_seconds = 0;

  void print() const;
  void print_json() const;
  /// Warns on stderr of levels that miss the tolerance.
  void report_misses() const;
};

}  // namespace welkin::cli
