#include <tiffio.h>

#include <cmath>
#include <functional>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// What this room's writer does not make, by libtiff itself.
Bytes by_libtiff(const char* mode, const std::function<void(TIFF*)>& fill) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.tif").string();
  TIFF* tiff = TIFFOpen(path.c_str(), mode);
  fill(tiff);
  TIFFClose(tiff);
  return file_bytes(path);
}

void set_tags(TIFF* tiff, int width, int height, int samples, int bits, int format, int photometric) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
}

template <class T>
void write_rows(TIFF* tiff, std::vector<T> values, int height) {
  const std::size_t row = values.size() / static_cast<std::size_t>(height);
  for (int y = 0; y < height; ++y) {
    TIFFWriteScanline(tiff, &values[static_cast<std::size_t>(y) * row], static_cast<std::uint32_t>(y), 0);
  }
}

TEST(Tiff, FloatsComeBackBitForBitInEveryCompression) {
  for (const char* compression : {"", "none", "zip", "lzw"}) {
    for (int channels = 1; channels <= 4; ++channels) {
      Image image = noise(300, 101, channels);
      const float special[] = {NAN, INFINITY, -INFINITY, -0.0f, 1e-45f, -3e38f};
      std::copy(special, special + 6, image.at(0, 0));
      WriteOptions options;
      options.compression = compression;
      WriteReport report;
      const Bytes bytes = encoded("tif", image, options, &report);
      const FileInfo info = info_of(bytes);
      EXPECT_EQ(report.not_finite + report.above + report.below, 0u);
      EXPECT_EQ(info.parts[0].channels, names_of(channels));
      EXPECT_EQ(info.parts[0].type, PixelType::float32);
      EXPECT_EQ(info.parts[0].compression, *compression == 0 ? "zip" : compression);
      EXPECT_EQ(info.colour, Colour::linear);
      expect_same(decoded(bytes), image);
    }
  }
}

TEST(Tiff, OtherTypesComeBackRoundedOnce) {
  struct Case {
    PixelType type;
    float error;
    Colour colour;
  };
  constexpr float kSteepest = 2.4f / 1.055f;  // slope of sRGB decoding at 1
  for (const Case& each :
       {Case{PixelType::uint8, 0.5f / 255 * (kSteepest + 1), Colour::srgb},  // and alpha's, which multiplies
        Case{PixelType::uint16, 0.5f / 65535 * (kSteepest + 1), Colour::srgb},
        Case{PixelType::uint32, 0x1p-24f, Colour::linear}, Case{PixelType::half, 0x1p-12f, Colour::linear}}) {
    for (const char* compression : {"none", "zip", "lzw"}) {
      WriteOptions options;
      options.type = each.type;
      options.compression = compression;
      Image image = noise(40, 30, 4);
      for (int i = 0; i < 40 * 30; ++i) {
        for (int k = 0; k < 3; ++k) image.at(i % 40, i / 40)[k] *= image.at(i % 40, i / 40)[3];
      }
      const Bytes bytes = encoded("tiff", image, options);
      EXPECT_EQ(info_of(bytes).parts[0].type, each.type);
      EXPECT_EQ(info_of(bytes).colour, each.colour);
      const Image once = decoded(bytes);
      EXPECT_LE(largest_difference(once, image), each.error + 1e-7f) << name_of(each.type);
      expect_same(decoded(encoded("tiff", once, options)), once);
    }
  }
}

TEST(Tiff, HalfClipsFiniteValuesAndKeepsInfinities) {
  Image image(3, 1, 1);
  const float values[3] = {1e5f, -1e5f, INFINITY};
  std::copy(values, values + 3, image.at(0, 0));
  WriteOptions options;
  options.type = PixelType::half;
  WriteReport report;
  const Image back = decoded(encoded("tif", image, options, &report));
  EXPECT_EQ(report.above, 2u);
  EXPECT_EQ(report.not_finite, 0u);
  EXPECT_EQ(*back.at(0, 0), 65504);
  EXPECT_EQ(*back.at(1, 0), -65504);
  EXPECT_EQ(*back.at(2, 0), INFINITY);
}

TEST(Tiff, PagesAreParts) {
  const Image first = noise(10, 20, 3, 1), second = noise(7, 5, 1, 2);
  const WritePart parts[] = {{"sky", first.view(), names_of(3)}, {"", second.view(), names_of(1)}};
  const TemporaryFolder folder;
  WriteOptions options;
  options.attributes = {{"Author", "nobody"}};
  write(folder / "a.tif", parts, options);
  const auto reader = open(folder / "a.tif");
  ASSERT_EQ(reader->info().parts.size(), 2u);
  EXPECT_EQ(reader->info().parts[0].name, "sky");
  EXPECT_EQ(reader->info().attributes, options.attributes);
  expect_same(read_part(*reader, 1), second);
  expect_same(read_part(*reader, 0), first);
}

TEST(Tiff, ChannelsKeepTheirNames) {
  const Image image = noise(6, 4, 5);
  const std::vector<std::string> names = {"Z", "A", "B", "G", "R"};
  const WritePart part{"", image.view(), names};
  const TemporaryFolder folder;
  write(folder / "a.tif", {&part, 1});
  const auto reader = open(folder / "a.tif");
  const std::vector<std::string> stored = {"R", "G", "B", "A", "Z"};
  ASSERT_EQ(reader->info().parts[0].channels, stored);
  EXPECT_TRUE(reader->info().attributes.empty());
  const Image back = read_part(*reader);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(back.at(3, 2)[k], image.at(3, 2)[4 - k]);
}

