#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/io/format.h"

/// The structure of an OpenEXR file: headers and chunk tables, parsed and checked here so that nothing behind
/// this file meets a size that the file cannot hold. Source: "OpenEXR File Layout" and "Technical
/// Introduction to OpenEXR" (Academy Software Foundation).
namespace welkin::io::exr {

/// Inclusive rectangle of pixels, as EXR's box2i.
struct Window {
  int min_x = 0, min_y = 0, max_x = -1, max_y = -1;

  std::int64_t width() const { return std::int64_t{max_x} - min_x + 1; }
  std::int64_t height() const { return std::int64_t{max_y} - min_y + 1; }
  bool empty() const { return max_x < min_x || max_y < min_y; }
  bool operator==(const Window&) const = default;
};

Window intersection(const Window& a, const Window& b);

/// Numbered as in the file.
enum class StoredType : std::int32_t { uint32 = 0, half = 1, float32 = 2 };
enum class Compression : std::uint8_t { none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab };
enum class LevelMode : std::uint8_t { one, mipmap, ripmap };

struct StoredChannel {
  std::string name;
  StoredType type = StoredType::half;
  int x_sampling = 1, y_sampling = 1;
};

inline std::size_t bytes_of(StoredType type) {
  return type == StoredType::half ? 2 : 4;
}

struct Part {
  std::string name;
  Window data, display;
  Compression compression = Compression::none;
  std::vector<StoredChannel> channels;  ///< sorted by name, as chunks store them
  bool deep = false;
  bool tiled = false;
  int tile_width = 0, tile_height = 0;
  LevelMode level_mode = LevelMode::one;
  bool round_up = false;                          ///< how the sizes of smaller levels are rounded
  std::uint64_t table = 0;                        ///< byte offset of the chunk table
  std::uint64_t chunk_count = 0;                  ///< its entries, all levels
  std::map<std::string, std::string> attributes;  ///< text and simple numbers; no structural ones
  std::optional<std::string> envmap;
  std::vector<std::string> views;  ///< the part's, or those of its channels' names
  float pixel_aspect = 1;
  std::optional<Chromaticities> chromaticities;
  std::vector<std::string> warnings;  ///< of what the header says and is not obeyed
  int own_levels = 0;  ///< of a mip pyramid, those that its writer was given; 0 when that is not said

  std::size_t bytes_per_pixel() const;
  int chunk_width() const;   ///< of level 0: the tile's, or the data window's
  int chunk_height() const;  ///< of level 0: the tile's, or the compression's number of lines
  std::uint64_t columns() const {
    return (static_cast<std::uint64_t>(data.width()) - 1) / chunk_width_64() + 1;
  }
  std::uint64_t rows() const {
    return (static_cast<std::uint64_t>(data.height()) - 1) / chunk_height_64() + 1;
  }
  /// Pixels of level 0's chunk number `index`, row by row.
  Window chunk_window(std::uint64_t index) const;
  /// Levels of a mip pyramid, those after own_levels left out. 1 when it is none, or when its levels cannot
  /// be placed: the data window is not the display window, or colour is luminance and chroma.
  int levels() const;
  /// Pixels of a level: level 0's first, and its size halved repeatedly.
  Window level_window(int level) const;
  /// Y with RY and BY at half the resolution: luminance and chroma in place of R G B.
  bool luminance_chroma() const;
  /// The same at the full resolution, which the format's writers don't make but its definition allows.
  bool full_chroma() const;
  /// The number of the channel of that name, −1 when there is none.
  int index_of(std::string_view channel) const;

 private:
  std::uint64_t chunk_width_64() const { return static_cast<std::uint64_t>(chunk_width()); }
  bool sampled(std::string_view channel, int step) const;
  std::uint64_t chunk_height_64() const { return static_cast<std::uint64_t>(chunk_height()); }
};

struct File {
  bool multi_part = false;
  std::vector<Part> parts;
};

/// Levels of a mip pyramid down to 1×1, when sizes are rounded down.
int level_count(int width, int height);

bool is_exr(std::span<const std::byte> bytes);

/// Parses all headers. On return every part but deep ones has: windows within ReadOptions::max_bytes;
/// channels that are known, unique and not subsampled (but luminance_chroma); a chunk table inside the file
/// whose entries for level 0 all point into the file; a size that the file's length can hold at the
/// compression's best ratio. Throws Error with the byte offset where it helps.
File parse(const Source& source);

/// The packed bytes of level 0's chunk `index`. Throws Error, the cause only, when the chunk's own header is
/// not the one that belongs there or its bytes pass the file's end.
std::span<const std::byte> chunk_bytes(std::span<const std::byte> file_bytes, const File& file,
                                       std::size_t part, std::uint64_t index);

std::string_view name_of(Compression compression);
/// Lines of a scan-line chunk.
int lines_of_chunk(Compression compression);
/// Throws Error that lists the known names.
Compression compression_named(std::string_view name);

/// The names that compression_named takes, `zip` first.
std::vector<std::string> compression_names();

}  // namespace welkin::io::exr
