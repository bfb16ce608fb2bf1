#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/io/boxes.h"
#include "welkin/io/colour/code_points.h"
#include "welkin/io/colour/gain_map.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/jxl/decoder.h"
#include "welkin/io/jxl/gain_map_box.h"

/// JPEG XL (ISO/IEC 18181), by libjxl.
namespace welkin::io {
namespace {

constexpr unsigned char kCodestream[] = {0xff, 0x0a};
constexpr unsigned char kContainer[] = {0, 0, 0, 12, 'J', 'X', 'L', ' ', 0x0d, 0x0a, 0x87, 0x0a};

/// The emptiest pictures that libjxl writes have 2^16 pixels to the byte.
constexpr std::uint64_t kMostPixelsOfByte = 1 << 18;

/// An XMP packet may have any size, or expand to it.
constexpr std::size_t kMaxXmpBytes = std::size_t{16} << 20;

bool matches(std::span<const std::byte> bytes) {
  const auto begins_with = [&](std::span<const unsigned char> magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
  };
  return begins_with(kCodestream) || begins_with(kContainer);
}

PixelType type_of(const JxlBasicInfo& basic) {
  if (basic.exponent_bits_per_sample > 0) {
    const bool half = basic.bits_per_sample == 16 && basic.exponent_bits_per_sample == 5;
    return half ? PixelType::half : PixelType::float32;
  }
  if (basic.bits_per_sample <= 8) return PixelType::uint8;
  return basic.bits_per_sample <= 16 ? PixelType::uint16 : PixelType::uint32;
}

/// 2^bits − 1 where a float holds that integer's fractions precisely enough to tell which one it is; else 0.
double largest_integer(std::uint32_t bits, std::uint32_t exponent_bits) {
  return exponent_bits == 0 && bits <= 16 ? std::exp2(bits) - 1 : 0;
}

/// Floats from libjxl → linear ones.
class ChannelDecoder {
 public:
  /// `largest` as from largest_integer.
  ChannelDecoder(double largest, bool srgb) : largest_(largest), srgb_(srgb) {
    for (double code = 0; largest > 0 && code <= largest; ++code) {
      const double value = code / largest;
      integers_.push_back(static_cast<float>(srgb ? srgb_to_linear(value) : value));
    }
  }

  float operator()(float value) const {
    // libjxl multiplies integers by a rounded 1/largest; what is an integer to float's precision is one.
    // Others, of lossy pictures, stay.
    constexpr double kPrecision = 1.0 / (1 << 22);
    const double scaled = value * largest_, rounded = std::nearbyint(scaled);
    if (largest_ > 0 && rounded >= 0 && rounded <= largest_ &&
        std::abs(scaled - rounded) <= kPrecision * largest_) {
      return integers_[static_cast<std::size_t>(rounded)];
    }
    return srgb_ ? static_cast<float>(srgb_to_linear(value)) : value;
  }

