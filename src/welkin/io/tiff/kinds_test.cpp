// TIFF's less common samples, and what a file says of its orientation, alpha and colours.

#include <bit>
#include <cmath>

#include "welkin/io/format.h"
#include "welkin/io/tiff/samples.h"
#include "welkin/io/tiff/tiff_test_files.h"

namespace welkin::io::test {
namespace {

ReadOptions linear() {
  ReadOptions options;
  options.colour = Colour::linear;
  return options;
}

Bytes integers(const std::vector<std::uint32_t>& values, int bytes, bool big = false) {
  Bytes data;
  for (const std::uint32_t value : values) put(data, value, bytes, big);
  return data;
}

void expect_values(const Bytes& file, const std::vector<double>& values) {
  const Image image = decoded(file, linear());
  ASSERT_EQ(static_cast<std::size_t>(image.width() * image.height() * image.channels()), values.size());
  const std::size_t row = static_cast<std::size_t>(image.width() * image.channels());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(image.view().row(static_cast<int>(i / row))[i % row], static_cast<float>(values[i])) << i;
}

TEST(TiffKinds, SignedIntegersKeepTheirSign) {
  for (const bool big : {false, true}) {
    OtherTiff tiff{.width = 4, .bits = 8, .format = 2, .big_endian = big};
    tiff.data = integers({127, 0, 0xff, 0x80}, 1, big);
    expect_values(tiff.file(), {1, 0, -1 / 127.0, -128 / 127.0});
    tiff.bits = 16;
    tiff.data = integers({32767, 0, 0xffff, 0x8000}, 2, big);
    expect_values(tiff.file(), {1, 0, -1 / 32767.0, -32768 / 32767.0});
    tiff.bits = 32;
    tiff.data = integers({0x7fffffff, 0, 0xffffffff, 0x80000000}, 4, big);
    expect_values(tiff.file(), {1, 0, -1 / 2147483647.0, -2147483648 / 2147483647.0});
    const FileInfo info = info_of(tiff.file());
    EXPECT_EQ(info.parts[0].type, PixelType::float32);
    EXPECT_EQ(info.colour, Colour::linear);
    ASSERT_EQ(info.warnings.size(), 1u);
    EXPECT_NE(info.warnings[0].find("32-bit signed integers are read as linear values"), std::string::npos);
  }
  OtherTiff twelve{.width = 3, .bits = 12, .format = 2};
  twelve.data = packed({2047, 4095, 2048}, 12, 3);
  expect_values(twelve.file(), {1, -1 / 2047.0, -2048 / 2047.0});
}

/// Codes of a picture of 3×2 pixels of R G B, all bits used.
std::vector<std::uint32_t> codes_of(int bits) {
  std::vector<std::uint32_t> codes;
  const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
  for (std::uint32_t i = 0; i < 18; ++i) codes.push_back((0x9e3779b9u * (i + 1) >> 7) & mask);
  codes[4] = mask;
  return codes;
}

Bytes reversed_bits(Bytes bytes) {
  for (std::byte& byte : bytes) {
    unsigned turned = 0;
    for (unsigned bit = 0; bit < 8; ++bit)
      turned |= (std::to_integer<unsigned>(byte) >> bit & 1) << (7 - bit);
    byte = static_cast<std::byte>(turned);
  }
  return bytes;
}

TEST(TiffKinds, SamplesOfAnyNumberOfBitsAreUnpacked) {
  for (const int bits : {1, 2, 3, 4, 6, 7, 9, 10, 12, 14, 15, 17, 20, 31}) {
    const auto codes = codes_of(bits);
    std::vector<double> values;
    for (const std::uint32_t code : codes) values.push_back(code / (std::ldexp(1.0, bits) - 1));
    for (const bool big : {false, true}) {
      for (const bool lowest_first : {false, true}) {
        SCOPED_TRACE(std::to_string(bits) + (big ? " MM" : " II") + (lowest_first ? " reversed" : ""));
        OtherTiff tiff{
            .width = 3, .height = 2, .samples = 3, .bits = bits, .photometric = 2, .big_endian = big};
        if (lowest_first) tiff.more[266] = {3, {2}};
        const auto order = [&](const Bytes& bytes) { return lowest_first ? reversed_bits(bytes) : bytes; };
        tiff.data = order(packed(codes, bits, 9));
        expect_values(tiff.file(), values);
        expect_truncation_is_an_error(Bytes(tiff.file()), 4);  // the link to no further directory

        tiff.planar = true;
        tiff.data.clear();
        for (std::size_t plane = 0; plane < 3; ++plane) {
          std::vector<std::uint32_t> own;
          for (std::size_t i = plane; i < codes.size(); i += 3) own.push_back(codes[i]);
          const Bytes rows = order(packed(own, bits, 3));
          tiff.data.insert(tiff.data.end(), rows.begin(), rows.end());
        }
        expect_values(tiff.file(), values);
      }
    }
  }
}

TEST(TiffKinds, TypesAreTheNextWider) {
  const auto type_of = [](int bits, int format) { return tiff_samples(bits, format)->type(); };
  EXPECT_EQ(type_of(1, SAMPLEFORMAT_UINT), PixelType::uint8);
  EXPECT_EQ(type_of(10, SAMPLEFORMAT_UINT), PixelType::uint16);
  EXPECT_EQ(type_of(14, SAMPLEFORMAT_VOID), PixelType::uint16);
  EXPECT_EQ(type_of(24, SAMPLEFORMAT_UINT), PixelType::uint32);
  EXPECT_EQ(type_of(16, SAMPLEFORMAT_IEEEFP), PixelType::half);
  EXPECT_EQ(type_of(24, SAMPLEFORMAT_IEEEFP), PixelType::float32);
  // Integers of up to 16 bits are sRGB, as those of 8 and 16 are.
  OtherTiff tiff{.width = 1, .bits = 12};
  tiff.data = packed({2048}, 12, 1);
  EXPECT_EQ(info_of(tiff.file()).colour, Colour::srgb);
  EXPECT_NEAR(*decoded(tiff.file()).at(0, 0), 0.2142, 1e-4);  // ((2048/4095 + 0.055)/1.055)^2.4
}

TEST(TiffKinds, WhiteIsZeroOfAnyNumberOfBits) {
  for (const int bits : {1, 2, 4, 8, 10, 12, 16, 24, 32}) {
    const auto largest = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    OtherTiff tiff{.width = 2, .bits = bits, .photometric = 0};
    tiff.data = bits % 8 == 0 ? integers({0, largest}, bits / 8) : packed({0, largest}, bits, 2);
    expect_values(tiff.file(), {1, 0});
  }
  // Alpha beside grey is not inverted.
  for (const int bits : {8, 12}) {
    const auto largest = (std::uint32_t{1} << bits) - 1;
    OtherTiff tiff{.width = 2, .samples = 2, .bits = bits, .photometric = 0};
    tiff.more[338] = {3, {1}};
    const auto row = [&](const std::vector<std::uint32_t>& codes) {
      return bits == 8 ? integers(codes, 1) : packed(codes, bits, codes.size());
    };
    tiff.data = row({0, largest, largest, 0});
    expect_values(tiff.file(), {1, 1, 0, 0});
    tiff.planar = true;
    tiff.data = row({0, largest});
    const Bytes alpha = row({largest, 0});
    tiff.data.insert(tiff.data.end(), alpha.begin(), alpha.end());
    expect_values(tiff.file(), {1, 1, 0, 0});
  }
  for (const int format : {2, 3}) {
    const OtherTiff tiff{.width = 1, .bits = 32, .format = format, .photometric = 0, .data = Bytes(4)};
    EXPECT_NE(error_of([&] { info_of(tiff.file()); }).find("of which 0 is white, which is not read"),
              std::string::npos);
  }
}

TEST(TiffKinds, TwentyFourBits) {
  for (const bool big : {false, true}) {
    OtherTiff tiff{.width = 3, .bits = 24, .big_endian = big};
    tiff.data = integers({0, 0xffffff, 0x123456}, 3, big);
    expect_values(tiff.file(), {0, 1, 0x123456 / 16777215.0});
    // Sign, exponent 63 for 1…2, mantissa.
    tiff.format = 3;
    tiff.width = 8;
    tiff.data = integers({0x3f0000, 0x3f8000, 0xc00000, 0x000001, 0x7effff, 0, 0x800000, 0x7f0000}, 3, big);
    expect_values(tiff.file(), {1, 1.5, -2, std::ldexp(1.0, -78),
                                (2 - std::ldexp(1.0, -16)) * std::ldexp(1.0, 63), 0, -0.0, INFINITY});
    tiff.data = integers({0x7f0001, 0, 0, 0, 0, 0, 0, 0}, 3, big);
    EXPECT_TRUE(std::isnan(*decoded(tiff.file()).at(0, 0)));
  }
}

TEST(TiffKinds, WhatHasNoMeaningIsRefusedByName) {
  const auto message = [](int bits, int format, int photometric = 1, int samples = 1) {
    const OtherTiff tiff{
        .samples = samples, .bits = bits, .format = format, .photometric = photometric, .data = Bytes(64)};
    return error_of([&] { decoded(tiff.file()); });
  };
  const auto expect = [](const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find("which is not read; convert it to RGB of 16-bit integers or floats"),
              std::string::npos)
        << text;
  };
  expect(message(64, 1), "64-bit unsigned integers");
  expect(message(64, 2), "64-bit signed integers");
  expect(message(64, 6), "64-bit complex numbers");
  expect(message(8, 3), "8-bit floats");
  expect(message(128, 3), "128-bit floats");
  expect(message(32, 1, 8, 3), "CIE L*a*b* pixels and 32-bit unsigned integers");
  expect(message(16, 1, 5, 4), "CMYK pixels and 16-bit unsigned integers");
  expect(message(8, 1, 77), "unknown pixels and 8-bit unsigned integers");
}

TEST(TiffKinds, SamplesDecodedByAnotherPathAreTold) {
  OtherTiff cmyk{.samples = 4, .photometric = 5, .data = integers({0, 255, 255, 0}, 1)};
  cmyk.more[34675] = {7, {}, bytes_of("a profile of inks")};
  const FileInfo info = info_of(cmyk.file());
  ASSERT_EQ(info.warnings.size(), 1u);
  EXPECT_EQ(info.warnings[0],
            "CMYK pixels of 8 bits, converted to 8-bit RGB without regard to their profile");
  EXPECT_TRUE(tiff_format().open({cmyk.file(), "a", {}})->declared().icc.empty()) << "it is not of RGB";
  expect_values(cmyk.file(), {1, 0, 0});
}

Declared declared_of(const Bytes& file, const ReadOptions& options = {}) {
  return tiff_format().open({file, "a.tif", options})->declared();
}

TEST(TiffKinds, AlphaIsAsExtraSamplesSay) {
  const auto with = [](int bits, int format, std::uint32_t extra) {
    OtherTiff tiff{.samples = 4,
                   .bits = bits,
                   .format = format,
                   .photometric = 2,
                   .data = Bytes(static_cast<std::size_t>(bits) / 2)};
    tiff.more[338] = {3, {extra}};
    return tiff.file();
  };
  for (const int bits : {8, 16}) {
    EXPECT_EQ(declared_of(with(bits, 1, 1)).alpha, AlphaKind::encoded);
    EXPECT_EQ(declared_of(with(bits, 1, 1), linear()).alpha, AlphaKind::associated);
    EXPECT_EQ(declared_of(with(bits, 1, 2)).alpha, AlphaKind::straight);
  }
  EXPECT_EQ(declared_of(with(32, 3, 1)).alpha, AlphaKind::associated);
  EXPECT_EQ(declared_of(with(32, 3, 2)).alpha, AlphaKind::straight);
  EXPECT_EQ(declared_of(with(32, 3, 2), linear()).alpha, AlphaKind::straight);
  // A sample of no stated kind is not alpha.
  EXPECT_EQ(declared_of(with(8, 1, 0)).alpha, AlphaKind::associated);
  EXPECT_EQ(info_of(with(8, 1, 0)).parts[0].channels[3], "S4");
}

TEST(TiffKinds, WrittenAlphaIsAssociatedWhereValuesAreLinear) {
  const auto written = [](PixelType type, Colour colour = Colour::automatic) {
    WriteOptions options;
    options.type = type;
    options.colour = colour;
    const Bytes bytes = encoded("tif", noise(3, 2, 4), options);
    return declared_of(bytes).alpha;
  };
  using enum PixelType;
  for (const PixelType type : {float32, half, uint32})
    EXPECT_EQ(written(type), AlphaKind::associated) << name_of(type);
  for (const PixelType type : {uint8, uint16}) EXPECT_EQ(written(type), AlphaKind::straight) << name_of(type);
  EXPECT_EQ(written(float32, Colour::srgb), AlphaKind::straight);
  // Whole colours, as other programs expect them: half of white is white of alpha ½. Others are left alone.
  Image half_white(1, 1, 5);
  const float values[] = {0.5f, 0.5f, 0.25f, 0.5f, 0.25f};
  std::copy(values, values + 5, half_white.at(0, 0));
  const TemporaryFolder of_integers;
  const WritePart five{"", half_white.view(), {"R", "G", "B", "A", "Z"}};
  WriteOptions words;
  words.type = uint16;
  write(of_integers / "a.tif", {&five, 1}, words);
  const Bytes file = file_bytes(of_integers / "a.tif");
  const auto stored = tiff_format().open({file, "a.tif", {}});
  const Image whole = read_part(*stored), again = decoded(file);
  const float expected[] = {1, 1, 0.5f, 0.5f, 0.25f};
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(whole.at(0, 0)[k], expected[k], 4e-5f);
    EXPECT_NEAR(again.at(0, 0)[k], values[k], 4e-5f);
  }
  // Names of further channels don't hide the kind.
  const Image image = noise(2, 2, 5);
  const WritePart part{"", image.view(), {"R", "G", "B", "A", "Z"}};
  const TemporaryFolder folder;
  write(folder / "a.tif", {&part, 1});
  EXPECT_EQ(declared_of(file_bytes(folder / "a.tif")).alpha, AlphaKind::associated);
}

