#include "welkin/io/format.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

namespace fs = std::filesystem;

/// Of the formats that this file's laws hold for; EXR has its own tests, as has `.env`, which takes whole
/// cubes alone.
std::vector<std::string> extensions() {
  std::vector<std::string> names = writable_extensions();
  std::erase_if(names,
                [](const std::string& name) { return name == "exr" || name == "env" || name == "glb"; });
  return names;
}

TEST(Formats, ExtensionsAreTheDocumentedOnes) {
  const std::vector<std::string> documented = {"hdr", "ktx2", "ktx", "dds",  "pfm", "png",
                                               "jpg", "jpeg", "tif", "tiff", "webp"};
  EXPECT_EQ(extensions(), documented);
}

TEST(Formats, PixelTypesHaveTheirNames) {
  EXPECT_EQ(name_of(PixelType::uint8), "uint8");
  EXPECT_EQ(name_of(PixelType::uint16), "uint16");
  EXPECT_EQ(name_of(PixelType::uint32), "uint32");
  EXPECT_EQ(name_of(PixelType::half), "half");
  EXPECT_EQ(name_of(PixelType::float32), "float");
  EXPECT_EQ(name_of(PixelType::rgb9e5), "rgb9e5");
  EXPECT_EQ(name_of(PixelType::r11g11b10), "r11g11b10");
  EXPECT_EQ(name_of(PixelType::bc6h), "bc6h");
}

TEST(Formats, AreKnownByTheirBytesNotTheirName) {
  const TemporaryFolder folder;
  const Image image = noise(3, 2, 3);
  for (const std::string& extension : extensions()) {
    const WritePart part{"", image.view(), names_of(3)};
    write(folder / ("a." + extension), {&part, 1});
    fs::rename(folder / ("a." + extension), folder / "misleading.exr");
    const auto reader = open(folder / "misleading.exr");
    const std::vector<Format>& all = formats();
    const auto format = std::find_if(all.begin(), all.end(), [&](const Format& each) {
      return std::count(each.capabilities.extensions.begin(), each.capabilities.extensions.end(), extension) >
             0;
    });
    EXPECT_EQ(reader->info().format, format->capabilities.format);
    EXPECT_EQ(reader->info().bytes, fs::file_size(folder / "misleading.exr"));
    EXPECT_EQ(reader->info().parts.at(0).width, 3);
    EXPECT_EQ(reader->info().parts.at(0).height, 2);
    EXPECT_EQ(read_part(*reader).width(), 3);
  }
}

TEST(Formats, UppercaseExtensionsAreTheSame) {
  const TemporaryFolder folder;
  const Image image = noise(3, 2, 3);
  const WritePart part{"", image.view(), names_of(3)};
  write(folder / "a.PFM", {&part, 1});
  EXPECT_EQ(open(folder / "a.PFM")->info().format, "pfm");
}

TEST(Formats, UnknownFilesAreExplained) {
  EXPECT_EQ(error_of([] { open(Bytes{}, "a.hdr"); }), "a.hdr: the file is empty");
  const std::string message = error_of([] { open(bytes_of("\2XYZ89a\1"), "a.xyz"); });
  EXPECT_NE(
      message.find("a.xyz: not an image of a known format: begins with '.XYZ89a.' (02 58 59 5a 38 39 61 01)"),
      std::string::npos)
      << message;
  EXPECT_NE(message.find("exr, hdr, ktx2, ktx, dds, pfm, png, jpeg, tiff, webp, jxl, avif, heif"),
            std::string::npos)
      << message;
  const TemporaryFolder folder;
  const std::string missing = (folder / "missing.png").string();
  EXPECT_EQ(error_of([&] { open(fs::path(missing)); }), missing + ": No such file or directory");
}