 private:
  double largest_;
  bool srgb_;
  std::vector<float> integers_;
};

bool near(const Chromaticities& a, const Chromaticities& b) {
  constexpr double kTolerance = 1e-4;  // libjxl's own primaries of sRGB are rounded
  const auto same = [](const double(&p)[2], const double(&q)[2]) {
    return std::abs(p[0] - q[0]) < kTolerance && std::abs(p[1] - q[1]) < kTolerance;
  };
  return same(a.red, b.red) && same(a.green, b.green) && same(a.blue, b.blue) && same(a.white, b.white);
}

std::string name_of(JxlExtraChannelType type) {
  switch (type) {
    case JXL_CHANNEL_ALPHA:
      return "a second alpha";
    case JXL_CHANNEL_DEPTH:
      return "depth";
    case JXL_CHANNEL_SELECTION_MASK:
      return "a selection";
    case JXL_CHANNEL_CFA:
      return "a colour filter's mosaic";
    case JXL_CHANNEL_THERMAL:
      return "thermal";
    default:
      return "of unknown meaning";
  }
}

/// The first XMP packet that is compressed, decompressed. Nothing when it is too large.
std::optional<std::string> compressed_xmp(const Source& source) {
  JxlFile file(source, JXL_DEC_BOX);
  std::string text;
  bool within = false;
  for (JxlDecoderStatus status = file.next();; status = file.next()) {
    if (within && status != JXL_DEC_BOX_NEED_MORE_OUTPUT) {
      text.resize(text.size() - libjxl().JxlDecoderReleaseBoxBuffer(file.get()));
      return text;
    }
    if (status == JXL_DEC_SUCCESS) return text;
    JxlBoxType type;
    if (!within && libjxl().JxlDecoderGetBoxType(file.get(), type, JXL_TRUE) == JXL_DEC_SUCCESS &&
        std::memcmp(type, "xml ", sizeof type) == 0) {
      within = true;
    }
    if (!within) continue;
    constexpr std::size_t kStep = std::size_t{1} << 16;
    const std::size_t filled =
        text.empty() ? 0 : text.size() - libjxl().JxlDecoderReleaseBoxBuffer(file.get());
    if (filled >= kMaxXmpBytes) return {};
    text.resize(std::max(2 * filled, kStep));
    libjxl().JxlDecoderSetBoxBuffer(file.get(), reinterpret_cast<std::uint8_t*>(text.data()) + filled,
                                    text.size() - filled);
  }
}

class JxlReader : public FormatReader {
 public:
  explicit JxlReader(const Source& source) : source_(source) {
    info_.format = "jxl";
    info_.bytes = source_.bytes.size();
    if (std::to_integer<unsigned char>(source_.bytes[0]) == kContainer[0]) read_boxes();
    JxlFile file(source_, JXL_DEC_BASIC_INFO | JXL_DEC_COLOR_ENCODING);
    for (JxlDecoderStatus status = file.next(); status != JXL_DEC_SUCCESS; status = file.next()) {
      if (status == JXL_DEC_BASIC_INFO) read_header(file);
      if (status == JXL_DEC_COLOR_ENCODING) {
        read_colour(file);
        find_gain_map();
        return;
      }
    }
    file.fail("holds no picture");
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part == 0 && out.width == info_.parts[0].width && out.height == info_.parts[0].height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    static_cast<void>(part);
    Target target{{}, channels, out};
    const std::vector<bool> srgb = srgb_channels(info_.parts[0].channels, info_.colour);
    for (std::size_t k = 0; k < srgb.size(); ++k) target.decoders.emplace_back(largest_[k], srgb[k]);
    JxlFile file(source_, JXL_DEC_COLOR_ENCODING | JXL_DEC_FULL_IMAGE);
    for (JxlDecoderStatus status = file.next(); status != JXL_DEC_FULL_IMAGE; status = file.next()) {
      if (status == JXL_DEC_COLOR_ENCODING) prefer_original_colour(file);
      if (status == JXL_DEC_SUCCESS) file.fail("holds no picture");
      if (status == JXL_DEC_NEED_IMAGE_OUT_BUFFER) {
        const JxlPixelFormat format = {static_cast<std::uint32_t>(largest_.size()), JXL_TYPE_FLOAT,
                                       JXL_NATIVE_ENDIAN, 0};
        if (libjxl().JxlDecoderSetImageOutCallback(file.get(), &format, Target::take, &target) !=
            JXL_DEC_SUCCESS)
          file.fail("libjxl cannot decode it to floats");
      }
    }
  }

 private:
  /// Where libjxl's runs of pixels go.
  struct Target {
    std::vector<ChannelDecoder> decoders;  ///< of the stored channels
    std::span<const int> channels;
    ImageView<float> out;

    /// A JxlImageOutCallback; on any of the threads.
    static void take(void* target, std::size_t x, std::size_t y, std::size_t count,
                     const void* run) noexcept {
      const auto& self = *static_cast<const Target*>(target);
      const std::size_t stored = self.decoders.size(), wanted = self.channels.size();
      const auto* pixel = static_cast<const float*>(run);
      float* to = self.out.row(static_cast<int>(y)) + x * wanted;
      for (std::size_t i = 0; i < count; ++i, pixel += stored, to += wanted) {
        for (std::size_t k = 0; k < wanted; ++k) {
          const auto channel = static_cast<std::size_t>(self.channels[k]);
          to[k] = self.decoders[channel](pixel[channel]);
        }
      }
    }
  };

  void read_boxes() {
    Boxes boxes(source_, source_.bytes);
    bool compressed = false, too_large = false;
    while (const std::optional<Box> box = boxes.next()) {
      const std::string_view content(reinterpret_cast<const char*>(box->content.data()), box->content.size());
      // The Exif box is not read: its orientation gives way to the codestream's (ISO/IEC 18181-2).
      if (box->type == "xml ") {
        if (content.size() > kMaxXmpBytes) {
          too_large = true;
        } else if (declared_.xmp.empty()) {
          declared_.xmp = content;
        }
      }
      if (box->type == "brob" && content.starts_with("xml ")) compressed = true;
      if (box->type == "brob" && content.starts_with("jhgm"))
        info_.warnings.push_back("its gain map is compressed, and left out, so that it is not HDR");
      if (box->type == "jhgm") gain_map_box_ = box->content;
      if (box->type == "jbrd") from_jpeg_ = true;
    }
    if (compressed && declared_.xmp.empty()) {
      std::optional<std::string> xmp = compressed_xmp(source_);
      too_large = too_large || !xmp;
      declared_.xmp = std::move(xmp).value_or("");
    }
    if (too_large) info_.warnings.push_back("its XMP packet is too large, and not read");
  }

