#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "welkin/prefilter/bake.h"

namespace welkin::cli {

/// What `bake` makes: one lobe, or a chain of a lobe at several roughnesses.
struct BakeLevels {
  std::string lobe_spec = "ggx", roughness, to = "cube", size, level0 = "filtered", method = "exact";
  std::optional<int> count;

  void add(Command command);
  /// Checks all of it, as far as it needs no input, and the output path. Throws as
  /// check_output does.
  void parse(const std::string& out, const WriteFlags& write);

  // Known after parse().
  std::optional<MapShape> shape;
  BakeOptions options;  ///< all but `prefilter`
  std::vector<PrefilterLevel> levels;

 private:
  /// Throws for what only a chain has.
  void check_one_lobe(const lobe::AnyLobe& lobe) const;
};

}  // namespace welkin::cli
