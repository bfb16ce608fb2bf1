#include <algorithm>
#include <cmath>

#include "welkin/io/colour/code_points.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/heif/heif_test_pictures.h"

namespace welkin::io::test {
namespace {

TEST(Heif, GreyIsWholeFractionsOfTheLargest) {
  for (const auto codec : {heif_compression_AV1, heif_compression_HEVC}) {
    for (const int depth : {8, 10, 12}) {
      SCOPED_TRACE(std::to_string(codec) + ", " + std::to_string(depth) + " bits");
      if (!can_encode(codec, depth)) continue;
      HeifOptions options;
      options.codec = codec;
      options.transfer = kLinear;
      const Bytes bytes = encoded_heif(varied_picture(48, 32, depth, heif_colorspace_monochrome), options);
      const auto reader = raw_reader(bytes);
      const PartInfo& part = reader->info().parts.at(0);
      EXPECT_EQ(reader->info().format, codec == heif_compression_AV1 ? "avif" : "heif");
      EXPECT_EQ(part.compression, codec == heif_compression_AV1 ? "av1" : "hevc");
      EXPECT_EQ(part.channels, names_of(1));
      EXPECT_EQ(part.type, depth == 8 ? PixelType::uint8 : PixelType::uint16);
      EXPECT_EQ(reader->info().notes.empty(), depth == 8);
      if (depth > 8) {
        EXPECT_EQ(reader->info().notes.at(0), "values of " + std::to_string(depth) + " bits");
      }
      const Image image = read_part(*reader);
      ASSERT_EQ(image.width(), 48);
      ASSERT_EQ(image.height(), 32);
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 48; ++x) {
          ASSERT_EQ(*image.at(x, y),
                    static_cast<float>(varied(heif_channel_Y, x, y, depth) / (std::exp2(depth) - 1)));
        }
      }
    }
  }
}

TEST(Heif, RgbAndAlphaAreWholeFractionsOfTheLargest) {
  for (const int depth : {8, 10, 12}) {
    for (const bool alpha : {false, true}) {
      SCOPED_TRACE(std::to_string(depth) + " bits");
      const Bytes bytes =
          encoded_heif(varied_picture(48, 32, depth, heif_colorspace_RGB, alpha), identity(kLinear, depth));
      const auto reader = raw_reader(bytes);
      EXPECT_EQ(reader->info().parts[0].channels, names_of(alpha ? 4 : 3));
      EXPECT_EQ(reader->declared().alpha, alpha ? AlphaKind::straight : AlphaKind::associated);
      const Image image = read_part(*reader);
      const heif_channel channels[] = {heif_channel_R, heif_channel_G, heif_channel_B, heif_channel_Alpha};
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 48; ++x) {
          for (int k = 0; k < image.channels(); ++k) {
            ASSERT_EQ(image.at(x, y)[k],
                      static_cast<float>(varied(channels[k], x, y, depth) / (std::exp2(depth) - 1)));
          }
        }
      }
    }
  }
}

TEST(Heif, SrgbIsUndoneAndAlphaIsNot) {
  const Bytes bytes = encoded_heif(varied_picture(32, 32, 8, heif_colorspace_RGB, true), identity(kSrgb));
  EXPECT_EQ(raw_reader(bytes)->info().colour, Colour::srgb);
  const Image image = raw_picture(bytes);
  ReadOptions options;
  options.colour = Colour::linear;
  const Image stored = raw_picture(bytes, options);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      EXPECT_EQ(image.at(x, y)[0],
                srgb8_to_linear()[static_cast<std::size_t>(varied(heif_channel_R, x, y, 8))]);
      EXPECT_EQ(image.at(x, y)[3], static_cast<float>(varied(heif_channel_Alpha, x, y, 8) / 255.0));
      EXPECT_EQ(stored.at(x, y)[0], static_cast<float>(varied(heif_channel_R, x, y, 8) / 255.0));
    }
  }
}

/// R'G'B' of smooth pictures.
double smooth(int k, int x, int y) {
  return 0.5 + 0.4 * std::sin(0.11 * x + 0.07 * y + 2.0 * k);
}

