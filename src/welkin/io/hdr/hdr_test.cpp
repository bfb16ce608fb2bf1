#include <algorithm>
#include <cmath>

#include "welkin/io/hdr/rgbe.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// A file of these pixels bytes; `lines` are the header's variables.
Bytes picture(const std::string& lines, const std::string& resolution, const std::vector<int>& pixels) {
  Bytes bytes = bytes_of("#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n");
  for (const int value : pixels) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

/// Red of (x, y) of an image whose pixels were stored as mantissa m, exponent 136: value m.
int value_at(const Image& image, int x, int y) {
  return static_cast<int>(image.at(x, y)[0]);
}

TEST(Rgbe, ValueIsMantissaTimesPowerOfTwo) {
  for (int e = 0; e < 256; ++e) {
    const auto exponent = static_cast<std::uint8_t>(e);
    const std::uint8_t mantissas[3] = {255, 1, 0};
    float rgb[3];
    decode_rgbe(&mantissas[0], &mantissas[1], &mantissas[2], &exponent, 1, rgb);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(rgb[k], e == 0 ? 0 : std::ldexp(static_cast<float>(mantissas[k]), e - 136));
  }
}

TEST(Rgbe, EveryNormalisedPixelComesBack) {
  for (int e = 1; e < 256; ++e) {
    for (int m = 128; m < 256; ++m) {
      const std::uint8_t stored[4] = {static_cast<std::uint8_t>(m), static_cast<std::uint8_t>(255 - m),
                                      static_cast<std::uint8_t>(m / 2), static_cast<std::uint8_t>(e)};
      float rgb[3];
      decode_rgbe(&stored[0], &stored[1], &stored[2], &stored[3], 1, rgb);
      std::uint8_t again[4];
      encode_rgbe(rgb[0], rgb[1], rgb[2], again);
      for (int k = 0; k < 4; ++k) ASSERT_EQ(again[k], stored[k]) << "mantissa " << m << ", exponent " << e;
    }
  }
}

// The largest mantissa is at least 128 and each is rounded to nearest: half a unit is at most 1/256 of the
// largest.
TEST(Rgbe, ErrorIsAtMostOnePartIn256OfTheLargestComponent) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-120, 126);
  for (int i = 0; i < 200000; ++i) {
    float rgb[3];
    for (float& value : rgb) value = std::exp2(exponent(random) / (i % 2 == 0 ? 1 : 60));
    std::uint8_t pixel[4];
    encode_rgbe(rgb[0], rgb[1], rgb[2], pixel);
    float back[3];
    decode_rgbe(&pixel[0], &pixel[1], &pixel[2], &pixel[3], 1, back);
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    for (int k = 0; k < 3; ++k) ASSERT_LE(std::abs(back[k] - rgb[k]), largest / 256);
    ASSERT_GE(std::max({pixel[0], pixel[1], pixel[2]}), 128);
  }
}

TEST(Hdr, EightOrientationsAreTurnedUpright) {
  struct Case {
    const char* resolution;
    std::vector<int> order;  // of the upright pixels 0 1 2 / 3 4 5
  };
  const std::vector<Case> cases = {{"-Y 2 +X 3", {0, 1, 2, 3, 4, 5}}, {"-Y 2 -X 3", {2, 1, 0, 5, 4, 3}},
                                   {"+Y 2 +X 3", {3, 4, 5, 0, 1, 2}}, {"+Y 2 -X 3", {5, 4, 3, 2, 1, 0}},
                                   {"+X 3 -Y 2", {0, 3, 1, 4, 2, 5}}, {"+X 3 +Y 2", {3, 0, 4, 1, 5, 2}},
                                   {"-X 3 -Y 2", {2, 5, 1, 4, 0, 3}}, {"-X 3 +Y 2", {5, 2, 4, 1, 3, 0}}};
  for (const Case& each : cases) {
    std::vector<int> pixels;
    for (const int k : each.order) pixels.insert(pixels.end(), {k + 10, k + 20, 200, 136});
    const Image image = decoded(picture("", each.resolution, pixels));
    ASSERT_EQ(image.width(), 3) << each.resolution;
    ASSERT_EQ(image.height(), 2);
    for (int k = 0; k < 6; ++k) {
      EXPECT_EQ(image.at(k % 3, k / 3)[0], static_cast<float>(k + 10)) << each.resolution;
      EXPECT_EQ(image.at(k % 3, k / 3)[1], static_cast<float>(k + 20)) << each.resolution;
    }
    const Bytes bytes = picture("", each.resolution, pixels);
    const auto reader = open(bytes, "test");
    Image blue_red(3, 2, 2);
    reader->read(0, std::vector<int>{2, 0}, blue_red.view());
    for (int k = 0; k < 6; ++k) {
      EXPECT_EQ(blue_red.at(k % 3, k / 3)[0], 200.0f);
      EXPECT_EQ(blue_red.at(k % 3, k / 3)[1], static_cast<float>(k + 10)) << each.resolution;
    }
  }
}

