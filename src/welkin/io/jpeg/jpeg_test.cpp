#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/exif.h"
#include "welkin/io/jpeg/jpeg_test_files.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// A smooth picture, which JPEG keeps well.
Image smooth(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < channels; ++k) {
        image.at(x, y)[k] = 0.5f + 0.4f * std::sin(0.05f * static_cast<float>(x + k * y));
      }
    }
  }
  return image;
}

float srgb_difference(const Image& a, const Image& b) {
  float largest = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int i = 0; i < a.width() * a.channels(); ++i) {
      const double difference = linear_to_srgb(a.view().row(y)[i]) - linear_to_srgb(b.view().row(y)[i]);
      largest = std::max(largest, static_cast<float>(std::abs(difference)));
    }
  }
  return largest;
}

/// What this room's writer does not make: CMYK, progressive scans.
Bytes by_libjpeg(J_COLOR_SPACE space, int components, bool progressive) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors;
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &data, &size);
  codec.image_width = codec.image_height = 20;
  codec.input_components = components;
  codec.in_color_space = space;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, 100, TRUE);
  if (progressive) jpeg_simple_progression(&codec);
  jpeg_start_compress(&codec, TRUE);
  for (int y = 0; y < 20; ++y) {
    std::vector<unsigned char> row(static_cast<std::size_t>(20 * components),
                                   static_cast<unsigned char>(10 * y));
    auto* start = row.data();
    jpeg_write_scanlines(&codec, &start, 1);
  }
  jpeg_finish_compress(&codec);
  const Bytes bytes(reinterpret_cast<std::byte*>(data), reinterpret_cast<std::byte*>(data) + size);
  jpeg_destroy_compress(&codec);
  std::free(data);
  return bytes;
}

TEST(Jpeg, SmoothPicturesComeBackNearly) {
  for (const int channels : {1, 3}) {
    const Image image = smooth(50, 70, channels);
    const Bytes bytes = encoded("jpg", image);
    EXPECT_EQ(info_of(bytes).colour, Colour::srgb);
    EXPECT_EQ(info_of(bytes).parts[0].channels, names_of(channels));
    // At quality 95 the quantisation steps of low frequencies are 1 to 2 of 255; a few add up.
    EXPECT_LE(srgb_difference(decoded(bytes), image), 6.0f / 255);
  }
}

TEST(Jpeg, QualityIsObeyed) {
  const Image image = noise(64, 64, 3);
  WriteOptions low, high;
  low.quality = 20;
  high.quality = 100;
  const Bytes worse = encoded("jpeg", image, low), better = encoded("jpeg", image, high);
  EXPECT_LT(worse.size() * 3, better.size());
  EXPECT_LT(srgb_difference(decoded(better), image), 0.05f);
  EXPECT_GT(srgb_difference(decoded(worse), image), 0.2f);
}

TEST(Jpeg, ColourIsAtFullResolution) {
  const Bytes bytes = encoded("jpg", noise(20, 20, 3));
  // The frame header: ff c0, length, precision, height, width, count, then per component: id, sampling,
  // table.
  std::size_t at = 0;
  while (at + 19 < bytes.size() && !(bytes[at] == std::byte{0xff} && bytes[at + 1] == std::byte{0xc0})) ++at;
  ASSERT_LT(at + 19, bytes.size());
  for (const std::size_t component : {0u, 1u, 2u}) EXPECT_EQ(bytes[at + 11 + 3 * component], std::byte{0x11});
}

TEST(Jpeg, ProgressiveIsRead) {
  const Bytes bytes = by_libjpeg(JCS_RGB, 3, true);
  EXPECT_EQ(info_of(bytes).notes.at(0), "progressive");
  const Image image = decoded(bytes);
  for (int y = 0; y < 20; ++y) EXPECT_NEAR(linear_to_srgb(image.at(10, y)[1]), 10 * y / 255.0, 3 / 255.0);
  expect_truncation_is_an_error(bytes);
  expect_damage_is_survived(bytes);
}

TEST(Jpeg, CmykIsRefusedClearly) {
  EXPECT_EQ(error_of([] { info_of(by_libjpeg(JCS_CMYK, 4, false)); }),
            "test: a CMYK picture; save it as RGB");
}

TEST(Jpeg, TruncationIsAnError) {
  expect_truncation_is_an_error(encoded("jpg", noise(20, 9, 3)));
}

TEST(Jpeg, AttributesAreACommentOfLines) {
  WriteOptions options;
  options.attributes = {{"Author", "nobody"}, {"comment", "free text"}};
  EXPECT_EQ(info_of(encoded("jpg", noise(4, 4, 3), options)).attributes, options.attributes);
  options.attributes["Author"] = std::string(70000, 'x');
  EXPECT_THROW(encoded("jpg", noise(4, 4, 3), options), Error);
}

TEST(Jpeg, TooLargeIsRefusedClearly) {
  const Image image(65501, 1, 1);
  EXPECT_NE(
      error_of([&] { encoded("jpg", image); }).find("too large for JPEG, whose sides are at most 65500"),
      std::string::npos);
}

/// An Exif block of one entry, of tag 0x0112, in little-endian order.
std::string exif_of(char orientation) {
  return std::string("II*\0\x8\0\0\0\1\0\x12\1\3\0\1\0\0\0", 18) + orientation + std::string(7, '\0');
}

TEST(Jpeg, ExifOrientationIsApplied) {
  const Bytes plain = encoded("jpg", smooth(20, 8, 3));
  const Image image = decoded(plain);
  const Image turned = decoded(with_marker(plain, '\xe1', std::string("Exif\0\0", 6) + exif_of(3)));
  ASSERT_EQ(turned.width(), 20);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(turned.at(0, 0)[c], image.at(19, 7)[c]);
  const Image on_its_side = decoded(with_marker(plain, '\xe1', std::string("Exif\0\0", 6) + exif_of(6)));
  ASSERT_EQ(on_its_side.width(), 8);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(on_its_side.at(7, 0)[c], image.at(0, 0)[c]);
}

TEST(Jpeg, AMalformedProfileIsTold) {
  const Bytes plain = encoded("jpg", smooth(20, 8, 3));
  EXPECT_EQ(info_of(with_marker(plain, '\xe2', std::string("ICC_PROFILE\0\2\2", 14) + "xyz")).warnings.size(),
            1u);
  EXPECT_EQ(info_of(with_marker(plain, '\xe2', std::string("ICC_PROFILE\0\1\1", 14) + "xyz")).warnings.size(),
            1u);
}

TEST(Exif, OrientationIsFoundOrNothing) {
  const auto orientation_of = [](const std::string& text) { return exif_orientation(bytes_of(text)); };
  for (int k = 1; k <= 8; ++k) EXPECT_EQ(orientation_of(exif_of(static_cast<char>(k))), k);
  EXPECT_EQ(orientation_of(exif_of(0)), std::nullopt);
  EXPECT_EQ(orientation_of(exif_of(9)), std::nullopt);
  const std::string big("MM\0*\0\0\0\x8\0\1\1\x12\0\3\0\0\0\1\0\3\0\0\0\0\0\0", 26);
  EXPECT_EQ(orientation_of(big), 3);
  for (std::size_t size = 0; size < 22; ++size) EXPECT_EQ(orientation_of(big.substr(0, size)), std::nullopt);
  EXPECT_EQ(orientation_of(std::string("II*\0\xff\xff\xff\xff\0\0", 10)), std::nullopt);
}

}  // namespace
}  // namespace welkin::io::test
