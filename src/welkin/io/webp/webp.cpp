#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>

#include "welkin/base/error.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/exif.h"
#include "welkin/io/format.h"
#include "welkin/io/write_choices.h"
#include "welkin/io/xmp.h"

namespace welkin::io {
namespace {

bool matches(std::span<const std::byte> bytes) {
  return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

std::string text_of(VP8StatusCode status) {
  switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY:
      return "out of memory";
    case VP8_STATUS_UNSUPPORTED_FEATURE:
      return "a WebP feature that is not supported";
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA:
      return "ends early";
    default:
      return "the WebP data is malformed";
  }
}

class WebpReader : public FormatReader {
 public:
  explicit WebpReader(const Source& source) : source_(source) {
    WebPBitstreamFeatures features;
    check(WebPGetFeatures(data(), source_.bytes.size(), &features));
    if (features.has_animation != 0)
      throw Error(ErrorKind::unsupported, source_.name, "an animation, not a picture");
    std::vector<std::string> channels = {"R", "G", "B"};
    if (features.has_alpha != 0) channels.push_back("A");
    check_size(source_, static_cast<std::uint64_t>(features.width),
               static_cast<std::uint64_t>(features.height), channels.size());
    constexpr int kLossless = 2;
    info_.format = "webp";
    info_.bytes = source_.bytes.size();
    info_.colour = source_.options.colour == Colour::linear ? Colour::linear : Colour::srgb;
    info_.parts.push_back({"", features.width, features.height, std::move(channels), PixelType::uint8,
                           features.format == kLossless ? "lossless" : "lossy"});
    if (features.has_alpha != 0) declared_.alpha = AlphaKind::straight;
    read_metadata();
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part == 0 && out.width == info_.parts[0].width && out.height == info_.parts[0].height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    static_cast<void>(part);
    const PartInfo& picture = info_.parts[0];
    const std::size_t stride = static_cast<std::size_t>(out.width) * picture.channels.size();
    std::vector<std::byte> stored(stride * static_cast<std::size_t>(out.height));

    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0)
      throw Error(ErrorKind::unsupported, "libwebp is of another version than its header");
    config.options.use_threads = 1;
    config.output.colorspace = picture.channels.size() == 4 ? MODE_RGBA : MODE_RGB;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {reinterpret_cast<std::uint8_t*>(stored.data()), static_cast<int>(stride),
                            stored.size()};
    const VP8StatusCode status = WebPDecode(data(), source_.bytes.size(), &config);
    WebPFreeDecBuffer(&config.output);
    check(status);
    PixelDecoder(picture.type, srgb_channels(picture.channels, info_.colour))
        .decode_rows(stored.data(), stride, channels, out);
  }

 private:
  void read_metadata() {
    const WebPData file{data(), source_.bytes.size()};
    const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> demuxer(WebPDemux(&file), WebPDemuxDelete);
    if (demuxer == nullptr) {
      info_.warnings.push_back("its metadata are malformed, and ignored");
      return;
    }
    const auto chunk = [&](const char* name) {
      std::span<const std::byte> bytes;
      WebPChunkIterator found{};
      if (WebPDemuxGetChunk(demuxer.get(), name, 1, &found) != 0)
        bytes = std::as_bytes(std::span(found.chunk.bytes, found.chunk.size));
      WebPDemuxReleaseChunkIterator(&found);
      return bytes;  // of the file
    };
    const auto profile = chunk("ICCP"), xmp = chunk("XMP ");
    auto exif = chunk("EXIF");
    declared_.icc.assign(profile.begin(), profile.end());
    declared_.xmp.assign(reinterpret_cast<const char*>(xmp.data()), xmp.size());
    // Some programs put what a JPEG's marker begins with before it.
    constexpr std::size_t kMarkerBytes = 6;
    if (exif.size() > kMarkerBytes && std::memcmp(exif.data(), "Exif\0\0", kMarkerBytes) == 0)
      exif = exif.subspan(kMarkerBytes);
    declared_.orientation = exif_orientation(exif).value_or(1);
  }

  const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(source_.bytes.data()); }
  void check(VP8StatusCode status) const {
    if (status != VP8_STATUS_OK) throw Error(ErrorKind::damaged, source_.name, text_of(status));
  }

  Source source_;
};

std::unique_ptr<FormatReader> open_webp(const Source& source) {
  return std::make_unique<WebpReader>(source);
}

/// Where the encoder's bytes go. An exception may not pass through libwebp's frames, so it waits in `thrown`.
struct Sink {
  ByteSink& file;
  std::exception_ptr thrown;

  static int write(const std::uint8_t* data, std::size_t size, const WebPPicture* picture) noexcept {
    auto* self = static_cast<Sink*>(picture->custom_ptr);
    try {
      self->file.write(data, size);
      return 1;
    } catch (...) {
      self->thrown = std::current_exception();
      return 0;
    }
  }
};

