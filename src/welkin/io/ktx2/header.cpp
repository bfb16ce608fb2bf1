#include "welkin/io/ktx2/header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/texels/format_names.h"
#include "welkin/io/texels/picture.h"

namespace welkin::io::ktx2 {

using namespace texels;

namespace {

static_assert(std::endian::native == std::endian::little, "KTX2's numbers are read as they lie in memory");

constexpr std::array<unsigned char, 12> kIdentifier{0xab, 'K',  'T',  'X',  ' ',  '2',
                                                    '0',  0xbb, '\r', '\n', 0x1a, '\n'};

/// Byte offsets of the fields.
namespace at {
constexpr std::size_t vk_format = 12, type_size = 16, width = 20, height = 24, depth = 28, layers = 32,
                      faces = 36, levels = 40, scheme = 44, descriptor = 48, keys = 56, global = 64,
                      level_index = 80;
}
constexpr std::size_t kLevelBytes = 24;

class Fields {
 public:
  explicit Fields(const Source& source) : source_(source) {
    if (source.bytes.size() < at::level_index) ends_early("the header", at::level_index);
  }

  std::uint32_t word(std::size_t offset) const { return take<std::uint32_t>(offset); }
  std::uint64_t long_word(std::size_t offset) const { return take<std::uint64_t>(offset); }

  [[noreturn]] void fail(const std::string& cause, std::size_t offset) const {
    throw Error(ErrorKind::damaged, source_.name, cause + " (byte " + std::to_string(offset) + ")");
  }
  /// What is well-formed but not read.
  [[noreturn]] void refuse(const std::string& cause, std::size_t offset) const {
    throw Error(ErrorKind::unsupported, source_.name, cause + " (byte " + std::to_string(offset) + ")");
  }
  [[noreturn]] void ends_early(const std::string& what, std::uint64_t end) const {
    throw Error(ErrorKind::damaged, source_.name,
                "ends early (byte " + std::to_string(source_.bytes.size()) + "): " + what + " ends at byte " +
                    std::to_string(end));
  }

