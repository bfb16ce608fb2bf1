#include "welkin/io/part_rows.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

/// The same picture, which doesn't lie in memory: its rows are drawn when they are asked for.
WritePart drawn(const WritePart& part) {
  WritePart copy = part;
  copy.image.data = nullptr;
  copy.draw = [image = part.image](int y, ImageView<float> rows) {
    ASSERT_LE(y + rows.height, image.height);
    copy_pixels(image.part(0, y, image.width, rows.height), rows);
  };
  return copy;
}

Bytes written(const std::string& extension, const std::vector<WritePart>& parts,
              const WriteOptions& options) {
  const TemporaryFolder folder;
  write(folder / ("picture." + extension), parts, options);
  return file_bytes(folder / ("picture." + extension));
}

TEST(PartRows, AreThoseOfThePicture) {
  const Image image = noise(7, 50, 3);
  const WritePart whole{"", image.view(), names_of(3)};
  for (const WritePart& part : {whole, drawn(whole)}) {
    PartRows source(part);
    Image memory;
    for (const auto& [y, count] : std::vector<std::pair<int, int>>{{0, 3}, {40, 10}, {5, 1}, {0, 50}}) {
      for (const auto& rows : {source.rows(y, count), draw_rows(part, y, count, memory)}) {
        ASSERT_EQ(rows.height, count);
        for (int i = 0; i < count; ++i)
          EXPECT_EQ(std::memcmp(rows.row(i), image.view().row(y + i), 7 * 3 * sizeof(float)), 0);
      }
    }
  }
}

TEST(PartRows, GiveTheSameFileInEveryFormat) {
  for (const std::string& extension : writable_extensions()) {
    if (extension == "env" || extension == "glb") continue;  // hold a cube alone
    for (const int channels : {1, 3}) {
      const Image image = noise(33, 700, channels);
      const WritePart part{"", image.view(), names_of(channels)};
      EXPECT_EQ(written(extension, {part}, {}), written(extension, {drawn(part)}, {})) << extension;
    }
  }
}

TEST(PartRows, GiveTheSameExrWithEveryCompressionTypeAndStructure) {
  const Image image = noise(65, 601, 4), other = noise(9, 40, 1);
  const Image level = noise(32, 300, 4);
  const WritePart first{"first", image.view(), names_of(4)}, second{"second", other.view(), {"depth"}};
  WritePart coarse{"", level.view(), names_of(4)};
  coarse.level = 1;
  for (const char* compression : {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "dwab"}) {
    for (const PixelType type : {PixelType::half, PixelType::float32, PixelType::uint32}) {
      WriteOptions options;
      options.compression = compression;
      options.type = type;
      EXPECT_EQ(written("exr", {first, second}, options),
                written("exr", {drawn(first), drawn(second)}, options))
          << compression;
      EXPECT_EQ(written("exr", {first, coarse}, options),
                written("exr", {drawn(first), drawn(coarse)}, options))
          << compression;
    }
  }
}

/// Larger than the pieces in which files are written, in every way that lines and pieces can meet.
TEST(PartRows, OfLargePicturesAreAllWritten) {
  for (const auto& [width, height] : {std::pair{11000, 61}, std::pair{300, 4100}, std::pair{1, 140001}}) {
    for (const int channels : {1, 3, 4}) {
      const Image image = noise(width, height, channels);
      for (const char* compression : {"none", "zips"}) {
        WriteOptions options;
        options.compression = compression;
        const WritePart part{"", image.view(), names_of(channels)};
        expect_same(decoded(written("exr", {drawn(part)}, options)), image);
      }
    }
  }
}

TEST(PartRows, ThatCannotBeDrawnLeaveNoFile) {
  const Image image = noise(100, 3000, 3);
  for (const std::string& extension : writable_extensions()) {
    WritePart part{"", image.view(), names_of(3)};
    part.image.data = nullptr;
    part.draw = [](int y, ImageView<float> rows) {
      if (y + rows.height > 2000) throw Error(ErrorKind::system, "no more rows");
      for (int i = 0; i < rows.height; ++i) std::fill_n(rows.row(i), rows.width * rows.channels, 0.5f);
    };
    const TemporaryFolder folder;
    const auto path = folder / ("picture." + extension);
    EXPECT_EQ(error_of([&] { write(path, {&part, 1}, {}); }), path.string() + ": no more rows");
    EXPECT_EQ(folder.entries(), 0);
  }
}

}  // namespace
}  // namespace welkin::io::test
