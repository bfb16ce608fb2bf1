#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/base/version.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/channel_names.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/format.h"
#include "welkin/io/texels/picture.h"
#include "welkin/io/texels/picture_set.h"

/// KTX, version 1: textures as OpenGL takes them. Source: "KTX File Format Specification", version 1
/// (Khronos).
///
///     identifier, 12 bytes, and 13 words    0
///     key/value data                        64
///     levels, the finest first                    each a word that gives its size, of a cube that of one
///     face; then layer
///                                                 by layer, face by face, row by row; rows and levels padded
///                                                 to words
namespace welkin::io {
namespace ktx1 {

using namespace texels;

namespace {

constexpr unsigned char kIdentifier[12] = {0xab, 'K', 'T', 'X', ' ', '1', '1', 0xbb, '\r', '\n', 0x1a, '\n'};
constexpr std::uint32_t kOurOrder = 0x04030201, kOtherOrder = 0x01020304;
constexpr std::size_t kHeaderBytes = 64;

/// Words of the header.
namespace at {
constexpr std::size_t order = 3, type = 4, format = 6, internal = 7, width = 9, height = 10, depth = 11,
                      layers = 12, faces = 13, levels = 14, key_bytes = 15;
}

/// What OpenGL calls the formats of texels. `also` is another glType that writers give.
struct Names {
  std::uint32_t vulkan, type, type_size, format, internal, base, also = 0;
};
constexpr std::uint32_t kByte = 0x1401, kShort = 0x1403, kFloat = 0x1406, kHalf = 0x140b, kRed = 0x1903,
                        kRg = 0x8227, kRgb = 0x1907, kRgba = 0x1908, kBgr = 0x80e0, kBgra = 0x80e1;
constexpr Names kNames[] = {{109, kFloat, 4, kRgba, 0x8814, kRgba},
                            {106, kFloat, 4, kRgb, 0x8815, kRgb},
                            {103, kFloat, 4, kRg, 0x8230, kRg},
                            {100, kFloat, 4, kRed, 0x822e, kRed},
                            {97, kHalf, 2, kRgba, 0x881a, kRgba},
                            {90, kHalf, 2, kRgb, 0x881b, kRgb},
                            {83, kHalf, 2, kRg, 0x822f, kRg},
                            {76, kHalf, 2, kRed, 0x822d, kRed},
                            // Filament's reader takes the internal format in place of the type.
                            {122, 0x8c3b, 4, kRgb, 0x8c3a, kRgb, 0x8c3a},
                            {123, 0x8c3e, 4, kRgb, 0x8c3d, kRgb},
                            {143, 0, 1, 0, 0x8e8f, kRgb},
                            {144, 0, 1, 0, 0x8e8e, kRgb},
                            {37, kByte, 1, kRgba, 0x8058, kRgba},
                            {43, kByte, 1, kRgba, 0x8c43, kRgba},
                            {44, kByte, 1, kBgra, 0x8058, kRgba},
                            {23, kByte, 1, kRgb, 0x8051, kRgb},
                            {29, kByte, 1, kRgb, 0x8c41, kRgb},
                            {30, kByte, 1, kBgr, 0x8051, kRgb},
                            {16, kByte, 1, kRg, 0x822b, kRg},
                            {9, kByte, 1, kRed, 0x8229, kRed},
                            {91, kShort, 2, kRgba, 0x805b, kRgba},
                            {84, kShort, 2, kRgb, 0x8054, kRgb},
                            {70, kShort, 2, kRed, 0x822a, kRed}};

std::uint64_t padded(std::uint64_t size) {
  return (size + 3) / 4 * 4;
}

struct Header {
  const TexelFormat* format = nullptr;
  TextureShape shape;
  std::uint64_t first = 0;  ///< byte at which the levels begin

