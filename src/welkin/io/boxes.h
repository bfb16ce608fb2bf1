#pragma once

#include "welkin/io/format.h"

/// Boxes of the ISO base media file format (ISO/IEC 14496-12, 4.2), of which JPEG XL, AVIF and HEIF files are
/// made.
namespace welkin::io {

struct Box {
  std::string_view type;               ///< four bytes: `ftyp`
  std::span<const std::byte> content;  ///< after its header
};

/// The boxes of a file, or within a box, one after the other.
class Boxes {
 public:
  /// `within` lies in source.bytes.
  Boxes(const Source& source, std::span<const std::byte> within) : source_(source), left_(within) {}

  /// The next box, or nothing at the end. Throws Error (damaged) for one that passes the end.
  std::optional<Box> next();

 private:
  const Source& source_;
  std::span<const std::byte> left_;
};

}  // namespace welkin::io
