#include "welkin/video/pixmap.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/encode_pixels.h"

namespace welkin::video {
namespace {

[[noreturn]] void damaged(const std::string& cause) {
  throw Error(ErrorKind::damaged, cause);
}

/// The next word; blanks before it and comments are passed over, and one blank after it is taken.
std::string next_word(const NextByte& next) {
  constexpr std::size_t kLongest = 64;
  std::string word;
  bool comment = false;
  while (const std::optional<unsigned char> byte = next()) {
    if (comment) {
      comment = *byte != '\n';
    } else if (std::isspace(*byte) != 0) {
      if (!word.empty()) return word;
    } else if (*byte == '#' && word.empty()) {
      comment = true;
    } else {
      word += static_cast<char>(*byte);
      if (word.size() > kLongest) damaged("its header is none of a pixmap");
    }
  }
  damaged("it ends within a header");
}

int whole_number(const NextByte& next, const char* what, int largest) {
  const std::string word = next_word(next);
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 1 || value > largest)
    damaged("its " + std::string(what) + " '" + word + "' is none of 1 … " + std::to_string(largest));
  return value;
}

/// Values of integers, linear. Those of the usual ranges are made once; `own` holds another's.
std::span<const float> table_of(int largest, bool linear, std::vector<float>& own) {
  if (largest == 255) return linear ? io::unorm8_to_float() : io::srgb8_to_linear();
  if (largest == 65535) return linear ? io::unorm16_to_float() : io::srgb16_to_linear();
  own.resize(static_cast<std::size_t>(largest) + 1);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double value = static_cast<double>(i) / largest;
    own[i] = static_cast<float>(linear ? value : io::srgb_to_linear(value));
  }
  return own;
}

void append(std::vector<std::byte>& bytes, const std::string& text) {
  const auto characters = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), characters.begin(), characters.end());
}

}  // namespace

PixmapHeader read_pixmap_header(char kind, const NextByte& next) {
  constexpr int kLongestSide = 1 << 20, kLargestValue = 65535;
  PixmapHeader header;
  const bool floats = kind == 'F' || kind == 'f';
  header.info.kind = floats ? StreamKind::pfm : StreamKind::ppm;
  header.info.channels = kind == '6' || kind == 'F' ? 3 : 1;
  header.info.width = whole_number(next, "width", kLongestSide);
  header.info.height = whole_number(next, "height", kLongestSide);
  if (!floats) {
    header.info.largest = whole_number(next, "largest value", kLargestValue);
    header.info.bits = header.info.largest > 255 ? 16 : 8;
    return header;
  }
  header.info.bits = 32;
  const std::string word = next_word(next);
  double scale = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), scale);
  if (error != std::errc() || end != word.data() + word.size() || scale == 0 || !std::isfinite(scale))
    damaged("its scale '" + word + "' is no number");
  header.little_endian = scale < 0;
  return header;
}

std::size_t pixmap_bytes(const PixmapHeader& header) {
  return static_cast<std::size_t>(header.info.width) * static_cast<std::size_t>(header.info.height) *
         static_cast<std::size_t>(header.info.channels) * static_cast<std::size_t>(header.info.bits / 8);
}

void decode_pixmap(const PixmapHeader& header, const StreamColour& colour, std::span<const std::byte> stored,
                   ImageView<float> out) {
  const int values = header.info.width * header.info.channels;
  const std::size_t stride =
      static_cast<std::size_t>(values) * static_cast<std::size_t>(header.info.bits / 8);
  std::vector<float> own;
  std::span<const float> table;
  if (header.info.kind == StreamKind::ppm) table = table_of(header.info.largest, colour.linear, own);
  const auto largest = static_cast<unsigned>(header.info.largest);
  const std::endian order = header.little_endian ? std::endian::little : std::endian::big;
  parallel_for(header.info.height, [&](int y) {
    const bool upwards = header.info.kind == StreamKind::pfm;
    const std::byte* const row =
        stored.data() + static_cast<std::size_t>(upwards ? header.info.height - 1 - y : y) * stride;
    float* const to = out.row(y);
    if (header.info.bits == 8) {
      for (int i = 0; i < values; ++i) to[i] = table[std::min(std::to_integer<unsigned>(row[i]), largest)];
    } else if (header.info.bits == 16) {
      for (int i = 0; i < values; ++i)
        to[i] = table[std::min<unsigned>(io::load<std::uint16_t>(row + 2 * i, std::endian::big), largest)];
    } else {
      for (int i = 0; i < values; ++i)
        to[i] = std::bit_cast<float>(io::load<std::uint32_t>(row + 4 * i, order));
    }
  });
}

std::string pixmap_header(const StreamInfo& info) {
  const bool grey = info.channels == 1;
  const std::string size = "\n" + std::to_string(info.width) + " " + std::to_string(info.height) + "\n";
  if (info.kind == StreamKind::pfm)
    return (grey ? "Pf" : "PF") + size + (std::endian::native == std::endian::little ? "-1.0\n" : "1.0\n");
  return (grey ? "P5" : "P6") + size + (info.bits == 8 ? "255\n" : "65535\n");
}

io::WriteReport encode_pixmap(const StreamInfo& info, const StreamColour& colour,
                              ImageView<const float> frame, std::vector<std::byte>& stored) {
  stored.clear();
  append(stored, pixmap_header(info));
  const int values = info.width * info.channels;
  if (info.kind == StreamKind::pfm) {
    const std::size_t header = stored.size(), stride = static_cast<std::size_t>(values) * sizeof(float);
    stored.resize(header + stride * static_cast<std::size_t>(info.height));
    for (int y = 0; y < info.height; ++y)
      std::memcpy(stored.data() + header + static_cast<std::size_t>(info.height - 1 - y) * stride,
                  frame.row(y), stride);
    return {};
  }
  const std::size_t header = stored.size(),
                    stride = static_cast<std::size_t>(values) * static_cast<std::size_t>(info.bits / 8);
  stored.resize(header + stride * static_cast<std::size_t>(info.height));
  std::vector<int> order;
  for (int c = 0; c < info.channels; ++c) order.push_back(c);
  const io::PixelEncoder encoder(info.bits == 8 ? io::PixelType::uint8 : io::PixelType::uint16, order,
                                 std::vector<bool>(order.size(), !colour.linear));
  const io::WriteReport report = encoder.encode_rows(frame, stored.data() + header, stride);
  if (info.bits == 16 && std::endian::native == std::endian::little) {
    for (std::size_t i = header; i + 1 < stored.size(); i += 2) std::swap(stored[i], stored[i + 1]);
  }
  return report;
}

}  // namespace welkin::video