TEST(Formats, UnknownExtensionsAreExplained) {
  const TemporaryFolder folder;
  const Image image = noise(2, 2, 3);
  const WritePart part{"", image.view(), names_of(3)};
  const auto message_for = [&](const std::string& name) {
    return error_of([&] { write(folder / name, {&part, 1}); });
  };
  EXPECT_NE(message_for("a.hdrr").find("a.hdrr: unknown extension 'hdrr'; did you mean 'hdr'?"),
            std::string::npos);
  EXPECT_NE(message_for("a").find("a: the name has no extension"), std::string::npos);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Formats, OnlyReadOnesAreNotWritten) {
  const TemporaryFolder folder;
  const Image image = noise(2, 2, 3);
  const WritePart part{"", image.view(), names_of(3)};
  int count = 0;
  for (const Capabilities& format : all_capabilities()) {
    if (format.writable) continue;
    ++count;
    const std::string cause =
        format.title +
        " is only read here, not written (can be written: exr, hdr, ktx2, ktx, dds, pfm, png, jpg, "
        "jpeg, tif, tiff, webp, env, glb)";
    for (const std::string& extension : format.extensions) {
      const fs::path path = folder / ("a." + extension);
      EXPECT_EQ(error_of([&] { write(path, {&part, 1}); }), path.string() + ": " + cause);
      EXPECT_EQ(error_of([&] { check_write(path, 2, 2, names_of(3)); }), path.string() + ": " + cause);
    }
    MemorySink sink;
    EXPECT_EQ(error_of([&] { write(sink, format.format, {&part, 1}); }), cause);
    EXPECT_EQ(sink.size(), 0u);
  }
  EXPECT_GE(count, 1);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Formats, CheckSizeRefusesWhatCannotBe) {
  const Source source{{}, "a", {}};
  EXPECT_NO_THROW(check_size(source, 1, 1, 1));
  EXPECT_NO_THROW(check_size(source, 1 << 20, 1, 4));
  EXPECT_THROW(check_size(source, 0, 1, 1), Error);
  EXPECT_THROW(check_size(source, 1, 0, 1), Error);
  EXPECT_THROW(check_size(source, 1, 1, 0), Error);
  EXPECT_THROW(check_size(source, (1 << 20) + 1, 1, 1), Error);
  EXPECT_THROW(check_size(source, 1, std::uint64_t{1} << 63, 1), Error);
  EXPECT_THROW(check_size(source, 1 << 20, 1 << 20, 1), Error);
  EXPECT_THROW(check_size(source, 1 << 20, 1 << 20, std::uint64_t{1} << 62), Error);
  Source small = source;
  small.options.max_bytes = 4 * 6 * 3;
  EXPECT_NO_THROW(check_size(small, 3, 2, 3));
  EXPECT_THROW(check_size(small, 3, 2, 4), Error);
}

TEST(Formats, LimitOfMemoryHoldsForEveryFormat) {
  ReadOptions options;
  options.max_bytes = 16 * 16 * 3 * sizeof(float) - 1;
  for (const std::string& extension : extensions()) {
    const Bytes bytes = encoded(extension, noise(16, 16, 3));
    EXPECT_NO_THROW(info_of(bytes)) << extension;
    const std::string message = error_of([&] { info_of(bytes, options); });
    EXPECT_NE(message.find("over the limit"), std::string::npos) << extension << ": " << message;
  }
}

TEST(Formats, FullDiskLeavesNothingAndSaysSo) {
  const TemporaryFolder folder;
  const Image image = noise(64, 64, 3);
  const WritePart part{"", image.view(), names_of(3)};
  for (const std::string& extension : extensions()) {
    const fs::path path = folder / ("full." + extension);
    fs::create_symlink("/dev/full", path);
    EXPECT_EQ(error_of([&] { write(path, {&part, 1}); }), path.string() + ": No space left on device");
  }
  EXPECT_EQ(folder.entries(), static_cast<int>(extensions().size()));
}

TEST(Formats, RefusedPictureLeavesTheOlderFile) {
  const TemporaryFolder folder;
  const Image image = noise(4, 4, 3);
  const WritePart part{"", image.view(), {"A", "B", "C"}};
  for (const std::string extension : {"hdr", "pfm", "png", "jpg", "webp"}) {
    const fs::path path = folder / ("a." + extension);
    std::ofstream(path) << "older";
    const std::string message = error_of([&] { write(path, {&part, 1}); });
    EXPECT_NE(message.find("holds the channels Y or R G B"), std::string::npos) << message;
    EXPECT_EQ(file_bytes(path), bytes_of("older"));
  }
  EXPECT_EQ(folder.entries(), 5);
}

TEST(Formats, OnePictureFormatsRefuseTwo) {
  const TemporaryFolder folder;
  const Image image = noise(4, 4, 3);
  const WritePart parts[2] = {{"a", image.view(), names_of(3)}, {"b", image.view(), names_of(3)}};
  for (const std::string extension : {"hdr", "pfm", "png", "jpg", "webp"}) {
    const std::string message = error_of([&] { write(folder / ("a." + extension), parts); });
    EXPECT_NE(message.find("holds one picture, not 2"), std::string::npos) << message;
  }
}

