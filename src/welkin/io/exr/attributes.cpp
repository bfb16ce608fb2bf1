#include "welkin/io/exr/attributes.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace welkin::io::exr {
namespace {

Window take_window(Cursor& value) {
  Window window;
  window.min_x = value.take<std::int32_t>();
  window.min_y = value.take<std::int32_t>();
  window.max_x = value.take<std::int32_t>();
  window.max_y = value.take<std::int32_t>();
  return window;
}

/// `count` numbers with spaces between, each with the digits that its type needs to be read back.
template <class T>
std::string take_numbers(Cursor& value, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    char digits[40];
    const T number = value.take<T>();
    if constexpr (std::is_same_v<T, float>) {
      std::snprintf(digits, sizeof digits, "%.9g", static_cast<double>(number));
    } else if constexpr (std::is_same_v<T, double>) {
      std::snprintf(digits, sizeof digits, "%.17g", number);
    } else {
      std::snprintf(digits, sizeof digits, "%lld", static_cast<long long>(number));
    }
    if (i > 0) text += ' ';
    text += digits;
  }
  return text;
}

/// The text of an attribute that is a string or a few numbers.
std::optional<std::string> take_text(std::string_view type, Cursor& value) {
  if (type == "string") {
    const auto bytes = value.take_bytes(value.left());
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  if (type == "int") return take_numbers<std::int32_t>(value, 1);
  if (type == "float") return take_numbers<float>(value, 1);
  if (type == "double") return take_numbers<double>(value, 1);
  if (type == "v2i") return take_numbers<std::int32_t>(value, 2);
  if (type == "v3i") return take_numbers<std::int32_t>(value, 3);
  if (type == "v2f") return take_numbers<float>(value, 2);
  if (type == "v3f") return take_numbers<float>(value, 3);
  if (type == "v2d") return take_numbers<double>(value, 2);
  if (type == "v3d") return take_numbers<double>(value, 3);
  if (type == "chromaticities") return take_numbers<float>(value, 8);
  if (type == "rational") {
    const std::string numerator = take_numbers<std::int32_t>(value, 1);
    return numerator + "/" + take_numbers<std::uint32_t>(value, 1);
  }
  return std::nullopt;
}

/// Strings, each behind its length.
std::vector<std::string> take_texts(Cursor& value) {
  std::vector<std::string> texts;
  while (value.left() > 0) {
    const auto bytes = value.take_bytes(value.take<std::uint32_t>());
    texts.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return texts;
}

Chromaticities take_chromaticities(Cursor value) {
  Chromaticities c{};
  for (double(*point)[2] : {&c.red, &c.green, &c.blue, &c.white}) {
    for (double& coordinate : *point) coordinate = static_cast<double>(value.take<float>());
  }
  return c;
}

/// Compressions that OpenEXR got after version 3.1, by name.
[[noreturn]] void refuse_compression(std::uint8_t number, const Cursor& value) {
  constexpr std::uint8_t kHtj2k256 = 10, kHtj2k32 = 11;
  const bool htj2k = number == kHtj2k256 || number == kHtj2k32;
  value.refuse(
      std::string(htj2k ? "htj2k compression, of OpenEXR 3.4, is"
                        : "a compression newer than OpenEXR 3.4 is") +
      " not read: write the file with another, as `oiiotool IN.exr --compression zip -o OUT.exr` does");
}

constexpr std::array kStructural{std::string_view("channels"),
                                 std::string_view("chunkCount"),
                                 std::string_view("compression"),
                                 std::string_view("dataWindow"),
                                 std::string_view("displayWindow"),
                                 std::string_view("envmap"),
                                 std::string_view("lineOrder"),
                                 std::string_view("name"),
                                 std::string_view("pixelAspectRatio"),
                                 std::string_view("screenWindowCenter"),
                                 std::string_view("screenWindowWidth"),
                                 std::string_view("tiles"),
                                 std::string_view("type"),
                                 std::string_view("version"),
                                 std::string_view("view"),
                                 kOwnWindow,
                                 kOwnLevels};

constexpr std::array kStandardNumbers{std::string_view("adoptedNeutral"),
                                      std::string_view("altitude"),
                                      std::string_view("aperture"),
                                      std::string_view("chromaticities"),
                                      std::string_view("deepImageState"),
                                      std::string_view("dwaCompressionLevel"),
                                      std::string_view("expTime"),
                                      std::string_view("focus"),
                                      std::string_view("framesPerSecond"),
                                      std::string_view("idManifest"),
                                      std::string_view("isoSpeed"),
                                      std::string_view("keyCode"),
                                      std::string_view("latitude"),
                                      std::string_view("longitude"),
                                      std::string_view("maxSamplesPerPixel"),
                                      std::string_view("multiView"),
                                      std::string_view("originalDataWindow"),
                                      std::string_view("preview"),
                                      std::string_view("timeCode"),
                                      std::string_view("utcOffset"),
                                      std::string_view("whiteLuminance"),
                                      std::string_view("worldToCamera"),
                                      std::string_view("worldToNDC"),
                                      std::string_view("xDensity")};

bool is_structural(std::string_view name) {
  return std::find(kStructural.begin(), kStructural.end(), name) != kStructural.end();
}

}  // namespace

bool is_reserved(std::string_view name) {
  return is_structural(name) ||
         std::find(kStandardNumbers.begin(), kStandardNumbers.end(), name) != kStandardNumbers.end();
}

void AttributeParser::parse(std::string_view name, std::string_view type, Cursor value) {
  if (parse_structure(name, type, value) || is_structural(name)) return;
  if (auto text = take_text(type, value)) part_.attributes[std::string(name)] = std::move(*text);
}

std::string AttributeParser::missing() const {
  if (!has_channels_) return "channels";
  if (!has_compression_) return "compression";
  if (!has_data_) return "dataWindow";
  if (!has_display_) return "displayWindow";
  return {};
}

bool AttributeParser::parse_structure(std::string_view name, std::string_view type, Cursor& value) {
  const auto expect = [&](std::string_view expected) {
    if (type != expected)
      value.fail("attribute '" + std::string(name) + "' has type '" + std::string(type) + "'");
  };
  if (name == "channels") {
    expect("chlist");
    parse_channels(value);
    has_channels_ = true;
  } else if (name == "compression") {
    expect("compression");
    const auto number = value.take<std::uint8_t>();
    if (number > static_cast<std::uint8_t>(Compression::dwab)) refuse_compression(number, value);
    part_.compression = static_cast<Compression>(number);
    has_compression_ = true;
  } else if (name == "dataWindow") {
    expect("box2i");
    part_.data = take_window(value);
    has_data_ = true;
  } else if (name == "displayWindow" || name == kOwnWindow) {
    expect("box2i");
    const Window window = take_window(value);
    const bool own = name == kOwnWindow;
    if (own || !has_own_window_) part_.display = window;
    (own ? has_own_window_ : has_display_) = true;
  } else if (name == "tiles") {
    expect("tiledesc");
    parse_tiles(value);
    has_tiles_ = true;
  } else if (name == "envmap") {
    expect("envmap");
    const auto kind = value.take<std::uint8_t>();
    if (kind > 1) {
      part_.warnings.push_back("attribute 'envmap' is neither a lat-long nor a cube, and is ignored");
    } else {
      part_.envmap = kind == 0 ? "latlong" : "cube";
    }
  } else if (name == "name") {
    expect("string");
    part_.name = *take_text(type, value);
  } else if (name == "type") {
    expect("string");
    part_type_ = *take_text(type, value);
  } else if (name == kOwnLevels) {
    expect("int");
    part_.own_levels = value.take<std::int32_t>();
    if (part_.own_levels < 1) value.fail("attribute '" + std::string(name) + "' is not a number of levels");
  } else if (name == "pixelAspectRatio" && type == "float") {
    part_.pixel_aspect = value.take<float>();
  } else if (name == "view" && type == "string") {
    if (auto text = take_text(type, value); text && !text->empty()) part_.views = {*text};
  } else if (name == "multiView" && type == "stringvector") {
    part_.views = take_texts(value);
  } else if (name == "chromaticities" && type == "chromaticities") {
    // Also shown as text, so a cursor of its own.
    part_.chromaticities = take_chromaticities(Cursor(value));
    return false;
  } else if (name == "chunkCount") {
    expect("int");
    chunk_count_ = value.take<std::uint32_t>();
  } else {
    return false;
  }
  return true;
}

void AttributeParser::parse_channels(Cursor& value) {
  part_.channels.clear();
  for (auto name = value.take_name(); !name.empty(); name = value.take_name()) {
    StoredChannel channel;
    channel.name = name;
    const auto type = value.take<std::int32_t>();
    if (type < 0 || type > 2) value.fail("channel '" + channel.name + "' has an unknown type");
    channel.type = static_cast<StoredType>(type);
    value.take<std::uint32_t>();  // how the values are perceived: ignored
    channel.x_sampling = value.take<std::int32_t>();
    channel.y_sampling = value.take<std::int32_t>();
    part_.channels.push_back(std::move(channel));
  }
  std::sort(part_.channels.begin(), part_.channels.end(),
            [](const StoredChannel& a, const StoredChannel& b) { return a.name < b.name; });
}

void AttributeParser::parse_tiles(Cursor& value) {
  const auto width = value.take<std::uint32_t>(), height = value.take<std::uint32_t>();
  const auto mode = value.take<std::uint8_t>();
  if (width > (1u << 20) || height > (1u << 20)) value.fail("the tile size is not in 1...2^20");
  if ((mode & 0xf) > 2 || (mode >> 4) > 1) value.fail("the tiles' level mode is not known");
  part_.tile_width = static_cast<int>(width);
  part_.tile_height = static_cast<int>(height);
  part_.level_mode = static_cast<LevelMode>(mode & 0xf);
  part_.round_up = mode >> 4;
}

}  // namespace welkin::io::exr
