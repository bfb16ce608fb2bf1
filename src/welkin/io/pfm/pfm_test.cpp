#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// A file of these floats in the given byte order.
Bytes picture(const std::string& header, const std::vector<float>& values, bool big_endian) {
  Bytes bytes = bytes_of(header);
  for (const float value : values) {
    auto stored = std::bit_cast<std::array<std::byte, 4>>(value);
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(stored.begin(), stored.end());
    bytes.insert(bytes.end(), stored.begin(), stored.end());
  }
  return bytes;
}

TEST(Pfm, RowsGoFromTheBottomUpInBothByteOrders) {
  const std::vector<float> values = {1, 2, 3, 4, 5, 6};
  for (const bool big : {false, true}) {
    const Image image = decoded(picture(big ? "Pf\n2 3\n1.0\n" : "Pf\n2 3\n-1.0\n", values, big));
    ASSERT_EQ(image.channels(), 1);
    EXPECT_EQ(*image.at(0, 2), 1);
    EXPECT_EQ(*image.at(1, 2), 2);
    EXPECT_EQ(*image.at(0, 0), 5);
    EXPECT_EQ(*image.at(1, 0), 6);
  }
}

TEST(Pfm, ColourHasThreeChannels) {
  const Image image = decoded(picture("PF 1 1 1 ", {-1, 2e30f, 3}, true));
  EXPECT_EQ(image.channels(), 3);
  EXPECT_EQ(image.at(0, 0)[0], -1);
  EXPECT_EQ(image.at(0, 0)[1], 2e30f);
}

TEST(Pfm, ScaleIsAnAttributeAndMultipliesNothing) {
  const Bytes bytes = picture("Pf\n1 1\n-2.50\n", {7}, false);
  EXPECT_EQ(info_of(bytes).attributes.at("pfm:scale"), "2.50");
  EXPECT_EQ(info_of(bytes).warnings.size(), 1u);
  EXPECT_EQ(*decoded(bytes).at(0, 0), 7);
  WriteOptions options;
  options.attributes = info_of(bytes).attributes;
  EXPECT_EQ(encoded("pfm", decoded(bytes), options), bytes);
  options.attributes["pfm:scale"] = "-1\n";
  EXPECT_THROW(encoded("pfm", decoded(bytes), options), Error);
}

TEST(Pfm, EveryFloatComesBackBitForBit) {
  for (const int channels : {1, 3}) {
    Image image = noise(37, 23, channels);
    const float special[] = {NAN, INFINITY, -INFINITY, -0.0f, 1e-45f, -3e38f};
    std::copy(special, special + 6, image.at(0, 0));
    WriteReport report;
    const Bytes bytes = encoded("pfm", image, {}, &report);
    EXPECT_EQ(report.not_finite + report.above + report.below, 0u);
    expect_same(decoded(bytes), image);
  }
}

TEST(Pfm, SrgbIsUndoneWhenAskedFor) {
  ReadOptions reading;
  reading.colour = Colour::srgb;
  WriteOptions writing;
  writing.colour = Colour::srgb;
  const Image image = noise(9, 5, 3);
  // Two roundings to float of values below 1, the first steepened by up to 2.4/1.055; and the knee's step of
  // 3e-8.
  EXPECT_LE(largest_difference(decoded(encoded("pfm", image, writing), reading), image), 3e-7f);
}

TEST(Pfm, FourChannelsHaveAlpha) {
  for (const bool big : {false, true}) {
    const Bytes bytes = picture(big ? "PF4\n1 2\n1\n" : "PF4\n1 2\n-1\n", {1, 2, 3, 0.5f, 5, 6, 7, 1}, big);
    const std::vector<std::string> rgba = {"R", "G", "B", "A"};
    EXPECT_EQ(info_of(bytes).parts[0].channels, rgba);
    const Image image = decoded(bytes);
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(image.at(0, 1)[k], std::vector<float>({1, 2, 3, 0.5f})[static_cast<std::size_t>(k)]);
    EXPECT_EQ(image.at(0, 0)[2], 7);
    expect_truncation_is_an_error(bytes);
  }
}

TEST(Pfm, CommentsAndAnyWhiteSpaceAreSkipped) {
  for (const char* header : {"Pf\n# by hand\n2 1\n-1.0\n", "Pf # a\n# b\n2 # c\n1\n#\n-1.0\n",
                             "Pf\t2\v1\f-1 ", "Pf\r2 1\r-1\r", "Pf\r\n2 1\r\n-1\r\n", "Pf\n2\n1\n-1e0\n"}) {
    const Bytes bytes = picture(header, {3, 4}, false);
    EXPECT_EQ(*decoded(bytes).at(1, 0), 4) << header;
    EXPECT_TRUE(info_of(bytes).warnings.empty()) << header;
  }
  EXPECT_EQ(*decoded(picture("Pf\n2 1\n+1.0\n", {3, 4}, true)).at(1, 0), 4);
  // A carriage return alone, before a pixel whose first byte is a line feed.
  const float pixel = std::bit_cast<float>(0x3f80000au);
  EXPECT_EQ(*decoded(picture("Pf\n1 1\n-1\r", {pixel}, false)).at(0, 0), pixel);
}

TEST(Pfm, ScalesThatAreNoneAreRefused) {
  for (const std::string scale : {"0", "-0.0", "nan", "inf", "-inf", "1x", "--1", "1e999", "x"}) {
    const std::string message = error_of([&] { decoded(picture("Pf\n1 1\n" + scale + "\n", {1}, false)); });
    EXPECT_NE(message.find("the scale '" + scale + "', whose sign tells the order of bytes"),
              std::string::npos)
        << message;
  }
}

TEST(Pfm, LengthMustFit) {
  const Bytes bytes = picture("PF\r\n2 2\r\n-1\r\n", std::vector<float>(12, 1.0f), false);
  EXPECT_EQ(decoded(bytes).at(1, 1)[2], 1);
  expect_truncation_is_an_error(bytes);
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_EQ(info_of(longer).warnings.back(), "1 bytes follow the pixels and are not read");
  expect_damage_is_survived(bytes);
}

TEST(Pfm, MalformedHeadersAreErrors) {
  for (const char* text :
       {"PF\n", "PF\n1", "PF\n1 1\n", "PF\n1 1\n1", "PF\n1 1\n0\n............", "PF\n1 1\nx\n............",
        "PF\n1 1\nnan\n............", "PF\n-1 1\n1\n............", "PF\n0 1\n1\n............",
        "PF\n99999999999999999999 1\n1\n............", "PF\n1048576 1048576\n1\n............",
        "PF\n4294967297 1\n1\n............"}) {
    EXPECT_THROW(decoded(bytes_of(text)), Error) << text;
  }
}

}  // namespace
}  // namespace welkin::io::test
