#include <cmath>
#include <cstdlib>

#include "welkin/io/png/png_test_files.h"
#include "welkin/io/test_readers.h"

/// What PngSuite of Willem van Schaik checks, in files made here: each colour type, depth, filter and size,
/// interlaced or not; transparency; gamma; damage.
namespace welkin::io::test {
namespace {

int samples_of(int colour_type) {
  return colour_type == kColour ? 3 : colour_type == kGreyAlpha ? 2 : colour_type == kColourAlpha ? 4 : 1;
}

struct Kind {
  int colour_type, depth;
};

const std::vector<Kind> kKinds = {{kGrey, 1},       {kGrey, 2},        {kGrey, 4},        {kGrey, 8},
                                  {kGrey, 16},      {kColour, 8},      {kColour, 16},     {kPalette, 1},
                                  {kPalette, 2},    {kPalette, 4},     {kPalette, 8},     {kGreyAlpha, 8},
                                  {kGreyAlpha, 16}, {kColourAlpha, 8}, {kColourAlpha, 16}};

/// A stored sample, of which the depth's bits count: all values come up, neighbours differ.
int sample(const Kind& kind, int x, int y, int k) {
  return (x * 7919 + y * 104729 + k * 31337 + (x * y) * 257) & ((1 << kind.depth) - 1);
}

int paeth(int left, int above, int corner) {
  const int p = left + above - corner;
  const int a = std::abs(p - left), b = std::abs(p - above), c = std::abs(p - corner);
  return a <= b && a <= c ? left : b <= c ? above : corner;
}

/// The rows of the pixels at x0 + i·dx, y0 + j·dy, with the filters 0 to 4 in turn, appended to `out`.
struct Pass {
  int x0, y0, dx, dy;
};
void append_rows(const Kind& kind, int width, int height, const Pass& pass, Values& out) {
  const int channels = samples_of(kind.colour_type);
  if (pass.x0 >= width) return;
  const std::size_t pixel_bytes = static_cast<std::size_t>(std::max(1, channels * kind.depth / 8));
  Values before;
  int filter = 0;
  for (int y = pass.y0; y < height; y += pass.dy) {
    Values row;
    int bits = 0;
    for (int x = pass.x0; x < width; x += pass.dx) {
      for (int k = 0; k < channels; ++k) {
        const int value = sample(kind, x, y, k);
        if (kind.depth == 16) row.push_back(value >> 8);
        if (kind.depth >= 8) {
          row.push_back(value & 255);
          continue;
        }
        if (bits % 8 == 0) row.push_back(0);
        row.back() |= value << (8 - kind.depth - bits % 8);
        bits += kind.depth;
      }
    }
    before.resize(row.size());
    out.push_back(filter);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const int left = i < pixel_bytes ? 0 : row[i - pixel_bytes], above = before[i],
                corner = i < pixel_bytes ? 0 : before[i - pixel_bytes];
      const int predicted[] = {0, left, above, (left + above) / 2, paeth(left, above, corner)};
      out.push_back((row[i] - predicted[filter]) & 255);
    }
    filter = (filter + 1) % 5;
    before = row;
  }
}

Values rows_of(const Kind& kind, int width, int height, bool interlaced) {
  // Adam7 (PNG third edition, 8.1).
  static constexpr Pass kPasses[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                     {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
  Values rows;
  if (!interlaced) append_rows(kind, width, height, {0, 0, 1, 1}, rows);
  for (const Pass& pass : kPasses) {
    if (interlaced) append_rows(kind, width, height, pass, rows);
  }
  return rows;
}

/// Colour k of the palette's entry i.
int entry(int i, int k) {
  return (i * (3 + 40 * k) + 17 * k) & 255;
}

std::string palette_of(const Kind& kind) {
  Values colours;
  for (int i = 0; i < 1 << kind.depth; ++i) {
    for (int k = 0; k < 3; ++k) colours.push_back(entry(i, k));
  }
  return kind.colour_type == kPalette ? chunk("PLTE", text_of(colours)) : "";
}

Bytes made(const Kind& kind, int width, int height, bool interlaced, const std::string& extra = "") {
  return picture(width, height, kind.depth, kind.colour_type, rows_of(kind, width, height, interlaced),
                 palette_of(kind) + extra, interlaced);
}

ReadOptions as_stored() {
  ReadOptions options;
  options.colour = Colour::linear;
  return options;
}

/// Channel k of the shown picture, without transparency: 1 is the largest code.
double shown(const Kind& kind, int x, int y, int k) {
  return kind.colour_type == kPalette ? entry(sample(kind, x, y, 0), k) / 255.0
                                      : sample(kind, x, y, k) / static_cast<double>((1 << kind.depth) - 1);
}

TEST(PngSuite, EveryTypeDepthFilterAndSizeIsReadInterlacedOrNot) {
  for (const Kind& kind : kKinds) {
    for (const bool interlaced : {false, true}) {
      for (int width = 1; width <= 9; ++width) {
        for (const int height : {1, 2, 3, 4, 5, 6, 7, 8, 9, 37}) {
          const Image image = raw_picture(made(kind, width, height, interlaced), as_stored());
          ASSERT_EQ(image.width(), width);
          ASSERT_EQ(image.height(), height);
          ASSERT_EQ(image.channels(), kind.colour_type == kPalette ? 3 : samples_of(kind.colour_type));
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
              for (int k = 0; k < image.channels(); ++k)
                ASSERT_NEAR(image.at(x, y)[k], shown(kind, x, y, k), 1e-7)
                    << "type " << kind.colour_type << ", depth " << kind.depth << ", " << width << "x"
                    << height << (interlaced ? ", interlaced" : "") << ", at " << x << " " << y;
            }
          }
        }
      }
    }
  }
}

TEST(PngSuite, OneTransparentColourIsAlpha) {
  constexpr int kWidth = 11, kHeight = 7, kX = 4, kY = 3;
  for (const Kind& kind : kKinds) {
    if (kind.colour_type != kGrey && kind.colour_type != kColour) continue;
    const int channels = samples_of(kind.colour_type);
    std::string transparent;
    for (int k = 0; k < channels; ++k)
      transparent += text_of({sample(kind, kX, kY, k) >> 8, sample(kind, kX, kY, k) & 255});
    for (const bool interlaced : {false, true}) {
      const Image image =
          raw_picture(made(kind, kWidth, kHeight, interlaced, chunk("tRNS", transparent)), as_stored());
      ASSERT_EQ(image.channels(), channels + 1);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          bool same = true;
          for (int k = 0; k < channels; ++k) {
            same = same && sample(kind, x, y, k) == sample(kind, kX, kY, k);
            EXPECT_NEAR(image.at(x, y)[k], shown(kind, x, y, k), 1e-7);
          }
          EXPECT_EQ(image.at(x, y)[channels], same ? 0.0f : 1.0f)
              << "type " << kind.colour_type << ", depth " << kind.depth << ", at " << x << " " << y;
        }
      }
    }
  }
}

