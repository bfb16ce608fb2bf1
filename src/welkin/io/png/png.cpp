#include "welkin/io/png/png.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/colour/code_points.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/exif.h"
#include "welkin/io/png/guard.h"
#include "welkin/io/xmp.h"

namespace welkin::io {
namespace {

constexpr unsigned char kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

/// Deflate cannot compress better (zlib's technical details: 1032:1).
constexpr std::uint64_t kBestDeflateRatio = 1032;

/// Text and profiles may claim, or expand to, any size: together they get 1 GiB at most.
constexpr png_alloc_size_t kMaxChunkBytes = png_alloc_size_t{8} << 20;
constexpr png_uint_32 kMaxChunksKept = 128;

bool matches(std::span<const std::byte> bytes) {
  return bytes.size() >= sizeof kSignature && std::memcmp(bytes.data(), kSignature, sizeof kSignature) == 0;
}

/// Throws unless whole chunks, as their lengths say, lead past an IDAT to an IEND. libpng would first
/// allocate memory for a chunk of any length, and then find its bytes missing.
void check_chunks(const Source& source) {
  constexpr std::size_t kAround = 12;  // length, name and checksum
  const auto fail = [&](const char* cause, std::size_t at) {
    throw Error(ErrorKind::damaged, source.name, std::string(cause) + " (byte " + std::to_string(at) + ")");
  };
  bool pixels = false;
  for (std::size_t at = sizeof kSignature;;) {
    const std::size_t left = source.bytes.size() - at;
    if (left < kAround) fail("ends early", source.bytes.size());
    const std::size_t length = load<std::uint32_t>(&source.bytes[at], std::endian::big);
    if (length > left - kAround) fail("ends early: a chunk passes the end of the file", at);
    if (std::memcmp(&source.bytes[at + 4], "IDAT", 4) == 0) pixels = true;
    if (std::memcmp(&source.bytes[at + 4], "IEND", 4) == 0) {
      if (!pixels) fail("holds no pixels: there is no IDAT chunk", at);
      return;
    }
    at += kAround + length;
  }
}

struct Chunk {
  std::string_view name;
  std::span<const std::byte> data;
  bool after_pixels;
};

/// Calls visit(chunk) for all but the pixels' up to IEND, of a file that check_chunks found sound.
template <class Visit>
void each_chunk(std::span<const std::byte> bytes, const Visit& visit) {
  constexpr std::size_t kDataAt = 8, kAround = 12;
  bool pixels = false;
  for (std::size_t at = sizeof kSignature;;) {
    const std::size_t length = load<std::uint32_t>(&bytes[at], std::endian::big);
    const std::string_view name(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (name == "IEND") return;
    if (name == "IDAT") {
      pixels = true;
    } else {
      visit(Chunk{name, bytes.subspan(at + kDataAt, length), pixels});
    }
    at += kAround + length;
  }
}

/// tEXt is Latin-1; attributes are UTF-8.
std::string from_latin1(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 128) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xc0 | code >> 6);
      utf8 += static_cast<char>(0x80 | (code & 63));
    }
  }
  return utf8;
}

