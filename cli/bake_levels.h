#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "welkin/lobe/roughness_curve.h"
#include "welkin/prefilter/prefilter.h"

namespace welkin::cli {

/// What `bake` makes: one lobe, or a chain of a lobe at several roughnesses.
struct BakeLevels {
  std::string lobe_spec = "ggx", roughness, to = "cube", size, level0 = "filtered";
  std::optional<int> count;

  void add(CLI::App& command);
  /// Checks all of it, as far as it needs no input, and the place where the result is written. Throws as
  /// check_output does.
  void parse(const std::string& out, const WriteFlags& write);

  // Known after parse().
  std::optional<MapShape> shape;
  std::vector<PrefilterLevel> levels;
  ChainNotes notes;
  bool chain = false;

 private:
  /// Throws for what only a chain has.
  void check_one_lobe(const lobe::AnyLobe& lobe) const;
  ChartSize default_size(const sphere::AnyParameterization& target, const lobe::AnyLobe& lobe) const;
};

}  // namespace welkin::cli