TEST(PngSuite, APalettesAlphasMayBeFewerThanItsColours) {
  constexpr int kWidth = 11, kHeight = 7;
  for (const Kind& kind : kKinds) {
    if (kind.colour_type != kPalette) continue;
    const Image image =
        raw_picture(made(kind, kWidth, kHeight, true, chunk("tRNS", text_of({0, 128}))), as_stored());
    ASSERT_EQ(image.channels(), 4);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int index = sample(kind, x, y, 0);
        EXPECT_NEAR(image.at(x, y)[3], index == 0 ? 0 : index == 1 ? 128 / 255.0 : 1, 1e-7);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(image.at(x, y)[k], shown(kind, x, y, k), 1e-7);
      }
    }
  }
}

TEST(PngSuite, EveryGammaIsUndone) {
  for (const int gamma : {35000, 40000, 55000, 70000, 100000, 250000}) {
    const Bytes bytes = picture(1, 1, 8, kColour, {0, 64, 128, 255},
                                chunk("gAMA", big_endian(static_cast<std::size_t>(gamma))));
    const Image image = decoded(bytes);
    const int stored[] = {64, 128, 255};
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(image.at(0, 0)[k], std::pow(stored[k] / 255.0, 100000.0 / gamma), 1e-5) << gamma;
  }
}

TEST(PngSuite, ChunksThatAreNotObeyedAreTold) {
  const auto warnings = [](int colour_type, const std::string& chunks) {
    const Values row = colour_type == kColour ? Values{0, 9, 9, 9} : Values{0, 9, 9, 9, 255};
    return info_of(picture(1, 1, 8, colour_type, row, chunks)).warnings;
  };
  const std::string zeros(32, '\0'), linear = chunk("gAMA", big_endian(100000));
  EXPECT_TRUE(warnings(kColour, linear).empty());
  EXPECT_EQ(warnings(kColour, chunk("cHRM", zeros)).size(), 1u);
  EXPECT_EQ(warnings(kColour, chunk("gAMA", big_endian(0))).size(), 1u);
  EXPECT_EQ(warnings(kColour, chunk("iCCP", std::string("a\0\0", 3) + deflated("nothing"))).size(), 1u);
  EXPECT_EQ(warnings(kColourAlpha, chunk("tRNS", "abcdef")).size(), 1u);
  EXPECT_TRUE(
      warnings(kColour, chunk("sRGB", std::string(1, '\0')) + chunk("gAMA", big_endian(45455))).empty());
}