TEST(TiffKinds, OrientationIsDeclaredAndRowsAreAsStored) {
  for (std::uint32_t orientation = 0; orientation <= 9; ++orientation) {
    OtherTiff tiff{.width = 2, .height = 2, .data = integers({0, 51, 102, 255}, 1)};
    tiff.more[274] = {3, {orientation}};
    const int expected = orientation == 0 || orientation == 9 ? 1 : static_cast<int>(orientation);
    const Bytes file = tiff.file();
    const auto reader = tiff_format().open({file, "a.tif", linear()});
    EXPECT_EQ(reader->declared().orientation, expected);
    EXPECT_TRUE(reader->info().notes.empty());
    const Image image = read_part(*reader);
    const float values[] = {0, 0.2f, 0.4f, 1};
    for (int i = 0; i < 4; ++i) EXPECT_EQ(*image.at(i % 2, i / 2), values[i]);
  }
}

TEST(TiffKinds, PalettesAreAsStoredInEveryOrientation) {
  OtherTiff tiff{.width = 3, .height = 2, .photometric = 3, .data = integers({0, 1, 2, 3, 4, 5}, 1)};
  std::vector<std::uint32_t> map(3 * 256);
  for (std::uint32_t i = 0; i < 6; ++i) map[i] = 51 * i * 257;
  tiff.more[320] = {3, map};
  for (std::uint32_t orientation = 1; orientation <= 8; ++orientation) {
    tiff.more[274] = {3, {orientation}};
    const Bytes file = tiff.file();
    const auto reader = tiff_format().open({file, "a.tif", linear()});
    EXPECT_EQ(reader->declared().orientation, static_cast<int>(orientation));
    const Image image = read_part(*reader);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(image.at(i % 3, i / 3)[0], i / 5.0, 1e-6) << orientation;
  }
}

