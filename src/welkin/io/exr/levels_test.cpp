// Mip pyramids in EXR: what OpenEXR's library writes is read, and it reads what we write.

#include <ImfTiledInputFile.h>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/exr/exr_test_files.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io {
namespace {

using namespace exr_test;
using test::TemporaryFolder;

/// One channel of a level, as OpenEXR's C++ library reads it.
Image level_by_library(const std::string& path, int level, const std::string& channel) {
  Imf::TiledInputFile file(path.c_str());
  const Imath::Box2i window = file.dataWindowForLevel(level);
  Image image(file.levelWidth(level), file.levelHeight(level), 1);
  Imf::FrameBuffer frame;
  frame.insert(channel, Imf::Slice::Make(Imf::FLOAT, image.at(0, 0), window, std::size_t{4},
                                         static_cast<std::size_t>(image.view().row_stride) * 4));
  file.setFrameBuffer(frame);
  file.readTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  return image;
}

void expect_levels_of_library(const std::string& path) {
  SCOPED_TRACE(path);
  const auto reader = open(std::filesystem::path(path));
  const FileInfo& info = reader->info();
  ASSERT_EQ(static_cast<std::size_t>(info.levels), info.parts.size());
  for (std::size_t level = 0; level < info.parts.size(); ++level) {
    const PartInfo& part = info.parts[level];
    EXPECT_EQ(part.level, static_cast<int>(level));
    EXPECT_EQ(part.name, "level " + std::to_string(level));
    const Image image = read_all(*reader, level);
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
      const Image expected = level_by_library(path, static_cast<int>(level), part.channels[c]);
      ASSERT_EQ(image.width(), expected.width());
      ASSERT_EQ(image.height(), expected.height());
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
          ASSERT_EQ(bits(image.at(x, y)[c]), bits(*expected.at(x, y)))
              << "level " << level << " channel " << part.channels[c] << " texel " << x << ", " << y;
    }
  }
}

TEST(ExrLevels, EveryLevelIsReadAsTheLibraryReadsIt) {
  const Folder folder;
  const std::map<std::string, Imf::PixelType> channels{
      {"R", Imf::HALF}, {"Z", Imf::FLOAT}, {"id", Imf::UINT}};
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    for (const auto rounding : {Imf::ROUND_DOWN, Imf::ROUND_UP}) {
      for (const Imath::V2i& corner : {Imath::V2i(0, 0), Imath::V2i(-7, 5)}) {
        const Imath::Box2i window(corner, corner + Imath::V2i(40, 21));
        TestPart part = part_of(window, window, Imf::Compression(compression), channels);
        make_tiled(part, 16, 8, Imf::MIPMAP_LEVELS, rounding);
        write_file(folder / "mip.exr", {part});
        EXPECT_EQ(open(std::filesystem::path(folder / "mip.exr"))->info().levels,
                  rounding == Imf::ROUND_DOWN ? 6 : 7);
        expect_levels_of_library(folder / "mip.exr");
      }
    }
  }
}

TEST(ExrLevels, WhereOnlyTheFinestIsReadTheNoteSaysSo) {
  const Folder folder;
  const auto expect_one = [&](const std::vector<TestPart>& parts) {
    write_file(folder / "one.exr", parts);
    const auto reader = open(std::filesystem::path(folder / "one.exr"));
    EXPECT_EQ(reader->info().levels, 1);
    EXPECT_EQ(reader->info().parts.size(), parts.size());
    EXPECT_NE(reader->info().notes.at(0).find("(level 0 is read)"), std::string::npos);
    expect_equals_library(folder / "one.exr");
  };
  const Imath::Box2i window({0, 0}, {20, 20}), inside({3, 3}, {12, 12});
  TestPart ripmap = part_of(window, window, Imf::ZIP_COMPRESSION, {{"Y", Imf::HALF}});
  make_tiled(ripmap, 8, 8, Imf::RIPMAP_LEVELS);
  expect_one({ripmap});
  TestPart placed = part_of(window, inside, Imf::ZIP_COMPRESSION, {{"Y", Imf::HALF}});
  make_tiled(placed, 8, 8, Imf::MIPMAP_LEVELS);
  expect_one({placed});
  TestPart first = part_of(window, window, Imf::ZIP_COMPRESSION, {{"Y", Imf::HALF}});
  make_tiled(first, 8, 8, Imf::MIPMAP_LEVELS);
  first.header.setName("first");
  TestPart second = first;
  second.header.setName("second");
  expect_one({first, second});
}

/// Levels of noise.
struct Pyramid {
  std::vector<Image> images;
  std::vector<WritePart> parts;

  Pyramid(int width, int height, int levels, const std::vector<std::string>& channels = {"R", "G", "B"}) {
    for (int level = 0; level < levels; ++level)
      images.push_back(test::noise(std::max(1, width >> level), std::max(1, height >> level),
                                   static_cast<int>(channels.size()), static_cast<unsigned>(level)));
    for (int level = 0; level < levels; ++level)
      parts.push_back({"", images[static_cast<std::size_t>(level)].view(), channels, level});
  }
};

