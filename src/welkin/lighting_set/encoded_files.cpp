#include "welkin/lighting_set/encoded_files.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// The channels as files name them; where a format holds no two, a third of zeros.
std::vector<std::string> names_of_channels(int count, const io::Capabilities& format) {
  if (count == 1) return {"Y"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  const bool holds_two = format.channels == io::Channels::any || format.channels == io::Channels::rg_or_rgba;
  names.resize(static_cast<std::size_t>(count == 2 && !holds_two ? 3 : count));
  return names;
}

Image with_channels(const Image& table, int channels) {
  Image wide(table.width(), table.height(), channels);
  for (int y = 0; y < table.height(); ++y) {
    for (int x = 0; x < table.width(); ++x) std::copy_n(table.at(x, y), table.channels(), wide.at(x, y));
  }
  return wide;
}

/// Of values that the type holds; what it doesn't is counted as clipped.
double largest_difference(const Image& table, const Image& stored, io::PixelType type) {
  const bool integer = type != io::PixelType::half && type != io::PixelType::float32;
  double largest = 0;
  for (int y = 0; y < table.height(); ++y) {
    for (int x = 0; x < table.width(); ++x) {
      for (int c = 0; c < table.channels(); ++c) {
        const double value = static_cast<double>(table.at(x, y)[c]);
        if (integer && (value < 0 || value > 1)) continue;
        largest = std::max(largest, std::fabs(value - static_cast<double>(stored.at(x, y)[c])));
      }
    }
  }
  return largest;
}

}  // namespace

EncodedTable encode_table(const Image& table, std::string_view format, io::PixelType type) {
  const std::vector<std::string> names = names_of_channels(table.channels(), io::capabilities(format));
  const Image wide = with_channels(table, static_cast<int>(names.size()));
  io::WriteOptions options;
  options.type = type;
  options.colour = io::Colour::linear;
  const io::WritePart part{"", wide.view(), names};
  io::MemorySink sink;
  EncodedTable encoded;
  encoded.report = io::write(sink, format, {&part, 1}, options);
  encoded.bytes = sink.take();

  io::ReadOptions as_stored;
  as_stored.colour = io::Colour::linear;
  const auto reader = io::open(encoded.bytes, "table", as_stored);
  const io::PartInfo& info = reader->info().parts.front();
  std::vector<int> channels;
  for (int c = 0; c < table.channels(); ++c) channels.push_back(c);
  Image again(info.width, info.height, table.channels());
  reader->read(0, channels, again.view());
  encoded.type = info.type;
  encoded.error = largest_difference(table, again, info.type);
  return encoded;
}

std::string data_url(std::string_view media_type, std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:" + std::string(media_type) + ";base64,";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace welkin
