// Reading: files that OpenEXR's library wrote must come out as that library reads them, bit for bit.

#include <ImfEnvmap.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <array>

#include "welkin/base/parallel.h"
#include "welkin/io/exr/chunk.h"
#include "welkin/io/exr/exr_test_files.h"

namespace welkin::io {
namespace {

using namespace exr_test;

const std::map<std::string, Imf::PixelType> kRgb{{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}};
const std::map<std::string, Imf::PixelType> kMixed{
    {"B", Imf::HALF}, {"R", Imf::FLOAT}, {"Z", Imf::FLOAT}, {"id", Imf::UINT}, {"A", Imf::HALF}};

Imath::Box2i box(int min_x, int min_y, int max_x, int max_y) {
  return {{min_x, min_y}, {max_x, max_y}};
}

TEST(ExrRead, EveryCompressionEqualsTheLibraryInScanLinesAndTiles) {
  const Folder folder;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    for (const Fill fill : {Fill::smooth, Fill::noise}) {
      const std::string name = std::to_string(compression) + (fill == Fill::noise ? "-noise" : "");
      TestPart part = part_of(box(0, 0, 300, 69), box(0, 0, 300, 69), Imf::Compression(compression), kMixed);
      write_file(folder / ("lines-" + name + ".exr"), {part}, fill);
      expect_equals_library(folder / ("lines-" + name + ".exr"));
      make_tiled(part, 64, 16);
      write_file(folder / ("tiles-" + name + ".exr"), {part}, fill);
      expect_equals_library(folder / ("tiles-" + name + ".exr"));
    }
  }
}

TEST(ExrRead, PlacesAndCropsEveryDataWindow) {
  const Folder folder;
  const std::array<Imath::Box2i, 6> windows{box(5, 7, 40, 30),   box(-20, -33, 90, 80),
                                            box(-20, 3, 10, 90), box(30, -40, 99, 10),
                                            box(48, 36, 48, 36), box(200, 200, 230, 240)};
  const Imath::Box2i display = box(1, -2, 48, 36);
  for (std::size_t i = 0; i < windows.size(); ++i)
    for (const auto compression : {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION})
      for (const bool tiled : {false, true}) {
        TestPart part = part_of(display, windows[i], compression, kRgb);
        if (tiled) make_tiled(part, 16, 24);
        const std::string path = folder / (std::to_string(i) + "-" + std::to_string(compression) +
                                           (tiled ? "-tiles.exr" : "-lines.exr"));
        write_file(path, {part});
        expect_equals_library(path);
        const auto reader = open(std::filesystem::path(path));
        EXPECT_EQ(reader->info().parts[0].width, 48);
        EXPECT_EQ(reader->info().parts[0].height, 39);
        const bool cropped =
            windows[i].min.x < 1 || windows[i].min.y < -2 || windows[i].max.x > 48 || windows[i].max.y > 36;
        EXPECT_NE(reader->info().notes.back().find(cropped ? "is cropped to" : "lies inside"),
                  std::string::npos);
      }
}

TEST(ExrRead, EveryLineOrderGivesTheSamePixels) {
  const Folder folder;
  for (const auto order : {Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y})
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PXR24_COMPRESSION})
      for (const bool tiled : {false, true}) {
        if (order == Imf::RANDOM_Y && !tiled) continue;
        TestPart part = part_of(box(0, 0, 99, 99), box(0, 0, 99, 99), compression, kRgb);
        if (tiled) make_tiled(part, 32, 32);
        part.header.lineOrder() = order;
        const std::string path = folder / "order.exr";
        write_file(path, {part});
        expect_equals_library(path);
      }
}

TEST(ExrRead, LevelZeroOfMipmapsAndRipmaps) {
  const Folder folder;
  for (const auto mode : {Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS})
    for (const auto rounding : {Imf::ROUND_DOWN, Imf::ROUND_UP})
      for (const auto compression : {Imf::ZIPS_COMPRESSION, Imf::B44_COMPRESSION})
        for (const int width : {1, 64, 77}) {
          TestPart part = part_of(box(0, 0, width - 1, 50), box(0, 0, width - 1, 50), compression, kRgb);
          make_tiled(part, 16, 8, mode, rounding);
          const std::string path = folder / "levels.exr";
          write_file(path, {part});
          expect_equals_library(path);
          const std::string note = open(std::filesystem::path(path))->info().notes.at(0);
          EXPECT_NE(note.find("16x8"), std::string::npos) << note;
          EXPECT_NE(note.find(mode == Imf::MIPMAP_LEVELS ? "mipmapped" : "ripmapped"), std::string::npos)
              << note;
        }
}

