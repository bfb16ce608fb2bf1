#include "welkin/io/dds/header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>
#include <string>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/texels/format_names.h"
#include "welkin/io/texels/picture.h"

namespace welkin::io::dds {

using namespace texels;

namespace {

/// Words of the header, from the magic on.
namespace at {
constexpr std::size_t size = 1, flags = 2, height = 3, width = 4, pitch = 5, levels = 7, reserved = 8,
                      format_size = 19, format_flags = 20, four_cc = 21, bits = 22, masks = 23, caps = 27,
                      caps2 = 28, dxgi = 32, dimension = 33, misc = 34, layers = 35, misc2 = 36;
}
constexpr std::size_t kOldBytes = 128, kModernBytes = 148;
constexpr std::uint32_t kHeaderSize = 124, kFormatSize = 32;
constexpr std::uint32_t kFlagPitch = 8, kFlagLevels = 0x20000, kFlagLinearSize = 0x80000,
                        kRequiredFlags = 0x1007;
constexpr std::uint32_t kHasAlpha = 1, kFourCc = 4, kRgb = 0x40, kLuminance = 0x20000;
constexpr std::uint32_t kCapsTexture = 0x1000, kCapsComplex = 8, kCapsLevels = 0x400000;
constexpr std::uint32_t kCube = 0x200, kAllFaces = 0xfc00, kVolume = 0x200000;
constexpr std::uint32_t kTexture1d = 2, kTexture2d = 3, kMiscCube = 4;
constexpr std::uint32_t kModePremultiplied = 2, kModeOpaque = 3;
/// In the first of the words that are reserved, and used by writers to sign: `WLKN`. Their alpha is 1.
constexpr std::uint32_t kSignature = 0x4e4b4c57;

constexpr std::uint32_t four_cc(const char (&text)[5]) {
  return static_cast<std::uint32_t>(text[0]) | static_cast<std::uint32_t>(text[1]) << 8 |
         static_cast<std::uint32_t>(text[2]) << 16 | static_cast<std::uint32_t>(text[3]) << 24;
}

struct Number {
  std::uint32_t theirs, vulkan;
};

/// DXGI_FORMATs.
constexpr Number kDxgi[] = {{2, 109}, {6, 106}, {10, 97}, {11, 91}, {13, 92}, {16, 103}, {24, 64},  {26, 122},
                            {28, 37}, {29, 43}, {31, 38}, {34, 83}, {35, 77}, {37, 78},  {41, 100}, {49, 16},
                            {51, 17}, {54, 76}, {56, 70}, {58, 71}, {61, 9},  {63, 10},  {67, 123}, {85, 4},
                            {86, 8},  {87, 44}, {88, 44}, {91, 50}, {93, 50}, {95, 143}, {96, 144}, {115, 3}};
constexpr std::uint32_t kDxgiX8 = 88, kDxgiX8Srgb = 93;

/// D3DFORMATs, where a FourCC stands.
constexpr Number kD3d9[] = {{36, 91}, {111, 76}, {112, 83}, {113, 97}, {114, 100}, {115, 103}, {116, 109}};

/// Compressed textures by their FourCC, and in DXGI_FORMATs by their first and last number.
struct Compressed {
  std::uint32_t code, first, last;
  const char* name;
};
constexpr Compressed kCompressed[] = {
    {four_cc("DXT1"), 70, 72, "BC1"}, {four_cc("DXT2"), 73, 75, "BC2"}, {four_cc("DXT3"), 73, 75, "BC2"},
    {four_cc("DXT4"), 76, 78, "BC3"}, {four_cc("DXT5"), 76, 78, "BC3"}, {four_cc("ATI1"), 79, 81, "BC4"},
    {four_cc("BC4U"), 79, 81, "BC4"}, {four_cc("BC4S"), 79, 81, "BC4"}, {four_cc("ATI2"), 82, 84, "BC5"},
    {four_cc("BC5U"), 82, 84, "BC5"}, {four_cc("BC5S"), 82, 84, "BC5"}, {0, 97, 99, "BC7"}};

/// Texels of integers by the bits of R, G, B and A.
struct Masks {
  std::uint32_t bits, r, g, b;
  std::uint32_t vulkan;
};
constexpr Masks kMasks[] = {{32, 0xff, 0xff00, 0xff0000, 37},     {32, 0xff0000, 0xff00, 0xff, 44},
                            {24, 0xff0000, 0xff00, 0xff, 30},     {24, 0xff, 0xff00, 0xff0000, 23},
                            {16, 0xf800, 0x7e0, 0x1f, 4},         {16, 0x7c00, 0x3e0, 0x1f, 8},
                            {32, 0x3ff, 0xffc00, 0x3ff00000, 64}, {32, 0x3ff00000, 0xffc00, 0x3ff, 58},
                            {32, 0xffff, 0xffff0000, 0, 77}};

constexpr const char* kRemedy =
    "make it BC6H, half or float, for instance by DirectXTex's `texconv -f R16G16B16A16_FLOAT`";

class Words {
 public:
  explicit Words(const Source& source) : source_(source) {}
  std::uint32_t operator[](std::size_t word) const {
    return load_native<std::uint32_t>(source_.bytes.data() + 4 * word);
  }
  [[noreturn]] void fail(const std::string& cause, std::size_t word) const {
    raise(ErrorKind::damaged, cause, word);
  }
  [[noreturn]] void refuse(const std::string& cause, std::size_t word) const {
    raise(ErrorKind::unsupported, cause, word);
  }
  void require_bytes(std::uint64_t end, const char* what) const {
    if (source_.bytes.size() >= end) return;
    throw Error(ErrorKind::damaged, source_.name,
                "ends early (byte " + std::to_string(source_.bytes.size()) + "): " + what + " ends at byte " +
                    std::to_string(end));
  }

