#include "welkin/io/jpeg/jpeg.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/io/colour/gain_map.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/exif.h"
#include "welkin/io/jpeg/guard.h"
#include "welkin/io/jpeg/pictures.h"
#include "welkin/io/text_attributes.h"

#include <jerror.h>

namespace welkin::io {
namespace {

bool matches(std::span<const std::byte> bytes) {
  constexpr unsigned char kStart[3] = {0xff, 0xd8, 0xff};
  return bytes.size() >= sizeof kStart && std::memcmp(bytes.data(), kStart, sizeof kStart) == 0;
}

/// One pass of libjpeg over the file, the header read.
class Decoder {
 public:
  explicit Decoder(const Source& source) : source_(source) {
    failure_.manager.error_exit = fail_jpeg;
    failure_.manager.emit_message = judge_warning;
    codec_.err = &failure_.manager;
    try {
      guarded([this] { read_header(); });
    } catch (...) {
      jpeg_destroy_decompress(&codec_);
      throw;
    }
  }
  ~Decoder() { jpeg_destroy_decompress(&codec_); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  jpeg_decompress_struct& codec() { return codec_; }

  /// Calls libjpeg; see guarded_jpeg for what `call` may not hold.
  template <class Call>
  void guarded(Call call) {
    if (guarded_jpeg(failure_, call)) return;
    throw Error(ErrorKind::damaged, source_.name,
                std::string(failure_.text) + " (byte " +
                    std::to_string(source_.bytes.size() - input_.bytes_in_buffer) + ")");
  }

 private:
  void read_header() {
    jpeg_create_decompress(&codec_);
    input_.init_source = [](j_decompress_ptr) {};
    input_.term_source = [](j_decompress_ptr) {};
    input_.resync_to_restart = jpeg_resync_to_restart;
    // The whole file is in the buffer, so a request for more means that it ends too early.
    input_.fill_input_buffer = [](j_decompress_ptr codec) -> boolean {
      ERREXIT(codec, JERR_INPUT_EOF);
      return FALSE;
    };
    input_.skip_input_data = [](j_decompress_ptr codec, long count) {
      if (count <= 0) return;
      if (static_cast<std::size_t>(count) > codec->src->bytes_in_buffer) ERREXIT(codec, JERR_INPUT_EOF);
      codec->src->next_input_byte += count;
      codec->src->bytes_in_buffer -= static_cast<std::size_t>(count);
    };
    input_.next_input_byte = reinterpret_cast<const JOCTET*>(source_.bytes.data());
    input_.bytes_in_buffer = source_.bytes.size();
    codec_.src = &input_;
    progress_.progress_monitor = limit_scans;
    codec_.progress = &progress_;
    constexpr unsigned kWholeMarker = 0xffff;
    jpeg_save_markers(&codec_, JPEG_APP0 + 1, kWholeMarker);
    jpeg_save_markers(&codec_, JPEG_APP0 + 2, kWholeMarker);
    jpeg_save_markers(&codec_, JPEG_COM, kWholeMarker);
    jpeg_read_header(&codec_, TRUE);
  }

  /// libjpeg warns and then invents pixels. Only warnings that leave the picture intact are accepted.
  static void judge_warning(j_common_ptr codec, int level) {
    if (level >= 0) return;
    switch (codec->err->msg_code) {
      case JWRN_ADOBE_XFORM:
      case JWRN_BOGUS_ICC:
      case JWRN_EXTRANEOUS_DATA:
      case JWRN_JFIF_MAJOR:
        return;
      default:
        fail_jpeg(codec);
    }
  }

  /// Each scan of a progressive file costs a pass over the whole picture, and may hold next to no bytes.
  static void limit_scans(j_common_ptr codec) {
    constexpr int kMaxScans = 500;
    if (codec->is_decompressor == TRUE &&
        reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number > kMaxScans) {
      ERREXIT(codec, JERR_BAD_PROGRESSION);
    }
  }

  const Source& source_;
  JpegFailure failure_;
  jpeg_source_mgr input_{};
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct codec_{};
};

/// Whether a picture is its file's first, or one behind it that may be its gain map.
enum class Picture { first, further };

class JpegReader : public FormatReader {
 public:
  explicit JpegReader(const Source& source, Picture picture = Picture::first) : source_(source) {
    Decoder decoder(source_);
    const jpeg_decompress_struct& codec = decoder.codec();
    std::vector<std::string> channels;
    switch (codec.jpeg_color_space) {
      case JCS_GRAYSCALE:
        channels = {"Y"};
        break;
      case JCS_RGB:
      case JCS_YCbCr:
        channels = {"R", "G", "B"};
        break;
      case JCS_CMYK:
      case JCS_YCCK:
        throw Error(ErrorKind::unsupported, source_.name, "a CMYK picture; save it as RGB");
      default:
        throw Error(ErrorKind::unsupported, source_.name,
                    "a JPEG of " + std::to_string(codec.num_components) + " components of unknown meaning");
    }
    check_size(source_, codec.image_width, codec.image_height, channels.size());
    // Huffman coding spends at least a bit on each block of 8×8 of the first component, which may be sampled
    // at a sixteenth of the picture's resolution.
    const std::uint64_t blocks = std::uint64_t{codec.image_width} * codec.image_height / (DCTSIZE2 * 16);
    if (codec.arith_code == FALSE && blocks / 8 > source_.bytes.size()) {
      throw Error(ErrorKind::damaged, source_.name,
                  std::to_string(source_.bytes.size()) + " bytes cannot hold " +
                      std::to_string(codec.image_width) + "×" + std::to_string(codec.image_height) +
                      " pixels");
    }
    info_.format = "jpeg";
    info_.bytes = source_.bytes.size();
    info_.colour = source_.options.colour == Colour::linear ? Colour::linear : Colour::srgb;
    info_.parts.push_back({"", static_cast<int>(codec.image_width), static_cast<int>(codec.image_height),
                           std::move(channels), PixelType::uint8, "jpeg"});
    if (codec.progressive_mode == TRUE) info_.notes.push_back("progressive");
    for (jpeg_saved_marker_ptr marker = codec.marker_list; marker != nullptr; marker = marker->next) {
      read_marker(*marker);
    }
    decoder.guarded([&] { read_profile(decoder.codec()); });
    if (picture == Picture::first && has_further_) find_gain_map();
  }