TEST(Hdr, OldRunsRepeatThePixelBefore) {
  // 7, 7·2 more, 9, then 1 + 1·256 more in two run pixels: 3 + 1 + 257 = 261 pixels.
  const Bytes bytes =
      picture("", "-Y 1 +X 261", {7, 200, 0, 136, 1, 1, 1, 2, 9, 200, 0, 136, 1, 1, 1, 1, 1, 1, 1, 1});
  const Image image = decoded(bytes);
  EXPECT_EQ(info_of(bytes).parts[0].compression, "rle");
  for (int x = 0; x < 261; ++x) EXPECT_EQ(value_at(image, x, 0), x < 3 ? 7 : 9);
  expect_truncation_is_an_error(bytes);
  expect_damage_is_survived(bytes);
}

TEST(Hdr, OldRunsAreChecked) {
  const auto message = [](const std::vector<int>& pixels) {
    return error_of([&] { decoded(picture("", "-Y 1 +X 9", pixels)); });
  };
  EXPECT_NE(message({1, 1, 1, 9, 1, 1, 1, 1}).find("begins with a run"), std::string::npos);
  EXPECT_NE(message({7, 7, 7, 136, 1, 1, 1, 9}).find("a run passes the end of the line"), std::string::npos);
  const std::vector<int> zeros = {7, 7, 7, 136, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1,
                                  1, 0, 1, 1,   1, 0, 1, 1, 1, 0, 1, 1, 1, 8};
  EXPECT_NE(message(zeros).find("a run passes the end of the line"), std::string::npos);
}

TEST(Hdr, ComponentRunsAreDecodedOneComponentAfterTheOther) {
  const std::vector<int> line = {2,       2,   0,  9,                            // nine pixels
                                 3,       10,  11, 12, 128 + 6, 13,              // red: 10 11 12 and six 13s
                                 128 + 9, 50,                                    // green
                                 9,       1,   2,  3,  4,       5,  6, 7, 8, 9,  // blue
                                 128 + 8, 136, 1,  137};                         // exponent
  const Bytes bytes = picture("", "-Y 1 +X 9", line);
  const Image image = decoded(bytes);
  for (int x = 0; x < 9; ++x) {
    const float scale = x < 8 ? 1 : 2;
    EXPECT_EQ(image.at(x, 0)[0], scale * static_cast<float>(std::min(10 + x, 13)));
    EXPECT_EQ(image.at(x, 0)[1], scale * 50);
    EXPECT_EQ(image.at(x, 0)[2], scale * static_cast<float>(x + 1));
  }
  expect_truncation_is_an_error(bytes);
  expect_damage_is_survived(bytes);
}

TEST(Hdr, ComponentRunsAreChecked) {
  const auto message = [](const std::vector<int>& pixels) {
    return error_of([&] { decoded(picture("", "-Y 1 +X 9", pixels)); });
  };
  EXPECT_EQ(message({2, 2, 0, 8, 137, 1, 137, 1}),
            "test: scan line 0: its length is given as 8, not 9 (byte 45)");
  EXPECT_NE(message({2, 2, 0, 9, 138, 1, 137, 1}).find("a run passes the end of the line (byte 49)"),
            std::string::npos);
  EXPECT_NE(message({2, 2, 0, 9, 0, 1, 137, 1}).find("a literal of length 0 (byte 49)"), std::string::npos);
}