 private:
  [[noreturn]] void raise(ErrorKind kind, const std::string& cause, std::size_t word) const {
    throw Error(kind, source_.name, cause + " (byte " + std::to_string(4 * word) + ")");
  }
  const Source& source_;
};

const TexelFormat* format_of(std::span<const Number> numbers, std::uint32_t theirs) {
  const auto found =
      std::find_if(numbers.begin(), numbers.end(), [&](const Number& each) { return each.theirs == theirs; });
  return found == numbers.end() ? nullptr : find_format(found->vulkan);
}

[[noreturn]] void refuse_compressed(const Words& words, const char* name, std::size_t word) {
  words.refuse("texels of " + std::string(name) + ", compressed blocks, are not read; " + kRemedy, word);
}

void parse_modern_format(const Words& words, Header& header) {
  const std::uint32_t number = words[at::dxgi];
  header.modern = true;
  header.format = format_of(kDxgi, number);
  if (header.format == nullptr) {
    for (const Compressed& each : kCompressed) {
      if (number >= each.first && number <= each.last) refuse_compressed(words, each.name, at::dxgi);
    }
    words.refuse("texels of DXGI_FORMAT " + std::to_string(number) + " are not read; " + kRemedy, at::dxgi);
  }
  header.srgb = header.format->srgb;
  const std::uint32_t mode = words[at::misc2] & 7;
  if (mode == kModePremultiplied) header.alpha = Alpha::premultiplied;
  if (mode == kModeOpaque || number == kDxgiX8 || number == kDxgiX8Srgb) header.alpha = Alpha::none;
}

void parse_old_format(const Words& words, Header& header) {
  const std::uint32_t flags = words[at::format_flags], code = words[at::four_cc];
  if ((flags & kFourCc) != 0) {
    header.format = format_of(kD3d9, code);
    if (header.format != nullptr) {
      if (words[at::reserved] == kSignature && (flags & kHasAlpha) == 0) header.alpha = Alpha::none;
      return;
    }
    for (const Compressed& each : kCompressed) {
      if (code == each.code) refuse_compressed(words, each.name, at::four_cc);
    }
    words.refuse("texels of the FourCC " + std::to_string(code) + " are not read; " + kRemedy, at::four_cc);
  }
  if ((flags & kLuminance) != 0 && words[at::bits] == 8 && words[at::masks] == 0xff) {
    header.format = find_format(9);
    header.grey = true;
    return;
  }
  if ((flags & kRgb) != 0) {
    for (const Masks& each : kMasks) {
      if (words[at::bits] != each.bits || words[at::masks] != each.r || words[at::masks + 1] != each.g ||
          words[at::masks + 2] != each.b)
        continue;
      header.format = find_format(each.vulkan);
      if ((flags & kHasAlpha) == 0) header.alpha = Alpha::none;
      return;
    }
  }
  words.refuse(
      "texels of " + std::to_string(words[at::bits]) + " bits in an arrangement that is not read; " + kRemedy,
      at::format_flags);
}

void parse_shape(const Words& words, const Source& source, Header& header) {
  const std::uint32_t width = words[at::width], height = words[at::height];
  const std::uint32_t caps2 = words[at::caps2];
  std::uint64_t layers = 1;
  bool cube = (caps2 & kCube) != 0;
  if (header.modern) {
    const std::uint32_t dimension = words[at::dimension];
    if (dimension != kTexture1d && dimension != kTexture2d)
      words.refuse(
          "a texture of three dimensions is no map; `texassemble` or `texconv` make pictures of its slices",
          at::dimension);
    cube = (words[at::misc] & kMiscCube) != 0;
    layers = words[at::layers];
    if (layers == 0) words.fail("an array of no textures", at::layers);
  } else if ((caps2 & kVolume) != 0) {
    words.refuse("a texture of three dimensions is no map; `texconv` makes pictures of its slices",
                 at::caps2);
  } else if (cube && (caps2 & kAllFaces) != kAllFaces) {
    words.refuse("a cube of which not all faces are there", at::caps2);
  }
  check_size(source, width, height, header.format->channels.size());
  if (cube && width != height)
    words.fail(
        "the faces of a cube are " + std::to_string(width) + "×" + std::to_string(height) + ", not square",
        at::height);
  const std::uint32_t stated = std::max(words[at::levels], 1u);
  const auto maximum = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
  if (stated > maximum)
    words.fail(std::to_string(stated) + " levels, of which " + std::to_string(width) + "×" +
                   std::to_string(height) + " has at most " + std::to_string(maximum),
               at::levels);
  const std::uint64_t pictures = layers * (cube ? 6 : 1) * stated;
  if (pictures > kMaxPictures)
    words.fail(std::to_string(pictures) + " pictures, more than " + std::to_string(kMaxPictures), at::layers);
  header.shape = {static_cast<int>(width), static_cast<int>(height), static_cast<int>(stated),
                  layers == 1 ? 0 : static_cast<int>(layers), cube ? 6 : 1};
}

}  // namespace

std::uint64_t Header::picture_bytes(int level) const {
  return texels::picture_bytes(*format, shape.width_of(level), shape.height_of(level));
}

std::uint64_t Header::offset(int level, int layer, int face) const {
  std::uint64_t chain = 0, before = 0;
  for (int l = 0; l < shape.levels; ++l) {
    if (l == level) before = chain;
    chain += picture_bytes(l);
  }
  return first + static_cast<std::uint64_t>(layer * shape.faces + face) * chain + before;
}

bool is_dds(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "DDS ", 4) == 0;
}

