#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// The numbered files of a sequence.
namespace welkin {

/// Frames by their numbers, the first and the last included.
struct FrameRange {
  int first = 0;  ///< 0 or more
  int last = 0;   ///< not below `first`
};

/// The names of a sequence's files: one with a place for the frame's number. That is `%d`, `%04d` (at least
/// so many digits, 1 to 9, filled up with zeros), or as many `#` as digits, two or more: `sky_####.exr`. It
/// stands in the name, not in a folder's. A `%s` beside it stays what it is in a map's file, the name of a
/// face (map_file.h); any other `%` is a letter.
class WELKIN_API FrameNames {
 public:
  /// The largest number that a frame can have.
  static constexpr int kLargest = 999999999;

  /// Whether a name has a place for a number.
  static bool has_place(const std::filesystem::path& name);

  /// Throws Error (bad_request) about the name when it has none, or two.
  explicit FrameNames(std::filesystem::path name);

  /// As it was given.
  const std::filesystem::path& name() const { return name_; }
  /// What stands for the number: `%04d`.
  const std::string& place() const { return place_; }
  /// The file of a frame; with `%s`, the name of its files. Throws Error (bad_request) for a number that is
  /// negative or above kLargest.
  std::filesystem::path file(int frame) const;

  /// The frames of which there are files, ascending. A file counts when its name is file()'s, so `%04d`
  /// doesn't find `sky_7.exr`; with `%s`, when one face is there. Throws Error about the name: (not_found)
  /// where there is none, (not_found, denied, system) for folders that can't be read.
  std::vector<int> find() const;

 private:
  std::filesystem::path name_;
  std::string before_, place_, after_;  // of the name without its folder
  int digits_ = 1;
};

/// Frames as people write them: `1–9, 12, 20–29`. Ascending. Of over `most` stretches the rest is `…`.
WELKIN_API std::string frames_text(std::span<const int> frames, int most = 8);

/// `7`, or `1-300`. Throws Error (bad_request) for anything else, and for ranges that go down.
WELKIN_API FrameRange frame_range_from(std::string_view text);

}  // namespace welkin
