#include "welkin/io/exr/header.h"

#include <algorithm>
#include <array>

#include "welkin/base/error.h"
#include "welkin/io/exr/attributes.h"
#include "welkin/io/exr/cursor.h"

namespace welkin::io::exr {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiledFlag = 0x200;
constexpr std::uint32_t kDeepFlag = 0x800;
constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::uint32_t kKnownFlags = 0x1e00;

struct CompressionFacts {
  std::string_view name;
  int lines;  ///< of a scan-line chunk
  /// Unpacked bytes per packed byte, at most. Deflate: 1032. Run lengths: 128 bytes from 2. PIZ: Huffman
  /// codes of 10 bits for a run of 256 words. PXR24: deflate of three bytes in four. B44A: 3 bytes for 16
  /// halves. DWA: one deflated word per block of 64.
  std::uint64_t best_ratio;
};

constexpr std::array<CompressionFacts, 10> kCompressions{{{"none", 1, 1},
                                                          {"rle", 1, 64},
                                                          {"zips", 1, 1032},
                                                          {"zip", 16, 1032},
                                                          {"piz", 32, 512},
                                                          {"pxr24", 16, 1400},
                                                          {"b44", 32, 11},
                                                          {"b44a", 32, 11},
                                                          {"dwaa", 32, 1 << 18},
                                                          {"dwab", 256, 1 << 18}}};

const CompressionFacts& facts_of(Compression compression) {
  return kCompressions[static_cast<std::size_t>(compression)];
}

std::uint64_t tiles_along(std::int64_t size, int tile) {
  return (static_cast<std::uint64_t>(size) - 1) / static_cast<std::uint64_t>(tile) + 1;
}

std::int64_t size_of_level(std::int64_t size, int level, bool round_up) {
  const std::int64_t up = round_up ? (std::int64_t{1} << level) - 1 : 0;
  return std::max<std::int64_t>((size + up) >> level, 1);
}

/// Tiles along one axis, level by level, until `levels` of them.
std::vector<std::uint64_t> tiles_of_levels(std::int64_t size, int tile, int levels, bool round_up) {
  std::vector<std::uint64_t> tiles;
  for (int level = 0; level < levels; ++level)
    tiles.push_back(tiles_along(size_of_level(size, level, round_up), tile));
  return tiles;
}

int level_count(std::int64_t size, bool round_up) {
  const auto value = static_cast<std::uint64_t>(size);
  return static_cast<int>(round_up ? std::bit_width(value - 1) : std::bit_width(value) - 1) + 1;
}

std::uint64_t count_chunks(const Part& part) {
  if (!part.tiled || part.level_mode == LevelMode::one) return part.columns() * part.rows();
  const std::int64_t width = part.data.width(), height = part.data.height();
  if (part.level_mode == LevelMode::mipmap) {
    const int levels = level_count(std::max(width, height), part.round_up);
    const auto across = tiles_of_levels(width, part.tile_width, levels, part.round_up);
    const auto down = tiles_of_levels(height, part.tile_height, levels, part.round_up);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < across.size(); ++i) sum += across[i] * down[i];
    return sum;
  }
  std::uint64_t across = 0, down = 0;
  for (const auto n :
       tiles_of_levels(width, part.tile_width, level_count(width, part.round_up), part.round_up))
    across += n;
  for (const auto n :
       tiles_of_levels(height, part.tile_height, level_count(height, part.round_up), part.round_up))
    down += n;
  return across * down;
}

void check_channels(const Part& part, const Cursor& at) {
  for (std::size_t i = 0; i < part.channels.size(); ++i) {
    const StoredChannel& channel = part.channels[i];
    if (i > 0 && part.channels[i - 1].name == channel.name)
      at.fail("two channels are called '" + channel.name + "'");
    const bool chroma = part.luminance_chroma() && (channel.name == "RY" || channel.name == "BY");
    if ((channel.x_sampling != 1 || channel.y_sampling != 1) && !chroma)
      at.fail("channel '" + channel.name + "' is subsampled " + std::to_string(channel.x_sampling) + "x" +
              std::to_string(channel.y_sampling) + ", which is read in Y RY BY files only");
  }
}

