// KTX2 files that are cut off, damaged or made to harm: each gives Error, soon, and takes no more memory than
// it may.

#include <chrono>
#include <functional>

#include "welkin/io/ktx2/ktx2_test_files.h"

namespace welkin::io::test {
namespace {

/// What opening and reading all parts throws, or empty.
std::string failure(const Bytes& bytes) {
  try {
    ReadOptions options;
    options.max_bytes = 1 << 24;
    const auto reader = open(bytes, "test.ktx2", options);
    for (std::size_t part = 0; part < reader->info().parts.size(); ++part) read_part(*reader, part);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void expect_refused(const Bytes& bytes, const std::string& cause) {
  const std::string message = failure(bytes);
  EXPECT_EQ(message.find("test.ktx2: "), 0u) << message;
  EXPECT_NE(message.find(cause), std::string::npos) << message << "\nis not: " << cause;
}

Bytes cube(const std::string& compression, PixelType type = PixelType::float32) {
  WriteOptions options;
  options.compression = compression;
  options.type = type;
  options.attributes = {{"welkin.parameterization", "cube"}};
  return Texture(8, 8, 4, 1, 6, 3).encoded(options);
}

template <class T>
Bytes with(Bytes bytes, std::size_t at, T value) {
  std::memcpy(&bytes.at(at), &value, sizeof value);
  return bytes;
}

TEST(Ktx2Damage, EveryTruncationIsAnError) {
  for (const std::string compression : {"none", "zstd"}) expect_truncation_is_an_error(cube(compression));
}

TEST(Ktx2Damage, TruncationNamesWhatIsCutAndWhere) {
  const Bytes bytes = cube("none");
  const auto cut_to = [&](std::size_t size) {
    return Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  };
  expect_refused(cut_to(79), "ends early (byte 79): the header ends at byte 80");
  expect_refused(cut_to(175), "ends early (byte 175): the level index ends at byte 176");
  expect_refused(cut_to(176), "ends early (byte 176): the data format descriptor ends at byte 268");
  expect_refused(cut_to(bytes.size() - 1), "level 0 ends at byte " + std::to_string(bytes.size()));
}

TEST(Ktx2Damage, ChangedHeaderFieldsAreRefusedByName) {
  const Bytes bytes = cube("none");
  const auto refused = [&](std::size_t at, std::uint32_t value, const std::string& cause) {
    expect_refused(with(bytes, at, value), cause);
  };
  refused(12, 145,
          "texels of VK_FORMAT_BC7_UNORM_BLOCK, compressed blocks (BC, S3TC), are not read; decompress it");
  refused(12, 0, "texels of VK_FORMAT_UNDEFINED, which only their descriptor describes, are not read");
  refused(12, 184, "texels of VK_FORMAT_ASTC_12x12_SRGB_BLOCK, compressed blocks (ASTC), are not read");
  refused(12, 1000054000,
          "texels of VK_FORMAT_PVRTC1_2BPP_UNORM_BLOCK_IMG, compressed blocks (PVRTC), are not read");
  refused(12, 97, "the type size 4 is not that of VK_FORMAT_R16G16B16A16_SFLOAT");
  refused(16, 2, "the type size 2 is not that of VK_FORMAT_R32G32B32A32_SFLOAT");
  refused(20, 9, "the faces of a cube are 9×8, not square");
  refused(28, 1, "a texture of three dimensions (8×8×1) is no map");
  refused(32, 0xffffffff, "pictures, more than 65536");
  refused(32, 2, "level 0 has 6144 bytes, not the 12288 of its pictures");
  refused(36, 0, "0 faces, neither 1 nor 6");
  refused(36, 7, "7 faces, neither 1 nor 6");
  refused(36, 1, "level 0 has 6144 bytes, not the 1024 of its pictures");
  refused(40, 5, "5 levels, of which 8×8 has at most 4");
  refused(40, 0xffffffff, "has at most 4");
  refused(44, 1, "Basis Universal (ETC1S, supercompressed by BasisLZ) are not read");
  refused(44, 4, "supercompression scheme 4 is not supported");
  refused(44, 0x10000, "supercompression scheme 65536 is not supported");
  refused(44, 2, "zstd data is damaged");
  refused(44, 3, "zlib data is damaged");
  refused(72, 1, "has global data");
  refused(48, 0, "overlaps the header");
  refused(48, 0xffffffff, "ends early");
  refused(52, 0xffffffff, "ends early");
  refused(56, 200, "overlaps");
  refused(60, 0xfffffff0, "ends early");
}

TEST(Ktx2Damage, LevelsThatLieElsewhereAreRefused) {
  const Bytes bytes = cube("none");
  constexpr std::size_t kOffset = 80, kBytes = 88, kUnpacked = 96, kOfLevel = 24;
  const auto refused = [&](std::size_t at, std::uint64_t value, const std::string& cause) {
    expect_refused(with(bytes, at, value), cause);
  };
  refused(kOffset, ~std::uint64_t{0}, "level 0 lies past the file's end");
  refused(kOffset, ~std::uint64_t{0} - 6143, "level 0 lies past the file's end");
  refused(kOffset, bytes.size(), "level 0 ends at byte " + std::to_string(bytes.size() + 6144));
  refused(kOffset, 0, "overlaps");
  refused(kOffset + kOfLevel, long_word(bytes, kOffset) + 16, "level 1 overlaps level 0");
  refused(kOffset, long_word(bytes, kOffset) - 1, "level 0 overlaps level 1");
  refused(kBytes, 0, "level 0 is stored in 0 bytes, not 6144");
  refused(kBytes, ~std::uint64_t{0}, "level 0 is stored in");
  refused(kUnpacked + kOfLevel, 0, "level 1 has 0 bytes, not the 1536 of its pictures");
  refused(kUnpacked, ~std::uint64_t{0}, "level 0 has 2^60 or more bytes");
}

TEST(Ktx2Damage, AbsurdSizesAreRefusedAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  for (const std::uint32_t scheme : {0u, 2u, 3u}) {
    for (const std::uint32_t side : {0u, 1u << 15, 1u << 20, 1u << 24, 0xffffffffu}) {
      OtherFile file{
          .format = 109, .type_size = 4, .texel_bytes = 16, .width = side, .height = side, .scheme = scheme};
      file.unpacked = std::uint64_t{16} * side * side;
      EXPECT_NE(failure(file_of(file, Bytes(100))), "");
      file.faces = 6;
      file.unpacked *= 6;
      EXPECT_NE(failure(file_of(file, Bytes(100))), "");
    }
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Ktx2Damage, BombsAreRefusedBeforeTheyAreUnpacked) {
  // 8 MiB from 100 bytes are more than any frame of Zstandard holds, and each face alone is within the limit.
  OtherFile file{.format = 109,
                 .type_size = 4,
                 .texel_bytes = 16,
                 .width = 512,
                 .height = 512,
                 .layers = 2,
                 .scheme = 2};
  file.unpacked = std::uint64_t{16} * 512 * 512 * 2;
  expect_refused(file_of(file, Bytes(100)), "level 0 cannot unpack to 8388608 bytes from 100");
  file.layers = 64;
  file.unpacked = std::uint64_t{16} * 512 * 512 * 64;
  expect_refused(file_of(file, Bytes(1 << 14)),
                 "level 0 unpacks to 268435456 bytes, over the limit of 16777216");
}

TEST(Ktx2Damage, PackedLevelsOfAnotherLengthAreRefused) {
  // A frame of a level of 8×8 under the index of one of 4×4, and the reverse.
  const auto zstd_level = [](int size) {
    const Image image = noise(size, size, 4);
    WriteOptions options;
    options.compression = "zstd";
    const Bytes bytes = encoded("ktx2", image, options);
    return Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(long_word(bytes, 80)), bytes.end());
  };
  OtherFile file{.format = 109,
                 .type_size = 4,
                 .texel_bytes = 16,
                 .width = 4,
                 .height = 4,
                 .scheme = 2,
                 .unpacked = 256};
  EXPECT_EQ(failure(file_of(file, zstd_level(4))), "");
  expect_refused(file_of(file, zstd_level(8)), "level 0: zstd data is damaged");
  expect_refused(file_of(file, zstd_level(2)), "level 0: zstd data unpacks to 64 bytes, not 256");
  expect_refused(file_of(file, Bytes{}), "level 0: zstd data unpacks to 0 bytes, not 256");
}

TEST(Ktx2Damage, AChangedPackedByteIsSeen) {
  const Bytes bytes = cube("zstd", PixelType::rgb9e5);
  // Of a frame's first byte, some bits have no meaning; the lowest has.
  const std::size_t from = long_word(bytes, 80 + 24 * 3);
  for (std::size_t at = from; at < bytes.size(); ++at) {
    Bytes changed = bytes;
    changed[at] ^= std::byte{0x01};
    EXPECT_NE(failure(changed), "") << at;
  }
}

TEST(Ktx2Damage, BrokenKeysAreRefused) {
  const auto with_keys = [](const Bytes& keys) {
    return file_of({.width = 2, .height = 2, .keys = keys}, Bytes(4));
  };
  EXPECT_EQ(failure(with_keys(key("a", "b"))), "");
  Bytes keys = key("abc", "d");
  EXPECT_EQ(failure(with_keys(Bytes(keys.begin(), keys.end()))), "");
  expect_refused(with_keys(with(keys, 0, 1u)), "an entry of 1 bytes holds no key (byte 132)");
  expect_refused(with_keys(with(keys, 0, 0u)), "holds no key");
  expect_refused(with_keys(with(keys, 0, 0xffffffffu)), "an entry is longer than the data");
  expect_refused(with_keys(with(keys, 0, 9u)), "an entry is longer than the data");
  expect_refused(with_keys(with(keys, 7, 'x')), "a key has no end (byte 136)");
  expect_refused(with_keys(with(keys, 4, '\0')), "a key is empty");
  keys.resize(14);
  expect_refused(with_keys(keys), "an entry ends early (byte 144)");
}

TEST(Ktx2Damage, BrokenDescriptorsAreRefused) {
  const Bytes bytes = file_of({.width = 2, .height = 2}, Bytes(4));
  const auto refused = [&](std::size_t at, std::uint32_t value, const std::string& cause) {
    expect_refused(with(bytes, at, value), cause);
  };
  refused(52, 24, "the data format descriptor is too short");
  refused(104, 24, "states another size than the index");
  refused(108, 1, "does not begin with a basic block");
  refused(112, 2u | 20u << 16, "does not begin with a basic block");
  refused(112, 2u | 28u << 16, "does not begin with a basic block");
  refused(116, 166, "is of colour model 166, not VK_FORMAT_R8_UNORM");
  refused(120, 0x0303, "is of blocks");
  refused(124, 8, "is of texels of 8 bytes");
}

TEST(Ktx2Damage, AnyChangedByteIsReadOrRefused) {
  std::size_t refused = 0;
  for (const std::string compression : {"none", "zstd"}) {
    const Bytes bytes = cube(compression, PixelType::half);
    for (std::size_t at = 0; at < bytes.size(); at += at < 500 ? 1 : 61) {
      for (const int value : {0x00, 0x01, 0x7f, 0xff}) {
        Bytes changed = bytes;
        changed[at] = static_cast<std::byte>(value);
        refused += failure(changed).empty() ? 0u : 1u;
      }
    }
  }
  EXPECT_GT(refused, 400u);
}

}  // namespace
}  // namespace welkin::io::test