TEST(ExrRead, PartsOfDifferentKinds) {
  const Folder folder;
  std::vector<TestPart> parts{part_of(box(0, 0, 59, 39), box(0, 0, 59, 39), Imf::ZIP_COMPRESSION, kRgb),
                              part_of(box(0, 0, 59, 39), box(0, 0, 59, 39), Imf::PIZ_COMPRESSION, kMixed),
                              part_of(box(0, 0, 59, 39), box(9, 9, 19, 19), Imf::RLE_COMPRESSION, kMixed),
                              part_of(box(0, 0, 59, 39), box(0, 0, 59, 39), Imf::DWAA_COMPRESSION, kRgb)};
  make_tiled(parts[1], 20, 20);
  make_tiled(parts[2], 8, 8, Imf::MIPMAP_LEVELS);
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].header.setName("part" + std::to_string(i));
  const std::string path = folder / "parts.exr";
  write_file(path, parts);
  expect_equals_library(path);
  const auto reader = open(std::filesystem::path(path));
  ASSERT_EQ(reader->info().parts.size(), 4u);
  EXPECT_EQ(reader->info().parts[1].name, "part1");
  EXPECT_EQ(reader->info().parts[1].compression, "piz");
  EXPECT_EQ(reader->info().parts[1].type, PixelType::float32);
  EXPECT_EQ(reader->info().parts[3].type, PixelType::half);
}

TEST(ExrRead, ReportsColourThenLuminanceThenOthersByName) {
  const Folder folder;
  TestPart part = part_of(box(0, 0, 9, 9), box(0, 0, 9, 9), Imf::NO_COMPRESSION,
                          {{"Z", Imf::FLOAT},
                           {"A", Imf::HALF},
                           {"Y", Imf::HALF},
                           {"B", Imf::HALF},
                           {"R", Imf::HALF},
                           {"G", Imf::HALF},
                           {"N.x", Imf::HALF},
                           {"albedo.R", Imf::HALF}});
  const std::string path = folder / "order.exr";
  write_file(path, {part});
  const std::vector<std::string> expected{"R", "G", "B", "A", "Y", "N.x", "Z", "albedo.R"};
  EXPECT_EQ(open(std::filesystem::path(path))->info().parts[0].channels, expected);
  expect_equals_library(path);
}

TEST(ExrRead, AnyChannelsIntoAnyStride) {
  const Folder folder;
  for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    const std::string path = folder / "stride.exr";
    write_file(path, {part_of(box(0, 0, 599, 20), box(0, 0, 599, 20), compression, kMixed)});
    const auto reader = open(std::filesystem::path(path));
    const Image all = read_all(*reader);
    for (const std::vector<int>& channels :
         {std::vector<int>{3}, {1, 0}, {0, 0, 2}, {4, 3, 2, 1}, {0, 1, 2, 3, 4, 0, 1}}) {
      const int count = static_cast<int>(channels.size());
      Image larger(700, 30, count);
      const auto part = larger.view().part(50, 5, 600, 21);
      reader->read(0, channels, part);
      for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 600; ++x)
          for (int c = 0; c < count; ++c)
            ASSERT_EQ(bits(part.at(x, y)[c]), bits(all.at(x, y)[channels[static_cast<std::size_t>(c)]]));
      for (int c = 0; c < count; ++c) {
        EXPECT_EQ(larger.at(49, 10)[c], 0.0f);
        EXPECT_EQ(larger.at(650, 10)[c], 0.0f);
        EXPECT_EQ(larger.at(100, 4)[c], 0.0f);
        EXPECT_EQ(larger.at(100, 26)[c], 0.0f);
      }
    }
  }
}

TEST(ExrRead, PicturesOfOneValueAreNotTakenForTooShortFiles) {
  const Folder folder;
  const std::string path = folder / "flat.exr";
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
    for (const auto type : {Imf::HALF, Imf::FLOAT, Imf::UINT})
      for (const bool tiled : {false, true}) {
        TestPart part = part_of(box(0, 0, 1023, 511), box(0, 0, 1023, 511), Imf::Compression(compression),
                                {{"R", type}, {"mask", type}});
        if (tiled) make_tiled(part, 512, 512);
        write_file(path, {part}, Fill::zero);
        const Image image = read_all(*open(std::filesystem::path(path)));
        EXPECT_EQ(image.at(1023, 511)[0], 0.0f);
        EXPECT_EQ(image.at(1000, 500)[1], 0.0f);
      }
}