/// One pass of libpng over the file, the header read and all transformations chosen.
class Decoder {
 public:
  explicit Decoder(const Source& source) : source_(source) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, fail_png, ignore_png_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    try {
      if (info_ == nullptr) throw std::bad_alloc();
      guarded([this] { read_header(); });
    } catch (...) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw;
    }
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

  /// Calls libpng; see guarded_png for what `call` may not hold.
  template <class Call>
  void guarded(Call call) {
    if (guarded_png(png_, call)) return;
    throw Error(ErrorKind::damaged, source_.name,
                std::string(failure_.text) + " (byte " + std::to_string(at_) + ")");
  }

  /// Palettes, fewer than 8 bits and tRNS become plain channels. Afterwards png_get_* tell of what rows will
  /// hold.
  void expand() {
    guarded([this] {
      png_set_expand(png_);
      if (std::endian::native == std::endian::little && png_get_bit_depth(png_, info_) == 16)
        png_set_swap(png_);
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
  }

 private:
  void read_header() {
    png_set_read_fn(png_, this, read_bytes);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size is the limit
    png_set_chunk_malloc_max(png_, kMaxChunkBytes);
    png_set_chunk_cache_max(png_, kMaxChunksKept);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>("cICP"), 1);
    png_read_info(png_, info_);
  }

  static void read_bytes(png_structp png, png_bytep out, std::size_t size) {
    auto* self = static_cast<Decoder*>(png_get_io_ptr(png));
    if (size > self->source_.bytes.size() - self->at_) {
      self->at_ = self->source_.bytes.size();
      png_error(png, "ends early");
    }
    std::memcpy(out, self->source_.bytes.data() + self->at_, size);
    self->at_ += size;
  }

  const Source& source_;
  std::size_t at_ = 0;
  PngFailure failure_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

std::string names_of_colour_type(int colour_type) {
  if (colour_type == PNG_COLOR_TYPE_PALETTE) return "palette";
  return (colour_type & PNG_COLOR_MASK_COLOR) != 0 ? "colour" : "grey";
}

class PngReader : public FormatReader {
 public:
  explicit PngReader(const Source& source) : source_(source) {
    check_chunks(source_);
    Decoder decoder(source_);
    const png_structp png = decoder.png();
    const png_infop info = decoder.info();
    const std::uint64_t width = png_get_image_width(png, info);
    const std::uint64_t height = png_get_image_height(png, info);
    check_size(source_, width, height, 1);
    if (png_get_rowbytes(png, info) * height / kBestDeflateRatio > source_.bytes.size()) {
      throw Error(ErrorKind::damaged, source_.name,
                  std::to_string(source_.bytes.size()) + " bytes cannot hold " + std::to_string(width) + "×" +
                      std::to_string(height) + " pixels");
    }
    info_.format = "png";
    info_.bytes = source_.bytes.size();
    const int depth = png_get_bit_depth(png, info);
    const int colour_type = png_get_color_type(png, info);
    if (depth < 8 || colour_type == PNG_COLOR_TYPE_PALETTE) {
      info_.notes.push_back("expanded from " + std::to_string(depth) + "-bit " +
                            names_of_colour_type(colour_type));
    }
    interlaced_ = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
    if (interlaced_) info_.notes.push_back("interlaced");
    read_colour(png, info);
    read_text(png, info);
    read_late_chunks();
    warn_of_dropped(png, info);
    decoder.expand();
    static const std::vector<std::string> names[] = {
        {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    const int channels = png_get_channels(png, info);
    check_size(source_, width, height, static_cast<std::uint64_t>(channels));
    info_.parts.push_back({"", static_cast<int>(width), static_cast<int>(height), names[channels - 1],
                           png_get_bit_depth(png, info) == 16 ? PixelType::uint16 : PixelType::uint8,
                           "deflate"});
    if (channels % 2 == 0) declared_.alpha = AlphaKind::straight;
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part == 0 && out.width == info_.parts[0].width && out.height == info_.parts[0].height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    static_cast<void>(part);
    const PartInfo& picture = info_.parts[0];
    const PixelDecoder pixels(picture.type, srgb_channels(picture.channels, info_.colour));
    Decoder decoder(source_);
    decoder.expand();

    // Interlaced passes are spread over the whole picture; otherwise a band of rows stays in the cache.
    constexpr int kRowsOfBand = 64;
    const int band = interlaced_ ? out.height : std::min(out.height, kRowsOfBand);
    const std::size_t stride = png_get_rowbytes(decoder.png(), decoder.info());
    std::vector<std::byte> stored(stride * static_cast<std::size_t>(band));
    std::vector<png_bytep> rows;
    for (int y = 0; y < band; ++y) {
      rows.push_back(reinterpret_cast<png_bytep>(stored.data() + stride * static_cast<std::size_t>(y)));
    }
    for (int y = 0; y < out.height; y += band) {
      const int count = std::min(band, out.height - y);
      decoder.guarded([&] {
        if (interlaced_) {
          png_read_image(decoder.png(), rows.data());
        } else {
          png_read_rows(decoder.png(), rows.data(), nullptr, static_cast<png_uint_32>(count));
        }
      });
      pixels.decode_rows(stored.data(), stride, channels, out.part(0, y, out.width, count));
    }
    decoder.guarded([&] { png_read_end(decoder.png(), nullptr); });
  }

 private:
  /// What the file says of its colours, the most specific chunk first (PNG third edition, 4.3).
  void read_colour(png_structp png, png_infop info) {
    info_.colour = Colour::srgb;
    const std::vector<int> code_points = read_cicp(png, info);
    if (!code_points.empty()) {
      declare_code_points(code_points[0], code_points[1], declared_, info_);
      if (code_points[3] == 0)
        info_.warnings.push_back(
            "its cICP chunk says that black and white are not at the ends of the range; ignored");
    } else if (png_get_valid(png, info, PNG_INFO_iCCP) != 0) {
      read_profile(png, info);
    } else if (png_get_valid(png, info, PNG_INFO_sRGB) == 0) {
      read_gamma(png, info);
    }
    if (source_.options.colour != Colour::automatic) info_.colour = source_.options.colour;
  }

  void read_profile(png_structp png, png_infop info) {
    png_charp name = nullptr;
    int method = 0;
    png_bytep data = nullptr;
    png_uint_32 size = 0;
    if (png_get_iCCP(png, info, &name, &method, &data, &size) == 0) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    declared_.icc.assign(bytes, bytes + size);
  }

  void read_gamma(png_structp png, png_infop info) {
    constexpr double kSrgbGamma = 0.45455, kTolerance = 0.005;
    double gamma = 0;
    if (png_get_gAMA(png, info, &gamma) != 0) {
      if (std::abs(gamma - 1) < kTolerance) {
        info_.colour = Colour::linear;
        info_.notes.push_back("linear by its gAMA chunk");
      } else if (std::abs(gamma - kSrgbGamma) > kTolerance && gamma > 0) {
        declared_.curve = Curve::gamma;
        declared_.gamma = 1 / gamma;
      }
    }
    Chromaticities c{};
    if (png_get_cHRM(png, info, &c.white[0], &c.white[1], &c.red[0], &c.red[1], &c.green[0], &c.green[1],
                     &c.blue[0], &c.blue[1]) != 0)
      declared_.primaries = c;
  }

  /// Colour primaries, transfer function, matrix, range; empty when there is no cICP chunk.
  static std::vector<int> read_cicp(png_structp png, png_infop info) {
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(png, info, &chunks);
    for (int i = 0; i < count; ++i) {
      if (std::memcmp(chunks[i].name, "cICP", 4) == 0 && chunks[i].size == 4) {
        return {chunks[i].data, chunks[i].data + 4};
      }
    }
    return {};
  }

  /// Those that many programs put after the pixels, where libpng comes only with them.
  void read_late_chunks() {
    each_chunk(source_.bytes, [&](const Chunk& chunk) {
      if (chunk.name == "eXIf") declared_.orientation = exif_orientation(chunk.data).value_or(1);
      if (chunk.name == "iTXt" && chunk.after_pixels && declared_.xmp.empty()) read_xmp(chunk.data);
    });
    if (late_xmp_left_out_)
      info_.warnings.push_back("its XMP after the pixels is compressed or malformed; it is not read");
  }

  /// Keyword, 0, whether compressed, method, language, 0, translated keyword, 0, text.
  void read_xmp(std::span<const std::byte> data) {
    std::string_view text(reinterpret_cast<const char*>(data.data()), data.size());
    const std::string start = std::string(kXmpKeyword) + '\0';
    if (!text.starts_with(start)) return;
    text.remove_prefix(start.size());
    const std::size_t language = text.size() < 2 ? text.npos : text.find('\0', 2);
    const std::size_t keyword = language == text.npos ? text.npos : text.find('\0', language + 1);
    if (keyword == text.npos || text[0] != 0) {
      late_xmp_left_out_ = true;
    } else {
      declared_.xmp = text.substr(keyword + 1);
    }
  }

  bool has_chunk(std::string_view name) const {
    bool found = false;
    each_chunk(source_.bytes,
               [&](const Chunk& chunk) { found = found || (chunk.name == name && !chunk.after_pixels); });
    return found;
  }

  /// libpng drops chunks that it finds malformed or at odds with others, of colour all at once.
  void warn_of_dropped(png_structp png, png_infop info) {
    const auto warn = [&](const char* name, png_uint_32 flag, const char* assumed) {
      if (has_chunk(name) && png_get_valid(png, info, flag) == 0)
        info_.warnings.push_back("its " + std::string(name) + " chunk is malformed, or another is; " +
                                 assumed);
    };
    warn("tRNS", PNG_INFO_tRNS, "no colour is transparent");
    if (!read_cicp(png, info).empty()) return;
    if (has_chunk("iCCP")) return warn("iCCP", PNG_INFO_iCCP, "sRGB is assumed");
    if (has_chunk("sRGB")) return warn("sRGB", PNG_INFO_sRGB, "sRGB is assumed all the same");
    warn("gAMA", PNG_INFO_gAMA, "sRGB is assumed");
    warn("cHRM", PNG_INFO_cHRM, "BT.709's primaries are assumed");
  }

  void read_text(png_structp png, png_infop info) {
    png_textp texts = nullptr;
    const int count = png_get_text(png, info, &texts, nullptr);
    for (int i = 0; i < count; ++i) {
      const bool utf8 = texts[i].compression >= PNG_ITXT_COMPRESSION_NONE;
      const std::string_view value =
          texts[i].text == nullptr
              ? std::string_view()
              : std::string_view(texts[i].text, utf8 ? texts[i].itxt_length : texts[i].text_length);
      const std::string key = from_latin1(texts[i].key);
      if (key == kXmpKeyword) {
        if (!declared_.xmp.empty()) info_.warnings.push_back("a second XMP packet is ignored");
        if (declared_.xmp.empty()) declared_.xmp = value;
        continue;
      }
      info_.attributes.emplace(key, utf8 ? std::string(value) : from_latin1(value));
    }
  }

  Source source_;
  bool interlaced_ = false;
  bool late_xmp_left_out_ = false;
};

}  // namespace

std::unique_ptr<FormatReader> open_png(const Source& source) {
  return std::make_unique<PngReader>(source);
}

Format png_format() {
  return {{.format = "png",
           .title = "PNG",
           .extensions = {"png"},
           .types = {PixelType::uint16, PixelType::uint8},
           .compressions = {"zip", "none"},
           .channels = Channels::rgba,
           .attributes = true},
          matches,
          open_png,
          write_png};
}

}  // namespace welkin::io