Header parse_header(const Source& source) {
  const Words words(source);
  words.require_bytes(kOldBytes, "the header");
  if (words[at::size] != kHeaderSize) words.fail("the header's size is not 124", at::size);
  if (words[at::format_size] != kFormatSize)
    words.fail("the size of the pixel format is not 32", at::format_size);
  Header header;
  const bool modern = (words[at::format_flags] & kFourCc) != 0 && words[at::four_cc] == four_cc("DX10");
  header.first = modern ? kModernBytes : kOldBytes;
  words.require_bytes(header.first, "the header");
  modern ? parse_modern_format(words, header) : parse_old_format(words, header);
  parse_shape(words, source, header);
  words.require_bytes(header.end(), "the last picture");
  return header;
}

std::vector<std::byte> written_header(const TextureShape& shape, PixelType type, bool premultiplied) {
  const TexelFormat& format = format_for(type);
  const auto by_vulkan = [&](const Number& each) { return each.vulkan == format.number; };
  const auto old = std::find_if(std::begin(kD3d9), std::end(kD3d9), by_vulkan);
  const bool modern = old == std::end(kD3d9) || shape.layers > 0 || premultiplied;
  std::array<std::uint32_t, kModernBytes / 4> words{};
  words[0] = four_cc("DDS ");
  words[at::size] = kHeaderSize;
  words[at::flags] = kRequiredFlags | (format.block() > 1 ? kFlagLinearSize : kFlagPitch) |
                     (shape.levels > 1 ? kFlagLevels : 0);
  words[at::height] = static_cast<std::uint32_t>(shape.height);
  words[at::width] = static_cast<std::uint32_t>(shape.width);
  words[at::pitch] = static_cast<std::uint32_t>(
      format.block() > 1 ? picture_bytes(format, shape.width, shape.height) : row_bytes(format, shape.width));
  words[at::levels] = static_cast<std::uint32_t>(shape.levels);
  words[at::reserved] = kSignature;
  words[at::format_size] = kFormatSize;
  words[at::format_flags] = kFourCc;
  words[at::four_cc] = modern ? four_cc("DX10") : old->theirs;
  words[at::caps] = kCapsTexture | (shape.levels > 1 || shape.faces == 6 ? kCapsComplex : 0) |
                    (shape.levels > 1 ? kCapsLevels : 0);
  if (shape.faces == 6) words[at::caps2] = kCube | kAllFaces;
  if (modern) {
    words[at::dxgi] = std::find_if(std::begin(kDxgi), std::end(kDxgi), by_vulkan)->theirs;
    words[at::dimension] = kTexture2d;
    words[at::misc] = shape.faces == 6 ? kMiscCube : 0;
    words[at::layers] = static_cast<std::uint32_t>(shape.layer_count());
    words[at::misc2] = premultiplied ? kModePremultiplied : kModeOpaque;
  }
  const auto bytes = std::as_bytes(std::span(words)).first(modern ? kModernBytes : kOldBytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace welkin::io::dds
