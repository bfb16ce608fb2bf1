#pragma once

#include <optional>
#include <string>

#include "bake_levels.h"
#include "sanitize_flags.h"

namespace welkin::cli {

/// Options of `bake` for numbered frames.
struct FrameFlags {
  std::string frames;
  std::optional<int> every, held_out;
  bool keys_only = false, resume = false;

  void add(Command command);
  /// Throws UsageError where one of them was given, for one map.
  void check_unused() const;
};

/// Whether IN names numbered frames. Throws UsageError where only OUT does.
bool names_frames(const std::string& in, const std::string& out);

/// The options that were given, but those that change no frame, as text: BakeFramesOptions::request.
std::string request_of(const Command& command);

/// The rest of what was asked for, parsed.
struct FramesRequest {
  const std::string &in, &out;
  const BakeLevels& made;
  const ReadFlags& read;
  const SanitizeFlags& repair;
  const SanitizeOptions& repairs;
  const WriteMapOptions& write;
  Matrix3 turn;
  double factor = 1;
  std::string text;  ///< request_of
  bool json = false;
};

/// Bakes them, and prints what was done.
void bake_numbered(const FrameFlags& flags, const FramesRequest& request);

}  // namespace welkin::cli
