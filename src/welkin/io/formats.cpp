#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "welkin/base/error.h"
#include "welkin/io/format.h"
#include "welkin/io/part_rows.h"

namespace welkin::io {
namespace {

/// A reader together with the file whose bytes it reads.
class FileReader : public Reader {
 public:
  FileReader(std::unique_ptr<InputFile> file, std::unique_ptr<Reader> reader)
      : file_(std::move(file)), reader_(std::move(reader)) {
    info_ = reader_->info();
  }
  void read(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
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

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string gibibytes(long double bytes) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3Lg GiB", bytes / (1 << 30));
  return text;
}

const Format& format_for_writing(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats()) {
    if (format.write == nullptr) continue;
    if (std::count(format.extensions.begin(), format.extensions.end(), extension) > 0) return format;
  }
  if (extension.empty()) {
    throw Error("the name has no extension to tell the format by (one of: " + listed(writable_extensions()) +
                ")");
  }
  throw Error(unknown_name("extension", extension, writable_extensions()));
}

}  // namespace

std::string_view name_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return "uint8";
    case PixelType::uint16:
      return "uint16";
    case PixelType::uint32:
      return "uint32";
    case PixelType::half:
      return "half";
    case PixelType::float32:
      return "float";
    case PixelType::rgb9e5:
      return "rgb9e5";
    case PixelType::r11g11b10:
      return "r11g11b10";
  }
  assert(false);
  return {};
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {exr_format(), hdr_format(),  ktx2_format(), pfm_format(),
                                          png_format(), jpeg_format(), tiff_format(), webp_format()};
  return all;
}

void check_extension(const std::filesystem::path& path) {
  format_for_writing(path);
}

std::vector<std::string> writable_extensions() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.write != nullptr)
      names.insert(names.end(), format.extensions.begin(), format.extensions.end());
  }
  return names;
}

void check_size(const Source& source, std::uint64_t width, std::uint64_t height, std::uint64_t channels) {
  constexpr std::uint64_t kLongestSide = std::uint64_t{1} << 20;
  const auto size = [&] {
    return std::to_string(width) + "×" + std::to_string(height) + " with " + std::to_string(channels) +
           " channels";
  };
  if (width < 1 || width > kLongestSide || height < 1 || height > kLongestSide || channels < 1) {
    throw Error(source.name + ": an image of " + size() + " is out of range (1…" +
                std::to_string(kLongestSide) + " a side)");
  }
  // width·height is at most 2^40, so the comparison by division cannot overflow.
  const std::uint64_t most_values = source.options.max_bytes / sizeof(float);
  if (channels > most_values / (width * height)) {
    const long double bytes =
        sizeof(float) * static_cast<long double>(width * height) * static_cast<long double>(channels);
    throw Error(source.name + ": an image of " + size() + " needs " + gibibytes(bytes) +
                " as floats, over the limit of " +
                gibibytes(static_cast<long double>(source.options.max_bytes)));
  }
}

std::unique_ptr<Reader> open(std::span<const std::byte> bytes, std::string name, const ReadOptions& options) {
  if (bytes.empty()) throw Error(name + ": the file is empty");
  for (const Format& format : formats()) {
    if (format.matches(bytes)) return format.open({bytes, std::move(name), options});
  }
  std::vector<std::string> names;
  for (const Format& format : formats()) names.emplace_back(format.name);
  throw Error(name + ": not an image of a known format: begins with " + first_bytes(bytes) +
              " (can be read: " + listed(names) + ")");
}

std::unique_ptr<Reader> open(const std::filesystem::path& path, const ReadOptions& options) {
  auto file = std::make_unique<InputFile>(path);
  auto reader = open(file->bytes(), path.string(), options);
  return std::make_unique<FileReader>(std::move(file), std::move(reader));
}

namespace {

/// Runs one step of writing a file; what goes wrong names the file.
template <class Step>
void for_file(const std::filesystem::path& path, const Step& step) {
  try {
    step();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

}  // namespace

WriteReport write_set(std::size_t count, const std::function<WriteFile(std::size_t)>& next,
                      const WriteOptions& options) {
  WriteReport total;
  std::vector<std::pair<std::filesystem::path, std::unique_ptr<OutputFile>>> written;
  for (std::size_t i = 0; i < count; ++i) {
    WriteFile file = next(i);
    assert(!file.parts.empty());
    for ([[maybe_unused]] const WritePart& part : file.parts) {
      assert((part.image.data != nullptr || part.draw) && part.image.width > 0 && part.image.height > 0);
      assert(part.channels.size() == static_cast<std::size_t>(part.image.channels));
    }
    for_file(file.path, [&] {
      const Format& format = format_for_writing(file.path);
      written.emplace_back(file.path, std::make_unique<OutputFile>(file.path));
      std::vector<Image> drawn;
      if (!format.draws_rows) drawn = draw_parts(file.parts);
      const WriteReport report = format.write(*written.back().second, file.parts, options);
      total.above += report.above;
      total.below += report.below;
      total.not_finite += report.not_finite;
    });
  }
  for (const auto& each : written) {
    for_file(each.first, [&] { each.second->commit(); });
  }
  return total;
}

WriteReport write(const std::filesystem::path& path, std::span<const WritePart> parts,
                  const WriteOptions& options) {
  return write_set(
      1,
      [&](std::size_t) {
        return WriteFile{path, {parts.begin(), parts.end()}};
      },
      options);
}

}  // namespace welkin::io
