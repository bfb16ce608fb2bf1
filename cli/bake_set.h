#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bake_levels.h"
#include "command.h"
#include "sanitize_flags.h"
#include "welkin/lighting_set/lighting_set.h"
#include "welkin/lighting_set/set_request.h"

namespace welkin::cli {

/// `welkin bake …` as it was typed, but for quotes.
std::string command_line(const Command& command);

/// `bake IN FOLDER/`: all files of a set, its manifest and its page.
struct BakeSet {
  std::string engine;
  std::optional<std::uint64_t> most_bytes;

  void add(Command command);
  /// Whether a set is asked for: an engine, or a path that is a folder. Throws UsageError for options that
  /// only a set has, of a single file, and for options of `command` that a set has no use for.
  bool asked(const std::string& out, const Command& command) const;
  /// The options that `made` and `write` stand for, checked against the engine and the folder. Throws
  /// UsageError.
  SetOptions parse(const std::string& out, const BakeLevels& made, const std::string& type,
                   const std::string& convention, const WriteMapOptions& write) const;
  /// Makes, writes and prints. `request` is what is told of the source.
  void run(const Map& source, const std::string& out, const SetOptions& options, const SetRequest& request,
           bool json) const;

 private:
  Engine chosen() const;
};

}  // namespace welkin::cli
