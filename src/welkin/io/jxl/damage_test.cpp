#include <tbb/global_control.h>

#include <algorithm>

#include "welkin/io/jxl/jxl_test_files.h"
#include "welkin/io/test_readers.h"

namespace welkin::io::test {
namespace {

/// The codestream's header alone, of a square picture of 8-bit sRGB (ISO/IEC 18181-1, D.2).
Bytes header_of_square(std::uint32_t side) {
  std::vector<bool> bits = {false, true, true};  // not small; 30 bits of height
  for (int i = 0; i < 30; ++i) bits.push_back(((side - 1) >> i & 1) != 0);
  bits.insert(bits.end(), {true, false, false, true, true});  // width : height = 1 : 1; all else the default
  Bytes bytes(2 + 16);
  bytes[0] = std::byte{0xff};
  bytes[1] = std::byte{0x0a};
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i]) bytes[2 + i / 8] |= static_cast<std::byte>(1 << i % 8);
  }
  return bytes;
}

TEST(JxlDamage, FewBytesOfManyPixelsAreRefused) {
  const Bytes large = header_of_square(1 << 15), too_large = header_of_square(1 << 21);
  EXPECT_EQ(error_of([&] { raw_reader(large); }), "test: 18 bytes cannot hold 32768×32768 pixels");
  EXPECT_NE(error_of([&] { raw_reader(too_large); }).find("is out of range"), std::string::npos);
  EXPECT_EQ(raw_reader(header_of_square(1 << 10))->info().parts[0].width, 1 << 10);
  // What an encoder makes of next to nothing is read.
  JxlOptions options;
  options.distance = 25;
  const Bytes bytes = encoded_jxl(picture_of(2048, 2048, 3, [](int, int, int) { return 0.5; }), options);
  EXPECT_LT(bytes.size(), 300u);
  EXPECT_EQ(raw_picture(bytes).width(), 2048);
}

TEST(JxlDamage, HeaderIsCheckedBeforeAnyMemory) {
  const Bytes bytes = encoded_jxl(noise(64, 32, 3));
  ReadOptions options;
  options.max_bytes = 64 * 32 * 3 * 4 - 1;
  EXPECT_NE(error_of([&] { raw_reader(bytes, options); }).find("over the limit"), std::string::npos);
}

// The last box may leave its size open.
TEST(JxlDamage, BoxesToTheEndOfTheFileAreRead) {
  const Image image = noise(9, 5, 3);
  Bytes bytes = encoded_jxl(image, linear_float());
  const Bytes type = bytes_of("jxlc");
  const auto found = std::search(bytes.begin(), bytes.end(), type.begin(), type.end());
  ASSERT_NE(found, bytes.end());
  std::fill(found - 4, found, std::byte{0});
  expect_same(raw_picture(bytes), image);
}

// 17 MiB of one letter are a few bytes.
TEST(JxlDamage, LargeXmpIsNotRead) {
  for (const bool brotli : {false, true}) {
    JxlOptions options = linear_float();
    options.xmp = std::string(std::size_t{17} << 20, 'x');
    options.brotli = brotli;
    const Bytes bytes = encoded_jxl(noise(9, 5, 3), options);
    EXPECT_EQ(bytes.size() < 10000u, brotli);
    const auto reader = raw_reader(bytes);
    EXPECT_EQ(reader->declared().xmp, "");
    ASSERT_EQ(reader->info().warnings.size(), 1u);
    EXPECT_EQ(reader->info().warnings[0], "its XMP packet is too large, and not read");
  }
}

TEST(JxlDamage, ThreadsDoNotMatter) {
  JxlOptions options;
  options.distance = 2;
  const Bytes bytes = encoded_jxl(noise(700, 600, 3), options);
  const Image by_all = raw_picture(bytes);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  expect_same(raw_picture(bytes), by_all);
}

TEST(JxlDamage, TruncationIsAnError) {
  JxlOptions lossy;
  lossy.distance = 1;
  JxlOptions container = linear_float();
  container.xmp = "<x/>";
  for (const JxlOptions& options : {JxlOptions(), lossy, container}) {
    const Bytes bytes = encoded_jxl(noise(40, 30, 3), options);
    for (std::size_t size = 2; size + 1 < bytes.size(); size += 1 + size / 8) {
      const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THROW(decoded(part), Error) << "cut to " << size << " of " << bytes.size() << " bytes";
    }
  }
}

TEST(JxlDamage, DamageIsSurvived) {
  JxlOptions lossy;
  lossy.distance = 1;
  JxlOptions container = linear_float();
  container.xmp = "<x/>";
  container.brotli = true;
  for (const JxlOptions& options : {JxlOptions(), lossy, container})
    expect_cuts_and_damage_are_survived(encoded_jxl(noise(20, 13, 4), options));
}

}  // namespace
}  // namespace welkin::io::test
