#include <cmath>

#include "welkin/io/colour/code_points.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/jxl/jxl_test_files.h"
#include "welkin/io/test_readers.h"

namespace welkin::io::test {
namespace {

/// Floats of every kind: bright, tiny, negative.
Image bright_noise(int width, int height, int channels) {
  const Image random = noise(width, height, channels);
  Image image = picture_of(width, height, channels, [&](int x, int y, int k) {
    return (random.at(x, y)[k] - 0.1) * std::exp2(x % 20 - 4);
  });
  const float odd[] = {0.0f, -0.0f, 1e-42f, 6.1e-5f, 65504.0f, 3e38f, -2.5f, INFINITY, -INFINITY, NAN};
  std::copy(std::begin(odd), std::end(odd), image.at(1, 0));
  return image;
}

TEST(Jxl, FloatsComeBackBitForBit) {
  for (const int channels : {1, 2, 3, 4}) {
    SCOPED_TRACE(channels);
    const Image image = bright_noise(33, 17, channels);
    const Bytes bytes = encoded_jxl(image, linear_float());
    const auto reader = raw_reader(bytes);
    const FileInfo& info = reader->info();
    EXPECT_EQ(info.format, "jxl");
    EXPECT_EQ(info.bytes, bytes.size());
    EXPECT_EQ(info.colour, Colour::linear);
    EXPECT_EQ(info.parts.at(0).channels, names_of(channels));
    EXPECT_EQ(info.parts[0].type, PixelType::float32);
    EXPECT_EQ(info.parts[0].compression, "lossless");
    EXPECT_TRUE(info.warnings.empty());
    EXPECT_EQ(reader->declared().curve, Curve::none);
    EXPECT_EQ(reader->declared().primaries, std::nullopt);
    EXPECT_EQ(reader->declared().alpha, channels % 2 == 0 ? AlphaKind::straight : AlphaKind::associated);
    expect_same(read_part(*reader), image);
  }
}

TEST(Jxl, HalvesComeBackBitForBit) {
  JxlOptions options = linear_float();
  options.bits = 16;
  options.exponent_bits = 5;
  const Image image = picture_of(16, 16, 3, [](int x, int y, int k) {
    return std::ldexp(1024 + 61 * ((x * 7 + y * 3 + k) % 16), (x + y) % 28 - 22);
  });
  const Bytes bytes = encoded_jxl(image, options);
  EXPECT_EQ(info_of(bytes).parts[0].type, PixelType::half);
  expect_same(raw_picture(bytes), image);
}

TEST(Jxl, IntegersAreWholeFractionsOfTheLargest) {
  for (const std::uint32_t bits : {1u, 5u, 8u, 10u, 12u, 14u, 16u, 17u, 24u}) {
    for (const int channels : {1, 4}) {
      SCOPED_TRACE(bits);
      JxlOptions options;
      options.bits = bits;
      options.colour = jxl_colour(JXL_TRANSFER_FUNCTION_LINEAR);
      const double largest = std::exp2(bits) - 1;
      const Image image = integer_noise(40, 30, channels, largest);
      const Bytes bytes = encoded_jxl(image, options);
      const FileInfo info = raw_reader(bytes)->info();
      EXPECT_EQ(info.parts[0].type, bits <= 8    ? PixelType::uint8
                                    : bits <= 16 ? PixelType::uint16
                                                 : PixelType::uint32);
      EXPECT_EQ(
          std::count(info.notes.begin(), info.notes.end(), "values of " + std::to_string(bits) + " bits"),
          bits == 8 || bits == 16 ? 0 : 1);
      if (bits <= 16) {
        expect_same(raw_picture(bytes), image);
      } else {
        // Of more bits a float holds 24, and libjxl's factor is rounded.
        EXPECT_LE(largest_difference(raw_picture(bytes), image), 2e-7f);
      }
    }
  }
}

TEST(Jxl, SrgbIsUndoneAndAlphaIsNot) {
  const Image stored = integer_noise(20, 10, 4, 255);
  const Bytes bytes = encoded_jxl(stored);
  EXPECT_EQ(info_of(bytes).colour, Colour::srgb);
  const Image image = raw_picture(bytes);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      for (int k = 0; k < 3; ++k) {
        const auto code = static_cast<std::size_t>(std::lround(stored.at(x, y)[k] * 255));
        ASSERT_EQ(image.at(x, y)[k], srgb8_to_linear()[code]);
      }
      ASSERT_EQ(image.at(x, y)[3], stored.at(x, y)[3]);
    }
  }
  ReadOptions options;
  options.colour = Colour::linear;
  EXPECT_EQ(raw_reader(bytes, options)->info().colour, Colour::linear);
  expect_same(raw_picture(bytes, options), stored);
}