OtherTiff::Value rational(const std::vector<std::uint32_t>& millionths) {
  OtherTiff::Value value{5, {}};
  for (const std::uint32_t number : millionths)
    put(value.bytes, number, 4, false), put(value.bytes, 1000000, 4, false);
  return value;
}

TEST(TiffKinds, ColourFieldsAreDeclared) {
  OtherTiff tiff{.samples = 3, .photometric = 2, .data = Bytes(3)};
  tiff.more[34675] = {7, {}, bytes_of("a profile")};
  tiff.more[700] = {1, {}, bytes_of("<x:xmpmeta/>\0\0")};
  const Declared declared = declared_of(tiff.file());
  EXPECT_EQ(declared.icc, bytes_of("a profile"));
  EXPECT_EQ(declared.xmp, "<x:xmpmeta/>");
  EXPECT_FALSE(declared.primaries);

  OtherTiff primaries{.samples = 3, .photometric = 2, .data = Bytes(3)};
  const auto with = [&](std::map<int, OtherTiff::Value> fields) {
    primaries.more = std::move(fields);
    return primaries.file();
  };
  Bytes file = with(
      {{319, rational({708000, 292000, 170000, 797000, 131000, 46000})}, {318, rational({312700, 329000})}});
  ASSERT_TRUE(declared_of(file).primaries);
  EXPECT_NEAR(declared_of(file).primaries->red[0], 0.708, 1e-6);
  EXPECT_NEAR(declared_of(file).primaries->blue[1], 0.046, 1e-6);
  EXPECT_NEAR(declared_of(file).primaries->white[1], 0.329, 1e-6);
  file = with({{319, rational({640000, 330000, 300000, 600000, 150000, 60000})}});
  EXPECT_NEAR(declared_of(file).primaries->white[0], 0.3127, 1e-6);
  file = with({{318, rational({345700, 358500})}});
  EXPECT_FALSE(declared_of(file).primaries);
  EXPECT_EQ(info_of(file).warnings.at(0), "its WhitePoint, without PrimaryChromaticities, is not obeyed");
  EXPECT_TRUE(info_of(with({{318, rational({312700, 329000})}})).warnings.empty());
  file = with({{319, rational({300000, 300000, 300000, 300000, 300000, 300000})}});
  EXPECT_FALSE(declared_of(file).primaries);
  EXPECT_NE(info_of(file).warnings.at(0).find("are ignored"), std::string::npos);
  file = with({{301, {3, std::vector<std::uint32_t>(3 * 256, 7)}}});
  EXPECT_EQ(info_of(file).warnings.at(0), "its TransferFunction is not obeyed");
}