/// Sizes, against the caller's limit and the file's length, before anything is allocated for them.
void check_sizes(const Source& source, Part& part, const Cursor& at) {
  constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 30;
  constexpr std::uint64_t kSmallTile = std::uint64_t{1} << 26;
  constexpr int kLargestCoordinate = 1 << 29;  // so that sums of two of them stay in int

  if (part.data.empty() || part.display.empty()) at.fail("a window is empty");
  for (const Window& w : {part.data, part.display}) {
    if (w.min_x < -kLargestCoordinate || w.min_y < -kLargestCoordinate || w.max_x > kLargestCoordinate ||
        w.max_y > kLargestCoordinate)
      at.fail("a window lies too far out");
    check_size(source, static_cast<std::uint64_t>(w.width()), static_cast<std::uint64_t>(w.height()),
               part.channels.size());
  }
  if (part.channels.empty()) at.fail("there are no channels");
  if (part.deep) return;

  check_channels(part, at);
  if (part.tiled && (part.tile_width < 1 || part.tile_height < 1 || part.tile_width > (1 << 20) ||
                     part.tile_height > (1 << 20)))
    at.fail("the tile size is not in 1...2^20");
  const std::uint64_t pixel = part.bytes_per_pixel();
  const std::uint64_t unpacked =
      static_cast<std::uint64_t>(part.data.width()) * static_cast<std::uint64_t>(part.data.height()) * pixel;
  const std::uint64_t chunk = static_cast<std::uint64_t>(part.chunk_width()) *
                              static_cast<std::uint64_t>(part.chunk_height()) * pixel;
  if (chunk > kLargestChunk) at.fail("a chunk unpacks to more than 1 GiB");
  if (part.tiled && chunk > std::max(kSmallTile, unpacked)) at.fail("a tile is larger than the image");
  const std::uint64_t ratio = facts_of(part.compression).best_ratio;
  const std::uint64_t stored = part.luminance_chroma() ? unpacked / 2 : unpacked;
  if (stored / ratio > source.bytes.size())
    at.fail("the file is too short for " + std::to_string(part.data.width()) + "x" +
            std::to_string(part.data.height()) + " pixels");
  part.chunk_count = count_chunks(part);
}

/// One header; empty names end the list of attributes, and an empty header the list of parts.
std::optional<Part> parse_header(const Source& source, Cursor& cursor, std::uint32_t flags) {
  const bool multi_part = flags & kMultiPartFlag;
  Part part;
  AttributeParser attributes(part);
  for (bool first = true;; first = false) {
    const std::string_view name = cursor.take_name();
    if (name.empty()) {
      if (first && multi_part) return std::nullopt;
      break;
    }
    const std::string_view type = cursor.take_name();
    const auto size = cursor.take<std::int32_t>();
    if (size < 0 || static_cast<std::uint32_t>(size) > cursor.left())
      cursor.fail("attribute '" + std::string(name) + "' is longer than the file");
    Cursor value(source.bytes.first(cursor.offset() + static_cast<std::size_t>(size)), source.name,
                 cursor.offset());
    cursor.take_bytes(static_cast<std::size_t>(size));
    attributes.parse(name, type, value);
  }
  if (const std::string missing = attributes.missing(); !missing.empty())
    cursor.fail("attribute '" + missing + "' is missing");

  const std::string& kind = attributes.part_type();
  part.deep = (flags & kDeepFlag && !multi_part) || kind == "deepscanline" || kind == "deeptile";
  part.tiled = multi_part ? kind == "tiledimage" || kind == "deeptile" : (flags & kTiledFlag) != 0;
  if (multi_part && !part.deep && !part.tiled && kind != "scanlineimage")
    cursor.fail(kind.empty() ? "attribute 'type' is missing" : "part type '" + kind + "' is not known");
  const char* const flagged = part.tiled ? "tiledimage" : "scanlineimage";
  if (!multi_part && !part.deep && !kind.empty() && kind != flagged) {
    part.warnings.push_back("attribute 'type' says '" + kind + "', but the flags of the file '" + flagged +
                            "': these are followed");
  }
  if (part.tiled && !attributes.has_tiles()) cursor.fail("attribute 'tiles' is missing");

  check_sizes(source, part, cursor);
  if (multi_part) {
    if (part.deep) part.chunk_count = attributes.chunk_count();
    if (attributes.chunk_count() != part.chunk_count) cursor.fail("attribute 'chunkCount' is wrong");
  }
  return part;
}