/// Smooth, so that lossy compression does little to it.
Image slope(int channels, double scale) {
  return picture_of(64, 64, channels, [&](int x, int y, int k) {
    return scale * (0.2 + 0.6 * (x + y) / 126.0 + 0.1 * std::sin(0.05 * (x - y) + k));
  });
}

// Lossy pictures are XYB inside; what comes out is what went in, whatever its curve, primaries and
// brightness.
TEST(Jxl, LossyPicturesKeepTheirColours) {
  const struct {
    const char* name;
    JxlOptions options;
    double scale;
    Colour colour;
    Curve curve;
    int primaries;
  } table[] = {
      {"sRGB", {}, 1, Colour::srgb, Curve::none, 1},
      {"linear", linear_float(), 1, Colour::linear, Curve::none, 1},
      {"linear above 1", linear_float(), 20, Colour::linear, Curve::none, 1},
      {"BT.709", {.colour = jxl_colour(JXL_TRANSFER_FUNCTION_709)}, 1, Colour::linear, Curve::bt709, 1},
      {"PQ",
       {.bits = 10, .colour = jxl_colour(JXL_TRANSFER_FUNCTION_PQ, JXL_PRIMARIES_2100)},
       0.8,
       Colour::linear,
       Curve::pq,
       9},
      {"PQ of 1000 cd/m²",
       {.bits = 10,
        .colour = jxl_colour(JXL_TRANSFER_FUNCTION_PQ, JXL_PRIMARIES_2100),
        .intensity_target = 1000},
       0.8,
       Colour::linear,
       Curve::pq,
       9},
      {"HLG",
       {.bits = 10, .colour = jxl_colour(JXL_TRANSFER_FUNCTION_HLG, JXL_PRIMARIES_2100)},
       1,
       Colour::linear,
       Curve::hlg,
       9},
      {"P3",
       {.colour = jxl_colour(JXL_TRANSFER_FUNCTION_SRGB, JXL_PRIMARIES_P3)},
       1,
       Colour::srgb,
       Curve::none,
       12},
  };
  for (const auto& row : table) {
    for (const int channels : {1, 3}) {
      for (const float distance : {0.0f, 0.1f}) {
        SCOPED_TRACE(std::string(row.name) + ", " + std::to_string(channels) + " channels, distance " +
                     std::to_string(distance));
        const Image stored = slope(channels, row.scale);
        JxlOptions options = row.options;
        options.distance = distance;
        const Bytes bytes = encoded_jxl(stored, options);
        const auto reader = raw_reader(bytes);
        EXPECT_EQ(reader->info().parts[0].compression, distance > 0 ? "lossy" : "lossless");
        EXPECT_EQ(reader->info().colour, row.colour);
        EXPECT_EQ(reader->declared().curve, row.curve);
        if (row.primaries == 1 || channels == 1) {
          EXPECT_EQ(reader->declared().primaries, std::nullopt);
        } else {
          EXPECT_EQ(reader->declared().primaries, chromaticities_of(row.primaries));
        }
        EXPECT_TRUE(reader->declared().icc.empty());
        EXPECT_TRUE(reader->info().warnings.empty());
        ReadOptions as_stored;
        as_stored.colour = Colour::linear;
        const float largest = static_cast<float>(row.scale);
        EXPECT_LE(largest_difference(raw_picture(bytes, as_stored), stored), 0.02f * largest);
      }
    }
  }
}

TEST(Jxl, CurvesAndPrimariesAreDeclared) {
  JxlOptions gamma;
  gamma.colour = jxl_colour(JXL_TRANSFER_FUNCTION_GAMMA, JXL_PRIMARIES_P3, JXL_WHITE_POINT_DCI, 1 / 2.2);
  const Bytes power = encoded_jxl(noise(8, 8, 3), gamma);
  const auto reader = raw_reader(power);
  EXPECT_EQ(reader->declared().curve, Curve::gamma);
  EXPECT_NEAR(reader->declared().gamma, 2.2, 1e-4);
  EXPECT_EQ(reader->info().colour, Colour::linear);
  EXPECT_EQ(reader->declared().primaries, chromaticities_of(11));

  JxlOptions custom;
  custom.colour = jxl_colour(JXL_TRANSFER_FUNCTION_DCI, JXL_PRIMARIES_CUSTOM, JXL_WHITE_POINT_CUSTOM);
  const double ap1[4][2] = {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};
  std::copy_n(ap1[0], 2, custom.colour.primaries_red_xy);
  std::copy_n(ap1[1], 2, custom.colour.primaries_green_xy);
  std::copy_n(ap1[2], 2, custom.colour.primaries_blue_xy);
  std::copy_n(ap1[3], 2, custom.colour.white_point_xy);
  const Bytes aces = encoded_jxl(noise(8, 8, 3), custom);
  const Declared declared = raw_reader(aces)->declared();
  EXPECT_EQ(declared.curve, Curve::gamma);
  EXPECT_EQ(declared.gamma, 2.6);
  ASSERT_TRUE(declared.primaries);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(declared.primaries->red[i], ap1[0][i], 1e-6);
    EXPECT_NEAR(declared.primaries->green[i], ap1[1][i], 1e-6);
    EXPECT_NEAR(declared.primaries->blue[i], ap1[2][i], 1e-6);
    EXPECT_NEAR(declared.primaries->white[i], ap1[3][i], 1e-6);
  }
}