  void find_gain_map() {
    if (!gain_map_box_) return;
    try {
      const JxlGainMapBox box = parse_jxl_gain_map_box(*gain_map_box_);
      const auto metadata = gain_map_metadata(box.metadata);
      if (!metadata) throw Error(ErrorKind::damaged, "it has no metadata");
      ReadOptions options = source_.options;
      options.colour = Colour::linear;
      declare_gain_map(*metadata, std::make_unique<JxlReader>(Source{box.codestream, source_.name, options}),
                       declared_, info_);
    } catch (const Error& error) {
      info_.warnings.push_back("its gain map is left out, so that it is not HDR: " + error.cause());
    }
  }

  void read_header(const JxlFile& file) {
    JxlBasicInfo basic;
    if (libjxl().JxlDecoderGetBasicInfo(file.get(), &basic) != JXL_DEC_SUCCESS)
      file.fail("the header is malformed");
    if (basic.have_animation == JXL_TRUE)
      throw Error(ErrorKind::unsupported, source_.name, "an animation, not a picture");
    std::vector<std::string> channels = {"Y"};
    if (basic.num_color_channels == 3) channels = {"R", "G", "B"};
    largest_.assign(channels.size(), largest_integer(basic.bits_per_sample, basic.exponent_bits_per_sample));
    if (basic.alpha_bits > 0) {
      channels.push_back("A");
      largest_.push_back(largest_integer(basic.alpha_bits, basic.alpha_exponent_bits));
      premultiplied_ = basic.alpha_premultiplied == JXL_TRUE;
    }
    read_extra_channels(file, basic);
    // Its orientation is undone by libjxl, and the size is that of the upright picture.
    check_size(source_, basic.xsize, basic.ysize, channels.size());
    if (std::uint64_t{basic.xsize} * basic.ysize / kMostPixelsOfByte > source_.bytes.size()) {
      throw Error(ErrorKind::damaged, source_.name,
                  std::to_string(source_.bytes.size()) + " bytes cannot hold " + std::to_string(basic.xsize) +
                      "×" + std::to_string(basic.ysize) + " pixels");
    }
    const PixelType type = type_of(basic);
    info_.parts.push_back({"", static_cast<int>(basic.xsize), static_cast<int>(basic.ysize),
                           std::move(channels), type,
                           from_jpeg_                                ? "jpeg"
                           : basic.uses_original_profile == JXL_TRUE ? "lossless"
                                                                     : "lossy"});
    if (size_of(type) * 8 != basic.bits_per_sample) {
      info_.notes.push_back("values of " + std::to_string(basic.bits_per_sample) + " bits");
    }
    constexpr float kUsualTarget = 255;
    if (basic.intensity_target != kUsualTarget) {
      char text[64];
      std::snprintf(text, sizeof text, "intensity target %g cd/m²",
                    static_cast<double>(basic.intensity_target));
      info_.notes.emplace_back(text);
    }
  }

  void read_extra_channels(const JxlFile& file, const JxlBasicInfo& basic) {
    std::string left_out;
    bool alpha_seen = false;
    for (std::uint32_t i = 0; i < basic.num_extra_channels; ++i) {
      JxlExtraChannelInfo extra;
      if (libjxl().JxlDecoderGetExtraChannelInfo(file.get(), i, &extra) != JXL_DEC_SUCCESS)
        file.fail("the header is malformed");
      if (extra.type == JXL_CHANNEL_BLACK)
        throw Error(ErrorKind::unsupported, source_.name, "a CMYK picture; save it as RGB");
      if (extra.type == JXL_CHANNEL_SPOT_COLOR) continue;  // libjxl paints it
      if (extra.type == JXL_CHANNEL_ALPHA && !std::exchange(alpha_seen, true)) continue;
      left_out += (left_out.empty() ? "" : ", ") + name_of(extra.type);
    }
    if (!left_out.empty()) info_.warnings.push_back("its extra channels are not read: " + left_out);
  }