/// Reads the part's chunk table; entries of level 0 must point behind all tables and into the file.
void place_table(const Source& source, Part& part, Cursor& cursor) {
  part.table = cursor.offset();
  if (part.chunk_count > cursor.left() / sizeof(std::uint64_t))
    cursor.fail("the file ends inside the chunk table");
  cursor.take_bytes(part.chunk_count * sizeof(std::uint64_t));
  if (part.deep) return;
  for (std::uint64_t i = 0; i < part.columns() * part.rows(); ++i) {
    const auto offset = number_at<std::uint64_t>(source.bytes, part.table + i * sizeof(std::uint64_t));
    if (offset >= part.table + part.chunk_count * sizeof(std::uint64_t) && offset < source.bytes.size())
      continue;
    throw Error(ErrorKind::damaged, source.name,
                "row " + std::to_string(part.chunk_window(i).min_y) +
                    (offset == 0 ? ": the chunk was never written" : ": the file ends before the chunk") +
                    " (byte " + std::to_string(offset) + ")");
  }
}

}  // namespace

Window intersection(const Window& a, const Window& b) {
  return {std::max(a.min_x, b.min_x), std::max(a.min_y, b.min_y), std::min(a.max_x, b.max_x),
          std::min(a.max_y, b.max_y)};
}

std::size_t Part::bytes_per_pixel() const {
  std::size_t sum = 0;
  for (const StoredChannel& channel : channels) sum += bytes_of(channel.type);
  return sum;
}

int Part::chunk_width() const {
  return tiled ? tile_width : static_cast<int>(data.width());
}

int Part::chunk_height() const {
  return tiled ? tile_height : facts_of(compression).lines;
}

Window Part::chunk_window(std::uint64_t index) const {
  const auto x = static_cast<std::int64_t>(index % columns()) * chunk_width();
  const auto y = static_cast<std::int64_t>(index / columns()) * chunk_height();
  const Window whole{static_cast<int>(data.min_x + x), static_cast<int>(data.min_y + y),
                     static_cast<int>(data.min_x + x + chunk_width() - 1),
                     static_cast<int>(data.min_y + y + chunk_height() - 1)};
  return intersection(whole, data);
}

int Part::levels() const {
  if (deep || !tiled || level_mode != LevelMode::mipmap || data != display || luminance_chroma()) return 1;
  const int all = level_count(std::max(data.width(), data.height()), round_up);
  return own_levels > 0 ? std::min(own_levels, all) : all;
}

Window Part::level_window(int level) const {
  const auto width = size_of_level(data.width(), level, round_up),
             height = size_of_level(data.height(), level, round_up);
  return {data.min_x, data.min_y, static_cast<int>(data.min_x + width - 1),
          static_cast<int>(data.min_y + height - 1)};
}

int Part::index_of(std::string_view channel) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const StoredChannel& each) { return each.name == channel; });
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

bool Part::sampled(std::string_view channel, int step) const {
  const int index = index_of(channel);
  if (index < 0) return false;
  const StoredChannel& stored = channels[static_cast<std::size_t>(index)];
  return stored.x_sampling == step && stored.y_sampling == step;
}

bool Part::luminance_chroma() const {
  return sampled("Y", 1) && sampled("RY", 2) && sampled("BY", 2);
}

