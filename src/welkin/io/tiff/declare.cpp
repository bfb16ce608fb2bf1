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

}  // namespace

void declare_tiff_page(TIFF* tiff, bool rgb, TiffPage& page) {
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
  if (orientation >= ORIENTATION_TOPLEFT && orientation <= ORIENTATION_LEFTBOT)
    page.declared.orientation = orientation;

  const auto xmp = bytes_of(tiff, TIFFTAG_XMLPACKET);
  page.declared.xmp.assign(reinterpret_cast<const char*>(xmp.data()), xmp.size());
  while (!page.declared.xmp.empty() && page.declared.xmp.back() == '\0') page.declared.xmp.pop_back();
  if (!rgb) return;

  const auto icc = bytes_of(tiff, TIFFTAG_ICCPROFILE);
  page.declared.icc.assign(icc.begin(), icc.end());
  declare_primaries(tiff, page);
  std::uint16_t* curves[3] = {};
  if (icc.empty() && TIFFGetField(tiff, TIFFTAG_TRANSFERFUNCTION, &curves[0], &curves[1], &curves[2]) == 1)
    page.warnings.push_back("its TransferFunction is not obeyed");
}

}  // namespace welkin::io