TEST(Hdr, HeaderVariablesBecomeAttributes) {
  const Bytes bytes =
      picture("SOFTWARE=test 1.0\n# a remark\nrpict -vp 0 0 0\n", "-Y 1 +X 1", {128, 128, 128, 129});
  const FileInfo info = info_of(bytes);
  EXPECT_EQ(info.attributes.at("SOFTWARE"), "test 1.0");
  EXPECT_EQ(info.attributes.at("history"), "# a remark\nrpict -vp 0 0 0");
  EXPECT_EQ(info.attributes.count("FORMAT"), 0u);
  EXPECT_EQ(info.colour, Colour::linear);
  EXPECT_EQ(info.parts[0].compression, "none");
}

TEST(Hdr, ExposuresMultiplyUpAndAreDividedOut) {
  const Bytes bytes =
      picture("EXPOSURE=2\nCOLORCORR=1 4 0.5\nEXPOSURE= 4.0\n", "-Y 1 +X 1", {128, 128, 128, 136});
  const Image image = decoded(bytes);
  EXPECT_EQ(image.at(0, 0)[0], 16.0f);
  EXPECT_EQ(image.at(0, 0)[1], 4.0f);
  EXPECT_EQ(image.at(0, 0)[2], 32.0f);
  for (const char* unusable :
       {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=x\n", "EXPOSURE=nan\n", "COLORCORR=1 1\n"}) {
    const Bytes file = picture(unusable, "-Y 1 +X 1", {128, 128, 128, 136});
    EXPECT_EQ(decoded(file).at(0, 0)[0], 128.0f) << unusable;
    EXPECT_NE(info_of(file).warnings.at(0).find("is ignored"), std::string::npos) << unusable;
  }
}

TEST(Hdr, XyzeBecomesLinearRgb) {
  // The white of sRGB, D65: X = 0.9505, Y = 1, Z = 1.089, in units of 1/128.
  Bytes bytes = bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n");
  for (const int value : {122, 128, 139, 129}) bytes.push_back(static_cast<std::byte>(value));
  const Image image = decoded(bytes);
  // The stored bytes are off by up to half a unit of 1/128, which the matrix triples.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(0, 0)[k], 1, 3 * 0.5 / 128);
}

TEST(Hdr, MalformedHeadersAreErrors) {
  for (const char* text :
       {"#?", "#?RADIANCE", "#?RADIANCE\n", "#?RADIANCE\n\n", "#?RADIANCE\n\n-Y 1 +X 1", "#?RADIANCE\n\n\n",
        "#?RADIANCE\n\n-Y 1 +X\nabcd", "#?RADIANCE\n\n-Y 1 +Y 1\nabcd", "#?RADIANCE\n\n-Y a +X 1\nabcd",
        "#?RADIANCE\n\n-Y 1 +X 1 1\nabcd", "#?RADIANCE\n\nY 1 X 1\nabcd", "#?RADIANCE\n\n-Y -1 +X 1\nabcd",
        "#?RADIANCE\n\n-Y 0 +X 1\nabcd", "#?RADIANCE\n\n-Y 1 +X 99999999999999999999999\nabcd",
        "#?RADIANCE\n\n-Y 1048576 +X 1048576\nabcd", "#?RADIANCE\n\n-Y 1048576 +X 8\nabcd",
        "#?RADIANCE\nFORMAT=text\n\n-Y 1 +X 1\nabcd"}) {
    EXPECT_THROW(decoded(bytes_of(text)), Error) << text;
  }
}

TEST(Hdr, WrittenFilesComeBackToHalfAUnit) {
  // 7 and 32768 are beyond what component runs can have; 128 and 129 straddle the longest literal.
  for (const int width : {1, 7, 8, 9, 127, 128, 129, 300, 32767, 32768}) {
    Image image = noise(width, 3, 3);
    for (int i = 0; i < 3 * width; ++i) {
      image.at(0, 0)[i] = 0.5f;                              // one long run
      image.at(0, 1)[i] = (i / 15) % 2 == 0 ? 1.0f : 0.25f;  // runs of five
    }
    for (const char* compression : {"", "none"}) {
      WriteOptions options;
      options.compression = compression;
      WriteReport report;
      const Bytes bytes = encoded("hdr", image, options, &report);
      EXPECT_EQ(report.above + report.below + report.not_finite, 0u);
      const Image back = decoded(bytes);
      EXPECT_LE(largest_difference(image, back), 1.0f / 256);
      // What was read is already rounded, so writing it again changes nothing.
      EXPECT_EQ(encoded("hdr", back, options), bytes);
    }
  }
}

TEST(Hdr, RunsAreShorterThanFlat) {
  const Bytes runs = encoded("hdr", Image(1000, 10, 3));
  EXPECT_LT(runs.size(), 1000u);
  EXPECT_EQ(info_of(runs).parts[0].compression, "rle");
  WriteOptions options;
  options.compression = "none";
  EXPECT_GT(encoded("hdr", Image(1000, 10, 3), options).size(), 40000u);
}

TEST(Hdr, GreyIsStoredThreeTimes) {
  Image grey(9, 1, 1);
  for (int x = 0; x < 9; ++x) *grey.at(x, 0) = static_cast<float>(x) - 1;
  WriteReport report;
  const Image back = decoded(encoded("hdr", grey, {}, &report));
  EXPECT_EQ(report.below, 1u);
  for (int x = 0; x < 9; ++x) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(back.at(x, 0)[k], std::max(0.0f, static_cast<float>(x) - 1));
  }
}

