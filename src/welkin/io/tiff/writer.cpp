#include <algorithm>
#include <exception>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/text_attributes.h"
#include "welkin/io/tiff/failure.h"
#include "welkin/io/tiff/file.h"
#include "welkin/io/tiff/tiff.h"
#include "welkin/io/write_choices.h"
#include "welkin/io/xmp.h"

namespace welkin::io {
namespace {

/// A ByteSink as libtiff writes to it. An exception may not pass through libtiff's frames, so it waits in
/// `thrown`.
struct Output {
  ByteSink& file;
  std::exception_ptr thrown;

  template <class Action>
  static tmsize_t attempt(thandle_t handle, Action action) noexcept {
    auto& self = *static_cast<Output*>(handle);
    try {
      return action(self.file);
    } catch (...) {
      if (!self.thrown) self.thrown = std::current_exception();
      return -1;
    }
  }
  static tmsize_t read(thandle_t handle, void* out, tmsize_t size) {
    return attempt(handle, [&](ByteSink& file) {
      const std::size_t got = file.read_at(file.tell(), out, static_cast<std::size_t>(size));
      file.seek(file.tell() + got);
      return static_cast<tmsize_t>(got);
    });
  }
  static tmsize_t write(thandle_t handle, void* data, tmsize_t size) {
    return attempt(handle, [&](ByteSink& file) {
      file.write(data, static_cast<std::size_t>(size));
      return size;
    });
  }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    ByteSink& file = static_cast<Output*>(handle)->file;
    if (whence == SEEK_CUR) offset += file.tell();
    if (whence == SEEK_END) offset += file.size();
    file.seek(offset);
    return offset;
  }
  static toff_t size(thandle_t handle) { return static_cast<Output*>(handle)->file.size(); }
  static int no_map(thandle_t, void**, toff_t*) { return 0; }
  TiffStream stream() { return {this, read, write, seek, size, no_map}; }
};

constexpr std::uint64_t kUnlimited = static_cast<std::uint64_t>(-1);

/// How a part's channels are stored: which, in what order, and what TIFF calls them.
struct Samples {
  std::vector<int> order;
  std::vector<std::string> names;
  std::size_t colours = 1;
  bool custom_names = false;
  bool alpha = false;  ///< A stands behind the colours that it belongs to

  int alpha_channel() const { return order[colours]; }
};

Samples arrange(const std::vector<std::string>& channels) {
  Samples samples;
  const auto take = [&](const std::string& name) {
    const auto found = std::find(channels.begin(), channels.end(), name);
    if (found == channels.end()) return false;
    samples.order.push_back(static_cast<int>(found - channels.begin()));
    samples.names.push_back(name);
    return true;
  };
  const auto has = [&](const std::string& name) {
    return std::find(channels.begin(), channels.end(), name) != channels.end();
  };
  if (has("R") && has("G") && has("B")) {
    for (const char* name : {"R", "G", "B"}) take(name);
    samples.colours = 3;
  } else {
    take("Y");
  }
  if (!samples.order.empty()) samples.alpha = take("A");
  for (const std::string& name : channels) {
    if (std::find(samples.names.begin(), samples.names.end(), name) != samples.names.end()) continue;
    samples.custom_names = samples.custom_names || channels.size() > 1;
    if (name.find(',') != std::string::npos)
      throw Error(ErrorKind::unsupported, "TIFF cannot hold a channel named '" + name + "'");
    take(name);
  }
  if (samples.names.size() != channels.size())
    throw Error(ErrorKind::bad_request, "two channels have one name");
  return samples;
}

class Writer {
 public:
  Writer(ByteSink& file, const WriteOptions& options, const char* mode)
      : options_(options),
        output_{file, nullptr},
        tiff_(open_tiff_stream(output_.stream(), mode, kUnlimited, failure_)) {
    if (tiff_ == nullptr) fail();
  }

  void choose(PixelType type, const std::string& compression, Colour colour) {
    type_ = type;
    colour_ = colour;
    if (compression == "zip") compression_ = COMPRESSION_ADOBE_DEFLATE;
    if (compression == "lzw") compression_ = COMPRESSION_LZW;
  }

  WriteReport write_page(const WritePart& part, std::size_t page, std::size_t pages) {
    const Samples samples = arrange(part.channels);
    set_tags(part, samples);
    if (pages > 1) {
      set(TIFFTAG_SUBFILETYPE, FILETYPE_PAGE);
      set(TIFFTAG_PAGENUMBER, static_cast<int>(page), static_cast<int>(pages));
    }
    set_description(page == 0, samples);
    if (page == 0 && options_.panorama) {
      const std::string xmp = xmp_of(*options_.panorama);
      set(TIFFTAG_XMLPACKET, static_cast<std::uint32_t>(xmp.size()), xmp.data());
    }
    const WriteReport report = write_pixels(part.image, samples);
    check(TIFFWriteDirectory(tiff_.get()) == 1);
    return report;
  }

  void finish() {
    check(TIFFFlush(tiff_.get()) == 1);
    tiff_.reset();
    check(true);
  }

