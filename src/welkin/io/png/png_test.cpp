#include <cmath>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/png/png_test_files.h"

namespace welkin::io::test {
namespace {

float linear8(int k) {
  return static_cast<float>(srgb_to_linear(k / 255.0));
}

TEST(Png, EveryTypeAndChannelCountComesBackExactly) {
  for (const PixelType type : {PixelType::uint8, PixelType::uint16}) {
    for (const Colour colour : {Colour::srgb, Colour::linear}) {
      for (int channels = 1; channels <= 4; ++channels) {
        WriteOptions options;
        options.type = type;
        options.colour = colour;
        const Bytes bytes = encoded("png", noise(33, 70, channels), options);
        const FileInfo info = info_of(bytes);
        EXPECT_EQ(info.colour, colour);
        EXPECT_EQ(info.parts[0].type, type);
        EXPECT_EQ(info.parts[0].channels, names_of(channels));
        // The first writing rounds; from then on nothing may change.
        const Image once = decoded(bytes);
        expect_same(decoded(encoded("png", once, options)), once);
        // Half a code, steepened by decoding; of the product with alpha, half a code of that too.
        const float levels = type == PixelType::uint8 ? 255.0f : 65535.0f;
        const float steepness = 2.4f / 1.055f + (channels % 2 == 0 ? 1 : 0);
        EXPECT_LE(largest_difference(once, noise(33, 70, channels)), 0.5f / levels * steepness + 1e-7f);
      }
    }
  }
}

TEST(Png, SixteenBitsIsTheDefaultAndUncompressedIsPossible) {
  const Image image = noise(8, 8, 3);
  EXPECT_EQ(info_of(encoded("png", image)).parts[0].type, PixelType::uint16);
  WriteOptions options;
  options.compression = "none";
  expect_same(decoded(encoded("png", image, options)), decoded(encoded("png", image)));
}

TEST(Png, ColourIsSrgbAndAlphaLinearAndMultipliedIn) {
  const Bytes bytes = picture(1, 1, 8, kColourAlpha, {0, 10, 128, 255, 128});
  const Image image = decoded(bytes);
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], linear8(10) * 128 / 255);
  EXPECT_FLOAT_EQ(image.at(0, 0)[1], linear8(128) * 128 / 255);
  EXPECT_EQ(image.at(0, 0)[2], 128.0f / 255);
  EXPECT_EQ(image.at(0, 0)[3], 128.0f / 255);
  // Colours alone are as they are stored.
  Image colours(1, 1, 3);
  open(bytes, "test")->read(0, std::vector{0, 1, 2}, colours.view());
  EXPECT_EQ(colours.at(0, 0)[0], linear8(10));
  EXPECT_EQ(colours.at(0, 0)[2], 1.0f);
}

TEST(Png, AssociatedColoursAreWrittenStraight) {
  Image image(2, 1, 4);
  const float pixels[8] = {0.25f, 0.25f, 0.25f, 0.5f, 0, 0, 0, 0};
  std::copy_n(pixels, 8, image.at(0, 0));
  WriteOptions options;
  options.type = PixelType::uint8;
  const Bytes bytes = encoded("png", image, options);
  // 0.25 of half a pixel is 0.5 of the whole: 188.
  Image colours(2, 1, 3);
  open(bytes, "test")->read(0, std::vector{0, 1, 2}, colours.view());
  EXPECT_EQ(colours.at(0, 0)[0], linear8(188));
  EXPECT_EQ(colours.at(1, 0)[0], 0.0f);
  EXPECT_FLOAT_EQ(decoded(bytes).at(0, 0)[0], linear8(188) * 128 / 255);
}

TEST(Png, SixteenBitValuesAreBigEndian) {
  const Image image = decoded(picture(1, 1, 16, kGreyAlpha, {0, 0x12, 0x34, 0x80, 0x00}));
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], static_cast<float>(srgb_to_linear(0x1234 / 65535.0) * 0x8000 / 65535));
  EXPECT_EQ(image.at(0, 0)[1], static_cast<float>(0x8000 / 65535.0));
}

TEST(Png, PaletteWithTransparencyIsExpanded) {
  const Bytes bytes =
      picture(3, 1, 2, kPalette, {0, 0b00011000},
              chunk("PLTE", text_of({255, 0, 0, 0, 255, 0, 0, 0, 255})) + chunk("tRNS", text_of({0, 51})));
  const Image image = decoded(bytes);
  ASSERT_EQ(image.channels(), 4);
  const float expected[12] = {0, 0, 0, 0, 0, 0.2f, 0, 0.2f, 0, 0, 1, 1};
  for (int i = 0; i < 12; ++i) EXPECT_EQ(image.at(0, 0)[i], expected[i]);
  EXPECT_EQ(info_of(bytes).notes.at(0), "expanded from 2-bit palette");
}

