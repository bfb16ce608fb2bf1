#include <algorithm>
#include <array>
#include <exception>

#include "welkin/base/error.h"
#include "welkin/io/decode_pixels.h"
#include "welkin/io/encode_pixels.h"
#include "welkin/io/jpeg/guard.h"
#include "welkin/io/jpeg/jpeg.h"
#include "welkin/io/text_attributes.h"
#include "welkin/io/write_choices.h"
#include "welkin/io/xmp.h"

#include <jerror.h>

namespace welkin::io {
namespace {

class Encoder {
 public:
  explicit Encoder(ByteSink& file) : file_(file) {
    failure_.manager.error_exit = fail_jpeg;
    codec_.err = &failure_.manager;
    output_.encoder = this;
    output_.manager.init_destination = [](j_compress_ptr codec) { self_of(codec).start_buffer(); };
    output_.manager.empty_output_buffer = [](j_compress_ptr codec) -> boolean {
      self_of(codec).flush(codec, kBufferBytes);
      return TRUE;
    };
    output_.manager.term_destination = [](j_compress_ptr codec) {
      self_of(codec).flush(codec, kBufferBytes - codec->dest->free_in_buffer);
    };
  }
  ~Encoder() { jpeg_destroy_compress(&codec_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  jpeg_compress_struct& codec() { return codec_; }

  void create() {
    guarded([this] {
      jpeg_create_compress(&codec_);
      codec_.dest = &output_.manager;
    });
  }

  template <class Call>
  void guarded(Call call) {
    if (guarded_jpeg(failure_, call)) return;
    if (thrown_) std::rethrow_exception(thrown_);
    throw Error(ErrorKind::bad_request, failure_.text);
  }

 private:
  static constexpr std::size_t kBufferBytes = 1 << 16;

  struct Output {
    jpeg_destination_mgr manager{};
    Encoder* encoder = nullptr;
  };

  static Encoder& self_of(j_compress_ptr codec) { return *reinterpret_cast<Output*>(codec->dest)->encoder; }

  void start_buffer() {
    output_.manager.next_output_byte = buffer_.data();
    output_.manager.free_in_buffer = buffer_.size();
  }
  void flush(j_compress_ptr codec, std::size_t count) {
    if (!try_write(count)) ERREXIT(codec, JERR_FILE_WRITE);
    start_buffer();
  }
  /// An exception may not pass through libjpeg's frames, so it waits in thrown_.
  bool try_write(std::size_t count) noexcept {
    try {
      file_.write(buffer_.data(), count);
      return true;
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }

  ByteSink& file_;
  JpegFailure failure_;
  std::exception_ptr thrown_;
  Output output_;
  std::array<JOCTET, kBufferBytes> buffer_;
  jpeg_compress_struct codec_{};
};

}  // namespace

WriteReport write_jpeg(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options) {
  static const std::string known[] = {"jpeg"};
  static constexpr PixelType types[] = {PixelType::uint8};
  constexpr std::size_t kLongestComment = 65533;
  const WritePart& part = only_part(parts, "JPEG");
  compression(options, known, "JPEG");
  const PixelType type = pixel_type(options, types, "JPEG");
  check_sides(part, JPEG_MAX_DIMENSION, "JPEG");
  const int quality = checked_quality(options);
  const std::vector<int> order = channel_order(part, Alpha::none, "JPEG");
  const std::string comment = attribute_lines(options.attributes, "comment");
  if (comment.size() > kLongestComment)
    throw Error(ErrorKind::too_large, "the attributes are too long for a JPEG comment");
  const std::string xmp =
      options.panorama ? std::string(kXmpMarker) + xmp_of(*options.panorama) : std::string();
  const ImageView<const float> image = part.image;
  const PixelEncoder pixels(
      type, order, std::vector<bool>(order.size(), colour_for(type, options.colour) == Colour::srgb));

  Encoder encoder(file);
  encoder.create();
  jpeg_compress_struct& codec = encoder.codec();
  encoder.guarded([&] {
    codec.image_width = static_cast<JDIMENSION>(image.width);
    codec.image_height = static_cast<JDIMENSION>(image.height);
    codec.input_components = static_cast<int>(order.size());
    codec.in_color_space = order.size() == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, quality, TRUE);
    for (int k = 0; k < codec.num_components; ++k) {
      codec.comp_info[k].h_samp_factor = codec.comp_info[k].v_samp_factor = 1;
    }
    codec.optimize_coding = TRUE;
    jpeg_start_compress(&codec, TRUE);
    if (!xmp.empty()) {
      jpeg_write_marker(&codec, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(xmp.data()),
                        static_cast<unsigned>(xmp.size()));
    }
    if (!comment.empty()) {
      jpeg_write_marker(&codec, JPEG_COM, reinterpret_cast<const JOCTET*>(comment.data()),
                        static_cast<unsigned>(comment.size()));
    }
  });

  constexpr int kRowsOfBand = 64;
  const std::size_t stride = static_cast<std::size_t>(image.width) * pixels.pixel_bytes();
  std::vector<std::byte> stored(stride * kRowsOfBand);
  WriteReport report;
  for (int y = 0; y < image.height; y += kRowsOfBand) {
    const int count = std::min(kRowsOfBand, image.height - y);
    report = report + pixels.encode_rows(image.part(0, y, image.width, count), stored.data(), stride);
    encoder.guarded([&] {
      for (int row = 0; row < count; ++row) {
        auto* start = reinterpret_cast<JSAMPROW>(stored.data() + static_cast<std::size_t>(row) * stride);
        jpeg_write_scanlines(&codec, &start, 1);
      }
    });
  }
  encoder.guarded([&] { jpeg_finish_compress(&codec); });
  return report;
}

}  // namespace welkin::io
