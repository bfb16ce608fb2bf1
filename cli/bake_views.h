#pragma once

#include <optional>
#include <string>

#include "bake_levels.h"
#include "welkin/brdf/brdf.h"
#include "welkin/map/lobe_sums.h"
#include "welkin/map/view_chains.h"

namespace welkin::cli {

/// What `bake` makes of a BRDF: a stack of angles of view, or one chain with a table of lobes to add.
struct BakeViews {
  std::string spec, axis = "fitted";
  std::optional<int> views, lobes;

  void add(Command command);
  /// Whether a BRDF is asked for. Throws UsageError for options that need one.
  bool asked() const;
  /// Whether angles of view become layers.
  bool makes_stack() const { return !spec.empty() && !lobes; }
  /// Before `made` is parsed: sets its lobe to what the levels are like. Throws UsageError.
  void prepare(BakeLevels& made, const std::string& out);
  /// Bakes, writes and prints. `options` are the chain's.
  void run(const Map& source, const BakeLevels& made, const std::string& in, const std::string& out,
           const WriteMapOptions& write, bool json) const;

 private:
  void run_stack(const Map& source, const BakeLevels& made, const std::string& in, const std::string& out,
                 const WriteMapOptions& write, bool json) const;
  void run_sums(const Map& source, const BakeLevels& made, const std::string& in, const std::string& out,
                const WriteMapOptions& write, bool json) const;

  std::optional<brdf::AnyBrdf> brdf_;
};

}  // namespace welkin::cli