  void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) override {
    assert(part == 0 && out.width == info_.parts[0].width && out.height == info_.parts[0].height);
    assert(channels.size() == static_cast<std::size_t>(out.channels));
    static_cast<void>(part);
    const PartInfo& picture = info_.parts[0];
    const PixelDecoder pixels(picture.type, srgb_channels(picture.channels, info_.colour));
    Decoder decoder(source_);
    jpeg_decompress_struct& codec = decoder.codec();
    decoder.guarded([&] {
      codec.out_color_space = picture.channels.size() == 1 ? JCS_GRAYSCALE : JCS_RGB;
      codec.dct_method = JDCT_ISLOW;
      jpeg_start_decompress(&codec);
    });
    constexpr int kRowsOfBand = 64;
    const std::size_t stride = static_cast<std::size_t>(out.width) * picture.channels.size();
    std::vector<std::byte> stored(stride * kRowsOfBand);
    for (int y = 0; y < out.height; y += kRowsOfBand) {
      const int count = std::min(kRowsOfBand, out.height - y);
      decoder.guarded([&] {
        for (int row = 0; row < count;) {
          auto* start = reinterpret_cast<JSAMPROW>(stored.data() + static_cast<std::size_t>(row) * stride);
          row += static_cast<int>(jpeg_read_scanlines(&codec, &start, 1));
        }
      });
      pixels.decode_rows(stored.data(), stride, channels, out.part(0, y, out.width, count));
    }
    decoder.guarded([&] { jpeg_finish_decompress(&codec); });
  }

