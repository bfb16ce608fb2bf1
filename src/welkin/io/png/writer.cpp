#include <algorithm>
#include <bit>
#include <exception>
#include <new>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/png/guard.h"
#include "welkin/io/png/png.h"
#include "welkin/io/write_choices.h"
#include "welkin/io/xmp.h"

namespace welkin::io {
namespace {

class Encoder {
 public:
  explicit Encoder(ByteSink& file) : file_(file) {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure_, fail_png, ignore_png_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, this, write_bytes, [](png_structp) {});
  }
  ~Encoder() { png_destroy_write_struct(&png_, &info_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

  template <class Call>
  void guarded(Call call) {
    if (guarded_png(png_, call)) return;
    if (thrown_) std::rethrow_exception(thrown_);
    throw Error(ErrorKind::bad_request, failure_.text);
  }

 private:
  /// An exception may not pass through libpng's frames, so it waits in thrown_.
  static void write_bytes(png_structp png, png_bytep data, std::size_t size) {
    auto* self = static_cast<Encoder*>(png_get_io_ptr(png));
    if (!self->try_write(data, size)) png_error(png, "write failed");
  }
  bool try_write(const void* data, std::size_t size) noexcept {
    try {
      file_.write(data, size);
      return true;
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }

  ByteSink& file_;
  PngFailure failure_;
  std::exception_ptr thrown_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
}

/// A tEXt keyword: 1–79 printable characters, no space at an end and no two in a row (PNG 11.3.3.2). Of
/// Latin-1 only ASCII is used.
void check_keyword(const std::string& key) {
  constexpr std::size_t kLongestKeyword = 79;
  const bool printable = std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (key.empty() || key.size() > kLongestKeyword || !printable || key.front() == ' ' || key.back() == ' ' ||
      key.find("  ") != std::string::npos) {
    throw Error(ErrorKind::unsupported,
                "the attribute name '" + key + "' cannot be a PNG keyword (1–79 printable ASCII characters)");
  }
}

std::vector<png_text> texts_of(const std::map<std::string, std::string>& attributes) {
  std::vector<png_text> texts;
  for (const auto& [key, value] : attributes) {
    check_keyword(key);
    if (value.find('\0') != std::string::npos)
      throw Error(ErrorKind::unsupported, "the attribute " + key + " holds a zero byte");
    png_text text{};
    const bool ascii = is_ascii(value);
    text.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(key.c_str());
    text.text = const_cast<char*>(value.c_str());
    (ascii ? text.text_length : text.itxt_length) = value.size();
    texts.push_back(text);
  }
  return texts;
}

}  // namespace

WriteReport write_png(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  static const std::string known[] = {"zip", "none"};
  static constexpr PixelType types[] = {PixelType::uint16, PixelType::uint8};
  // On smooth 8-bit pictures libpng's default of 6 takes three times as long, for files of the same size.
  constexpr int kZipLevel = 4;
  const WritePart& part = only_part(parts, "PNG");
  const PixelType type = pixel_type(options, types, "PNG");
  const int level = compression(options, known, "PNG") == "none" ? 0 : kZipLevel;
  const std::vector<int> order = channel_order(part, Alpha::allowed, "PNG");
  // Of an encoding the bytes are as they are, and no chunk says how they are to be shown.
  const Colour colour = options.encoding ? Colour::linear : colour_for(type, options.colour);
  std::vector<png_text> texts = texts_of(options.attributes);
  std::string xmp = options.panorama ? xmp_of(*options.panorama) : std::string();
  if (!xmp.empty()) {
    png_text text{};
    text.compression = PNG_ITXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(kXmpKeyword);
    text.text = xmp.data();
    text.itxt_length = xmp.size();
    texts.push_back(text);
  }
  const ImageView<const float> image = part.image;

  static const std::vector<std::string> names[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  static constexpr int colour_types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                         PNG_COLOR_TYPE_RGB_ALPHA};
  const std::size_t kind = order.size() - 1;
  const bool alpha = order.size() % 2 == 0;
  const PixelEncoder pixels(type, order, srgb_channels(names[kind], colour),
                            alpha && !options.encoding ? std::optional(order.back()) : std::nullopt);
  const int depth = static_cast<int>(8 * size_of(type));

  Encoder encoder(file);
  encoder.guarded([&] {
    png_set_user_limits(encoder.png(), PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_compression_level(encoder.png(), level);
    if (level == 0) png_set_filter(encoder.png(), PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_IHDR(encoder.png(), encoder.info(), static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height), depth, colour_types[kind], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (colour == Colour::srgb) {
      png_set_sRGB_gAMA_and_cHRM(encoder.png(), encoder.info(), PNG_sRGB_INTENT_RELATIVE);
    } else if (!options.encoding) {
      png_set_gAMA_fixed(encoder.png(), encoder.info(), PNG_FP_1);
    }
    if (!texts.empty())
      png_set_text(encoder.png(), encoder.info(), texts.data(), static_cast<int>(texts.size()));
    png_write_info(encoder.png(), encoder.info());
    if (std::endian::native == std::endian::little && depth == 16) png_set_swap(encoder.png());
  });

  constexpr int kRowsOfBand = 64;
  const std::size_t stride = static_cast<std::size_t>(image.width) * pixels.pixel_bytes();
  std::vector<std::byte> stored(stride * kRowsOfBand);
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < kRowsOfBand; ++y)
    rows.push_back(reinterpret_cast<png_bytep>(&stored[y * stride]));
  WriteReport report;
  for (int y = 0; y < image.height; y += kRowsOfBand) {
    const int count = std::min(kRowsOfBand, image.height - y);
    report = report + pixels.encode_rows(image.part(0, y, image.width, count), stored.data(), stride);
    encoder.guarded([&] { png_write_rows(encoder.png(), rows.data(), static_cast<png_uint_32>(count)); });
  }
  encoder.guarded([&] { png_write_end(encoder.png(), nullptr); });
  return report;
}

}  // namespace welkin::io
