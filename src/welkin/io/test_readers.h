#pragma once

#include <lcms2.h>

#include <cmath>

#include "welkin/io/format.h"
#include "welkin/io/test_pictures.h"

/// What tests of one format's reader share.
namespace welkin::io::test {

/// The format's own reader, whose pictures are as they lie in the file. The bytes must outlive it.
inline std::unique_ptr<FormatReader> raw_reader(const Bytes& bytes, const ReadOptions& options = {}) {
  for (const Format& format : formats()) {
    if (format.matches(bytes)) return format.open({bytes, "test", options});
  }
  throw std::runtime_error("no format has these first bytes");
}

inline Image raw_picture(const Bytes& bytes, const ReadOptions& options = {}) {
  return read_part(*raw_reader(bytes, options));
}

/// An ICC profile that no list of code points has: ROMM's primaries (ISO 22028-2), and a power of 1.8.
inline Bytes unusual_profile() {
  const cmsCIExyY white = {0.3457, 0.3585, 1};
  const cmsCIExyYTRIPLE primaries = {{0.7347, 0.2653, 1}, {0.1596, 0.8404, 1}, {0.0366, 0.0001, 1}};
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 1.8);
  cmsToneCurve* curves[3] = {curve, curve, curve};
  const cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  Bytes bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(curve);
  return bytes;
}

/// value(x, y, channel) for each value of a picture.
template <class F>
Image picture_of(int width, int height, int channels, F value) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < channels; ++k) image.at(x, y)[k] = static_cast<float>(value(x, y, k));
    }
  }
  return image;
}

/// Where the pixel that is stored at (x, y) of w×h is shown, by Exif's definition of its orientations.
inline std::pair<int, int> shown_at(int orientation, int x, int y, int w, int h) {
  switch (orientation) {
    case 2:
      return {w - 1 - x, y};
    case 3:
      return {w - 1 - x, h - 1 - y};
    case 4:
      return {x, h - 1 - y};
    case 5:
      return {y, x};
    case 6:
      return {h - 1 - y, x};
    case 7:
      return {h - 1 - y, w - 1 - x};
    case 8:
      return {y, w - 1 - x};
    default:
      return {x, y};
  }
}

/// Noise of whole multiples of 1/largest, 0 and 1 among them.
inline Image integer_noise(int width, int height, int channels, double largest) {
  const Image random = noise(width, height, channels);
  return picture_of(width, height, channels, [&](int x, int y, int k) {
    if (x == 0 && y == 0) return k % 2 == 0 ? 0.0 : 1.0;
    return std::round(random.at(x, y)[k] * largest) / largest;
  });
}

/// At 400 places or at each byte, the file cut, and one byte of it changed: a picture or an Error, nothing
/// else.
inline void expect_cuts_and_damage_are_survived(const Bytes& bytes) {
  ReadOptions options;
  options.max_bytes = 1 << 22;
  const auto survive = [&](const Bytes& file) {
    try {
      EXPECT_GT(raw_picture(file, options).width(), 0);
    } catch (const Error& error) {
      EXPECT_STRNE(error.what(), "");
    }
  };
  const std::size_t step = std::max<std::size_t>(1, bytes.size() / 400);
  for (std::size_t at = 12; at < bytes.size(); at += step) {
    survive(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at)));
    for (const int change : {0x01, 0x80, 0xff}) {
      Bytes damaged = bytes;
      damaged[at] ^= static_cast<std::byte>(change);
      survive(damaged);
    }
  }
}

}  // namespace welkin::io::test