  std::uint64_t row_stride(int level) const {
    const std::uint64_t bytes = row_bytes(*format, shape.width_of(level));
    return format->block() > 1 ? bytes : padded(bytes);
  }
  std::uint64_t picture_bytes(int level) const {
    return row_stride(level) * static_cast<std::uint64_t>(stored_rows(*format, shape.height_of(level)));
  }
  int of_level() const { return shape.layer_count() * shape.faces; }
  /// What the word before a level says.
  std::uint64_t image_size(int level) const {
    const bool one_face = shape.faces == 6 && shape.layers == 0;
    return picture_bytes(level) * static_cast<std::uint64_t>(one_face ? 1 : of_level());
  }
  /// With the word before it.
  std::uint64_t level_bytes(int level) const {
    return 4 + padded(picture_bytes(level)) * static_cast<std::uint64_t>(of_level());
  }
  std::uint64_t level_offset(int level) const {
    std::uint64_t offset = first;
    for (int l = 0; l < level; ++l) offset += level_bytes(l);
    return offset;
  }
};

bool is_ktx1(std::span<const std::byte> bytes) {
  return bytes.size() >= sizeof kIdentifier &&
         std::memcmp(bytes.data(), kIdentifier, sizeof kIdentifier) == 0;
}

class Ktx1Reader final : public FormatReader {
 public:
  explicit Ktx1Reader(const Source& source) : source_(source) {
    require_bytes(kHeaderBytes, "the header");
    const std::uint32_t order = load_native<std::uint32_t>(source.bytes.data() + 4 * at::order);
    if (order != kOurOrder && order != kOtherOrder) fail("neither little- nor big-endian", 4 * at::order);
    swapped_ = order == kOtherOrder;
    parse_format();
    parse_shape();
    parse_keys();
    info_.format = "ktx";
    info_.bytes = source.bytes.size();
    info_.colour = source.options.colour != Colour::automatic ? source.options.colour
                   : header_.format->srgb                     ? Colour::srgb
                                                              : Colour::linear;
    check_levels();
    std::vector<std::string> names;
    for (const char name : std::string_view("RGBA")) {
      const std::size_t found = header_.format->channels.find(name);
      if (found == std::string_view::npos || (name == 'A' && is_alpha_added(info_.attributes))) continue;
      names.emplace_back(1, name);
      stored_.push_back(static_cast<int>(found));
    }
    list_pictures(header_.shape, names, header_.format->type, "none", info_);
    if (names.back() == "A") declared_.alpha = is_ours() ? AlphaKind::associated : AlphaKind::straight;
  }

  void decode(std::size_t part_index, std::span<const int> channels, ImageView<float> out) override {
    const PartInfo& part = info_.parts[part_index];
    std::vector<int> stored;
    for (const int channel : channels) stored.push_back(stored_[static_cast<std::size_t>(channel)]);
    const auto picture = static_cast<std::uint64_t>(part.layer * header_.shape.faces + part.face);
    StoredPicture from{header_.format, source_.bytes.data() + header_.level_offset(part.level) + 4 +
                                           picture * padded(header_.picture_bytes(part.level))};
    from.row_stride = static_cast<std::size_t>(header_.row_stride(part.level));
    from.colour = info_.colour;
    from.from_bottom = from_bottom_;
    from.from_right = from_right_;
    std::vector<std::byte> turned;
    if (swapped_ && header_.format->type_size > 1) {
      const std::span<const std::byte> bytes(from.bytes,
                                             static_cast<std::size_t>(header_.picture_bytes(part.level)));
      turned.assign(bytes.begin(), bytes.end());
      swap_values(turned, header_.format->type_size);
      from.bytes = turned.data();
    }
    read_picture(from, stored, out);
  }

 private:
  std::uint32_t word(std::size_t at) const {
    const auto value = load_native<std::uint32_t>(source_.bytes.data() + at);
    return swapped_ ? swap_bytes(value) : value;
  }
  [[noreturn]] void fail(const std::string& cause, std::uint64_t at) const {
    throw Error(ErrorKind::damaged, source_.name, cause + " (byte " + std::to_string(at) + ")");
  }
  [[noreturn]] void refuse(const std::string& cause, std::uint64_t at) const {
    throw Error(ErrorKind::unsupported, source_.name, cause + " (byte " + std::to_string(at) + ")");
  }
  void require_bytes(std::uint64_t end, const std::string& what) const {
    if (source_.bytes.size() >= end) return;
    throw Error(ErrorKind::damaged, source_.name,
                "ends early (byte " + std::to_string(source_.bytes.size()) + "): " + what + " ends at byte " +
                    std::to_string(end));
  }
  static void swap_values(std::vector<std::byte>& bytes, std::size_t size) {
    for (std::size_t i = 0; i + size <= bytes.size(); i += size)
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                   bytes.begin() + static_cast<std::ptrdiff_t>(i + size));
  }

