#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/io/encoded_light.h"
#include "welkin/io/format.h"
#include "welkin/io/interpret.h"
#include "welkin/io/output_file.h"
#include "welkin/io/unread_formats.h"

namespace welkin::io {

// Here, so that the library holds the class's type information.
Reader::~Reader() = default;

void Reader::read(std::size_t part, std::span<const int> channels, ImageView<float> out) {
  require(part < info_.parts.size(), "the file has no picture of that number");
  const PartInfo& info = info_.parts[part];
  require(out.data != nullptr && out.width == info.width && out.height == info.height,
          "the image to read a picture into has another size");
  require(!channels.empty() && channels.size() == static_cast<std::size_t>(out.channels),
          "the image to read a picture into has another number of channels");
  for (const int channel : channels) {
    require(channel >= 0 && static_cast<std::size_t>(channel) < info.channels.size(),
            "the picture has no channel of that number");
  }
  decode(part, channels, out);
}

namespace {

/// A reader together with the file whose bytes it reads.
class FileReader : public Reader {
 public:
  FileReader(std::unique_ptr<InputFile> file, std::unique_ptr<Reader> reader)
      : file_(std::move(file)), reader_(std::move(reader)) {
    info_ = reader_->info();
  }
  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    reader_->read(part, channels, out);
  }

 private:
  std::unique_ptr<InputFile> file_;
  std::unique_ptr<Reader> reader_;
};

/// `'RIFF' (52 49 46 46)`: how an unknown file begins.
std::string first_bytes(std::span<const std::byte> bytes) {
  std::string text, codes;
  for (const std::byte byte : bytes.first(std::min<std::size_t>(bytes.size(), 8))) {
    const int code = std::to_integer<int>(byte);
    text += code >= 32 && code < 127 ? static_cast<char>(code) : '.';
    char digits[4];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(code));
    codes += (codes.empty() ? "" : " ") + std::string(digits);
  }
  return "'" + text + "' (" + codes + ")";
}

std::string gibibytes(long double bytes) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3Lg GiB", bytes / (1 << 30));
  return text;
}

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {exr_format(),  hdr_format(),  ktx2_format(), ktx1_format(),
                                          dds_format(),  pfm_format(),  png_format(),  jpeg_format(),
                                          tiff_format(), webp_format(), jxl_format(),  avif_format(),
                                          heif_format(), env_format(),  glb_format()};
  return all;
}

void check_size(const Source& source, std::uint64_t width, std::uint64_t height, std::uint64_t channels) {
  constexpr std::uint64_t kLongestSide = std::uint64_t{1} << 20;
  const auto size = [&] {
    return std::to_string(width) + "×" + std::to_string(height) + " with " + std::to_string(channels) +
           " channels";
  };
  if (width < 1 || width > kLongestSide || height < 1 || height > kLongestSide || channels < 1) {
    throw Error(ErrorKind::too_large, source.name,
                "an image of " + size() + " is out of range (1…" + std::to_string(kLongestSide) + " a side)");
  }
  // width·height is at most 2^40, so the comparison by division cannot overflow.
  const std::uint64_t max_values = source.options.max_bytes / sizeof(float);
  if (channels > max_values / (width * height)) {
    const long double bytes =
        sizeof(float) * static_cast<long double>(width * height) * static_cast<long double>(channels);
    throw Error(ErrorKind::too_large, source.name,
                "an image of " + size() + " needs " + gibibytes(bytes) + " as floats, over the limit of " +
                    gibibytes(static_cast<long double>(source.options.max_bytes)));
  }
}

std::unique_ptr<Reader> open(std::span<const std::byte> bytes, std::string name, const ReadOptions& options) {
  if (bytes.empty()) throw Error(ErrorKind::damaged, name, "the file is empty");
  for (const Format& format : formats()) {
    if (!format.matches(bytes)) continue;
    try {
      return interpret(decode_light(format.open({bytes, name, options}), options), options);
    } catch (const Error& error) {
      if (!error.file().empty()) throw;
      throw in_file(name, error);
    }
  }
  std::vector<std::string> names;
  for (const Format& format : formats()) names.push_back(format.capabilities.format);
  if (const auto known = unread_format(bytes)) throw Error(ErrorKind::unsupported, name, *known);
  throw Error(ErrorKind::unsupported, name,
              "not an image of a known format: begins with " + first_bytes(bytes) +
                  " (can be read: " + listed(names, ", ") + ")");
}

std::unique_ptr<Reader> open(const std::filesystem::path& path, const ReadOptions& options) {
  auto file = std::make_unique<InputFile>(path);
  auto reader = open(file->bytes(), path.string(), options);
  return std::make_unique<FileReader>(std::move(file), std::move(reader));
}

}  // namespace welkin::io