TEST(Hdr, WhatCannotBeStoredIsCounted) {
  Image image(2, 1, 3);
  const float values[6] = {3e38f, INFINITY, NAN, -1, -INFINITY, 1};
  std::copy(values, values + 6, image.at(0, 0));
  WriteReport report;
  const Image back = decoded(encoded("hdr", image, {}, &report));
  EXPECT_EQ(report.above, 1u);
  EXPECT_EQ(report.below, 1u);
  EXPECT_EQ(report.not_finite, 3u);
  const float expected[6] = {kLargestRgbe, kLargestRgbe, 0, 0, 0, 1};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(back.at(0, 0)[i], expected[i]);
}

TEST(Hdr, AttributesAreWrittenExceptThoseOfOtherPixels) {
  WriteOptions options;
  options.attributes = {
      {"SOFTWARE", "two\nlines"}, {"EXPOSURE", "4"}, {"FORMAT", "x"}, {"history", "made\n\nby hand"}};
  const FileInfo info = info_of(encoded("hdr", noise(2, 2, 3), options));
  const std::map<std::string, std::string> expected = {{"SOFTWARE", "two lines"},
                                                       {"history", "made\nby hand"}};
  EXPECT_EQ(info.attributes, expected);
  options.attributes = {{"a=b", "c"}};
  EXPECT_THROW(encoded("hdr", noise(2, 2, 3), options), Error);
}

TEST(Hdr, SrgbIsUndoneWhenAskedFor) {
  ReadOptions reading;
  reading.colour = Colour::srgb;
  WriteOptions writing;
  writing.colour = Colour::srgb;
  const Image image = noise(20, 5, 3);
  const Image back = decoded(encoded("hdr", image, writing), reading);
  // Half a unit of 1/256 in the encoded value, times the steepest slope of decoding, 2.4/1.055.
  EXPECT_LE(largest_difference(image, back), 2.4f / 1.055f / 256);
}

TEST(Hdr, TruncationIsAnError) {
  expect_truncation_is_an_error(encoded("hdr", noise(20, 3, 3)));
  expect_truncation_is_an_error(encoded("hdr", noise(5, 3, 3)));
}

}  // namespace
}  // namespace welkin::io::test