TEST(Png, BilevelGreyIsExpanded) {
  const Bytes bytes = picture(9, 1, 1, kGrey, {0, 0b10100000, 0b10000000});
  const Image image = decoded(bytes);
  ASSERT_EQ(image.channels(), 1);
  for (int x = 0; x < 9; ++x) EXPECT_EQ(*image.at(x, 0), x == 0 || x == 2 || x == 8 ? 1.0f : 0.0f);
}

TEST(Png, TransparentColourBecomesAlpha) {
  const Image image = decoded(picture(2, 1, 8, kGrey, {0, 7, 8}, chunk("tRNS", text_of({0, 7}))));
  ASSERT_EQ(image.channels(), 2);
  EXPECT_EQ(image.at(0, 0)[1], 0.0f);
  EXPECT_EQ(image.at(1, 0)[1], 1.0f);
}

TEST(Png, InterlacedRowsAreSpread) {
  // Adam7 of 2×2: pass 1 holds (0,0), pass 6 (1,0), pass 7 row 1.
  const Bytes bytes = picture(2, 2, 8, kGrey, {0, 10, 0, 20, 0, 30, 40}, "", true);
  const Image image = decoded(bytes);
  const int expected[4] = {10, 20, 30, 40};
  for (int k = 0; k < 4; ++k) EXPECT_EQ(*image.at(k % 2, k / 2), linear8(expected[k]));
  EXPECT_EQ(info_of(bytes).notes.at(0), "interlaced");
  expect_truncation_is_an_error(bytes);
}

TEST(Png, ChunksDecideTheColour) {
  const auto colour_with = [](const std::string& extra) {
    return info_of(picture(1, 1, 8, kGrey, {0, 128}, extra)).colour;
  };
  const std::string linear_gamma = chunk("gAMA", big_endian(100000));
  EXPECT_EQ(colour_with(""), Colour::srgb);
  EXPECT_EQ(colour_with(linear_gamma), Colour::linear);
  EXPECT_EQ(colour_with(chunk("gAMA", big_endian(45455))), Colour::srgb);
  EXPECT_EQ(colour_with(chunk("sRGB", text_of({0})) + linear_gamma), Colour::srgb);
  EXPECT_EQ(colour_with(chunk("cICP", text_of({1, 8, 0, 1}))), Colour::linear);
  EXPECT_EQ(colour_with(chunk("cICP", text_of({1, 13, 0, 1})) + linear_gamma), Colour::srgb);
  const Bytes unknown = picture(1, 1, 8, kGrey, {0, 128}, chunk("cICP", text_of({1, 7, 0, 1})));
  EXPECT_EQ(info_of(unknown).warnings.size(), 1u);
  ReadOptions options;
  options.colour = Colour::linear;
  EXPECT_EQ(*decoded(picture(1, 1, 8, kGrey, {0, 51}), options).at(0, 0), 0.2f);
}

/// The first pixel of a PNG of one pixel with these chunks.
std::vector<float> pixel_with(const Values& row, int depth, const std::string& chunks,
                              const ReadOptions& options = {}) {
  const Image image = decoded(picture(1, 1, depth, kColour, row, chunks), options);
  return {image.at(0, 0), image.at(0, 0) + 3};
}

TEST(Png, PowersAndPrimariesAreConverted) {
  // 2.2: 0.5^2.2. The primaries are sRGB's own, so nothing else changes.
  const std::string gamma = chunk("gAMA", big_endian(55556));
  EXPECT_NEAR(pixel_with({0, 51, 102, 255}, 8, gamma)[1], std::pow(0.4, 1 / 0.55556), 1e-6);
  ReadOptions linear;
  linear.colour = Colour::linear;
  EXPECT_EQ(pixel_with({0, 51, 102, 255}, 8, gamma, linear)[1], 0.4f);
  // Display P3's red lies outside BT.709 (Apple's profile and CSS Color 4: 1.2249 −0.0421 −0.0196).
  std::string numbers;
  for (const std::size_t n : {31270u, 32900u, 68000u, 32000u, 26500u, 69000u, 15000u, 6000u})
    numbers += big_endian(n);
  const std::string p3 = chunk("gAMA", big_endian(45455)) + chunk("cHRM", numbers);
  const std::vector<float> red = pixel_with({0, 255, 0, 0}, 8, p3);
  EXPECT_NEAR(red[0], 1.2249, 1e-4);
  EXPECT_NEAR(red[1], -0.0421, 1e-4);
  EXPECT_NEAR(red[2], -0.0196, 1e-4);
  const std::vector<float> white = pixel_with({0, 255, 255, 255}, 8, p3);
  for (const float value : white) EXPECT_NEAR(value, 1, 1e-6);
  ReadOptions keep;
  keep.keep_primaries = true;
  EXPECT_EQ(pixel_with({0, 255, 0, 0}, 8, p3, keep), (std::vector<float>{1, 0, 0}));
}

