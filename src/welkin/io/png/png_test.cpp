#include <zlib.h>

#include <cmath>

#include "welkin/io/test_pictures.h"
#include "welkin/io/transfer.h"

namespace welkin::io::test {
namespace {

using Values = std::vector<int>;

std::string big_endian(std::size_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 255);
  return text;
}

std::string text_of(const Values& values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
  return big_endian(data.size()) + body + big_endian(crc32(0, bytes, static_cast<uInt>(body.size())));
}

/// A PNG made by hand: `rows` are filtered rows, `extra` the chunks before the pixels.
Bytes picture(int width, int height, int depth, int colour_type, const Values& rows,
              const std::string& extra = "", bool interlaced = false) {
  const std::string raw = text_of(rows);
  std::string packed(compressBound(static_cast<uLong>(raw.size())), 0);
  auto packed_size = static_cast<uLongf>(packed.size());
  compress(reinterpret_cast<Bytef*>(packed.data()), &packed_size, reinterpret_cast<const Bytef*>(raw.data()),
           static_cast<uLong>(raw.size()));
  packed.resize(packed_size);
  const std::string header = big_endian(static_cast<std::size_t>(width)) +
                             big_endian(static_cast<std::size_t>(height)) +
                             text_of({depth, colour_type, 0, 0, interlaced ? 1 : 0});
  return bytes_of("\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + extra + chunk("IDAT", packed) +
                  chunk("IEND", ""));
}

constexpr int kGrey = 0, kColour = 2, kPalette = 3, kGreyAlpha = 4, kColourAlpha = 6;

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
        // Half a code, steepened by decoding.
        const float levels = type == PixelType::uint8 ? 255.0f : 65535.0f;
        EXPECT_LE(largest_difference(once, noise(33, 70, channels)), 0.5f / levels * 2.4f / 1.055f + 1e-7f);
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

TEST(Png, ColourIsSrgbAndAlphaLinear) {
  const Image image = decoded(picture(1, 1, 8, kColourAlpha, {0, 10, 128, 255, 128}));
  EXPECT_EQ(image.at(0, 0)[0], linear8(10));
  EXPECT_EQ(image.at(0, 0)[1], linear8(128));
  EXPECT_EQ(image.at(0, 0)[2], 1.0f);
  EXPECT_EQ(image.at(0, 0)[3], 128.0f / 255);
}

TEST(Png, SixteenBitValuesAreBigEndian) {
  const Image image = decoded(picture(1, 1, 16, kGreyAlpha, {0, 0x12, 0x34, 0x80, 0x00}));
  EXPECT_EQ(image.at(0, 0)[0], static_cast<float>(srgb_to_linear(0x1234 / 65535.0)));
  EXPECT_EQ(image.at(0, 0)[1], static_cast<float>(0x8000 / 65535.0));
}

TEST(Png, PaletteWithTransparencyIsExpanded) {
  const Bytes bytes =
      picture(3, 1, 2, kPalette, {0, 0b00011000},
              chunk("PLTE", text_of({255, 0, 0, 0, 255, 0, 0, 0, 255})) + chunk("tRNS", text_of({0, 51})));
  const Image image = decoded(bytes);
  ASSERT_EQ(image.channels(), 4);
  const float expected[12] = {1, 0, 0, 0, 0, 1, 0, 0.2f, 0, 0, 1, 1};
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
  const Bytes perceptual_quantiser = picture(1, 1, 8, kGrey, {0, 128}, chunk("cICP", text_of({9, 16, 0, 1})));
  EXPECT_NE(info_of(perceptual_quantiser).notes.at(0).find("transfer function 16"), std::string::npos);
  ReadOptions options;
  options.colour = Colour::linear;
  EXPECT_EQ(*decoded(picture(1, 1, 8, kGrey, {0, 51}), options).at(0, 0), 0.2f);
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