/// The file with the one bit of its header changed that says that colours are multiplied by alpha: libjxl's
/// encoder does not take such pictures.
Bytes premultiplied(const Bytes& bytes) {
  const std::byte signature[] = {std::byte{0xff}, std::byte{0x0a}};
  const auto codestream = static_cast<std::size_t>(
      std::search(bytes.begin(), bytes.end(), std::begin(signature), std::end(signature)) - bytes.begin());
  for (std::size_t bit = 8 * (codestream + 2); bit < 8 * (codestream + 40); ++bit) {
    Bytes changed = bytes;
    changed[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    try {
      const auto reader = raw_reader(changed);
      if (reader->declared().alpha == AlphaKind::straight || reader->info().parts[0].channels.back() != "A")
        continue;
      read_part(*reader);
      return changed;
    } catch (const Error&) {
    }
  }
  ADD_FAILURE() << "no bit says so";
  return bytes;
}

TEST(Jxl, AlphaIsAsTheFileSays) {
  JxlOptions options;
  options.bits = 10;
  const Bytes encoded = encoded_jxl(integer_noise(8, 8, 4, 1023), options);
  EXPECT_EQ(raw_reader(encoded)->declared().alpha, AlphaKind::straight);
  EXPECT_EQ(raw_reader(premultiplied(encoded))->declared().alpha, AlphaKind::encoded);
  const Image image = noise(8, 8, 2);
  const Bytes associated = premultiplied(encoded_jxl(image, linear_float()));
  EXPECT_EQ(raw_reader(associated)->declared().alpha, AlphaKind::associated);
  expect_same(raw_picture(associated), image);
}

TEST(Jxl, ColoursUnderZeroAlphaStay) {
  Image image = noise(8, 8, 4);
  for (int i = 0; i < 64; ++i) image.at(0, 0)[4 * i + 3] = 0;
  expect_same(raw_picture(encoded_jxl(image, linear_float())), image);
}

TEST(Jxl, OrientationIsUndone) {
  constexpr int kWidth = 300, kHeight = 7;
  const Image stored = noise(kWidth, kHeight, 3);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(orientation);
    JxlOptions options = linear_float();
    options.orientation = orientation;
    const Bytes bytes = encoded_jxl(stored, options);
    EXPECT_EQ(raw_reader(bytes)->declared().orientation, 1);
    const Image image = raw_picture(bytes);
    ASSERT_EQ(image.width(), orientation < 5 ? kWidth : kHeight);
    ASSERT_EQ(image.height(), orientation < 5 ? kHeight : kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto [u, v] = shown_at(orientation, x, y, kWidth, kHeight);
        for (int k = 0; k < 3; ++k) ASSERT_EQ(image.at(u, v)[k], stored.at(x, y)[k]);
      }
    }
  }
}

TEST(Jxl, ContainersAndTheirXmpAreRead) {
  const std::string xmp = "<x:xmpmeta>" + std::string(200000, 'x') + "</x:xmpmeta>";
  const Image image = noise(9, 5, 3);
  for (const bool brotli : {false, true}) {
    JxlOptions options = linear_float();
    options.xmp = xmp;
    options.brotli = brotli;
    const Bytes bytes = encoded_jxl(image, options);
    EXPECT_EQ(bytes[4], std::byte{'J'});
    EXPECT_EQ(raw_reader(bytes)->declared().xmp, xmp);
    expect_same(raw_picture(bytes), image);
  }
}

TEST(Jxl, OtherExtraChannelsAreLeftOutAndTold) {
  JxlOptions options = linear_float();
  options.extra = {JXL_CHANNEL_DEPTH, JXL_CHANNEL_ALPHA};
  const Image image = noise(9, 5, 4);
  const Bytes bytes = encoded_jxl(image, options);
  ASSERT_EQ(raw_reader(bytes)->info().warnings.size(), 1u);
  EXPECT_EQ(raw_reader(bytes)->info().warnings[0], "its extra channels are not read: depth, a second alpha");
  expect_same(raw_picture(bytes), image);
}

