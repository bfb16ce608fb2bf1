// Radiance pictures of other and older writers: flat ones that look run-length coded, and variants of the
// header.

#include <algorithm>
#include <cmath>

#include "welkin/io/format.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

Bytes with_pixels(const std::string& header, const std::vector<int>& pixels) {
  Bytes bytes = bytes_of(header);
  for (const int value : pixels) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

Bytes picture(const std::string& resolution, const std::vector<int>& pixels) {
  return with_pixels("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n", pixels);
}

/// What a flat file of these bytes means, without asking how it may look.
void expect_flat(const Bytes& bytes, const std::vector<int>& pixels) {
  const Image image = decoded(bytes);
  EXPECT_EQ(info_of(bytes).parts[0].compression, "none");
  ASSERT_EQ(static_cast<std::size_t>(4 * image.width() * image.height()), pixels.size());
  for (std::size_t i = 0; i < pixels.size() / 4; ++i) {
    const int x = static_cast<int>(i) % image.width(), y = static_cast<int>(i) / image.width();
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = std::ldexp(pixels[4 * i + k], pixels[4 * i + 3] - 136);
      ASSERT_EQ(image.at(x, y)[k], static_cast<float>(expected)) << x << "," << y;
    }
  }
}

std::vector<int> grey(int width, int height, int (*value)(int x, int y)) {
  std::vector<int> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int v = value(x, y);
      pixels.insert(pixels.end(), {v, v, v, 128});
    }
  }
  return pixels;
}

TEST(HdrOldFiles, FlatPixelsThatLookLikeOldRunsAreFlat) {
  // One at the beginning, one inside, and several behind each other, whose counts would be multiplied up.
  for (const std::vector<int>& marks : {std::vector{0}, {1}, {4}, {1, 2, 3, 4}, {7}}) {
    std::vector<int> pixels = grey(4, 2, [](int x, int y) { return 9 + x + y; });
    for (const int mark : marks) std::fill_n(pixels.begin() + 4 * mark, 3, 1);
    expect_flat(picture("-Y 2 +X 4", pixels), pixels);
  }
}

TEST(HdrOldFiles, OneDarkPixelOfFixedExponentChangesNoOther) {
  const auto pixels = grey(200, 100, [](int x, int y) { return x == 10 && y == 50 ? 1 : y + 3; });
  expect_flat(picture("-Y 100 +X 200", pixels), pixels);
}

TEST(HdrOldFiles, FlatLinesThatBeginWithTwoTwoAreFlat) {
  // 2 2 and a third value below 128 begin a line of component runs; with 2 and 128 they even state the width
  // 640.
  const auto twos = grey(9, 3, [](int x, int y) { return x == 0 || y == 1 ? 2 : 7; });
  expect_flat(picture("-Y 3 +X 9", twos), twos);
  for (const int width : {640, 641}) {
    const auto pixels = grey(width, 4, [](int, int y) { return y + 1; });
    expect_flat(picture("-Y 4 +X " + std::to_string(width), pixels), pixels);
  }
  // The width 9 is stated by the first pixel of one line.
  auto stated = grey(9, 3, [](int x, int y) { return 10 + x + y; });
  const int head[] = {2, 2, 0, 9};
  std::copy(head, head + 4, stated.begin() + 36);
  expect_flat(picture("-Y 3 +X 9", stated), stated);
}

TEST(HdrOldFiles, AFewBytesMoreAreTold) {
  const auto pixels = grey(4, 2, [](int x, int) { return x == 1 ? 1 : 9; });
  Bytes bytes = picture("-Y 2 +X 4", pixels);
  bytes.push_back(std::byte{'\n'});
  expect_flat(bytes, pixels);
  ASSERT_EQ(info_of(bytes).warnings.size(), 1u);
  EXPECT_EQ(info_of(bytes).warnings[0], "1 bytes follow the pixels and are not read");
}

TEST(HdrOldFiles, NoiseByComponentsIsNotTakenForFlat) {
  // Runs don't shorten noise, so the file is as long as a flat one; cut off to exactly that, it is still
  // damaged.
  for (const int height : {1, 2, 5}) {
    Image image = noise(50, height, 3);
    for (int i = 0; i < 50 * height; ++i) {
      // Exponents without runs.
      for (int k = 0; k < 3; ++k)
        image.at(i % 50, i / 50)[k] = std::ldexp(image.at(i % 50, i / 50)[k], i % 7);
    }
    Bytes bytes = encoded("hdr", image);
    const std::size_t flat = static_cast<std::size_t>(4 * 50 * height);
    EXPECT_EQ(info_of(bytes).parts[0].compression, "rle");
    EXPECT_LE(largest_difference(decoded(bytes), image), 64.0f / 256);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t pixels_at = text.find('\n', text.find("-Y")) + 1;
    ASSERT_GT(bytes.size(), pixels_at + flat);
    bytes.resize(pixels_at + flat);
    EXPECT_THROW(decoded(bytes), Error);
  }
}

