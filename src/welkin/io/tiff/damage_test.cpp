// TIFF files that are cut off or damaged: what is said of them.

#include <set>

#include "welkin/io/tiff/failure.h"
#include "welkin/io/tiff/tiff_test_files.h"

namespace welkin::io::test {
namespace {

std::string failure(const Bytes& bytes) {
  try {
    ReadOptions options;
    options.max_bytes = 1 << 20;
    const auto reader = open(bytes, "a.tif", options);
    for (std::size_t part = 0; part < reader->info().parts.size(); ++part) read_part(*reader, part);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// libtiff's words and numbers, which mean nothing to who reads them.
void expect_readable(const std::string& message) {
  for (const char* word : {"Can not", "Cannot", "can not", "Sorry", "TIFF:", "TIFFRead", "TIFFFill",
                           "TIFFFetch", "Decode", "18446744073709551", "%", "\n"})
    EXPECT_EQ(message.find(word), std::string::npos) << message;
}

TEST(TiffDamage, BlocksOutsideTheFileAreNamed) {
  OtherTiff tiff{.width = 4, .height = 4, .data = Bytes(16)};
  tiff.offset = 100000;
  const std::string past = failure(tiff.file());
  EXPECT_NE(past.find("strip 0 begins at byte 100000, past the file's end (byte "), std::string::npos)
      << past;
  EXPECT_NE(past.find("the file was cut off, or its directory is damaged"), std::string::npos) << past;
  tiff.offset = static_cast<std::int64_t>(tiff.file().size()) - 3;
  EXPECT_NE(failure(tiff.file()).find(", passes the file's end"), std::string::npos) << failure(tiff.file());
  tiff.offset = 0xffffffff;
  expect_readable(failure(tiff.file()));
  tiff.samples = 3;
  tiff.planar = true;
  tiff.photometric = 2;
  tiff.data = Bytes(48);
  EXPECT_NE(failure(tiff.file()).find("strip 0 begins at byte 4294967295"), std::string::npos)
      << failure(tiff.file());
}

TEST(TiffDamage, FieldsThatAreMissingOrMalformedAreNamed) {
  OtherTiff tiff{.width = 4, .height = 4, .data = Bytes(16)};
  const auto with = [&](int tag, OtherTiff::Value value) {
    OtherTiff other = tiff;
    other.more[tag] = std::move(value);
    return failure(other.file());
  };
  EXPECT_EQ(with(257, {4, {0}}),
            "a.tif: its first directory cannot be read: its strips or tiles have no size");
  EXPECT_NE(with(259, {3, {34712}}).find("compressed by jpeg-2000, which libtiff does not decode here"),
            std::string::npos);
  EXPECT_NE(with(259, {3, {4711}}).find("compressed in a way that is not known here"), std::string::npos);
  EXPECT_EQ(with(259, {3, {4711}}).find("4711"), std::string::npos);
  const std::string differ = failure([&] {
    OtherTiff other{.width = 4, .height = 4, .samples = 3, .photometric = 2, .data = Bytes(48)};
    other.more[258] = {3, {5, 6, 5}};
    return other.file();
  }());
  EXPECT_NE(differ.find("its samples differ in BitsPerSample"), std::string::npos) << differ;
  for (int tag = 256; tag < 340; ++tag) {
    for (const std::uint32_t value : {0u, 1u, 3u, 0xffffu, 0xffffffffu}) {
      for (const int type : {3, 4}) expect_readable(with(tag, {type, {value}}));
    }
  }
}

TEST(TiffDamage, MessagesAreReadableWhateverIsDamaged) {
  std::set<std::string> messages;
  for (const char* compression : {"none", "zip", "lzw"}) {
    for (const PixelType type : {PixelType::float32, PixelType::uint8}) {
      WriteOptions options;
      options.compression = compression;
      options.type = type;
      const Bytes bytes = encoded("tif", noise(9, 7, 4), options);
      for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (const int change : {0x01, 0x08, 0x80, 0xff}) {
          Bytes damaged = bytes;
          damaged[at] ^= static_cast<std::byte>(change);
          messages.insert(failure(damaged));
        }
      }
      for (std::size_t size = 0; size < bytes.size(); ++size)
        messages.insert(failure(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
    }
  }
  for (const std::string& message : messages) expect_readable(message);
  EXPECT_GT(messages.size(), 20u);
}

TEST(TiffDamage, LibtiffsWordsBecomeOurs) {
  EXPECT_EQ(tiff_failure("TIFFReadDirectory: TIFF directory is missing required \"ImageLength\" field"),
            "the field ImageLength is missing");
  EXPECT_EQ(tiff_failure("Read error on strip 0; got 18446744073709451774 bytes, expected 16"),
            "its data end early");
  EXPECT_EQ(tiff_failure("TIFFFetchDirectory: Can not read TIFF directory count"),
            "its directory lies outside the file or is cut off");
  EXPECT_EQ(tiff_failure("ZIPDecode: Decoding error at scanline 0, incorrect header check"),
            "its data are damaged");
  EXPECT_EQ(tiff_failure("Not a TIFF file, bad version number 43 (0x2b)"), "its header is malformed");
  EXPECT_EQ(tiff_failure("TIFFReadDirectory: Incorrect count for"), "the field of a directory is malformed");
  EXPECT_EQ(tiff_failure("JPEGSetupDecode: BitsPerSample 12 not allowed for JPEG"),
            "its JPEG data are of a kind that libtiff does not decode");
  EXPECT_EQ(tiff_failure(""), "");
  EXPECT_EQ(tiff_failure("something new"), "");
}

}  // namespace
}  // namespace welkin::io::test
