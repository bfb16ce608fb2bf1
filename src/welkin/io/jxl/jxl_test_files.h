#pragma once

#include <jxl/encode.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "welkin/image/image.h"

/// JPEG XL files, made by libjxl's encoder.
namespace welkin::io::test {

using Bytes = std::vector<std::byte>;

inline JxlColorEncoding jxl_colour(JxlTransferFunction transfer, JxlPrimaries primaries = JXL_PRIMARIES_SRGB,
                                   JxlWhitePoint white = JXL_WHITE_POINT_D65, double gamma = 0) {
  JxlColorEncoding colour{};
  colour.color_space = JXL_COLOR_SPACE_RGB;
  colour.white_point = white;
  colour.primaries = primaries;
  colour.transfer_function = transfer;
  colour.gamma = gamma;
  colour.rendering_intent = JXL_RENDERING_INTENT_RELATIVE;
  return colour;
}

struct JxlOptions {
  std::uint32_t bits = 8, exponent_bits = 0;
  float distance = 0;  ///< 0: lossless, in the original profile
  JxlColorEncoding colour = jxl_colour(JXL_TRANSFER_FUNCTION_SRGB);
  Bytes icc = {};  ///< instead of `colour`
  int orientation = 1;
  float intensity_target = 0;
  bool container = false;
  std::string xmp = {};
  bool brotli = false;                          ///< of the XMP box
  std::vector<JxlExtraChannelType> extra = {};  ///< besides alpha, all 0
  bool animation = false;
  int frames = 1;
};

inline JxlOptions linear_float() {
  JxlOptions options;
  options.bits = 32;
  options.exponent_bits = 8;
  options.colour = jxl_colour(JXL_TRANSFER_FUNCTION_LINEAR);
  return options;
}

inline void check_jxl(JxlEncoderStatus status) {
  if (status != JXL_ENC_SUCCESS) throw std::runtime_error("libjxl cannot encode the test's picture");
}

/// All that the encoder, its input closed, gives.
inline Bytes jxl_output(JxlEncoder* encoder) {
  Bytes bytes;
  std::vector<std::uint8_t> part(1 << 16);
  for (JxlEncoderStatus status = JXL_ENC_NEED_MORE_OUTPUT; status == JXL_ENC_NEED_MORE_OUTPUT;) {
    std::uint8_t* next = part.data();
    std::size_t left = part.size();
    status = JxlEncoderProcessOutput(encoder, &next, &left);
    if (status == JXL_ENC_ERROR) check_jxl(status);
    const auto* begin = reinterpret_cast<const std::byte*>(part.data());
    bytes.insert(bytes.end(), begin, begin + (next - part.data()));
  }
  return bytes;
}

/// A JPEG file as JPEG XL, from which the same JPEG file could be made.
inline Bytes jxl_of_jpeg(const Bytes& jpeg) {
  const std::unique_ptr<JxlEncoder, void (*)(JxlEncoder*)> encoder(JxlEncoderCreate(nullptr),
                                                                   JxlEncoderDestroy);
  check_jxl(JxlEncoderStoreJPEGMetadata(encoder.get(), JXL_TRUE));
  check_jxl(JxlEncoderAddJPEGFrame(JxlEncoderFrameSettingsCreate(encoder.get(), nullptr),
                                   reinterpret_cast<const std::uint8_t*>(jpeg.data()), jpeg.size()));
  JxlEncoderCloseInput(encoder.get());
  return jxl_output(encoder.get());
}

/// A file of `stored`, values 0…1 of integers, or floats, one to four channels.
inline Bytes encoded_jxl(const Image& stored, const JxlOptions& options = {}) {
  const std::unique_ptr<JxlEncoder, void (*)(JxlEncoder*)> owner(JxlEncoderCreate(nullptr),
                                                                 JxlEncoderDestroy);
  JxlEncoder* encoder = owner.get();
  const bool grey = stored.channels() <= 2, alpha = stored.channels() % 2 == 0;
  if (!options.xmp.empty() || options.container) check_jxl(JxlEncoderUseContainer(encoder, JXL_TRUE));
  if (!options.xmp.empty()) check_jxl(JxlEncoderUseBoxes(encoder));
  JxlBasicInfo info;
  JxlEncoderInitBasicInfo(&info);
  info.xsize = static_cast<std::uint32_t>(stored.width());
  info.ysize = static_cast<std::uint32_t>(stored.height());
  info.bits_per_sample = options.bits;
  info.exponent_bits_per_sample = options.exponent_bits;
  info.intensity_target = options.intensity_target;
  info.uses_original_profile = options.distance == 0 ? JXL_TRUE : JXL_FALSE;
  info.orientation = static_cast<JxlOrientation>(options.orientation);
  info.num_color_channels = grey ? 1 : 3;
  info.num_extra_channels = static_cast<std::uint32_t>((alpha ? 1 : 0) + options.extra.size());
  if (alpha) {
    info.alpha_bits = options.bits;
    info.alpha_exponent_bits = options.exponent_bits;
  }
  info.have_animation = options.animation ? JXL_TRUE : JXL_FALSE;
  if (options.animation) info.animation = {10, 1, 0, JXL_FALSE};
  constexpr int kLevelOfManyBits = 10;
  if (options.bits > 16) check_jxl(JxlEncoderSetCodestreamLevel(encoder, kLevelOfManyBits));
  check_jxl(JxlEncoderSetBasicInfo(encoder, &info));
  for (std::size_t i = 0; i < options.extra.size(); ++i) {
    JxlExtraChannelInfo extra;
    JxlEncoderInitExtraChannelInfo(options.extra[i], &extra);
    extra.bits_per_sample = 8;
    check_jxl(JxlEncoderSetExtraChannelInfo(encoder, i + (alpha ? 1 : 0), &extra));
  }
  if (options.icc.empty()) {
    JxlColorEncoding colour = options.colour;
    if (grey) colour.color_space = JXL_COLOR_SPACE_GRAY;
    check_jxl(JxlEncoderSetColorEncoding(encoder, &colour));
  } else {
    check_jxl(JxlEncoderSetICCProfile(encoder, reinterpret_cast<const std::uint8_t*>(options.icc.data()),
                                      options.icc.size()));
  }
  for (int frame = 0; frame < options.frames; ++frame) {
    JxlEncoderFrameSettings* settings = JxlEncoderFrameSettingsCreate(encoder, nullptr);
    if (options.distance == 0) {
      check_jxl(JxlEncoderSetFrameLossless(settings, JXL_TRUE));
    } else {
      check_jxl(JxlEncoderSetFrameDistance(settings, options.distance));
    }
    check_jxl(JxlEncoderFrameSettingsSetOption(settings, JXL_ENC_FRAME_SETTING_EFFORT, 3));
    check_jxl(JxlEncoderFrameSettingsSetOption(settings, JXL_ENC_FRAME_SETTING_KEEP_INVISIBLE, 1));
    if (options.animation) {
      JxlFrameHeader header;
      JxlEncoderInitFrameHeader(&header);
      header.duration = 1;
      check_jxl(JxlEncoderSetFrameHeader(settings, &header));
    }
    const JxlPixelFormat format = {static_cast<std::uint32_t>(stored.channels()), JXL_TYPE_FLOAT,
                                   JXL_NATIVE_ENDIAN, 0};
    std::vector<float> pixels;
    for (int y = 0; y < stored.height(); ++y) {
      pixels.insert(pixels.end(), stored.at(0, y), stored.at(0, y) + stored.width() * stored.channels());
    }
    check_jxl(JxlEncoderAddImageFrame(settings, &format, pixels.data(), pixels.size() * sizeof(float)));
    const std::vector<std::uint8_t> zeros(
        static_cast<std::size_t>(stored.width()) * static_cast<std::size_t>(stored.height()), 0);
    for (std::size_t i = 0; i < options.extra.size(); ++i) {
      const JxlPixelFormat bytes = {1, JXL_TYPE_UINT8, JXL_NATIVE_ENDIAN, 0};
      check_jxl(JxlEncoderSetExtraChannelBuffer(settings, &bytes, zeros.data(), zeros.size(),
                                                static_cast<std::uint32_t>(i + (alpha ? 1 : 0))));
    }
  }
  JxlEncoderCloseFrames(encoder);
  if (!options.xmp.empty()) {
    check_jxl(JxlEncoderAddBox(encoder, "xml ", reinterpret_cast<const std::uint8_t*>(options.xmp.data()),
                               options.xmp.size(), options.brotli ? JXL_TRUE : JXL_FALSE));
    JxlEncoderCloseBoxes(encoder);
  }
  return jxl_output(encoder);
}

}  // namespace welkin::io::test
