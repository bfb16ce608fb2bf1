#include "welkin/io/tiff/declare.h"

#include <cmath>
#include <cstring>

namespace welkin::io {
namespace {

constexpr double kD65[2] = {0.3127, 0.3290};

/// The bytes of a field that counts them.
std::span<const std::byte> bytes_of(TIFF* tiff, std::uint32_t tag) {
  std::uint32_t count = 0;
  void* data = nullptr;
  if (TIFFGetField(tiff, tag, &count, &data) != 1 || data == nullptr) return {};
  return {static_cast<const std::byte*>(data), count};
}

void declare_primaries(TIFF* tiff, TiffPage& page) {
  const float *white = nullptr, *xy = nullptr;
  const bool has_white = TIFFGetField(tiff, TIFFTAG_WHITEPOINT, &white) == 1 && white != nullptr;
  const bool has_primaries = TIFFGetField(tiff, TIFFTAG_PRIMARYCHROMATICITIES, &xy) == 1 && xy != nullptr;
  const double w[2] = {has_white ? white[0] : kD65[0], has_white ? white[1] : kD65[1]};
  if (!has_primaries) {
    const bool is_d65 = std::fabs(w[0] - kD65[0]) < 0.002 && std::fabs(w[1] - kD65[1]) < 0.002;
    if (!is_d65) page.warnings.push_back("its WhitePoint, without PrimaryChromaticities, is not obeyed");
    return;
  }
  bool finite = std::isfinite(w[0]) && std::isfinite(w[1]);
  double p[6];
  for (int k = 0; k < 6; ++k) {
    p[k] = xy[k];
    finite = finite && std::isfinite(p[k]);
  }
  const double area = (p[2] - p[0]) * (p[5] - p[1]) - (p[4] - p[0]) * (p[3] - p[1]);
  if (!finite || w[1] <= 0 || std::fabs(area) < 1e-6) {
    page.warnings.push_back("its PrimaryChromaticities are not the corners of a gamut, and are ignored");
    return;
  }
  page.declared.primaries = Chromaticities{{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {w[0], w[1]}};
}

/// Where, in texels, a position is that a file has in its units of resolution. Some writers have texels
/// there.
std::optional<int> offset_of(TIFF* tiff, std::uint32_t position_tag, std::uint32_t resolution_tag, int most) {
  float position = 0, resolution = 0;
  if (TIFFGetField(tiff, position_tag, &position) != 1) return 0;
  TIFFGetField(tiff, resolution_tag, &resolution);
  constexpr double kTolerance = 0.01;
  for (const double scale : {static_cast<double>(resolution), 1.0}) {
    const double texels = static_cast<double>(position) * scale, whole = std::nearbyint(texels);
    if (scale > 0 && std::fabs(texels - whole) <= kTolerance && whole >= 0 && whole <= most)
      return static_cast<int>(whole);
  }
  return std::nullopt;
}

/// A picture cut out of a larger one, as Hugin writes what it has warped. Nothing says of what projection;
/// those that are twice as wide as high are taken for whole panoramas.
void declare_crop(TIFF* tiff, TiffPage& page) {
  constexpr std::uint32_t kLargest = 1 << 20;
  std::uint32_t full_width = 0, full_height = 0;
  if (TIFFGetField(tiff, TIFFTAG_PIXAR_IMAGEFULLWIDTH, &full_width) != 1 ||
      TIFFGetField(tiff, TIFFTAG_PIXAR_IMAGEFULLLENGTH, &full_height) != 1)
    return;
  const auto width = static_cast<std::uint32_t>(page.part.width),
             height = static_cast<std::uint32_t>(page.part.height);
  if (full_width == width && full_height == height) return;
  const std::string whole =
      "a picture of " + std::to_string(full_width) + "×" + std::to_string(full_height) + " texels";
  const bool fits =
      full_width >= width && full_height >= height && full_width <= kLargest && full_height <= kLargest;
  const auto left =
      fits ? offset_of(tiff, TIFFTAG_XPOSITION, TIFFTAG_XRESOLUTION, static_cast<int>(full_width - width))
           : std::nullopt;
  const auto top =
      fits ? offset_of(tiff, TIFFTAG_YPOSITION, TIFFTAG_YRESOLUTION, static_cast<int>(full_height - height))
           : std::nullopt;
  if (!left || !top) {
    page.warnings.push_back("its tags say that it is cut out of " + whole +
                            ", which cannot be: read as it is");
    return;
  }
  const std::string cut =
      "cut out of " + whole + ", at " + std::to_string(*left) + ", " + std::to_string(*top);
  if (full_width != 2 * full_height) {
    page.warnings.push_back(cut + "; read as if it were the whole");
    return;
  }
  page.warnings.push_back(cut + "; taken for a part of a lat-long");
  Panorama panorama;
  panorama.projection = "equirectangular";
  panorama.full_width = static_cast<int>(full_width);
  panorama.full_height = static_cast<int>(full_height);
  panorama.crop_width = page.part.width;
  panorama.crop_height = page.part.height;
  panorama.crop_left = *left;
  panorama.crop_top = *top;
  page.panorama = panorama;
}

}  // namespace

void declare_tiff_page(TIFF* tiff, bool rgb, TiffPage& page) {
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
  if (orientation >= ORIENTATION_TOPLEFT && orientation <= ORIENTATION_LEFTBOT)
    page.declared.orientation = orientation;

  const auto xmp = bytes_of(tiff, TIFFTAG_XMLPACKET);
  page.declared.xmp.assign(reinterpret_cast<const char*>(xmp.data()), xmp.size());
  while (!page.declared.xmp.empty() && page.declared.xmp.back() == '\0') page.declared.xmp.pop_back();
  declare_crop(tiff, page);
  if (!rgb) return;

  const auto icc = bytes_of(tiff, TIFFTAG_ICCPROFILE);
  page.declared.icc.assign(icc.begin(), icc.end());
  declare_primaries(tiff, page);
  std::uint16_t* curves[3] = {};
  if (icc.empty() && TIFFGetField(tiff, TIFFTAG_TRANSFERFUNCTION, &curves[0], &curves[1], &curves[2]) == 1)
    page.warnings.push_back("its TransferFunction is not obeyed");
}

}  // namespace welkin::io
