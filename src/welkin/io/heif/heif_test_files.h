#pragma once

#include <libheif/heif.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/// AVIF and HEIF files, made by libheif's encoders.
namespace welkin::io::test {

/// Codes of a picture: code(channel, x, y) of planes that have these sizes.
struct HeifPicture {
  int width = 0, height = 0, depth = 8;
  heif_colorspace space = heif_colorspace_RGB;
  heif_chroma chroma = heif_chroma_444;
  bool alpha = false;
  std::function<int(heif_channel, int, int)> code;
};

struct HeifOptions {
  heif_compression_format codec = heif_compression_AV1;
  bool lossless = true;
  int quality = 90;
  bool nclx = true;
  int primaries = 1, transfer = 13, matrix = 6;
  bool full_range = true;
  std::vector<std::byte> icc = {};
  bool premultiplied = false;
  heif_orientation orientation = heif_orientation_normal;
  bool grid = false;  ///< of an odd size: one tile of a grid, else a clean aperture
  std::string xmp = {}, exif = {};
};

inline void check_heif(const heif_error& error) {
  if (error.code != heif_error_Ok)
    throw std::runtime_error(std::string("libheif cannot encode the test's picture: ") + error.message);
}

inline std::vector<std::byte> encoded_heif(const HeifPicture& picture, const HeifOptions& options = {}) {
  heif_image* image = nullptr;
  check_heif(heif_image_create(picture.width, picture.height, picture.space, picture.chroma, &image));
  const std::unique_ptr<heif_image, void (*)(const heif_image*)> owner(image, heif_image_release);
  const auto plane = [&](heif_channel channel, bool chroma) {
    const int divide_x = chroma && picture.chroma != heif_chroma_444 ? 2 : 1;
    const int divide_y = chroma && picture.chroma == heif_chroma_420 ? 2 : 1;
    const int width = (picture.width + divide_x - 1) / divide_x,
              height = (picture.height + divide_y - 1) / divide_y;
    check_heif(heif_image_add_plane(image, channel, width, height, picture.depth));
    int stride = 0;
    std::uint8_t* data = heif_image_get_plane(image, channel, &stride);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int code = picture.code(channel, x, y);
        std::uint8_t* row = data + static_cast<std::ptrdiff_t>(y) * stride;
        if (picture.depth > 8) {
          row[2 * x] = static_cast<std::uint8_t>(code & 255);
          row[2 * x + 1] = static_cast<std::uint8_t>(code >> 8);
        } else {
          row[x] = static_cast<std::uint8_t>(code);
        }
      }
    }
  };
  if (picture.space == heif_colorspace_RGB) {
    for (const auto channel : {heif_channel_R, heif_channel_G, heif_channel_B}) plane(channel, false);
  } else {
    plane(heif_channel_Y, false);
    if (picture.space == heif_colorspace_YCbCr) {
      plane(heif_channel_Cb, true);
      plane(heif_channel_Cr, true);
    }
  }
  if (picture.alpha) plane(heif_channel_Alpha, false);
  heif_image_set_premultiplied_alpha(image, options.premultiplied ? 1 : 0);

  const std::unique_ptr<heif_color_profile_nclx, void (*)(heif_color_profile_nclx*)> nclx(
      heif_nclx_color_profile_alloc(), heif_nclx_color_profile_free);
  nclx->color_primaries = static_cast<heif_color_primaries>(options.primaries);
  nclx->transfer_characteristics = static_cast<heif_transfer_characteristics>(options.transfer);
  nclx->matrix_coefficients = static_cast<heif_matrix_coefficients>(options.matrix);
  nclx->full_range_flag = options.full_range ? 1 : 0;
  if (options.nclx) check_heif(heif_image_set_nclx_color_profile(image, nclx.get()));
  if (!options.icc.empty()) {
    check_heif(heif_image_set_raw_color_profile(image, "prof", options.icc.data(), options.icc.size()));
  }

  const std::unique_ptr<heif_context, void (*)(heif_context*)> context(heif_context_alloc(),
                                                                       heif_context_free);
  heif_encoder* encoder = nullptr;
  check_heif(heif_context_get_encoder_for_format(context.get(), options.codec, &encoder));
  const std::unique_ptr<heif_encoder, void (*)(heif_encoder*)> encoder_owner(encoder, heif_encoder_release);
  check_heif(heif_encoder_set_lossless(encoder, options.lossless ? 1 : 0));
  if (!options.lossless) check_heif(heif_encoder_set_lossy_quality(encoder, options.quality));
  if (picture.space != heif_colorspace_monochrome) {
    const char* chroma = picture.chroma == heif_chroma_420   ? "420"
                         : picture.chroma == heif_chroma_422 ? "422"
                                                             : "444";
    check_heif(heif_encoder_set_parameter_string(encoder, "chroma", chroma));
  }
  const std::unique_ptr<heif_encoding_options, void (*)(heif_encoding_options*)> settings(
      heif_encoding_options_alloc(), heif_encoding_options_free);
  settings->output_nclx_profile = options.nclx ? nclx.get() : nullptr;
  settings->macOS_compatibility_workaround = options.grid ? 1 : 0;
  settings->save_two_colr_boxes_when_ICC_and_nclx_available = 1;
  settings->macOS_compatibility_workaround_no_nclx_profile = 0;
  settings->image_orientation = options.orientation;
  heif_image_handle* handle = nullptr;
  check_heif(heif_context_encode_image(context.get(), image, encoder, settings.get(), &handle));
  const std::unique_ptr<heif_image_handle, void (*)(const heif_image_handle*)> handle_owner(
      handle, heif_image_handle_release);
  if (!options.xmp.empty()) {
    check_heif(heif_context_add_XMP_metadata(context.get(), handle, options.xmp.data(),
                                             static_cast<int>(options.xmp.size())));
  }
  if (!options.exif.empty()) {
    check_heif(heif_context_add_exif_metadata(context.get(), handle, options.exif.data(),
                                              static_cast<int>(options.exif.size())));
  }

  std::vector<std::byte> bytes;
  heif_writer writer{1, [](heif_context*, const void* data, size_t size, void* to) {
                       const auto* begin = static_cast<const std::byte*>(data);
                       static_cast<std::vector<std::byte>*>(to)->assign(begin, begin + size);
                       return heif_error{heif_error_Ok, heif_suberror_Unspecified, ""};
                     }};
  check_heif(heif_context_write(context.get(), &writer, &bytes));
  return bytes;
}

}  // namespace welkin::io::test
