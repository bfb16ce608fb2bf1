#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "welkin/io/exr/cursor.h"
#include "welkin/io/exr/header.h"

namespace welkin::io::exr {

/// True for names that EXR keeps for the file's structure or for a standard attribute that is not text: these
/// are never written from WriteOptions::attributes.
bool is_reserved(std::string_view attribute);

/// Name of our own box2i attribute. Parts of one file must share a display window; where their sizes differ,
/// each part's own size is here, and the display window is the largest.
inline constexpr std::string_view kOwnWindow = "welkinWindow";

/// Name of our own attribute, an int: how many levels of a mip pyramid its writer was given. The others were
/// made, because a pyramid goes down to 1×1.
inline constexpr std::string_view kOwnLevels = "welkinLevels";

/// Fills a part from its header's attributes, one by one.
class AttributeParser {
 public:
  explicit AttributeParser(Part& part) : part_(part) {}

  /// `value` ends where the attribute ends. Throws Error when a structural attribute has a wrong type or
  /// size.
  void parse(std::string_view name, std::string_view type, Cursor value);

  /// The name of a structural attribute that did not occur, or empty.
  std::string missing() const;

  const std::string& part_type() const { return part_type_; }
  bool has_tiles() const { return has_tiles_; }
  std::uint64_t chunk_count() const { return chunk_count_; }

 private:
  bool parse_structure(std::string_view name, std::string_view type, Cursor& value);
  void parse_channels(Cursor& value);
  void parse_tiles(Cursor& value);

  Part& part_;
  std::string part_type_;
  std::uint64_t chunk_count_ = 0;
  bool has_channels_ = false, has_compression_ = false, has_data_ = false, has_display_ = false;
  bool has_tiles_ = false, has_own_window_ = false;
};

}  // namespace welkin::io::exr