/// Codes of the smooth picture by ITU-T H.273's equations for matrices of red's and blue's part in luma.
int code_of(heif_channel channel, int x, int y, double red, double blue, int depth, bool full) {
  const double r = smooth(0, x, y), g = smooth(1, x, y), b = smooth(2, x, y);
  const double luma = red * r + (1 - red - blue) * g + blue * b, unit = std::exp2(depth - 8);
  const double largest = std::exp2(depth) - 1, middle = std::exp2(depth - 1);
  if (channel == heif_channel_Y)
    return static_cast<int>(std::lround(full ? largest * luma : (219 * luma + 16) * unit));
  const double difference =
      channel == heif_channel_Cb ? (b - luma) / (2 * (1 - blue)) : (r - luma) / (2 * (1 - red));
  return static_cast<int>(
      std::lround(full ? largest * difference + middle : (224 * difference + 128) * unit));
}

TEST(Heif, LumaAndChromaAreUndoneByTheMatrixThatTheFileNames) {
  const struct {
    int matrix;
    double red, blue;
  } table[] = {{1, 0.2126, 0.0722}, {2, 0.299, 0.114}, {4, 0.30, 0.11},     {5, 0.299, 0.114},
               {6, 0.299, 0.114},   {7, 0.212, 0.087}, {9, 0.2627, 0.0593}, {12, 0.2126, 0.0722}};
  for (const auto& row : table) {
    for (const int depth : {8, 10, 12}) {
      for (const bool full : {true, false}) {
        SCOPED_TRACE("matrix " + std::to_string(row.matrix) + ", " + std::to_string(depth) + " bits, " +
                     (full ? "full" : "narrow") + " range");
        HeifPicture picture{32, 32, depth, heif_colorspace_YCbCr, heif_chroma_444, false, nullptr};
        picture.code = [&](heif_channel channel, int x, int y) {
          return code_of(channel, x, y, row.red, row.blue, depth, full);
        };
        HeifOptions options;
        options.codec = codec_for(depth);
        options.matrix = row.matrix;
        options.transfer = kLinear;
        options.full_range = full;
        const Bytes bytes = encoded_heif(picture, options);
        const Image image = raw_picture(bytes);
        // Half a code of 219 of luma, of 224 of chroma, whose factors are below 1.9, and libheif's roundings,
        // which come to 1.2 codes of narrow range.
        const double tolerance = 2.9 / (std::exp2(depth) - 1);
        for (int y = 0; y < 32; ++y) {
          for (int x = 0; x < 32; ++x) {
            for (int k = 0; k < 3; ++k) ASSERT_NEAR(image.at(x, y)[k], smooth(k, x, y), tolerance);
          }
        }
      }
    }
  }
}

TEST(Heif, OtherMatricesAreRefusedByName) {
  const HeifPicture picture{
      32, 32, 8, heif_colorspace_YCbCr, heif_chroma_444, false, [](heif_channel, int, int) { return 100; }};
  for (const auto& [matrix, name] :
       {std::pair{8, "YCgCo"}, {10, "BT.2020 of constant luminance"}, {14, "ICtCp"}}) {
    HeifOptions options;
    options.matrix = matrix;
    const Bytes bytes = encoded_heif(picture, options);
    EXPECT_EQ(error_of([&] { raw_reader(bytes); }), "test: its colours are coded by the matrix number " +
                                                        std::to_string(matrix) + " of ITU-T H.273 (" + name +
                                                        "), which is not read");
  }
}

TEST(Heif, GreyOfNarrowRangeIsWidened) {
  for (const int depth : {8, 12}) {
    HeifOptions options;
    options.transfer = kLinear;
    options.full_range = false;
    const Image image =
        raw_picture(encoded_heif(varied_picture(48, 32, depth, heif_colorspace_monochrome), options));
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 48; ++x) {
        const double code = varied(heif_channel_Y, x, y, depth) / std::exp2(depth - 8);
        ASSERT_EQ(*image.at(x, y), static_cast<float>(std::clamp((code - 16) / 219, 0.0, 1.0)));
      }
    }
  }
  HeifOptions options = identity();
  options.full_range = false;
  const Bytes bytes = encoded_heif(varied_picture(16, 16, 8), options);
  EXPECT_EQ(error_of([&] { raw_reader(bytes); }), "test: R, G and B of narrow range, which is not read");
}