/// A WebPPicture with its pixels.
class Picture {
 public:
  Picture(const std::vector<std::byte>& stored, int width, int height, bool alpha, bool lossless) {
    if (WebPPictureInit(&picture_) == 0)
      throw Error(ErrorKind::unsupported, "libwebp is of another version than its header");
    picture_.width = width;
    picture_.height = height;
    picture_.use_argb = lossless ? 1 : 0;
    const auto* data = reinterpret_cast<const std::uint8_t*>(stored.data());
    const int imported = alpha ? WebPPictureImportRGBA(&picture_, data, 4 * width)
                               : WebPPictureImportRGB(&picture_, data, 3 * width);
    if (imported == 0) throw std::bad_alloc();
  }
  ~Picture() { WebPPictureFree(&picture_); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  void encode(const WebPConfig& config, Sink& sink) {
    picture_.writer = Sink::write;
    picture_.custom_ptr = &sink;
    if (WebPEncode(&config, &picture_) != 0) return;
    if (sink.thrown) std::rethrow_exception(sink.thrown);
    throw Error(ErrorKind::damaged,
                "libwebp cannot encode the picture (error " + std::to_string(picture_.error_code) + ")");
  }

 private:
  WebPPicture picture_;
};

/// Writes an encoded picture again, in the container that holds metadata beside it.
void write_with_xmp(ByteSink& file, std::span<const std::byte> picture, const std::string& xmp) {
  const std::unique_ptr<WebPMux, decltype(&WebPMuxDelete)> mux(WebPMuxNew(), WebPMuxDelete);
  const WebPData pixels{reinterpret_cast<const std::uint8_t*>(picture.data()), picture.size()};
  const WebPData packet{reinterpret_cast<const std::uint8_t*>(xmp.data()), xmp.size()};
  WebPData whole{};
  const bool assembled = mux != nullptr && WebPMuxSetImage(mux.get(), &pixels, 0) == WEBP_MUX_OK &&
                         WebPMuxSetChunk(mux.get(), "XMP ", &packet, 0) == WEBP_MUX_OK &&
                         WebPMuxAssemble(mux.get(), &whole) == WEBP_MUX_OK;
  const std::unique_ptr<void, decltype(&WebPFree)> owner(const_cast<std::uint8_t*>(whole.bytes), WebPFree);
  if (!assembled) throw std::bad_alloc();
  file.write(whole.bytes, whole.size);
}

/// Lossless at quality 100 or if `compression` says so, else lossy. Grey is stored as three equal channels.
WriteReport write_webp(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  static const std::string known[] = {"", "lossless", "lossy"};
  static constexpr PixelType types[] = {PixelType::uint8};
  constexpr int kLosslessQuality = 100;
  const WritePart& part = only_part(parts, "WebP");
  const std::string asked =
      compression(options, std::span(known).subspan(options.compression.empty() ? 0 : 1), "WebP");
  const PixelType type = pixel_type(options, types, "WebP");
  const int quality = checked_quality(options);
  const bool lossless = asked.empty() ? quality == kLosslessQuality : asked == "lossless";
  check_sides(part, WEBP_MAX_DIMENSION, "WebP");

  std::vector<int> order = channel_order(part, Alpha::allowed, "WebP");
  if (order.size() <= 2) order.insert(order.begin(), 2, order.front());
  const bool alpha = order.size() == 4;
  std::vector<bool> srgb(order.size(), colour_for(type, options.colour) == Colour::srgb);
  if (alpha) srgb.back() = false;
  const PixelEncoder pixels(type, order, srgb, alpha ? std::optional(order.back()) : std::nullopt);
  const ImageView<const float> image = part.image;
  const std::size_t stride = static_cast<std::size_t>(image.width) * pixels.pixel_bytes();
  std::vector<std::byte> stored(stride * static_cast<std::size_t>(image.height));
  const WriteReport report = pixels.encode_rows(image, stored.data(), stride);

  WebPConfig config;
  if (WebPConfigInit(&config) == 0)
    throw Error(ErrorKind::unsupported, "libwebp is of another version than its header");
  config.thread_level = 1;
  if (lossless) {
    constexpr int kLevel = 6;
    WebPConfigLosslessPreset(&config, kLevel);
    config.exact = 1;  // colours under zero alpha stay as they are
  } else {
    config.quality = static_cast<float>(quality);
  }
  Picture picture(stored, image.width, image.height, alpha, lossless);
  if (options.panorama) {
    MemorySink pixels_alone;
    Sink sink{pixels_alone, nullptr};
    picture.encode(config, sink);
    write_with_xmp(file, pixels_alone.bytes(), xmp_of(*options.panorama));
  } else {
    Sink sink{file, nullptr};
    picture.encode(config, sink);
  }
  return report;
}

}  // namespace

Format webp_format() {
  return {{.format = "webp",
           .title = "WebP",
           .extensions = {"webp"},
           .types = {PixelType::uint8},
           .compressions = {"lossy", "lossless"},
           .channels = Channels::rgba,
           .lossless = false,
           .longest_side = WEBP_MAX_DIMENSION},
          matches,
          open_webp,
          write_webp};
}

}  // namespace welkin::io