TEST(Tiff, AttributesAreLinesOfTheDescription) {
  WriteOptions options;
  options.attributes = {{"Author", "nobody"}, {"ImageDescription", "a sky\nof clouds"}};
  EXPECT_EQ(info_of(encoded("tif", noise(2, 2, 3), options)).attributes, options.attributes);
}

TEST(Tiff, PlanarTiledBigEndianBigTiffIsRead) {
  const Image image = noise(70, 50, 3);
  const Bytes bytes = by_libtiff("w8b", [&](TIFF* tiff) {
    set_tags(tiff, 70, 50, 3, 32, SAMPLEFORMAT_IEEEFP, PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_SEPARATE);
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 32);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    for (std::uint16_t plane = 0; plane < 3; ++plane) {
      for (int top = 0; top < 50; top += 16) {
        for (int left = 0; left < 70; left += 32) {
          std::vector<float> tile(32 * 16);
          for (int y = top; y < std::min(top + 16, 50); ++y) {
            for (int x = left; x < std::min(left + 32, 70); ++x) {
              tile[static_cast<std::size_t>((y - top) * 32 + x - left)] = image.at(x, y)[plane];
            }
          }
          TIFFWriteTile(tiff, tile.data(), static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top),
                        0, plane);
        }
      }
    }
  });
  expect_same(decoded(bytes), image);
  const auto reader = open(bytes, "test");
  Image swapped(70, 50, 2);
  reader->read(0, std::vector<int>{2, 0}, swapped.view());
  EXPECT_EQ(swapped.at(69, 49)[0], image.at(69, 49)[2]);
  EXPECT_EQ(swapped.at(69, 49)[1], image.at(69, 49)[0]);
}

TEST(Tiff, WhiteIsZeroIsInverted) {
  const Image image = decoded(by_libtiff("w", [](TIFF* tiff) {
    set_tags(tiff, 2, 1, 1, 16, SAMPLEFORMAT_UINT, PHOTOMETRIC_MINISWHITE);
    write_rows(tiff, std::vector<std::uint16_t>{0, 65535}, 1);
  }));
  EXPECT_EQ(*image.at(0, 0), 1.0f);
  EXPECT_EQ(*image.at(1, 0), 0.0f);
}

TEST(Tiff, DoublesAreNarrowed) {
  const Image image = decoded(by_libtiff("w", [](TIFF* tiff) {
    set_tags(tiff, 2, 1, 1, 64, SAMPLEFORMAT_IEEEFP, PHOTOMETRIC_MINISBLACK);
    write_rows(tiff, std::vector<double>{0.1, -1e30}, 1);
  }));
  EXPECT_EQ(*image.at(0, 0), 0.1f);
  EXPECT_EQ(*image.at(1, 0), -1e30f);
}

TEST(Tiff, PaletteIsExpanded) {
  const Bytes bytes = by_libtiff("w", [](TIFF* tiff) {
    set_tags(tiff, 2, 1, 1, 8, SAMPLEFORMAT_UINT, PHOTOMETRIC_PALETTE);
    std::vector<std::uint16_t> red(256), green(256), blue(256);
    red[3] = green[9] = 65535;
    TIFFSetField(tiff, TIFFTAG_COLORMAP, red.data(), green.data(), blue.data());
    write_rows(tiff, std::vector<std::uint8_t>{3, 9}, 1);
  });
  const Image image = decoded(bytes);
  ASSERT_EQ(image.channels(), 3);
  const float expected[6] = {1, 0, 0, 0, 1, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(image.at(0, 0)[i], expected[i]);
}

TEST(Tiff, LogLuvIsLinearRgb) {
  const Bytes bytes = by_libtiff("w", [](TIFF* tiff) {
    set_tags(tiff, 16, 1, 3, 16, SAMPLEFORMAT_INT, PHOTOMETRIC_LOGLUV);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_SGILOG);
    TIFFSetField(tiff, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
    std::vector<float> xyz;
    for (int x = 0; x < 16; ++x) xyz.insert(xyz.end(), {95.047f, 100.0f, 108.883f});  // D65 of luminance 100
    write_rows(tiff, xyz, 1);
  });
  const Image image = decoded(bytes);
  // LogLuv's steps are 0.3 % in luminance and 0.0025 in u′v′, which red and blue multiply.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(7, 0)[k], 100, 3);
}

TEST(Tiff, AbsurdSizesAreErrors) {
  const Bytes bytes = by_libtiff("w", [](TIFF* tiff) {
    set_tags(tiff, 100000, 50000, 1, 8, SAMPLEFORMAT_UINT, PHOTOMETRIC_MINISBLACK);
    write_rows(tiff, std::vector<std::uint8_t>(100000), 1);
  });
  const std::string message = error_of([&] { info_of(bytes); });
  EXPECT_NE(message.find("bytes cannot hold 100000×50000 pixels"), std::string::npos) << message;
}

// The directory stands after the pixels, so every cut loses a part of it; its last bytes are padding and
// text.
TEST(Tiff, TruncationIsAnError) {
  for (const char* compression : {"none", "zip", "lzw"}) {
    WriteOptions options;
    options.compression = compression;
    expect_truncation_is_an_error(encoded("tif", noise(9, 7, 3), options));
  }
}

TEST(Tiff, FailuresAreNotPrinted) {
  testing::internal::CaptureStderr();
  EXPECT_THROW(info_of(bytes_of(std::string("II*\0\x8\0\0\0\1\0", 10))), Error);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace welkin::io::test