TEST(Heif, HalvedChromaIsRead) {
  for (const auto chroma : {heif_chroma_420, heif_chroma_422}) {
    for (const auto& [width, height] : {std::pair{32, 24}, {33, 25}}) {
      SCOPED_TRACE(std::to_string(chroma) + ", " + std::to_string(width));
      const bool halved_y = chroma == heif_chroma_420;
      HeifPicture picture{width, height, 10, heif_colorspace_YCbCr, chroma, false, nullptr};
      picture.code = [](heif_channel channel, int x, int y) {
        return channel == heif_channel_Y    ? 500
               : channel == heif_channel_Cb ? 480 + 3 * x + 2 * y
                                            : 520 - 2 * x + y;
      };
      HeifOptions options;
      options.codec = codec_for(10, chroma);
      options.transfer = kLinear;
      const Bytes bytes = encoded_heif(picture, options);
      const auto reader = raw_reader(bytes);
      const Image image = read_part(*reader);
      ASSERT_EQ(image.width(), width);
      ASSERT_EQ(image.height(), height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const int u = x / 2, v = halved_y ? y / 2 : y;
          const double cb = (480 + 3 * u + 2 * v - 512) / 1023.0, cr = (520 - 2 * u + v - 512) / 1023.0;
          const double luma = 500 / 1023.0, r = luma + 1.402 * cr, b = luma + 1.772 * cb;
          ASSERT_NEAR(image.at(x, y)[0], r, 1.1 / 1023);
          ASSERT_NEAR(image.at(x, y)[1], (luma - 0.299 * r - 0.114 * b) / 0.587, 1.1 / 1023);
          ASSERT_NEAR(image.at(x, y)[2], b, 1.1 / 1023);
        }
      }
    }
  }
}

TEST(Heif, CodePointsAreDeclared) {
  const struct {
    int primaries, transfer;
    Colour colour;
    Curve curve;
    double gamma;
  } table[] = {{1, 13, Colour::srgb, Curve::none, 1},    {1, 1, Colour::linear, Curve::bt709, 1},
               {9, 14, Colour::linear, Curve::bt709, 1}, {9, 16, Colour::linear, Curve::pq, 1},
               {9, 18, Colour::linear, Curve::hlg, 1},   {12, 13, Colour::srgb, Curve::none, 1},
               {11, 8, Colour::linear, Curve::none, 1},  {4, 4, Colour::linear, Curve::gamma, 2.2},
               {5, 5, Colour::linear, Curve::gamma, 2.8}};
  for (const auto codec : {heif_compression_AV1, heif_compression_HEVC}) {
    for (const auto& row : table) {
      SCOPED_TRACE(std::to_string(row.primaries) + ", " + std::to_string(row.transfer));
      HeifOptions options;
      options.codec = codec;
      options.primaries = row.primaries;
      options.transfer = row.transfer;
      const Bytes bytes = encoded_heif(varied_picture(16, 16, 12, heif_colorspace_YCbCr), options);
      const auto reader = raw_reader(bytes);
      EXPECT_EQ(reader->info().colour, row.colour);
      EXPECT_EQ(reader->declared().curve, row.curve);
      EXPECT_EQ(reader->declared().gamma, row.gamma);
      EXPECT_EQ(reader->declared().primaries,
                row.primaries == 1 ? std::nullopt : chromaticities_of(row.primaries));
      EXPECT_TRUE(reader->info().warnings.empty());
    }
  }
}

TEST(Heif, IccProfilesAreDeclaredAndTheMatrixStays) {
  HeifOptions options;
  options.codec = codec_for(10);
  options.icc = unusual_profile();
  options.matrix = 9;
  HeifPicture picture{32, 32, 10, heif_colorspace_YCbCr, heif_chroma_444, false, nullptr};
  picture.code = [](heif_channel channel, int x, int y) {
    return code_of(channel, x, y, 0.2627, 0.0593, 10, true);
  };
  const Bytes bytes = encoded_heif(picture, options);
  const auto reader = raw_reader(bytes);
  EXPECT_EQ(reader->declared().icc, options.icc);
  EXPECT_EQ(reader->declared().primaries, std::nullopt);
  EXPECT_EQ(reader->declared().curve, Curve::none);
  ReadOptions as_stored;
  as_stored.colour = Colour::linear;
  const Image image = raw_picture(bytes, as_stored);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(7, 9)[k], smooth(k, 7, 9), 2.1 / 1023);
}