 private:
  template <class T>
  T take(std::size_t offset) const {
    return load_native<T>(source_.bytes.data() + offset);
  }
  const Source& source_;
};

/// The data format descriptor's, or 0 where it lies outside the file.
std::uint32_t colour_model(const Fields& fields, const Source& source) {
  constexpr std::size_t kModelAt = 12;
  const std::size_t at = std::size_t{fields.word(at::descriptor)} + kModelAt;
  return at < source.bytes.size() ? std::to_integer<std::uint32_t>(source.bytes[at]) : 0;
}

void parse_format(const Fields& fields, const Source& source, Header& header) {
  const std::uint32_t scheme = fields.word(at::scheme), number = fields.word(at::vk_format);
  if (scheme == 1) fields.refuse(refusal_of_basis_lz(), at::scheme);
  if (scheme != 0 && scheme != 2 && scheme != 3) {
    fields.refuse("supercompression scheme " + std::to_string(scheme) + " is not supported", at::scheme);
  }
  header.scheme = static_cast<Scheme>(scheme);
  const std::uint32_t model = colour_model(fields, source);
  header.format = find_format(number, model);
  if (header.format == nullptr) fields.refuse(refusal_of(number, model), at::vk_format);
  if (const std::uint32_t size = fields.word(at::type_size); size != header.format->type_size) {
    fields.fail("the type size " + std::to_string(size) + " is not that of " + format_name(number),
                at::type_size);
  }
}

void parse_shape(const Fields& fields, const Source& source, Header& header) {
  const std::uint32_t width = fields.word(at::width), height = fields.word(at::height),
                      layers = fields.word(at::layers), faces = fields.word(at::faces);
  if (const std::uint32_t depth = fields.word(at::depth); depth != 0) {
    fields.refuse("a texture of three dimensions (" + std::to_string(width) + "×" + std::to_string(height) +
                      "×" + std::to_string(depth) +
                      ") is no map; `ktx extract --all` makes pictures of its slices",
                  at::depth);
  }
  if (faces != 1 && faces != 6) fields.fail(std::to_string(faces) + " faces, neither 1 nor 6", at::faces);
  if (faces == 6 && width != height) {
    fields.fail(
        "the faces of a cube are " + std::to_string(width) + "×" + std::to_string(height) + ", not square",
        at::width);
  }
  header.one_dimensional = height == 0;
  check_size(source, width, std::max(height, 1u), header.format->channels.size());
  header.width = static_cast<int>(width);
  header.height = static_cast<int>(std::max(height, 1u));

  const std::uint32_t stated = fields.word(at::levels);
  const auto maximum = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
  if (stated > maximum) {
    fields.fail(std::to_string(stated) + " levels, of which " + std::to_string(width) + "×" +
                    std::to_string(height) + " has at most " + std::to_string(maximum),
                at::levels);
  }
  header.asks_for_levels = stated == 0;
  header.levels.resize(std::max(stated, 1u));
  const std::uint64_t pictures = std::uint64_t{std::max(layers, 1u)} * faces * header.levels.size();
  if (pictures > kMaxPictures) {
    fields.fail(std::to_string(pictures) + " pictures, more than " + std::to_string(kMaxPictures),
                at::layers);
  }
  header.layers = static_cast<int>(layers);
  header.faces = static_cast<int>(faces);
}

/// Of bytes that the file states, which may be any number.
std::string count_of(std::uint64_t bytes) {
  constexpr std::uint64_t kAbsurd = std::uint64_t{1} << 60;
  return bytes < kAbsurd ? std::to_string(bytes) : "2^60 or more";
}

/// Sizes: at most 2^20 texels a side and 2^16 pictures of 16 bytes a texel come to less than 2^63 bytes.
void parse_level(const Fields& fields, const Source& source, const Header& header, std::size_t level,
                 Level& parsed) {
  const std::size_t entry = at::level_index + level * kLevelBytes;
  const std::string name = "level " + std::to_string(level);
  parsed = {{fields.long_word(entry), fields.long_word(entry + 8)}, fields.long_word(entry + 16)};
  const std::uint64_t demanded = header.level_bytes(level);
  if (parsed.unpacked_bytes != demanded) {
    fields.fail(name + " has " + count_of(parsed.unpacked_bytes) + " bytes, not the " +
                    std::to_string(demanded) + " of its pictures",
                entry + 16);
  }
  if (header.scheme == Scheme::none) {
    if (parsed.stored.bytes == demanded) return;
    fields.fail(
        name + " is stored in " + count_of(parsed.stored.bytes) + " bytes, not " + std::to_string(demanded),
        entry + 8);
  }
  if (demanded > source.options.max_bytes) {
    fields.fail(name + " unpacks to " + std::to_string(demanded) + " bytes, over the limit of " +
                    std::to_string(source.options.max_bytes),
                entry + 16);
  }
  // Zstandard: 4 bytes for a block of 128 KiB that are all the same. Deflate: a bit for 129 bytes.
  const std::uint64_t best_ratio = header.scheme == Scheme::zstd ? 32768 : 1032;
  if (demanded / best_ratio > parsed.stored.bytes) {
    fields.fail(name + " cannot unpack to " + std::to_string(demanded) + " bytes from " +
                    std::to_string(parsed.stored.bytes),
                entry + 8);
  }
}

/// Every section lies in the file, and no two overlap.
void check_sections(const Fields& fields, const Source& source, const Header& header) {
  struct Named {
    Section section;
    std::string name;
  };
  std::vector<Named> all = {{{0, header_bytes(header.levels.size())}, "the header"},
                            {header.descriptor, "the data format descriptor"}};
  if (header.keys.bytes > 0) all.push_back({header.keys, "the key/value data"});
  for (std::size_t i = 0; i < header.levels.size(); ++i)
    all.push_back({header.levels[i].stored, "level " + std::to_string(i)});

  const std::uint64_t size = source.bytes.size();
  for (const Named& each : all) {
    if (each.section.offset <= size && each.section.bytes <= size - each.section.offset) continue;
    const std::uint64_t end = each.section.offset + each.section.bytes;
    if (end < each.section.offset) fields.fail(each.name + " lies past the file's end", each.section.offset);
    fields.ends_early(each.name, end);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Named& a, const Named& b) { return a.section.offset < b.section.offset; });
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Section& before = all[i - 1].section;
    if (before.offset + before.bytes > all[i].section.offset)
      fields.fail(all[i].name + " overlaps " + all[i - 1].name, all[i].section.offset);
  }
}