TEST(ExrLevels, WhatIsWrittenIsReadBack) {
  const TemporaryFolder folder;
  const auto path = folder / "mip.exr";
  for (const auto& [width, height] : {std::pair{150, 70}, std::pair{64, 64}, std::pair{9, 200}}) {
    const Pyramid pyramid(width, height, 7);
    for (const std::string compression : {"none", "rle", "zips", "zip", "piz", "pxr24"}) {
      for (const auto type : {PixelType::float32, PixelType::half}) {
        SCOPED_TRACE(compression);
        WriteOptions options;
        options.compression = compression;
        options.type = type;
        options.attributes = {{"welkin.parameterization", "latlong"}};
        options.envmap = "latlong";
        write(path, pyramid.parts, options);
        const auto reader = open(path);
        const FileInfo& info = reader->info();
        EXPECT_EQ(info.levels, 7);
        EXPECT_EQ(info.attributes.at("welkin.parameterization"), "latlong");
        EXPECT_EQ(info.envmap, "latlong");
        EXPECT_EQ(info.parts.at(3).compression, compression);
        EXPECT_EQ(info.parts.at(3).type, type);
        for (std::size_t level = 0; level < 7; ++level) {
          const Image image = test::read_part(*reader, level);
          // Half keeps 11 bits, PXR24 16 of a float.
          const float tolerance = type == PixelType::half  ? 0x1p-12f
                                  : compression == "pxr24" ? 0x1p-16f
                                                           : 0.0f;
          EXPECT_LE(test::largest_difference(image, pyramid.images[level]), tolerance) << level;
        }
        expect_levels_of_library(path.string());
      }
    }
  }
}

TEST(ExrLevels, ThePyramidIsCompletedByAverages) {
  const TemporaryFolder folder;
  const Pyramid pyramid(16, 12, 3, {"Y"});
  write(folder / "part.exr", pyramid.parts);
  EXPECT_EQ(open(folder / "part.exr")->info().levels, 3) << "those that were given";
  Imf::TiledInputFile file((folder / "part.exr").c_str());
  EXPECT_EQ(file.numLevels(), 5);
  const ImageView<const float> last = pyramid.images[2].view();
  const Image after = level_by_library((folder / "part.exr").string(), 3, "Y");
  ASSERT_EQ(after.width(), 2);
  ASSERT_EQ(after.height(), 1);
  EXPECT_NEAR(*after.at(1, 0), (*last.at(2, 0) + *last.at(3, 0) + *last.at(2, 1) + *last.at(3, 1)) / 4, 1e-6);
}

TEST(ExrLevels, OneLevelIsAPlainFile) {
  const TemporaryFolder folder;
  const Pyramid pyramid(16, 12, 1);
  write(folder / "a.exr", pyramid.parts);
  EXPECT_TRUE(open(folder / "a.exr")->info().notes.empty()) << "scan lines";
}

TEST(ExrLevels, LossesOfLevelsAreCounted) {
  const TemporaryFolder folder;
  Pyramid pyramid(4, 4, 2);
  pyramid.images[0].at(0, 0)[1] = 1e9f;
  pyramid.images[1].at(1, 1)[0] = 1e9f;
  WriteOptions options;
  options.type = PixelType::half;
  EXPECT_EQ(write(folder / "a.exr", pyramid.parts, options).above, 2u) << "and not those of the averages";
}

TEST(ExrLevels, WhatIsNoPyramidIsRefused) {
  const TemporaryFolder folder;
  const auto message = [&](const std::vector<WritePart>& parts) {
    return test::error_of([&] { write(folder / "a.exr", parts); });
  };
  const Pyramid pyramid(16, 12, 5);
  auto parts = pyramid.parts;
  parts.erase(parts.begin() + 2);
  EXPECT_NE(message(parts).find("no picture for level 2"), std::string::npos) << message(parts);
  parts = pyramid.parts;
  parts.push_back(parts[1]);
  EXPECT_NE(message(parts).find("two pictures for level 1"), std::string::npos) << message(parts);
  parts = pyramid.parts;
  parts[2].image.height = 2;
  EXPECT_NE(message(parts).find("level 2 is 4×2, not 4×3"), std::string::npos) << message(parts);
  parts = pyramid.parts;
  parts[4].level = 5;
  parts.push_back(parts[4]);
  parts.back().level = 4;
  EXPECT_NE(message(parts).find("levels after that of 1×1"), std::string::npos) << message(parts);
  parts = pyramid.parts;
  parts[1].channels = {"R", "G", "Z"};
  EXPECT_NE(message(parts).find("level 1 has other channels"), std::string::npos) << message(parts);
  parts = pyramid.parts;
  parts[1].face = 1;
  EXPECT_NE(message(parts).find("not layers or faces"), std::string::npos) << message(parts);
}

}  // namespace
}  // namespace welkin::io
