#pragma once

#include <optional>
#include <string>

#include "welkin/image/image.h"
#include "welkin/io/image_file.h"

/// Tables ↔ files, for `lut`.
namespace welkin::cli {

/// What became of a table in its file.
struct StoredTable {
  std::string type;        ///< of a value: `half`, `uint16`…
  double error = 0;        ///< the largest difference that rounding made
  io::WriteReport report;  ///< what was clipped
};

/// Whether the file is C source, `.h`, instead of a picture.
bool is_c_header(const std::string& path);

/// The type in which a picture file of that name will hold the table: `asked`, which it must hold; else
/// `usual`, where it does; else its best. Throws UsageError.
io::PixelType table_type(const std::string& path, const std::string& asked, const std::string& usual);

/// Writes the table, linear, and reads it again.
StoredTable write_table(const std::string& path, const Image& table, io::PixelType type);

/// The same as C source. `about` becomes its comment.
StoredTable write_c_header(const std::string& path, const Image& table, const std::string& about);

}  // namespace welkin::cli