// SMPTE ST 2084 has 203 cd/m², diffuse white, at 0.58068888.
TEST(Heif, DiffuseWhiteOfPqIsOne) {
  HeifOptions options = identity(16);
  options.primaries = 9;
  HeifPicture picture{
      16, 16, 12, heif_colorspace_RGB, heif_chroma_444, false, [](heif_channel, int, int) { return 2378; }};
  const Image image = decoded(encoded_heif(picture, options));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(8, 8)[k], 1, 0.002);
}

TEST(Heif, PremultipliedAlphaIsDeclared) {
  for (const int transfer : {kSrgb, kLinear, 16}) {
    HeifOptions options = identity(transfer);
    options.premultiplied = true;
    const Bytes bytes = encoded_heif(varied_picture(16, 16, 8, heif_colorspace_RGB, true), options);
    EXPECT_EQ(raw_reader(bytes)->declared().alpha,
              transfer == kLinear ? AlphaKind::associated : AlphaKind::encoded);
  }
}

/// An Exif block that holds an orientation.
std::string exif(char orientation) {
  return std::string("MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19) + orientation +
         std::string("\0\0\0\0\0\0", 6);
}

// libheif applies irot and imir; the Exif block, which repeats them in many files, is not applied again.
TEST(Heif, RotationAndMirroringAreUndoneOnce) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(orientation);
    HeifOptions options = identity();
    options.orientation = static_cast<heif_orientation>(orientation);
    options.exif = exif(static_cast<char>(orientation));
    const Bytes bytes = encoded_heif(varied_picture(48, 16, 8), options);
    const auto reader = raw_reader(bytes);
    EXPECT_EQ(reader->declared().orientation, 1);
    const Image image = read_part(*reader);
    ASSERT_EQ(image.width(), orientation < 5 ? 48 : 16);
    ASSERT_EQ(image.height(), orientation < 5 ? 16 : 48);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 48; ++x) {
        const auto [u, v] = shown_at(orientation, x, y, 48, 16);
        ASSERT_EQ(image.at(u, v)[0], static_cast<float>(varied(heif_channel_R, x, y, 8) / 255.0));
      }
    }
  }
}

// HEVC codes even sizes alone: others are cropped by `clap`, or are a tile of a grid.
TEST(Heif, CroppedPicturesAndGridsAreRead) {
  for (const bool grid : {false, true}) {
    HeifOptions options;
    options.codec = heif_compression_HEVC;
    options.transfer = kLinear;
    options.grid = grid;
    HeifPicture picture{65, 67, 8, heif_colorspace_YCbCr, heif_chroma_444, false, nullptr};
    picture.code = [](heif_channel channel, int x, int y) {
      return code_of(channel, x, y, 0.299, 0.114, 8, true);
    };
    const Bytes bytes = encoded_heif(picture, options);
    const Bytes name = bytes_of(grid ? "grid" : "clap");
    EXPECT_NE(std::search(bytes.begin(), bytes.end(), name.begin(), name.end()), bytes.end());
    const Image image = raw_picture(bytes);
    ASSERT_EQ(image.width(), 65);
    ASSERT_EQ(image.height(), 67);
    for (int y = 0; y < 67; ++y) {
      for (int x = 0; x < 65; ++x) {
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(image.at(x, y)[k], smooth(k, x, y), 2.1 / 255);
      }
    }
  }
}

TEST(Heif, XmpIsRead) {
  HeifOptions options;
  options.xmp = "<x:xmpmeta/>";
  const Bytes bytes = encoded_heif(varied_picture(16, 16, 8), options);
  EXPECT_EQ(raw_reader(bytes)->declared().xmp, options.xmp);
}

TEST(Heif, LossyPicturesAreNear) {
  for (const auto codec : {heif_compression_AV1, heif_compression_HEVC}) {
    HeifOptions options;
    options.codec = codec;
    options.transfer = kLinear;
    options.lossless = false;
    HeifPicture picture{64, 64, 8, heif_colorspace_RGB, heif_chroma_444, false, nullptr};
    picture.code = [](heif_channel channel, int x, int y) {
      const int k = static_cast<int>(channel) - static_cast<int>(heif_channel_R);
      return static_cast<int>(std::lround(255 * smooth(k, x / 4, y / 4)));
    };
    const Image image = raw_picture(encoded_heif(picture, options));
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(image.at(x, y)[k], smooth(k, x / 4, y / 4), 0.06);
      }
    }
  }
}

}  // namespace
}  // namespace welkin::io::test