TEST(HdrOldFiles, ShorterFilesHaveOldRuns) {
  const Bytes bytes = picture("-Y 2 +X 4", {9, 9, 9, 128, 1, 1, 1, 3, 7, 7, 7, 128, 1, 1, 1, 3});
  const Image image = decoded(bytes);
  EXPECT_EQ(info_of(bytes).parts[0].compression, "rle");
  for (int x = 0; x < 4; ++x) {
    EXPECT_EQ(image.at(x, 0)[0], 9.0f / 256);
    EXPECT_EQ(image.at(x, 1)[0], 7.0f / 256);
  }
  // A flat file that was cut off is not read as runs in silence.
  auto pixels = grey(4, 4, [](int x, int) { return x == 1 ? 1 : 9; });
  pixels[7] = 3;  // a run to the end of the line
  pixels.resize(pixels.size() - 4);
  try {
    EXPECT_FALSE(info_of(picture("-Y 4 +X 4", pixels)).warnings.empty());
  } catch (const Error&) {
  }
}

const std::vector<int> kPixel = {200, 100, 150, 129};

TEST(HdrOldFiles, HeadersOfOtherWritersAreRead) {
  for (const std::string head :
       {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n", "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n",
        "#?AUTOPANO\nFORMAT=32-bit_rle_rgbe\nSOFTWARE=x\n\n", "#?RADIANCE\n\n", "FORMAT=32-bit_rle_rgbe\n\n",
        "Xim format\nFORMAT=32-bit_rle_rgbe\n\n", "oconv a.rad\nrpict -vp 0 0 0\n\n",
        "#?RADIANCE\nFORMAT = 32-bit_rle_rgbe \nVIEW= -vtv -vp 0 0 0\nGAMMA=1\nPIXASPECT=1.0\n\n"}) {
    for (const bool dos : {false, true}) {
      std::string text = head + "-Y 1 +X 1\n";
      for (std::size_t at = 0; dos && (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.insert(at, "\r");
      const Bytes bytes = with_pixels(text, kPixel);
      const FileInfo info = info_of(bytes);
      EXPECT_EQ(info.format, "hdr") << text;
      EXPECT_EQ(info.warnings.size(), head.starts_with("oconv") ? 1u : 0u) << text;
      EXPECT_EQ(decoded(bytes).at(0, 0)[0], 200.0f / 128) << text;
    }
  }
}

TEST(HdrOldFiles, OtherTextsAreNotTakenForPictures) {
  const auto hdr = hdr_format();
  const auto matches = [&](const std::string& text) { return hdr.matches(bytes_of(text)); };
  EXPECT_FALSE(matches(""));
  EXPECT_FALSE(matches("\n-Y 1 +X 1\nabcd"));
  EXPECT_FALSE(matches("Dear reader,\n\nthis is a letter.\n"));
  EXPECT_FALSE(matches("Dear reader,\n\n-Y 1 and +X 1 are axes.\n"));
  EXPECT_FALSE(matches("FORMAT=text\n\nabc\n"));
  EXPECT_FALSE(matches(std::string("a\1b\n\n-Y 1 +X 1\nabcd", 20)));
  EXPECT_FALSE(matches("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"));
  EXPECT_FALSE(matches(std::string(1 << 17, 'a') + "\n\n-Y 1 +X 1\nabcd"));
  EXPECT_TRUE(matches("a\n\n-Y 1 +X 1\nabcd"));
}

Bytes with_lines(const std::string& lines, const std::vector<int>& pixel = {128, 128, 128, 136}) {
  return with_pixels("#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n", pixel);
}

Declared declared_of(const Bytes& bytes, const ReadOptions& options = {}) {
  return hdr_format().open({bytes, "test", options})->declared();
}

TEST(HdrOldFiles, PrimariesAreDeclared) {
  const Chromaticities expected{{0.708, 0.292}, {0.17, 0.797}, {0.131, 0.046}, {0.3127, 0.329}};
  EXPECT_EQ(declared_of(with_lines("PRIMARIES= .708 .292 .170 .797 .131 .046 .3127 .329\n")).primaries,
            expected);
  EXPECT_FALSE(declared_of(with_lines("")).primaries);
  // Photoshop's way to say nothing.
  const Bytes zeros = with_lines("PRIMARIES=0 0 0 0 0 0 0 0\n");
  EXPECT_FALSE(declared_of(zeros).primaries);
  EXPECT_TRUE(info_of(zeros).warnings.empty());
  for (const char* unusable : {"PRIMARIES=1 2 3\n", "PRIMARIES=a\n", "PRIMARIES=.3 .3 .3 .3 .3 .3 .3 .3\n",
                               "PRIMARIES=.6 .3 .3 .6 .1 .1 .3 0\n", "PRIMARIES=.6 .3 .3 .6 .1 .1 .3 .3 9\n",
                               "PRIMARIES=nan .3 .3 .6 .1 .1 .3 .3\n"}) {
    const Bytes bytes = with_lines(unusable);
    EXPECT_FALSE(declared_of(bytes).primaries) << unusable;
    ASSERT_EQ(info_of(bytes).warnings.size(), 1u) << unusable;
    EXPECT_NE(info_of(bytes).warnings[0].find("is ignored"), std::string::npos);
  }
  const Bytes xyze = with_pixels(
      "#?RADIANCE\nFORMAT=32-bit_rle_xyze\nPRIMARIES=.6 .3 .3 .6 .1 .1 .3 .3\n\n-Y 1 +X 1\n", kPixel);
  EXPECT_FALSE(declared_of(xyze).primaries);
  EXPECT_EQ(info_of(xyze).warnings.size(), 1u);
}

TEST(HdrOldFiles, GammaIsDeclaredAndExposureDividesWhatIsLinear) {
  for (const char* lines : {"GAMMA=2\n", "GAMMA=0.5\n"}) {
    const Declared declared = declared_of(with_lines(lines));
    EXPECT_EQ(declared.curve, Curve::gamma);
    EXPECT_EQ(declared.gamma, 2);
    EXPECT_EQ(info_of(with_lines(lines)).warnings.size(), 1u);
  }
  EXPECT_EQ(declared_of(with_lines("GAMMA=1\n")).curve, Curve::none);
  EXPECT_TRUE(info_of(with_lines("GAMMA=1.0\n")).warnings.empty());
  EXPECT_EQ(declared_of(with_lines("GAMMA=0\n")).curve, Curve::none);
  EXPECT_EQ(info_of(with_lines("GAMMA=0\n")).warnings.size(), 1u);
  // (128/4)² = 128²/16.
  EXPECT_EQ(hdr_format().open({with_lines("EXPOSURE=16\nGAMMA=2\n"), "test", {}})->declared().gamma, 2);
  const Bytes exposed = with_lines("EXPOSURE=16\nGAMMA=2\n");
  const auto reader = hdr_format().open({exposed, "test", {}});
  EXPECT_EQ(read_part(*reader).at(0, 0)[0], 32.0f);
  // Who asks for linear values gets them as they are.
  ReadOptions linear;
  linear.colour = Colour::linear;
  EXPECT_EQ(declared_of(exposed, linear).curve, Curve::none);
  EXPECT_EQ(decoded(exposed, linear).at(0, 0)[0], 8.0f);
}

TEST(HdrOldFiles, LinesOfTheSourcesSayNothingOfThePicture) {
  const Bytes bytes =
      with_lines("pcomb a.hdr\n\tEXPOSURE=4\n\tFORMAT=32-bit_rle_xyze\n\tPRIMARIES=1\n EXPOSURE=9\n");
  EXPECT_EQ(decoded(bytes).at(0, 0)[0], 128.0f);
  EXPECT_TRUE(info_of(bytes).warnings.empty());
}

TEST(HdrOldFiles, WhatIsNotObeyedIsWarnedOf) {
  for (const char* lines : {"PIXASPECT=0.5\n", "PIXASPECT=x\n", "EXPOSURE=x\n", "EXPOSURE = 0\n"})
    EXPECT_EQ(info_of(with_lines(lines)).warnings.size(), 1u) << lines;
  EXPECT_TRUE(info_of(with_lines("PIXASPECT=1\n")).warnings.empty());
}

TEST(HdrOldFiles, WhatWasObeyedIsNotWrittenAgain) {
  const Bytes bytes = with_lines("GAMMA=2\nPRIMARIES=.6 .3 .3 .6 .1 .1 .3 .3\nPIXASPECT=2\nSOFTWARE=x\n");
  WriteOptions options;
  options.attributes = info_of(bytes).attributes;
  const std::map<std::string, std::string> expected = {{"SOFTWARE", "x"}};
  EXPECT_EQ(info_of(encoded("hdr", noise(2, 2, 3), options)).attributes, expected);
}

}  // namespace
}  // namespace welkin::io::test