TEST(ExrRead, AttributesAsText) {
  const Folder folder;
  TestPart part = part_of(box(0, 0, 3, 3), box(0, 0, 3, 3), Imf::NO_COMPRESSION, kRgb);
  Imf::addOwner(part.header, "somebody");
  Imf::addWhiteLuminance(part.header, 0.1f);
  Imf::addFramesPerSecond(part.header, {24000, 1001});
  Imf::addAdoptedNeutral(part.header, {0.25f, -3.0f});
  Imf::addEnvmap(part.header, Imf::ENVMAP_CUBE);
  write_file(folder / "attributes.exr", {part});
  const auto reader = open(std::filesystem::path(folder / "attributes.exr"));
  const std::map<std::string, std::string> expected{{"owner", "somebody"},
                                                    {"whiteLuminance", "0.100000001"},
                                                    {"framesPerSecond", "24000/1001"},
                                                    {"adoptedNeutral", "0.25 -3"}};
  EXPECT_EQ(reader->info().attributes, expected);
  EXPECT_EQ(reader->info().envmap, "cube");
}

TEST(ExrRead, LuminanceAndChromaAsTheLibraryConvertsThem) {
  const Folder folder;
  const std::string path = folder / "yca.exr";
  constexpr int kWidth = 128, kHeight = 66;
  std::vector<Imf::Rgba> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto channel = [&](std::size_t c) { return static_cast<float>(value_at(x, y, c, Imf::HALF)); };
      pixels.emplace_back(channel(0), channel(1), channel(2), channel(3));
    }
  {
    Imf::RgbaOutputFile file(path.c_str(), kWidth, kHeight, Imf::WRITE_YCA);
    file.setFrameBuffer(pixels.data(), 1, kWidth);
    file.writePixels(kHeight);
  }
  std::vector<Imf::Rgba> expected(pixels.size());
  Imf::RgbaInputFile library(path.c_str());
  library.setFrameBuffer(expected.data(), 1, kWidth);
  library.readPixels(0, kHeight - 1);

  const auto reader = open(std::filesystem::path(path));
  EXPECT_EQ(reader->info().parts[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  const Image image = read_all(*reader);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Imf::Rgba& texel = expected[static_cast<std::size_t>(y * kWidth + x)];
      EXPECT_EQ(image.at(x, y)[0], texel.r);
      EXPECT_EQ(image.at(x, y)[1], texel.g);
      EXPECT_EQ(image.at(x, y)[2], texel.b);
      EXPECT_EQ(image.at(x, y)[3], texel.a);
    }
}

TEST(ExrSteps, EveryHalfBecomesTheFloatOfImath) {
  std::vector<std::uint16_t> halves(65536);
  std::vector<float> floats(halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = static_cast<std::uint16_t>(i);
  exr::convert_to_float(exr::StoredType::half, reinterpret_cast<const std::byte*>(halves.data()), 65536,
                        floats.data());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const float expected = Imath::half(Imath::half::FromBits, halves[i]);
    ASSERT_EQ(bits(floats[i]), bits(expected)) << i;
  }
}

TEST(ExrSteps, DifferencesAndInterleavingEqualTheirDefinitionAtEverySize) {
  for (std::size_t size = 1; size < 140; ++size) {
    std::vector<std::byte> bytes(size), expected(size), interleaved(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * i * 7 + size);
    expected[0] = bytes[0];
    for (std::size_t i = 1; i < size; ++i)
      expected[i] = static_cast<std::byte>(std::to_integer<int>(expected[i - 1]) +
                                           std::to_integer<int>(bytes[i]) - 128);
    exr::undo_differences(bytes);
    ASSERT_EQ(bytes, expected);
    exr::interleave_halves(bytes, interleaved);
    for (std::size_t i = 0; i < size; ++i)
      ASSERT_EQ(interleaved[i], bytes[i % 2 == 0 ? i / 2 : (size + 1) / 2 + i / 2]);
  }
}

}  // namespace
}  // namespace welkin::io