TEST(Png, PqAndHlgBecomeLinearOfDiffuseWhite) {
  const auto words = [](int value) {
    return Values{0, value >> 8, value & 255, value >> 8, value & 255, value >> 8, value & 255};
  };
  const std::string pq = chunk("cICP", text_of({9, 16, 0, 1})), hlg = chunk("cICP", text_of({9, 18, 0, 1}));
  // ITU-R BT.2408: 203 cd/m² is 58.07 % of PQ and 75 % of HLG, 1000 cd/m² 75.18 % of PQ and 100 % of HLG.
  for (const float value : pixel_with(words(38059), 16, pq)) EXPECT_NEAR(value, 1, 1e-3);
  for (const float value : pixel_with(words(49269), 16, pq)) EXPECT_NEAR(value, 1000.0 / 203, 5e-3);
  for (const float value : pixel_with(words(65535), 16, pq)) EXPECT_NEAR(value, 10000.0 / 203, 1e-3);
  for (const float value : pixel_with(words(49151), 16, hlg)) EXPECT_NEAR(value, 1, 5e-3);
  for (const float value : pixel_with(words(65535), 16, hlg)) EXPECT_NEAR(value, 1000.0 / 203, 1e-3);
}

TEST(Png, ExifOrientationIsApplied) {
  // Stored 2×1, to be shown turned clockwise: what was left is on top.
  const std::string exif = std::string("MM\0*\0\0\0\x8\0\1\1\x12\0\3\0\0\0\1\0\6\0\0\0\0\0\0", 26);
  const Image image = decoded(picture(2, 1, 8, kGrey, {0, 10, 20}, chunk("eXIf", exif)));
  ASSERT_EQ(image.width(), 1);
  ASSERT_EQ(image.height(), 2);
  EXPECT_EQ(*image.at(0, 0), linear8(10));
  EXPECT_EQ(*image.at(0, 1), linear8(20));
}

TEST(Png, TextGoesBothWays) {
  WriteOptions options;
  options.attributes = {{"Title", "a sky"}, {"Author", "Zo\xc3\xab"}, {"Lines", "one\ntwo"}, {"Empty", ""}};
  EXPECT_EQ(info_of(encoded("png", noise(2, 2, 3), options)).attributes, options.attributes);
  const Bytes latin1 = picture(1, 1, 8, kGrey, {0, 1}, chunk("tEXt", std::string("Author\0Zo\xeb", 10)));
  EXPECT_EQ(info_of(latin1).attributes.at("Author"), "Zo\xc3\xab");
  for (const std::string key : {"", " a", "a ", "a  b", "line\n"}) {
    WriteOptions bad;
    bad.attributes = {{key, "x"}};
    EXPECT_THROW(encoded("png", noise(2, 2, 3), bad), Error) << "'" << key << "'";
  }
  WriteOptions longest;
  longest.attributes = {{std::string(80, 'k'), "x"}};
  EXPECT_THROW(encoded("png", noise(2, 2, 3), longest), Error);
}

TEST(Png, TruncationIsAnError) {
  expect_truncation_is_an_error(encoded("png", noise(7, 5, 3)));
  const std::string message = error_of([] {
    const Bytes bytes = picture(1, 1, 8, kGrey, {0, 1});
    decoded(Bytes(bytes.begin(), bytes.begin() + 50));
  });
  EXPECT_EQ(message, "test: ends early: a chunk passes the end of the file (byte 33)");
}

TEST(Png, WrongChecksumIsAnError) {
  Bytes bytes = picture(1, 1, 8, kGrey, {0, 1});
  bytes[bytes.size() - 14] ^= std::byte{1};
  EXPECT_THROW(decoded(bytes), Error);
}

TEST(Png, AbsurdSizesAreErrors) {
  EXPECT_THROW(decoded(picture(1 << 21, 1, 8, kGrey, {0, 1})), Error);
  EXPECT_THROW(decoded(picture(1 << 20, 1 << 20, 8, kGrey, {0, 1})), Error);
  const std::string message = error_of([] { info_of(picture(1 << 14, 1 << 14, 8, kColour, {0, 1})); });
  EXPECT_NE(message.find("bytes cannot hold 16384×16384 pixels"), std::string::npos) << message;
}

}  // namespace
}  // namespace welkin::io::test