TEST(Formats, OptionsThatAFormatLacksAreRefused) {
  const Image image = noise(4, 4, 3);
  for (const std::string& extension : extensions()) {
    WriteOptions options;
    options.compression = "zipp";
    EXPECT_THROW(encoded(extension, image, options), Error) << extension;
  }
  WriteOptions options;
  options.type = PixelType::half;
  for (const std::string extension : {"hdr", "pfm", "png", "jpg", "webp"}) {
    EXPECT_THROW(encoded(extension, image, options), Error) << extension;
  }
  for (const int quality : {0, 101}) {
    WriteOptions bad;
    bad.quality = quality;
    EXPECT_THROW(encoded("jpg", image, bad), Error);
    EXPECT_THROW(encoded("webp", image, bad), Error);
  }
}

// A view with gaps between rows and a part of its channels, out of order, gives the same values as the whole.
TEST(Formats, AnyChannelsInAnyOrderIntoAnyStride) {
  for (const std::string& extension : extensions()) {
    const Bytes bytes = encoded(extension, noise(9, 5, 3));
    const auto reader = open(bytes, extension);
    const Image whole = read_part(*reader);
    for (const auto& channels :
         {std::vector{2, 0}, std::vector{1}, std::vector{2, 1, 0}, std::vector{0, 0, 1, 2}}) {
      const int count = static_cast<int>(channels.size());
      Image wide(20, 8, count);
      reader->read(0, channels, wide.view().part(3, 2, 9, 5));
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 20; ++x) {
          const bool inside = x >= 3 && x < 12 && y >= 2 && y < 7;
          for (int k = 0; k < count; ++k) {
            const float expected = inside ? whole.at(x - 3, y - 2)[channels[static_cast<std::size_t>(k)]] : 0;
            ASSERT_EQ(wide.at(x, y)[k], expected) << extension;
          }
        }
      }
    }
  }
}

// Channels are found by name, whatever their order in memory, and rows may have gaps.
TEST(Formats, WritersFindChannelsByName) {
  const Image image = noise(9, 5, 3);
  Image shuffled(30, 9, 3);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 9; ++x) {
      for (int k = 0; k < 3; ++k) shuffled.at(x + 4, y + 1)[(k + 1) % 3] = image.at(x, y)[k];
    }
  }
  const TemporaryFolder folder;
  for (const std::string& extension : extensions()) {
    const fs::path path = folder / ("a." + extension);
    const WritePart part{"", shuffled.view().part(4, 1, 9, 5), {"B", "R", "G"}};
    write(path, {&part, 1});
    EXPECT_EQ(file_bytes(path), encoded(extension, image)) << extension;
  }
}

TEST(Formats, IntegerFormatsCountWhatTheyClip) {
  Image image(4, 1, 3);
  const float values[12] = {0, 1, 0.5f, 2, 3e38f, -0.5f, -0.0f, INFINITY, -INFINITY, NAN, 1, 0};
  std::copy(values, values + 12, image.at(0, 0));
  for (const std::string extension : {"png", "jpg", "webp"}) {
    WriteReport report;
    encoded(extension, image, {}, &report);
    EXPECT_EQ(report.above, 2u) << extension;
    EXPECT_EQ(report.below, 1u) << extension;
    EXPECT_EQ(report.not_finite, 3u) << extension;
  }
}

TEST(Formats, ParallelWritersAndReadersAreIndependent) {
  const TemporaryFolder folder;
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < 4; ++i) {
    workers.emplace_back([&, i] {
      const Image image = noise(40, 30, 3, i);
      const WritePart part{"", image.view(), names_of(3)};
      for (const std::string extension : {"pfm", "tif"}) {
        const fs::path path = folder / (std::to_string(i) + "." + extension);
        write(path, {&part, 1});
        expect_same(read_part(*open(path)), image);
      }
    });
  }
  for (auto& worker : workers) worker.join();
}

TEST(Formats, DamageIsSurvived) {
  for (const std::string& extension : extensions()) {
    SCOPED_TRACE(extension);
    WriteOptions options;
    options.attributes = {{"Author", "nobody"}};
    expect_damage_is_survived(encoded(extension, noise(9, 3, 3), options));
  }
}

}  // namespace
}  // namespace welkin::io::test
