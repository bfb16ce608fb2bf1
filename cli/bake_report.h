#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bake_levels.h"
#include "welkin/light/light_set.h"
#include "welkin/lighting_set/stored_error.h"
#include "welkin/prefilter/verify.h"

namespace welkin::cli {

/// What was asked for, for programs: names, lobe, normalisation, parameterization, tolerance.
nlohmann::ordered_json describe_bake(const std::string& in, const std::string& out, const BakeLevels& made,
                                     const ChainNotes& notes);
/// The levels: sizes, lobes, and methods where there are any.
nlohmann::ordered_json describe_levels(const BakeLevels& made, const ChainNotes& notes,
                                       const std::vector<PrefilterMethod>& methods);

/// What `bake` reports.
struct BakeReport {
  std::string in, out;
  const BakeLevels* made = nullptr;
  ChainNotes notes;
  std::vector<PrefilterMethod> methods;
  std::vector<LevelVerification> verification;  ///< empty, or one for each level
  std::vector<StoredError> stored;              ///< of texels that lose by being stored: of each level
  std::optional<LightSet> sun;                  ///< where it was to be taken out: it, or none
  double read_seconds = 0, plan_seconds = 0, compute_seconds = 0, verify_seconds = 0, write_seconds = 0;

  void print() const;
  void print_json() const;
  /// Warns on stderr of levels that miss the tolerance.
  void report_misses() const;
};

}  // namespace welkin::cli
