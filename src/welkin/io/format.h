#pragma once

#include "welkin/io/byte_sink.h"
#include "welkin/io/capabilities.h"
#include "welkin/io/declared.h"
#include "welkin/io/image_file.h"

/// What one file format provides; formats.cpp lists them all. A new format is one folder and one line there.
namespace welkin::io {

struct Source {
  std::span<const std::byte> bytes;
  std::string name;  ///< for messages
  ReadOptions options;
};

/// A format's reader. Its pictures are as they lie in the file; `declared` says what is still to be done.
class FormatReader : public Reader {
 public:
  const Declared& declared() const { return declared_; }
  /// What `decode` undoes from now on; FileInfo says so.
  void set_colour(Colour colour) { info_.colour = colour; }
  void set_info(FileInfo info) { info_ = std::move(info); }

 protected:
  Declared declared_;
};

struct Format {
  Capabilities capabilities;
  bool (*matches)(std::span<const std::byte> bytes);  ///< by magic number
  /// Throws Error, to which the caller adds the file's name where it lacks.
  std::unique_ptr<FormatReader> (*open)(const Source& source);
  /// The request lies within the capabilities. Throws Error without the file's name, which the caller
  /// adds. Null where Capabilities::writable is false.
  WriteReport (*write)(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);
  /// Whether `write` takes parts that are drawn when they are written; for others they are drawn before.
  bool draws_rows = false;
  /// Checks type and compression in the format's own words; null where the capabilities say all there is.
  void (*check)(const WriteOptions& options) = nullptr;
};

/// All formats, in the order in which `matches` is asked.
const std::vector<Format>& formats();

// One per folder of this room.
Format exr_format();
Format hdr_format();
Format ktx2_format();
Format ktx1_format();
Format dds_format();
Format env_format();
Format glb_format();
Format pfm_format();
Format png_format();
Format jpeg_format();
Format tiff_format();
Format webp_format();
Format jxl_format();
Format avif_format();
Format heif_format();

/// That a format is not written, and which are: the message for who asks it to be.
std::string only_read(const Capabilities& format);

/// Throws Error when the decoded floats of width×height×channels would pass options.max_bytes or a side is
/// not in 1…2^20. Call it before any allocation.
void check_size(const Source& source, std::uint64_t width, std::uint64_t height, std::uint64_t channels);

}  // namespace welkin::io