TEST(PngSuite, WhatLiesAfterThePixelsIsRead) {
  const std::string exif("II*\0\x08\0\0\0\1\0\x12\1\3\0\1\0\0\0\6\0\0\0\0\0\0\0", 26);
  const std::string packet =
      "<a><p:b xmlns:p='http://ns.google.com/photos/1.0/panorama/' p:ProjectionType='equirectangular'/></a>";
  const auto late = [&](const std::string& chunks) {
    const Bytes before = made({kColour, 8}, 3, 2, false), inserted = bytes_of(chunks);
    Bytes bytes = before;
    bytes.insert(bytes.end() - 12, inserted.begin(), inserted.end());
    return bytes;
  };
  const FileInfo turned = info_of(late(chunk("eXIf", exif)));
  EXPECT_EQ(turned.parts[0].width, 2);
  EXPECT_EQ(turned.parts[0].height, 3);
  const std::string keyword = "XML:com.adobe.xmp";
  const FileInfo info = info_of(late(chunk("iTXt", keyword + std::string(5, '\0') + packet)));
  ASSERT_TRUE(info.panorama);
  EXPECT_EQ(info.panorama->projection, "equirectangular");
  EXPECT_EQ(info_of(late(chunk("iTXt", keyword + std::string("\0\1\0\0\0", 5) + "?"))).warnings.size(), 1u);
  EXPECT_EQ(info_of(late(chunk("iTXt", keyword + std::string(1, '\0')))).warnings.size(), 1u);
}

TEST(PngSuite, DamageIsNamed) {
  const Kind kind{kColour, 8};
  const Bytes sound = made(kind, 4, 4, false);
  const auto with = [&](std::size_t at, int value) {
    Bytes bytes = sound;
    bytes.at(at) = static_cast<std::byte>(value);
    return bytes;
  };
  const Values rows = rows_of(kind, 4, 4, false);
  const std::string signature("\x89PNG\r\n\x1a\n");
  const auto header = [](int depth, int colour_type) {
    return chunk("IHDR", big_endian(4) + big_endian(4) + text_of({depth, colour_type, 0, 0, 0}));
  };
  const std::string pixels = chunk("IDAT", deflated(text_of(rows))), end = chunk("IEND", "");
  struct Case {
    const char* what;
    Bytes bytes;
    const char* message;  ///< a part of it
  };
  const Case cases[] = {
      {"first byte", with(0, 0x88), "format"},
      {"line ends changed", with(4, '\n'), "format"},
      {"checksum of the header", with(8 + 8 + 13, 1), "CRC"},
      {"checksum of the pixels", with(sound.size() - 13, 1), "CRC"},
      {"no pixels", bytes_of(signature + header(8, kColour) + end), "IDAT"},
      {"colour type 1", bytes_of(signature + header(8, 1) + pixels + end), "IHDR"},
      {"colour type 9", bytes_of(signature + header(8, 9) + pixels + end), "IHDR"},
      {"depth 0", bytes_of(signature + header(0, kColour) + pixels + end), "IHDR"},
      {"depth 3", bytes_of(signature + header(3, kGrey) + pixels + end), "IHDR"},
      {"depth 99", bytes_of(signature + header(99, kColour) + pixels + end), "IHDR"},
      {"colours of 4 bits", bytes_of(signature + header(4, kColour) + pixels + end), "IHDR"},
      {"no palette", bytes_of(signature + header(8, kPalette) + pixels + end), "PLTE"},
      {"no header", bytes_of(signature + pixels + end), "IHDR"},
      {"a filter of 5", picture(1, 1, 8, kGrey, {5, 0}), "filter"},
      {"too few rows", picture(4, 4, 8, kGrey, {0, 1, 2, 3, 4}), ""},
  };
  for (const Case& each : cases) {
    const std::string message = error_of([&] { decoded(each.bytes); });
    EXPECT_NE(message.find(each.message), std::string::npos) << each.what << ": " << message;
    EXPECT_NE(message.find("test"), std::string::npos) << each.what << ": " << message;
  }
  EXPECT_EQ(decoded(sound).width(), 4);
}

}  // namespace
}  // namespace welkin::io::test