// 33300 and 33301 are the whole's size, 286 and 287 the position in units of 282 and 283.
TEST(TiffKinds, PartsOfPanoramasAreDeclared) {
  OtherTiff tiff{.width = 30, .height = 20, .data = Bytes(600)};
  const auto with = [&](std::uint32_t width, std::uint32_t height,
                        std::map<int, OtherTiff::Value> fields = {}) {
    tiff.more = std::move(fields);
    tiff.more[33300] = {4, {width}};
    tiff.more[33301] = {4, {height}};
    return info_of(tiff.file());
  };
  const std::map<int, OtherTiff::Value> hugins{{282, rational({150000000})},
                                               {283, rational({150000000})},
                                               {286, rational({50 * 1000000 / 150})},
                                               {287, rational({7 * 1000000 / 150})}};
  FileInfo info = with(200, 100, hugins);
  ASSERT_TRUE(info.panorama);
  Panorama expected;
  expected.projection = "equirectangular";
  expected.full_width = 200;
  expected.full_height = 100;
  expected.crop_width = 30;
  expected.crop_height = 20;
  expected.crop_left = 50;
  expected.crop_top = 7;
  EXPECT_EQ(*info.panorama, expected);
  EXPECT_EQ(info.warnings.at(0),
            "cut out of a picture of 200×100 texels, at 50, 7; taken for a part of a lat-long");

  info = with(200, 100, {{282, rational({72000000})}, {286, rational({50000000})}});
  EXPECT_EQ(info.panorama->crop_left, 50) << "texels, as other writers have it";
  EXPECT_EQ(info.panorama->crop_top, 0);

  info = with(200, 150, hugins);
  EXPECT_FALSE(info.panorama);
  EXPECT_EQ(info.warnings.at(0),
            "cut out of a picture of 200×150 texels, at 50, 7; read as if it were the whole");
  for (const FileInfo& wrong :
       {with(20, 10), with(200, 100, {{286, rational({171000000})}}),
        with(200, 100, {{286, rational({50500000})}}), with(0xffffffff, 0x7fffffff)}) {
    EXPECT_FALSE(wrong.panorama);
    EXPECT_NE(wrong.warnings.at(0).find("which cannot be: read as it is"), std::string::npos);
  }
  EXPECT_TRUE(with(30, 20).warnings.empty());
}

TEST(TiffKinds, PagesThatDifferAreTold) {
  OtherTiff first{.samples = 4, .photometric = 2, .data = Bytes(4)}, second = first;
  first.more[338] = second.more[338] = {3, {2}};
  EXPECT_TRUE(info_of(OtherTiff::pages({first, second})).warnings.empty());
  second.more[274] = {3, {6}};
  second.more[338] = {3, {1}};
  const Bytes file = OtherTiff::pages({first, second});
  EXPECT_EQ(declared_of(file).orientation, 1);
  EXPECT_EQ(declared_of(file).alpha, AlphaKind::straight);
  ASSERT_EQ(info_of(file).warnings.size(), 1u);
  EXPECT_EQ(info_of(file).warnings[0],
            "its pages differ in orientation and kind of alpha; all are read as the first of them says");
  // A first page without alpha says nothing of it.
  const OtherTiff opaque{.samples = 3, .photometric = 2, .data = Bytes(3)};
  first.more[338] = {3, {2}};
  EXPECT_EQ(declared_of(OtherTiff::pages({opaque, first})).alpha, AlphaKind::straight);
  EXPECT_TRUE(info_of(OtherTiff::pages({opaque, first})).warnings.empty());
}

}  // namespace
}  // namespace welkin::io::test