  void parse_format() {
    const std::uint32_t type = word(4 * at::type), format = word(4 * at::format),
                        internal = word(4 * at::internal);
    for (const Names& names : kNames) {
      // Older writers name the unsized format in `internal`.
      const bool same_type = type == names.type || (names.also != 0 && type == names.also);
      if (same_type && format == names.format &&
          (internal == names.internal || (format != 0 && internal == names.base))) {
        header_.format = find_format(names.vulkan);
        return;
      }
    }
    if (type == 0 && format == 0)
      refuse("compressed texels of OpenGL's format " + std::to_string(internal) +
                 " are not read; unpack them to half floats",
             4 * at::internal);
    refuse("texels of OpenGL's type " + std::to_string(type) + ", format " + std::to_string(format) +
               ", internal format " + std::to_string(internal) + " are not read; make them half floats",
           4 * at::type);
  }

  void parse_shape() {
    const std::uint32_t width = word(4 * at::width), height = word(4 * at::height),
                        layers = word(4 * at::layers), faces = word(4 * at::faces),
                        stated = word(4 * at::levels);
    if (word(4 * at::depth) > 1) refuse("a texture of three dimensions is no map", 4 * at::depth);
    if (faces != 1 && faces != 6) fail(std::to_string(faces) + " faces, neither 1 nor 6", 4 * at::faces);
    if (faces == 6 && width != height)
      fail("the faces of a cube are " + std::to_string(width) + "×" + std::to_string(height) + ", not square",
           4 * at::width);
    check_size(source_, width, std::max(height, 1u), header_.format->channels.size());
    const auto maximum = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
    if (stated > maximum)
      fail(std::to_string(stated) + " levels, of which " + std::to_string(width) + "×" +
               std::to_string(height) + " has at most " + std::to_string(maximum),
           4 * at::levels);
    if (stated == 0) info_.notes.push_back("its other levels are to be made from level 0");
    const std::uint64_t levels = std::max(stated, 1u);
    const std::uint64_t pictures = std::uint64_t{std::max(layers, 1u)} * faces * levels;
    if (pictures > kMaxPictures)
      fail(std::to_string(pictures) + " pictures, more than " + std::to_string(kMaxPictures), 4 * at::layers);
    header_.shape = {static_cast<int>(width), static_cast<int>(std::max(height, 1u)),
                     static_cast<int>(levels), static_cast<int>(layers), static_cast<int>(faces)};
  }

  void parse_keys() {
    const std::uint64_t bytes = word(4 * at::key_bytes);
    header_.first = kHeaderBytes + bytes;
    require_bytes(header_.first, "the key/value data");
    std::uint64_t entry = kHeaderBytes;
    while (entry + 4 <= header_.first) {
      const std::uint64_t size = word(static_cast<std::size_t>(entry));
      if (size > header_.first - entry - 4) fail("a key and its value are longer than the data", entry);
      const std::string_view text(reinterpret_cast<const char*>(source_.bytes.data()) + entry + 4,
                                  static_cast<std::size_t>(size));
      const std::size_t end = text.find('\0');
      if (end == std::string_view::npos || end == 0) fail("a key is empty or has no end", entry);
      std::string_view value = text.substr(end + 1);
      if (!value.empty() && value.back() == '\0') value.remove_suffix(1);
      const std::string key(text.substr(0, end));
      if (value.find('\0') == std::string_view::npos) {
        info_.attributes.emplace(key, value);
      } else {
        info_.notes.push_back(key + ": " + std::to_string(size - end - 1) + " bytes that are not text");
      }
      entry += 4 + padded(size);
    }
    const auto found = info_.attributes.find("KTXorientation");
    if (found == info_.attributes.end() || header_.shape.faces == 6) return;
    from_right_ = found->second.find("S=l") != std::string::npos;
    from_bottom_ = found->second.find("T=u") != std::string::npos;
    if (from_right_ || from_bottom_)
      info_.notes.push_back("stored in the orientation " + found->second + "; turned upright");
  }

  void check_levels() {
    for (int level = 0; level < header_.shape.levels; ++level) {
      const std::uint64_t at = header_.level_offset(level), end = at + header_.level_bytes(level);
      // The last level's padding may be missing.
      const std::uint64_t slack = padded(header_.picture_bytes(level)) - header_.picture_bytes(level);
      require_bytes(end - slack, "level " + std::to_string(level));
      // Some writers give all six faces of a cube.
      const std::uint64_t stated = word(static_cast<std::size_t>(at)), size = header_.image_size(level);
      if (stated == size || (header_.shape.faces == 6 && stated == 6 * size)) continue;
      fail("level " + std::to_string(level) + " has " + std::to_string(stated) + " bytes, not the " +
               std::to_string(size) + " of its pictures",
           at);
    }
    const std::uint64_t end = header_.level_offset(header_.shape.levels);
    if (source_.bytes.size() > end)
      info_.warnings.push_back(std::to_string(source_.bytes.size() - end) +
                               " bytes follow the pictures and are not read");
  }

