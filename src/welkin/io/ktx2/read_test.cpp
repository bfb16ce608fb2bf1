// KTX2 files as other writers make them.

#include <algorithm>
#include <cmath>

#include "welkin/io/byte_order.h"
#include "welkin/io/ktx2/ktx2_test_files.h"

namespace welkin::io::test {
namespace {

TEST(Ktx2Read, ReadsTheFormatsOfOtherWriters) {
  struct Case {
    std::uint32_t format, type_size;
    std::vector<std::string> channels;
    PixelType type;
    Colour colour;
  };
  using enum PixelType;
  const std::vector<std::string> r{"R"}, rg{"R", "G"}, rgb{"R", "G", "B"}, rgba{"R", "G", "B", "A"};
  const std::vector<Case> cases = {
      {9, 1, r, uint8, Colour::linear},       {23, 1, rgb, uint8, Colour::linear},
      {29, 1, rgb, uint8, Colour::srgb},      {37, 1, rgba, uint8, Colour::linear},
      {43, 1, rgba, uint8, Colour::srgb},     {50, 1, rgba, uint8, Colour::srgb},
      {91, 2, rgba, uint16, Colour::linear},  {76, 2, r, half, Colour::linear},
      {83, 2, rg, half, Colour::linear},      {90, 2, rgb, half, Colour::linear},
      {100, 4, r, float32, Colour::linear},   {103, 4, rg, float32, Colour::linear},
      {106, 4, rgb, float32, Colour::linear}, {30, 1, rgb, uint8, Colour::linear}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.format);
    const std::size_t texel = c.type_size * c.channels.size();
    Bytes texels(6 * texel);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::byte>(i * 3 % 60);
    const Bytes bytes =
        file_of({.format = c.format, .type_size = c.type_size, .texel_bytes = texel, .width = 3, .height = 2},
                texels);
    const auto reader = open(bytes, "other.ktx2");
    EXPECT_EQ(reader->info().parts.at(0).channels, c.channels);
    EXPECT_EQ(reader->info().parts.at(0).type, c.type);
    EXPECT_EQ(reader->info().colour, c.colour);
    const Image image = read_part(*reader);
    if (c.type == uint8 && c.colour == Colour::linear) {
      const std::size_t red = c.format == 30 ? 2 : 0;
      EXPECT_EQ(image.at(1, 0)[0], static_cast<float>(std::to_integer<int>(texels[texel + red])) / 255);
    }
    if (c.type == float32) {
      EXPECT_EQ(image.at(2, 1)[0], load_native<float>(&texels[5 * texel]));
    }
    if (c.format == 43) {
      EXPECT_EQ(image.at(1, 0)[3], static_cast<float>(std::to_integer<int>(texels[7])) / 255);
    }
  }
}

TEST(Ktx2Read, OtherOrientationsAreTurnedUpright) {
  Bytes texels(6);
  for (std::size_t i = 0; i < 6; ++i) texels[i] = static_cast<std::byte>(51 * i);  // i/5 of white
  const auto rows = [&](const std::string& orientation) {
    OtherFile file{.format = 9, .type_size = 1, .texel_bytes = 1, .width = 3, .height = 2};
    if (!orientation.empty()) file.keys = key("KTXorientation", orientation + '\0');
    const Bytes bytes = file_of(file, texels);
    const Image image = decoded(bytes);
    std::string text;
    for (int i = 0; i < 6; ++i) text += std::to_string(std::lround(5 * image.at(i % 3, i / 3)[0]));
    EXPECT_EQ(info_of(bytes).notes.size(), orientation.empty() || orientation == "rd" ? 0u : 1u);
    return text;
  };
  EXPECT_EQ(rows(""), "012345");
  EXPECT_EQ(rows("rd"), "012345");
  EXPECT_EQ(rows("ru"), "345012");
  EXPECT_EQ(rows("ld"), "210543");
  EXPECT_EQ(rows("lu"), "543210");
  EXPECT_NE(error_of([&] { rows("xx"); }).find("KTXorientation is 'xx'"), std::string::npos);
  OtherFile cube{.format = 9, .type_size = 1, .texel_bytes = 1, .width = 1, .height = 1, .faces = 6};
  cube.keys = key("KTXorientation", "ru");
  EXPECT_NE(error_of([&] { info_of(file_of(cube, texels)); }).find("where the format demands rd"),
            std::string::npos);
}

TEST(Ktx2Read, UnusualTexturesAreReadAndNoted) {
  const auto notes = [](const OtherFile& file) {
    const FileInfo info =
        info_of(file_of(file, Bytes(file.width * std::max(1u, file.height) * file.texel_bytes)));
    std::string text;
    for (const std::string& note : info.notes) text += note + "; ";
    return text;
  };
  const OtherFile plain{.format = 9, .type_size = 1, .texel_bytes = 1, .width = 3, .height = 2};
  OtherFile file = plain;
  file.levels = 0;
  EXPECT_NE(notes(file).find("other levels are to be made"), std::string::npos);
  file = plain;
  file.height = 0;
  EXPECT_NE(notes(file).find("one dimension"), std::string::npos);
  file = plain;
  file.keys = key("numbers", std::string("\1\0\2\0", 4));
  EXPECT_NE(notes(file).find("numbers: 4 bytes that are not text"), std::string::npos);
}

TEST(Ktx2Read, ZlibIsRead) {
  // The stored block of RFC 1951 with the header and the Adler-32 of RFC 1950, for the texels 1 2 3 4.
  const Bytes packed =
      bytes_of(std::string("\x78\x01\x01\x04\x00\xfb\xff\x01\x02\x03\x04\x00\x18\x00\x0b", 15));
  OtherFile file{
      .format = 9, .type_size = 1, .texel_bytes = 1, .width = 2, .height = 2, .scheme = 3, .unpacked = 4};
  const Bytes bytes = file_of(file, packed);
  EXPECT_EQ(info_of(bytes).parts[0].compression, "zlib");
  const Image image = decoded(bytes);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(image.at(i % 2, i / 2)[0], static_cast<float>(i + 1) / 255);
}

TEST(Ktx2Read, ChannelsAreReadInAnyOrder) {
  const Texture texture(5, 4, 1, 1, 1, 4);
  for (const auto type : {PixelType::float32, PixelType::r11g11b10}) {
    WriteOptions options;
    options.type = type;
    const Texture rgb(5, 4, 1, 1, 1, 3);
    const Bytes bytes = type == PixelType::float32 ? texture.encoded() : rgb.encoded(options);
    const auto reader = open(bytes, "a");
    const Image all = read_part(*reader);
    const int order[] = {2, 0, 2};
    Image some(5, 4, 3);
    reader->read(0, order, some.view());
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x)
        for (int k = 0; k < 3; ++k) EXPECT_EQ(some.at(x, y)[k], all.at(x, y)[order[k]]);
  }
}

}  // namespace
}  // namespace welkin::io::test
