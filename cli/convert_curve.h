#pragma once

#include "command.h"

namespace welkin::cli {

/// `--roughness-curve` of convert: a chain for another curve, without a new bake.
struct CurveFlags {
  std::string curve;
  std::optional<int> count;

  void add(Command command);
  bool asked() const { return !curve.empty(); }
  /// Throws UsageError.
  void parse(const std::string& out, const ReadFlags& read) const;
  /// The levels that are written; `info` becomes theirs. What interpolating costs is told on stderr.
  std::vector<Map> levels(MapReader& reader, const std::string& in, const std::string& out,
                          MapFileInfo& info) const;
};

}  // namespace welkin::cli