TEST(Jxl, IccProfilesAreDeclared) {
  JxlOptions options;
  options.icc = unusual_profile();
  const Image stored = integer_noise(16, 16, 3, 255);
  const Bytes bytes = encoded_jxl(stored, options);
  const auto reader = raw_reader(bytes);
  EXPECT_EQ(reader->declared().icc, options.icc);
  EXPECT_EQ(reader->declared().primaries, std::nullopt);
  ReadOptions as_stored;
  as_stored.colour = Colour::linear;
  expect_same(raw_picture(bytes, as_stored), stored);
}

/// 0.6, 0.5, 0.4 of unusual_profile(), as linear values of sRGB's primaries: by ROMM's matrix to XYZ of D50,
/// and Lindbloom's of that to linear sRGB, which includes Bradford's adaptation.
void expect_unusual_colour(const float* pixel) {
  const double to_xyz[3][3] = {
      {0.7976749, 0.1351917, 0.0313534}, {0.2880402, 0.7118741, 0.0000857}, {0, 0, 0.8252100}};
  const double to_srgb[3][3] = {{3.1338561, -1.6168667, -0.4906146},
                                {-0.9787684, 1.9161415, 0.0334540},
                                {0.0719453, -0.2289914, 1.4052427}};
  double xyz[3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) xyz[i] += to_xyz[i][k] * std::pow(0.6 - 0.1 * k, 1.8);
  }
  for (int i = 0; i < 3; ++i) {
    double expected = 0;
    for (int k = 0; k < 3; ++k) expected += to_srgb[i][k] * xyz[k];
    EXPECT_NEAR(pixel[i], expected, 0.01);
  }
}

// Where libjxl undoes the profile itself, and where it is left to be obeyed.
TEST(Jxl, ColoursOfAnIccProfileBecomeLinear) {
  for (const float distance : {0.1f, 0.0f}) {
    JxlOptions options;
    options.icc = unusual_profile();
    options.distance = distance;
    const Bytes bytes =
        encoded_jxl(picture_of(64, 64, 3, [](int, int, int k) { return 0.6 - 0.1 * k; }), options);
    expect_unusual_colour(decoded(bytes).at(32, 32));
    if (distance == 0) continue;
    const auto reader = raw_reader(bytes);
    EXPECT_TRUE(reader->declared().icc.empty());
    EXPECT_EQ(reader->info().colour, Colour::linear);
    EXPECT_EQ(reader->declared().curve, Curve::none);
    EXPECT_EQ(reader->declared().primaries, std::nullopt);
  }
}

// SMPTE ST 2084 has 203 cd/m², diffuse white, at 0.58068888.
TEST(Jxl, DiffuseWhiteOfPqIsOne) {
  for (const float distance : {0.0f, 0.1f}) {
    JxlOptions options;
    options.bits = 16;
    options.distance = distance;
    options.colour = jxl_colour(JXL_TRANSFER_FUNCTION_PQ, JXL_PRIMARIES_2100);
    const Bytes bytes = encoded_jxl(picture_of(64, 64, 3, [](int, int, int) { return 0.58068888; }), options);
    const Image image = decoded(bytes);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(32, 32)[k], 1, distance > 0 ? 0.02 : 1e-3);
  }
}

TEST(Jxl, WhatWasAJpegSaysSo) {
  const Bytes jpeg = encoded("jpg", slope(3, 1));
  const Bytes bytes = jxl_of_jpeg(jpeg);
  const FileInfo info = raw_reader(bytes)->info();
  EXPECT_EQ(info.parts[0].compression, "jpeg");
  EXPECT_EQ(info.parts[0].type, PixelType::uint8);
  EXPECT_EQ(info.colour, Colour::srgb);
  // libjxl decodes more precisely than a JPEG decoder, which rounds to bytes.
  EXPECT_LE(largest_difference(raw_picture(bytes), raw_picture(jpeg)), 0.02f);
}

TEST(Jxl, WhatIsNoPictureOfColourIsRefused) {
  JxlOptions animation;
  animation.animation = true;
  animation.frames = 2;
  const Bytes frames = encoded_jxl(noise(8, 8, 3), animation);
  EXPECT_EQ(error_of([&] { raw_reader(frames); }), "test: an animation, not a picture");
  JxlOptions cmyk;
  cmyk.extra = {JXL_CHANNEL_BLACK};
  const Bytes black = encoded_jxl(noise(8, 8, 3), cmyk);
  EXPECT_EQ(error_of([&] { raw_reader(black); }), "test: a CMYK picture; save it as RGB");
}

}  // namespace
}  // namespace welkin::io::test