  bool is_ours() const {
    const auto writer = info_.attributes.find("KTXwriter");
    return writer != info_.attributes.end() && writer->second.starts_with("welkin ");
  }

  Source source_;
  Header header_;
  bool swapped_ = false, from_right_ = false, from_bottom_ = false;
  std::vector<int> stored_;
};

std::unique_ptr<FormatReader> open_ktx1(const Source& source) {
  return std::make_unique<Ktx1Reader>(source);
}

void append(std::vector<std::byte>& bytes, std::uint32_t word) {
  const auto* first = reinterpret_cast<const std::byte*>(&word);
  bytes.insert(bytes.end(), first, first + sizeof word);
}

std::vector<std::byte> written_keys(const std::map<std::string, std::string>& attributes) {
  std::map<std::string, std::string> all = {{"KTXorientation", "S=r,T=d"},
                                            {"KTXwriter", "welkin " + std::string(version())}};
  for (const auto& [key, value] : attributes) {
    if (key.starts_with("KTX") || key.starts_with("ktx")) continue;
    if (key.empty())
      throw Error(ErrorKind::bad_request, "an attribute without a name cannot be a key of KTX");
    if ((key + value).find('\0') != std::string::npos)
      throw Error(ErrorKind::bad_request,
                  "the attribute '" + std::string(key.c_str()) + "' holds a zero byte, where its text ends");
    all.emplace(key, value);
  }
  std::vector<std::byte> bytes;
  for (const auto& [key, value] : all) {
    const std::string entry = key + '\0' + value + '\0';
    append(bytes, static_cast<std::uint32_t>(entry.size()));
    const auto* first = reinterpret_cast<const std::byte*>(entry.data());
    bytes.insert(bytes.end(), first, first + entry.size());
    bytes.resize(static_cast<std::size_t>(padded(bytes.size())));
  }
  return bytes;
}

WriteReport write_ktx1(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  const PictureSet pictures(parts);
  PictureWriter writer(options, "KTX");
  Header header;
  header.format = &writer.format();
  header.shape = pictures.shape();
  const auto names = std::find_if(std::begin(kNames), std::end(kNames),
                                  [&](const Names& each) { return each.vulkan == header.format->number; });
  for (int level = 0; level < header.shape.levels; ++level) {
    if (header.image_size(level) > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::too_large, "a level of more than 4 GiB does not fit in KTX; KTX2 holds it");
  }
  const std::vector<std::byte> keys = written_keys(options.attributes);
  std::vector<std::byte> head;
  for (const unsigned char c : kIdentifier) head.push_back(std::byte{c});
  const auto count = [](int value) { return static_cast<std::uint32_t>(value); };
  for (const std::uint32_t word :
       {kOurOrder, names->also != 0 ? names->also : names->type, names->type_size, names->format,
        names->internal, names->base, count(header.shape.width), count(header.shape.height), 0u,
        count(header.shape.layers), count(header.shape.faces), count(header.shape.levels),
        static_cast<std::uint32_t>(keys.size())})
    append(head, word);
  head.insert(head.end(), keys.begin(), keys.end());
  file.write(head);
  WriteReport report;
  for (int level = 0; level < header.shape.levels; ++level) {
    const auto size = static_cast<std::uint32_t>(header.image_size(level));
    file.write(&size, sizeof size);
    // All texels written are of whole words, so rows and pictures need no padding.
    for (int picture = 0; picture < pictures.of_level(); ++picture)
      report = report + writer.write(file, pictures.at(level, picture));
  }
  return report;
}

}  // namespace
}  // namespace ktx1

Format ktx1_format() {
  return {{.format = "ktx",
           .title = "KTX",
           .extensions = {"ktx"},
           .types = {std::begin(texels::PictureWriter::kTypes), std::end(texels::PictureWriter::kTypes)},
           .compressions = {"none"},
           .channels = Channels::rgba,
           .pictures = true,
           .levels = true,
           .texture = true,
           .hdr = true,
           .negative = true,
           .attributes = true},
          ktx1::is_ktx1,
          ktx1::open_ktx1,
          ktx1::write_ktx1};
}

}  // namespace welkin::io