 private:
  [[noreturn]] void fail() {
    if (output_.thrown) std::rethrow_exception(output_.thrown);
    const std::string detail = tiff_failure(failure_.text);
    throw Error(ErrorKind::bad_request, "the TIFF cannot be written" + (detail.empty() ? "" : ": " + detail));
  }
  void check(bool succeeded) {
    if (!succeeded || output_.thrown) fail();
  }
  template <class... Values>
  void set(std::uint32_t tag, Values... values) {
    check(TIFFSetField(tiff_.get(), tag, values...) == 1);
  }

  /// Colours in memory are multiplied by alpha, and linear. They are stored so where they stay linear; where
  /// they are encoded, programs expect whole ones.
  bool stores_straight_alpha() const { return colour_ == Colour::srgb; }

  void set_tags(const WritePart& part, const Samples& samples) {
    const bool floats = type_ == PixelType::half || type_ == PixelType::float32;
    set(TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(part.image.width));
    set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(part.image.height));
    set(TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * size_of(type_)));
    set(TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(samples.order.size()));
    set(TIFFTAG_SAMPLEFORMAT, floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    set(TIFFTAG_PHOTOMETRIC, samples.colours == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    set(TIFFTAG_COMPRESSION, compression_);
    // libtiff's horizontal differencing ends at 32-bit integers, its byte planes begin at half.
    if (compression_ != COMPRESSION_NONE) {
      set(TIFFTAG_PREDICTOR, floats ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
    }
    std::vector<std::uint16_t> extra;
    for (std::size_t k = samples.colours; k < samples.names.size(); ++k) {
      const bool alpha = samples.alpha && k == samples.colours;
      const auto kind = stores_straight_alpha() ? EXTRASAMPLE_UNASSALPHA : EXTRASAMPLE_ASSOCALPHA;
      extra.push_back(static_cast<std::uint16_t>(alpha ? kind : EXTRASAMPLE_UNSPECIFIED));
    }
    if (!extra.empty()) set(TIFFTAG_EXTRASAMPLES, static_cast<int>(extra.size()), extra.data());
    if (!part.name.empty()) set(TIFFTAG_PAGENAME, part.name.c_str());
  }

  void set_description(bool first, const Samples& samples) {
    std::map<std::string, std::string> attributes;
    if (first) attributes = options_.attributes;
    if (samples.custom_names) {
      attributes[kTiffChannels] = listed(samples.names, ",");
    }
    const std::string text = attribute_lines(attributes, "ImageDescription");
    if (!text.empty()) set(TIFFTAG_IMAGEDESCRIPTION, text.c_str());
  }

  WriteReport write_pixels(ImageView<const float> image, const Samples& samples) {
    const bool divides = samples.alpha && stores_straight_alpha();
    const PixelEncoder pixels(type_, samples.order, srgb_channels(samples.names, colour_),
                              divides ? std::optional(samples.alpha_channel()) : std::nullopt);
    const std::size_t stride = static_cast<std::size_t>(image.width) * pixels.pixel_bytes();
    constexpr std::size_t kStripBytes = std::size_t{1} << 18;
    const int rows_of_strip = static_cast<int>(
        std::clamp<std::size_t>(kStripBytes / stride, 1, static_cast<std::size_t>(image.height)));
    set(TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(rows_of_strip));
    std::vector<std::byte> strip(stride * static_cast<std::size_t>(rows_of_strip));
    WriteReport report;
    for (int y = 0; y < image.height; y += rows_of_strip) {
      const int count = std::min(rows_of_strip, image.height - y);
      report = report + pixels.encode_rows(image.part(0, y, image.width, count), strip.data(), stride);
      const auto index = static_cast<std::uint32_t>(y / rows_of_strip);
      const auto size = static_cast<tmsize_t>(stride * static_cast<std::size_t>(count));
      check(TIFFWriteEncodedStrip(tiff_.get(), index, strip.data(), size) == size);
    }
    return report;
  }

  const WriteOptions& options_;
  PixelType type_ = PixelType::float32;
  Colour colour_ = Colour::linear;
  int compression_ = COMPRESSION_NONE;
  TiffFailure failure_;
  Output output_;
  TiffHandle tiff_;
};

}  // namespace

WriteReport write_tiff(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  static const std::string known[] = {"zip", "none", "lzw"};
  static constexpr PixelType types[] = {PixelType::float32, PixelType::half, PixelType::uint8,
                                        PixelType::uint16, PixelType::uint32};
  const PixelType type = pixel_type(options, types, "TIFF");
  const std::string chosen = compression(options, known, "TIFF");

  // Classic TIFF has 32-bit offsets; some room is left for what a codec adds to noise.
  constexpr std::uint64_t kMaxClassicBytes = std::uint64_t{15} << 28;
  std::uint64_t bytes = 0;
  for (const WritePart& part : parts) {
    bytes += static_cast<std::uint64_t>(part.image.width) * static_cast<std::uint64_t>(part.image.height) *
             part.channels.size() * size_of(type);
  }
  Writer writer(file, options, bytes > kMaxClassicBytes ? "w8" : "w");
  writer.choose(type, chosen, colour_for(type, options.colour));
  WriteReport report;
  for (std::size_t page = 0; page < parts.size(); ++page) {
    report = report + writer.write_page(parts[page], page, parts.size());
  }
  writer.finish();
  return report;
}

}  // namespace welkin::io
