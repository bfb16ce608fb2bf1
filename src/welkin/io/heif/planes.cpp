#include "welkin/io/heif/planes.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/io/byte_order.h"
#include "welkin/io/colour/transfer.h"

namespace welkin::io::heif {
namespace {

/// Matrix coefficients (ITU-T H.273, table 4) that libheif takes for others.
const char* meaning_of_unknown(int coefficients) {
  switch (coefficients) {
    case 0:  // R G B
    case 1:  // BT.709
    case 2:  // unspecified
    case 4:  // FCC
    case 5:  // BT.601
    case 6:
    case 7:   // SMPTE 240M
    case 9:   // BT.2020
    case 12:  // by the primaries
      return nullptr;
    case 8:
      return "YCgCo";
    case 10:
      return "BT.2020 of constant luminance";
    case 11:
      return "SMPTE ST 2085";
    case 13:
      return "of constant luminance, by its primaries";
    case 14:
      return "ICtCp";
    default:
      return "reserved";
  }
}

void check_matrix(const heif_color_profile_nclx* code_points, const Source& source) {
  if (code_points == nullptr) return;
  const int coefficients = code_points->matrix_coefficients;
  if (const char* meaning = meaning_of_unknown(coefficients)) {
    throw Error(ErrorKind::unsupported, source.name,
                "its colours are coded by the matrix number " + std::to_string(coefficients) +
                    " of ITU-T H.273 (" + meaning + "), which is not read");
  }
}

}  // namespace

Planes::Planes(const Picture& picture, const heif_color_profile_nclx* code_points, const Source& source) {
  const heif_colorspace space = libheif().heif_image_get_colorspace(picture.get());
  grey_ = space == heif_colorspace_monochrome;
  if (!grey_) {
    if (space != heif_colorspace_RGB ||
        libheif().heif_image_get_chroma_format(picture.get()) != heif_chroma_444)
      throw Error(ErrorKind::unsupported, source.name, "its pixels lie in an order that is not known");
    check_matrix(code_points, source);
  }
  depth_ =
      libheif().heif_image_get_bits_per_pixel_range(picture.get(), grey_ ? heif_channel_Y : heif_channel_R);
  // libheif brings luma and chroma of narrow range to R G B of full range, leaves grey as it is, and makes
  // R G B of narrow range still narrower.
  constexpr int kNarrowBlack = 16, kNarrowWhite = 235, kWhite = 255;
  const bool narrow = code_points != nullptr && code_points->full_range_flag == 0;
  if (grey_) {
    channels_ = {
        plane(picture, heif_channel_Y, narrow ? kNarrowBlack : 0, narrow ? kNarrowWhite : kWhite, source)};
  } else {
    if (narrow && code_points->matrix_coefficients == heif_matrix_coefficients_RGB_GBR)
      throw Error(ErrorKind::unsupported, source.name, "R, G and B of narrow range, which is not read");
    for (const heif_channel channel : {heif_channel_R, heif_channel_G, heif_channel_B})
      channels_.push_back(plane(picture, channel, 0, kWhite, source));
  }
  if (libheif().heif_image_has_channel(picture.get(), heif_channel_Alpha) != 0)
    channels_.push_back(plane(picture, heif_channel_Alpha, 0, kWhite, source));
  for (const Plane& each : channels_) {
    if (each.width != width() || each.height != height())
      throw Error(ErrorKind::damaged, source.name, "its channels are not of the same size");
  }
  set_colour(Colour::linear);
}

Planes::Plane Planes::plane(const Picture& picture, heif_channel channel, int black, int white,
                            const Source& source) const {
  constexpr int kLeastBits = 8, kMostBits = 16, kWhite = 255;
  int stride = 0;
  const std::uint8_t* data = libheif().heif_image_get_plane_readonly(picture.get(), channel, &stride);
  const int bits = libheif().heif_image_get_bits_per_pixel_range(picture.get(), channel);
  if (data == nullptr || bits < kLeastBits || bits > kMostBits)
    throw Error(ErrorKind::damaged, source.name, "a channel of its pixels is missing, or of a strange depth");
  const double largest = std::exp2(bits) - 1, eighth = std::exp2(bits - kLeastBits);
  return {data,
          stride,
          libheif().heif_image_get_width(picture.get(), channel),
          libheif().heif_image_get_height(picture.get(), channel),
          bits > kLeastBits,
          black * eighth,
          white == kWhite ? largest : white * eighth,
          std::vector<float>(std::size_t{1} << bits)};
}

void Planes::set_colour(Colour colour) {
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    Plane& plane = channels_[k];
    const bool srgb = colour == Colour::srgb && !(alpha() && k + 1 == channels_.size());
    for (std::size_t code = 0; code < plane.values.size(); ++code) {
      const double value =
          std::clamp((static_cast<double>(code) - plane.zero) / (plane.one - plane.zero), 0.0, 1.0);
      plane.values[code] = static_cast<float>(srgb ? srgb_to_linear(value) : value);
    }
  }
}

void Planes::read_row(int y, std::span<const int> channels, float* out, std::ptrdiff_t step) const {
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const Plane& plane = channels_[static_cast<std::size_t>(channels[k])];
    const std::uint8_t* row = plane.data + y * plane.stride;
    float* to = out + k;
    for (std::size_t x = 0; x < static_cast<std::size_t>(plane.width); ++x, to += step) {
      const std::size_t code = plane.wide ? load_native<std::uint16_t>(row + 2 * x) : row[x];
      *to = plane.values[std::min(code, plane.values.size() - 1)];
    }
  }
}

}  // namespace welkin::io::heif
