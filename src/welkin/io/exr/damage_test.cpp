// Files that are cut off, damaged or made to harm: each gives Error, soon, and takes no more memory than it
// may.

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfOutputFile.h>

#include <chrono>
#include <functional>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/io/exr/exr_test_files.h"

namespace welkin::io {
namespace {

using namespace exr_test;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 24;

/// What opening and reading all parts throws, or empty.
std::string failure(std::span<const std::byte> bytes) {
  try {
    ReadOptions options;
    options.max_bytes = kMaxBytes;
    const auto reader = open(bytes, "test.exr", options);
    for (std::size_t part = 0; part < reader->info().parts.size(); ++part) read_all(*reader, part);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

const std::map<std::string, Imf::PixelType> kEveryType{
    {"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"Z", Imf::FLOAT}, {"id", Imf::UINT}};

std::vector<std::byte> small_file(const Folder& folder, Imf::Compression compression, bool tiled,
                                  const std::map<std::string, Imf::PixelType>& channels = kEveryType) {
  TestPart part = part_of({{0, 0}, {40, 37}}, {{0, 0}, {40, 37}}, compression, channels);
  if (tiled) make_tiled(part, 16, 16, Imf::MIPMAP_LEVELS);
  write_file(folder / "small.exr", {part});
  return bytes_of_file(folder / "small.exr");
}

TEST(ExrDamage, EveryTruncationIsAnError) {
  const Folder folder;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    const auto bytes = small_file(folder, Imf::Compression(compression), false);
    ASSERT_EQ(failure(bytes), "");
    for (std::size_t size = 0; size < bytes.size(); size += size < 700 ? 1 : 37) {
      // An exact copy on the heap, so that reading past the end is seen by the address sanitizer.
      const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_NE(failure(cut), "") << compression << " cut to " << size;
    }
  }
}

/// Layers, luminance with chroma, levels rounded up, parts with views and windows of their own.
std::vector<std::vector<std::byte>> unusual_files(const Folder& folder) {
  const Imath::Box2i window({0, 0}, {40, 37});
  std::vector<std::vector<TestPart>> files;
  const auto half = [](const std::vector<std::string>& names) {
    std::map<std::string, Imf::PixelType> channels;
    for (const std::string& name : names) channels[name] = Imf::HALF;
    return channels;
  };
  files.push_back(
      {part_of(window, window, Imf::ZIP_COMPRESSION, half({"a.b.R", "a.b.G", "a.b.B", "Z", "..", "x."}))});
  files.push_back({part_of(window, window, Imf::PIZ_COMPRESSION, half({"Y", "RY", "BY", "A"}))});
  files.push_back({part_of(window, window, Imf::ZIP_COMPRESSION, half({"R", "G", "B"}))});
  make_tiled(files.back()[0], 16, 16, Imf::MIPMAP_LEVELS, Imf::ROUND_UP);
  files.push_back({part_of(window, {{-5, -5}, {20, 20}}, Imf::RLE_COMPRESSION, half({"Z"})),
                   part_of(window, {{30, 10}, {45, 37}}, Imf::ZIPS_COMPRESSION, half({"R", "G", "B"}))});
  for (std::size_t i = 0; i < 2; ++i) {
    files.back()[i].header.setName("part" + std::to_string(i));
    files.back()[i].header.setView(i == 0 ? "left" : "right");
  }
  std::vector<std::vector<std::byte>> all;
  for (const auto& parts : files) {
    write_file(folder / "unusual.exr", parts);
    all.push_back(bytes_of_file(folder / "unusual.exr"));
  }
  return all;
}

TEST(ExrDamage, TruncationsAndChangesOfUnusualFiles) {
  const Folder folder;
  std::size_t refused = 0;
  for (const auto& bytes : unusual_files(folder)) {
    ASSERT_EQ(failure(bytes), "");
    for (std::size_t size = 0; size < bytes.size(); size += size < 900 ? 3 : 53) {
      const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_NE(failure(cut), "") << "cut to " << size << " of " << bytes.size();
    }
    for (std::size_t at = 0; at < bytes.size(); at += at < 900 ? 1 : 61) {
      for (const int value : {0x00, 0x7f, 0xff}) {
        auto changed = bytes;
        changed[at] = static_cast<std::byte>(value);
        refused += !failure(changed).empty();
      }
    }
  }
  EXPECT_GT(refused, 1000u);
}

TEST(ExrDamage, ATruncatedChunkNamesItsRow) {
  const Folder folder;
  auto bytes = small_file(folder, Imf::ZIP_COMPRESSION, false);
  bytes.pop_back();
  EXPECT_EQ(failure(bytes).find("test.exr: row 32: "), 0u) << failure(bytes);
}

/// Where the table of `count` offsets stands: its first entry points just behind it.
std::size_t chunk_table(const std::vector<std::byte>& bytes, std::size_t count) {
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) {
    std::uint64_t offset;
    std::memcpy(&offset, bytes.data() + i, sizeof offset);
    if (offset == i + count * sizeof offset) return i;
  }
  ADD_FAILURE() << "no table of chunks";
  return 0;
}

TEST(ExrDamage, ADamagedChunkNamesItsRow) {
  const Folder folder;
  struct Case {
    Imf::Compression compression;
    std::size_t chunks, damaged;
    const char* start;
  };
  for (const Case& c : {Case{Imf::ZIP_COMPRESSION, 3, 2, "test.exr: row 32: deflated data is damaged"},
                        Case{Imf::PIZ_COMPRESSION, 2, 0, "test.exr: row 0: "}}) {
    auto bytes = small_file(folder, c.compression, false, {{"Y", Imf::HALF}});
    std::uint64_t at;
    std::memcpy(&at, &bytes[chunk_table(bytes, c.chunks) + 8 * c.damaged], sizeof at);
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at) + 8, 16, std::byte{0xff});
    EXPECT_EQ(failure(bytes).find(c.start), 0u) << failure(bytes);
  }
}

TEST(ExrDamage, AnyChangedByteIsReadOrRefused) {
  const Folder folder;
  std::size_t refused = 0;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
    for (const bool tiled : {false, true}) {
      const auto bytes = small_file(folder, Imf::Compression(compression), tiled);
      for (std::size_t at = 0; at < bytes.size(); at += at < 500 ? 1 : 61)
        for (const int value : {0x00, 0x7f, 0xff}) {
          auto changed = bytes;
          changed[at] = static_cast<std::byte>(value);
          refused += !failure(changed).empty();
        }
    }
  EXPECT_GT(refused, 1000u);
}

/// Replaces the value of the first attribute of that name.
void set_attribute(std::vector<std::byte>& bytes, const std::string& name_and_type,
                   std::vector<std::uint32_t> words) {
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = text.find(name_and_type) + name_and_type.size() + sizeof(std::uint32_t);
  ASSERT_LT(at, bytes.size());
  std::memcpy(bytes.data() + at, words.data(), words.size() * sizeof(std::uint32_t));
}

using namespace std::string_literals;
const std::string kDataWindow = "dataWindow\0box2i\0"s, kDisplayWindow = "displayWindow\0box2i\0"s,
                  kTiles = "tiles\0tiledesc\0"s;

TEST(ExrDamage, AbsurdSizesAreRefusedAtOnce) {
  const Folder folder;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::vector<std::uint32_t>> windows{{0, 0, 0x7fffffff, 0x7fffffff},
                                                        {0x80000000, 0x80000000, 0x7fffffff, 0x7fffffff},
                                                        {0, 0, 1u << 19, 1u << 19},
                                                        {0, 0, 0xffffffff, 0},
                                                        {5, 5, 4, 4},
                                                        {0, 0, 1u << 25, 0},
                                                        {0x7ffffff0, 0, 0x7fffffff, 9}};
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
    for (const bool tiled : {false, true})
      for (const auto& window : windows)
        for (const auto& which : {kDataWindow, kDisplayWindow}) {
          auto bytes = small_file(folder, Imf::Compression(compression), tiled);
          set_attribute(bytes, which, window);
          EXPECT_NE(failure(bytes), "");
        }
  for (const auto& tiles : std::vector<std::vector<std::uint32_t>>{
           {0, 16}, {16, 0}, {0xffffffff, 0xffffffff}, {1u << 20, 1u << 20}, {1, 1}}) {
    auto bytes = small_file(folder, Imf::PIZ_COMPRESSION, true);
    set_attribute(bytes, kTiles, tiles);
    EXPECT_NE(failure(bytes), "");
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ExrDamage, AFileTooShortForItsPixelsIsRefusedWhenOpened) {
  const Folder folder;
  auto bytes = small_file(folder, Imf::ZIP_COMPRESSION, false);
  for (const auto& which : {kDataWindow, kDisplayWindow})
    set_attribute(bytes, which, {0, 0, (1u << 19) - 1, 37});
  ReadOptions options;
  try {
    open(bytes, "test.exr", options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("too short for 524288x38 pixels"), std::string::npos)
        << error.what();
  }
}

TEST(ExrDamage, ChunksOfOtherPositionsAreRefused) {
  const Folder folder;
  auto bytes = small_file(folder, Imf::ZIP_COMPRESSION, false);
  const std::size_t table = chunk_table(bytes, 3);
  auto swapped = bytes;
  std::swap_ranges(swapped.begin() + static_cast<std::ptrdiff_t>(table),
                   swapped.begin() + static_cast<std::ptrdiff_t>(table) + 8,
                   swapped.begin() + static_cast<std::ptrdiff_t>(table) + 8);
  EXPECT_NE(failure(swapped).find("of another place"), std::string::npos) << failure(swapped);
  auto zeroed = bytes;
  std::fill_n(zeroed.begin() + static_cast<std::ptrdiff_t>(table) + 8, 8, std::byte{0});
  EXPECT_NE(failure(zeroed).find("row 16: the chunk was never written"), std::string::npos)
      << failure(zeroed);
}

TEST(ExrDamage, DeepDataIsListedButNotRead) {
  const Folder folder;
  const std::string path = folder / "deep.exr";
  {
    Imf::Header header(4, 4);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    Imf::DeepScanLineOutputFile file(path.c_str(), header);
    std::vector<unsigned> counts(16, 1);
    std::vector<float> values(16, 2.0f);
    std::vector<float*> pointers;
    for (float& value : values) pointers.push_back(&value);
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 16));
    frame.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), 8, 32, 4));
    file.setFrameBuffer(frame);
    file.writePixels(4);
  }
  const auto bytes = bytes_of_file(path);
  const auto reader = open(bytes, "deep.exr");
  EXPECT_EQ(reader->info().parts[0].channels, (std::vector<std::string>{"Z"}));
  EXPECT_EQ(reader->info().notes, (std::vector<std::string>{"deep data, which cannot be read"}));
  EXPECT_NE(failure(bytes).find("deep data cannot be read"), std::string::npos);
}

TEST(ExrDamage, SubsampledChannelsAreRefusedByName) {
  const Folder folder;
  const std::string path = folder / "sub.exr";
  {
    Imf::Header header(8, 8);
    header.channels().insert("R", Imf::Channel(Imf::HALF));
    header.channels().insert("flow", Imf::Channel(Imf::HALF, 2, 2));
    Imf::OutputFile file(path.c_str(), header);
    std::vector<std::uint16_t> values(64);
    Imf::FrameBuffer frame;
    frame.insert("R", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), 2, 16));
    frame.insert("flow", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), 2, 8, 2, 2));
    file.setFrameBuffer(frame);
    file.writePixels(8);
  }
  const std::string cause = failure(bytes_of_file(path));
  EXPECT_NE(cause.find("'flow' is subsampled 2x2"), std::string::npos) << cause;
}

}  // namespace
}  // namespace welkin::io