 private:
  void read_marker(const jpeg_marker_struct& marker) {
    const std::string_view text(reinterpret_cast<const char*>(marker.data), marker.data_length);
    if (marker.marker == JPEG_COM) parse_attribute_lines(text, "comment", info_.attributes);
    constexpr std::string_view kExif("Exif\0\0", 6);
    constexpr std::string_view kProfile("ICC_PROFILE\0", 12);
    has_profile_ = has_profile_ || (marker.marker == JPEG_APP0 + 2 && text.starts_with(kProfile));
    constexpr std::string_view kIso("urn:iso:std:iso:ts:21496:-1\0", 28), kSeveral("MPF\0", 4);
    if (marker.marker == JPEG_APP0 + 2 && text.starts_with(kIso)) iso_gain_map_ = text.substr(kIso.size());
    has_further_ = has_further_ ||
                   (marker.marker == JPEG_APP0 + 2 && (text.starts_with(kIso) || text.starts_with(kSeveral)));
    if (marker.marker != JPEG_APP0 + 1) return;
    if (text.starts_with(kExif))
      declared_.orientation =
          exif_orientation(std::as_bytes(std::span(text)).subspan(kExif.size())).value_or(1);
    if (!text.starts_with(kXmpMarker)) return;
    if (!declared_.xmp.empty()) {
      info_.warnings.push_back("a second XMP packet is ignored");
      return;
    }
    declared_.xmp = text.substr(kXmpMarker.size());
    has_further_ = has_further_ || declared_.xmp.find(kHdrGainMapSpace) != std::string::npos;
  }

  /// What this picture says of itself as a gain map; ISO's words go before Adobe's.
  std::optional<GainMapMetadata> gain_map() const {
    if (const auto metadata = gain_map_metadata(std::as_bytes(std::span(iso_gain_map_)))) return metadata;
    return declared_.xmp.empty() ? std::nullopt : gain_map_metadata(Xmp(declared_.xmp));
  }

  void find_gain_map() {
    constexpr std::size_t kMostPictures = 16;
    const auto pictures = jpegs_in(source_.bytes, kMostPictures);
    try {
      for (std::size_t i = 1; i < pictures.size(); ++i) {
        ReadOptions options = source_.options;
        options.colour = Colour::linear;
        auto reader =
            std::make_unique<JpegReader>(Source{pictures[i], source_.name, options}, Picture::further);
        if (reader->declared_.xmp.find("http://ns.apple.com/HDRGainMap/") != std::string::npos)
          info_.warnings.push_back(
              "a gain map as Apple writes it is left out: only the picture without it is read");
        const auto metadata = reader->gain_map();
        if (!metadata) continue;
        declare_gain_map(*metadata, std::move(reader), declared_, info_);
        return;
      }
    } catch (const Error& error) {
      info_.warnings.push_back("its gain map is left out, so that it is not HDR: " + error.cause());
      return;
    }
    if (!iso_gain_map_.empty() || declared_.xmp.find(kHdrGainMapSpace) != std::string::npos)
      info_.warnings.push_back("it declares a gain map, but holds none: it is not HDR");
  }

  void read_profile(jpeg_decompress_struct& codec) {
    JOCTET* data = nullptr;
    unsigned size = 0;
    if (jpeg_read_icc_profile(&codec, &data, &size) == FALSE) {
      if (has_profile_) info_.warnings.push_back("its ICC profile is malformed; sRGB is assumed");
      return;
    }
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    declared_.icc.assign(bytes, bytes + size);
    std::free(data);
  }

  Source source_;
  bool has_profile_ = false;
  bool has_further_ = false;  ///< something says that pictures follow this one
  std::string iso_gain_map_;  ///< ISO 21496-1's bytes
};

}  // namespace

std::unique_ptr<FormatReader> open_jpeg(const Source& source) {
  return std::make_unique<JpegReader>(source);
}

Format jpeg_format() {
  return {{.format = "jpeg",
           .title = "JPEG",
           .extensions = {"jpg", "jpeg"},
           .types = {PixelType::uint8},
           .compressions = {"jpeg"},
           .lossless = false,
           .attributes = true,
           .longest_side = JPEG_MAX_DIMENSION},
          matches,
          open_jpeg,
          write_jpeg};
}

}  // namespace welkin::io
