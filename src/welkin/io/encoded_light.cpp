#include "welkin/io/encoded_light.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/write_choices.h"

namespace welkin::io {
namespace {

bool is_rgba8(const PartInfo& part) {
  return part.type == PixelType::uint8 && part.channels == std::vector<std::string>{"R", "G", "B", "A"};
}

class LightReader final : public FormatReader {
 public:
  LightReader(std::unique_ptr<FormatReader> reader, const LightEncoding& encoding)
      : reader_(std::move(reader)), encoding_(encoding) {
    reader_->set_colour(Colour::linear);
    info_ = reader_->info();
    for (PartInfo& part : info_.parts) {
      part.channels = {"R", "G", "B"};
      part.compression += " " + encoding.text();
    }
    // How it lies is still to be obeyed; colour and alpha are none.
    declared_.orientation = reader_->declared().orientation;
    declared_.xmp = reader_->declared().xmp;
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    constexpr int kAll[] = {0, 1, 2, 3};
    Image stored(out.width, out.height, 4);
    reader_->read(part, kAll, stored.view());
    parallel_for(out.height, [&](int y) {
      std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(out.width));
      std::vector<float> rgb(3 * static_cast<std::size_t>(out.width));
      const float* row = stored.at(0, y);
      for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(std::lround(255 * row[i]));
      encoding_.decode(bytes.data(), static_cast<std::size_t>(out.width), rgb.data());
      float* to = out.row(y);
      for (int x = 0; x < out.width; ++x) {
        for (const int channel : channels) *to++ = rgb[static_cast<std::size_t>(3 * x + channel)];
      }
    });
  }

 private:
  std::unique_ptr<FormatReader> reader_;
  LightEncoding encoding_;
};

}  // namespace

std::unique_ptr<FormatReader> decode_light(std::unique_ptr<FormatReader> reader, const ReadOptions& options) {
  std::optional<LightEncoding> encoding = options.encoding;
  const FileInfo& info = reader->info();
  const bool fits = std::all_of(info.parts.begin(), info.parts.end(), is_rgba8);
  if (encoding && !fits) {
    throw Error(ErrorKind::mismatch,
                "is no picture of R, G, B and A of 8 bits each, and so holds no " + encoding->text());
  }
  if (const auto noted = info.attributes.find(kEncodingKey); !encoding && noted != info.attributes.end()) {
    FileInfo warned = info;
    try {
      encoding = LightEncoding::from_name(noted->second);
      if (!fits)
        warned.warnings.push_back("says that it is encoded as " + noted->second + ", which it can't be");
    } catch (const Error&) {
      warned.warnings.push_back("says that it is encoded as '" + noted->second + "', which is unknown");
    }
    if (!encoding || !fits) {
      reader->set_info(std::move(warned));
      return reader;
    }
  }
  if (!encoding) return reader;
  return std::make_unique<LightReader>(std::move(reader), *encoding);
}

void check_encoded(const WritePart& part, const WriteOptions& options, const Capabilities& format) {
  const std::string what = options.encoding->text();
  if (format.format != "png")
    throw Error(ErrorKind::unsupported, format.title + " isn't written as " + what + ": PNG is");
  if (options.type.value_or(PixelType::uint8) != PixelType::uint8)
    throw Error(ErrorKind::unsupported,
                what + " is of 8 bits, not of " + std::string(name_of(*options.type)));
  if (options.colour == Colour::srgb)
    throw Error(ErrorKind::unsupported, what + " is an encoding of its own, not sRGB");
  channel_order(part, Alpha::none, "PNG of " + what);
}

Image encode_light(const WritePart& part, const LightEncoding& encoding, WriteReport& report) {
  const ImageView<const float> picture = part.image;
  std::vector<int> order = channel_order(part, Alpha::none, encoding.text());
  if (order.size() == 1) order = {order[0], order[0], order[0]};
  Image encoded(picture.width, picture.height, 4);
  std::vector<WriteReport> reports(static_cast<std::size_t>(picture.height));
  parallel_for(picture.height, [&](int y) {
    std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(picture.width));
    std::vector<float> rgb;
    rgb.reserve(3 * static_cast<std::size_t>(picture.width));
    for (int x = 0; x < picture.width; ++x) {
      for (const int channel : order) rgb.push_back(picture.at(x, y)[channel]);
    }
    encoding.encode(rgb.data(), 3, static_cast<std::size_t>(picture.width), bytes.data(),
                    reports[static_cast<std::size_t>(y)]);
    float* row = encoded.at(0, y);
    for (const std::uint8_t byte : bytes) *row++ = static_cast<float>(byte) / 255;
  });
  // In order, so that the sums don't depend on the threads.
  for (const WriteReport& each : reports) report = report + each;
  return encoded;
}

}  // namespace welkin::io