bool Part::full_chroma() const {
  const bool rgb = index_of("R") >= 0 && index_of("G") >= 0 && index_of("B") >= 0;
  return !rgb && sampled("Y", 1) && sampled("RY", 1) && sampled("BY", 1);
}

int level_count(int width, int height) {
  return level_count(std::int64_t{std::max(width, height)}, false);
}

bool is_exr(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && number_at<std::uint32_t>(bytes, 0) == kMagic;
}

File parse(const Source& source) {
  Cursor cursor(source.bytes, source.name, 0);
  if (cursor.take<std::uint32_t>() != kMagic) cursor.fail("not an OpenEXR file");
  const auto version = cursor.take<std::uint32_t>();
  if ((version & 0xff) != 2 || (version & ~0xffu & ~kKnownFlags) != 0)
    cursor.fail("unknown version of OpenEXR");
  if (version & kMultiPartFlag && version & kTiledFlag)
    cursor.fail("the version's flags contradict each other");

  File file;
  file.multi_part = version & kMultiPartFlag;
  while (auto part = parse_header(source, cursor, version)) {
    file.parts.push_back(std::move(*part));
    if (!file.multi_part) break;
  }
  if (file.parts.empty()) cursor.fail("there are no parts");
  if (!file.multi_part && file.parts[0].deep) return file;
  for (Part& part : file.parts) place_table(source, part, cursor);
  return file;
}

std::span<const std::byte> chunk_bytes(std::span<const std::byte> bytes, const File& file,
                                       std::size_t part_index, std::uint64_t index) {
  const Part& part = file.parts[part_index];
  Cursor cursor(bytes, "chunk", number_at<std::uint64_t>(bytes, part.table + index * sizeof(std::uint64_t)));
  const std::size_t header = (file.multi_part ? 4u : 0u) + (part.tiled ? 20u : 8u);
  if (cursor.left() < header) throw Error(ErrorKind::damaged, "the file ends early");
  bool expected = !file.multi_part || cursor.take<std::uint32_t>() == part_index;
  const Window window = part.chunk_window(index);
  if (part.tiled) {
    expected &= cursor.take<std::uint32_t>() == index % part.columns();
    expected &= cursor.take<std::uint32_t>() == index / part.columns();
    expected &= cursor.take<std::uint64_t>() == 0;  // the level's two numbers
  } else {
    expected &= cursor.take<std::int32_t>() == window.min_y;
  }
  if (!expected)
    throw Error(ErrorKind::damaged,
                "the chunk is of another place (byte " + std::to_string(cursor.offset()) + ")");
  const auto size = cursor.take<std::int32_t>();
  if (size <= 0 || static_cast<std::size_t>(size) > cursor.left())
    throw Error(ErrorKind::damaged, "the chunk's size " + std::to_string(size) +
                                        " passes the file's end (byte " + std::to_string(cursor.offset()) +
                                        ")");
  const auto maximum = static_cast<std::uint64_t>(window.width()) *
                       static_cast<std::uint64_t>(window.height()) * part.bytes_per_pixel();
  if (static_cast<std::uint64_t>(size) > maximum)
    throw Error(ErrorKind::too_large,
                "the chunk's size " + std::to_string(size) + " is more than its pixels need");
  return cursor.take_bytes(static_cast<std::size_t>(size));
}

std::string_view name_of(Compression compression) {
  return facts_of(compression).name;
}

int lines_of_chunk(Compression compression) {
  return facts_of(compression).lines;
}

std::vector<std::string> compression_names() {
  std::vector<std::string> names{"zip"};
  for (const CompressionFacts& each : kCompressions) {
    if (each.name != names.front()) names.emplace_back(each.name);
  }
  return names;
}

Compression compression_named(std::string_view name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < kCompressions.size(); ++i) {
    if (kCompressions[i].name == name) return static_cast<Compression>(i);
    known.emplace_back(kCompressions[i].name);
  }
  throw Error(ErrorKind::bad_request, unknown_name("EXR compression", name, known));
}

}  // namespace welkin::io::exr