  /// Has libjxl give an XYB picture's values as the file says that they once were. Without tone mapping.
  static std::optional<JxlColorEncoding> prefer_original_colour(const JxlFile& file) {
    JxlColorEncoding colour;
    const bool enumerated =
        libjxl().JxlDecoderGetColorAsEncodedProfile(file.get(), nullptr, JXL_COLOR_PROFILE_TARGET_ORIGINAL,
                                                    &colour) == JXL_DEC_SUCCESS;
    if (enumerated) libjxl().JxlDecoderSetPreferredColorProfile(file.get(), &colour);
    // Of a picture that has an ICC profile instead, XYB becomes linear, of sRGB's primaries.
    if (libjxl().JxlDecoderGetColorAsEncodedProfile(file.get(), nullptr, JXL_COLOR_PROFILE_TARGET_DATA,
                                                    &colour) == JXL_DEC_SUCCESS) {
      return colour;
    }
    return {};
  }

  void read_colour(const JxlFile& file) {
    const std::optional<JxlColorEncoding> colour = prefer_original_colour(file);
    if (colour) {
      declare(*colour);
    } else {
      read_icc(file);
    }
    if (premultiplied_) {
      const bool linear =
          info_.colour == Colour::linear && declared_.curve == Curve::none && declared_.icc.empty();
      declared_.alpha = linear ? AlphaKind::associated : AlphaKind::encoded;
    } else if (info_.parts[0].channels.back() == "A") {
      declared_.alpha = AlphaKind::straight;
    }
    if (source_.options.colour != Colour::automatic) info_.colour = source_.options.colour;
  }

  void declare(const JxlColorEncoding& colour) {
    constexpr int kUnspecified = 2;
    if (colour.color_space == JXL_COLOR_SPACE_XYB)
      throw Error(ErrorKind::unsupported, source_.name, "a picture of XYB values; save it as RGB");
    if (colour.transfer_function == JXL_TRANSFER_FUNCTION_GAMMA) {
      info_.colour = Colour::linear;
      declared_.curve = Curve::gamma;
      declared_.gamma = 1 / colour.gamma;  // libjxl's is the exponent of what encodes
    } else {
      // The others have the numbers of ITU-T H.273.
      declare_code_points(kUnspecified, colour.transfer_function, declared_, info_);
    }
    if (colour.color_space == JXL_COLOR_SPACE_GRAY) return;
    Chromaticities said;
    const auto copy = [](const double(&from)[2], double(&to)[2]) { std::copy_n(from, 2, to); };
    copy(colour.primaries_red_xy, said.red);
    copy(colour.primaries_green_xy, said.green);
    copy(colour.primaries_blue_xy, said.blue);
    copy(colour.white_point_xy, said.white);
    constexpr int kBt709 = 1;
    declared_.primaries = said;
    for (const int known : {kBt709, 9, 11, 12}) {
      if (near(said, *chromaticities_of(known))) declared_.primaries = chromaticities_of(known);
    }
    if (declared_.primaries == chromaticities_of(kBt709)) declared_.primaries.reset();
  }

  void read_icc(const JxlFile& file) {
    std::size_t size = 0;
    // As for integers and floats of no declared meaning, should the profile turn out to be damaged.
    const PixelType type = info_.parts[0].type;
    info_.colour = type == PixelType::uint8 || type == PixelType::uint16 ? Colour::srgb : Colour::linear;
    if (libjxl().JxlDecoderGetICCProfileSize(file.get(), nullptr, JXL_COLOR_PROFILE_TARGET_DATA, &size) ==
        JXL_DEC_SUCCESS) {
      declared_.icc.resize(size);
      if (libjxl().JxlDecoderGetColorAsICCProfile(file.get(), nullptr, JXL_COLOR_PROFILE_TARGET_DATA,
                                                  reinterpret_cast<std::uint8_t*>(declared_.icc.data()),
                                                  size) == JXL_DEC_SUCCESS) {
        return;
      }
    }
    declared_.icc.clear();
    info_.warnings.push_back(info_.colour == Colour::srgb
                                 ? "what its colours mean is not known; sRGB is assumed"
                                 : "what its colours mean is not known; linear values are assumed");
  }

  Source source_;
  std::vector<double> largest_;  ///< see Target
  bool premultiplied_ = false, from_jpeg_ = false;
  std::optional<std::span<const std::byte>> gain_map_box_;
};

std::unique_ptr<FormatReader> open_jxl(const Source& source) {
  return std::make_unique<JxlReader>(source);
}

}  // namespace

Format jxl_format() {
  return {
      {.format = "jxl",
       .title = "JPEG XL",
       .extensions = {"jxl"},
       .types = {PixelType::float32, PixelType::half, PixelType::uint8, PixelType::uint16, PixelType::uint32},
       .compressions = {"lossless", "lossy", "jpeg"},
       .channels = Channels::rgba,
       .hdr = true,
       .negative = true,
       .writable = false},
      matches,
      open_jxl,
      nullptr};
}

}  // namespace welkin::io
