#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/io/capabilities.h"
#include "welkin/io/image_file.h"

/// @file
/// Tables, and pictures for pages, as the bytes of files.
namespace welkin {

/// A table as the bytes of a file.
struct EncodedTable {
  std::vector<std::byte> bytes;              ///< of the file
  io::PixelType type = io::PixelType::half;  ///< of a value
  double error = 0;        ///< the largest difference that rounding made, of values that the type holds
  io::WriteReport report;  ///< what was clipped
};

/// A table of one to four channels, linear, in the format of that name, and read again. Formats without
/// pictures of two channels get a third of zeros. Throws as io::write.
WELKIN_API EncodedTable encode_table(const Image& table, std::string_view format, io::PixelType type);

/// `data:TYPE;base64,…`
WELKIN_API std::string data_url(std::string_view media_type, std::span<const std::byte> bytes);

}  // namespace welkin