template <class T>
void append(std::vector<std::byte>& bytes, T value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

}  // namespace

std::string_view name_of(Scheme scheme) {
  if (scheme == Scheme::none) return "none";
  return scheme == Scheme::zstd ? "zstd" : "zlib";
}

std::uint64_t Header::picture_bytes(std::size_t level) const {
  return texels::picture_bytes(*format, width_of(level), height_of(level));
}

std::uint64_t Header::level_bytes(std::size_t level) const {
  return picture_bytes(level) * static_cast<std::uint64_t>(shape().layer_count()) *
         static_cast<std::uint64_t>(faces);
}

bool is_ktx2(std::span<const std::byte> bytes) {
  return bytes.size() >= kIdentifier.size() &&
         std::memcmp(bytes.data(), kIdentifier.data(), kIdentifier.size()) == 0;
}

std::uint64_t header_bytes(std::size_t levels) {
  return at::level_index + levels * kLevelBytes;
}

std::uint64_t level_alignment(const Header& header) {
  return header.scheme == Scheme::none ? std::lcm(std::uint64_t{header.format->bytes()}, std::uint64_t{4})
                                       : 1;
}

Header parse_header(const Source& source) {
  const Fields fields(source);
  Header header;
  parse_format(fields, source, header);
  parse_shape(fields, source, header);
  header.descriptor = {fields.word(at::descriptor), fields.word(at::descriptor + 4)};
  header.keys = {fields.word(at::keys), fields.word(at::keys + 4)};
  if (fields.long_word(at::global + 8) != 0) {
    fields.fail("has global data, which its supercompression does not use", at::global + 8);
  }
  const std::uint64_t index_end = header_bytes(header.levels.size());
  if (source.bytes.size() < index_end) fields.ends_early("the level index", index_end);
  for (std::size_t i = 0; i < header.levels.size(); ++i)
    parse_level(fields, source, header, i, header.levels[i]);
  check_sections(fields, source, header);
  return header;
}

std::vector<std::byte> written_header(const Header& header) {
  std::vector<std::byte> bytes;
  for (const unsigned char c : kIdentifier) bytes.push_back(std::byte{c});
  const auto width = static_cast<std::uint32_t>(header.width),
             height = static_cast<std::uint32_t>(header.one_dimensional ? 0 : header.height),
             layers = static_cast<std::uint32_t>(header.layers),
             faces = static_cast<std::uint32_t>(header.faces),
             levels = static_cast<std::uint32_t>(header.levels.size());
  constexpr std::uint32_t kDepth = 0;
  for (const std::uint32_t word : {header.format->number, header.format->type_size, width, height, kDepth,
                                   layers, faces, levels, static_cast<std::uint32_t>(header.scheme)})
    append(bytes, word);
  for (const Section& section : {header.descriptor, header.keys}) {
    append(bytes, static_cast<std::uint32_t>(section.offset));
    append(bytes, static_cast<std::uint32_t>(section.bytes));
  }
  append(bytes, Section{});
  for (const Level& level : header.levels) append(bytes, level);
  return bytes;
}

}  // namespace welkin::io::ktx2
