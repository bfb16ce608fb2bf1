#include "welkin/io/heif/heif_test_pictures.h"

namespace welkin::io::test {
namespace {

Bytes with_box(Bytes bytes, const std::string& type) {
  const Bytes box = bytes_of(std::string("\0\0\0\x08", 4) + type);
  bytes.insert(bytes.end(), box.begin(), box.end());
  return bytes;
}

TEST(HeifOddFiles, SizesAreCheckedBeforePixelsAreDecoded) {
  const Bytes bytes = encoded_heif(varied_picture(16, 16, 8));
  const std::string size("ispe\0\0\0\0\0\0\0\x10\0\0\0\x10", 16);
  const Bytes large = replaced(bytes, size, std::string("ispe\0\0\0\0\0\0\x60\0\0\0\x60\0", 16));
  EXPECT_EQ(error_of([&] { raw_reader(large); }),
            "test: " + std::to_string(bytes.size()) + " bytes cannot hold 24576×24576 pixels");
  for (const char* side : {"\x00\x01\x00\x00", "\x7f\xff\xff\xff", "\xff\xff\xff\xff", "\0\0\0\0"}) {
    const std::string four(side, 4);
    const Bytes changed = replaced(bytes, size, std::string("ispe\0\0\0\0", 8) + four + four);
    const std::string message = error_of([&] { raw_reader(changed); });
    EXPECT_NE(
        message.find(four == std::string(4, '\0') ? "is out of range" : "exceeds the maximum image size"),
        std::string::npos)
        << message;
  }
  ReadOptions options;
  options.max_bytes = 16 * 16 * 3 * 4 - 1;
  EXPECT_NE(error_of([&] { raw_reader(bytes, options); }).find("over the limit"), std::string::npos);
}

TEST(HeifOddFiles, ReadingTwiceGivesTheSame) {
  const Bytes bytes = encoded_heif(varied_picture(32, 16, 12, heif_colorspace_YCbCr));
  const auto reader = raw_reader(bytes);
  const Image first = read_part(*reader);
  expect_same(read_part(*reader), first);
}

TEST(HeifOddFiles, TruncationIsAnError) {
  for (const auto codec : {heif_compression_AV1, heif_compression_HEVC}) {
    HeifOptions options;
    options.codec = codec;
    options.xmp = "<x/>";
    const Bytes bytes = encoded_heif(varied_picture(32, 16, 8, heif_colorspace_RGB, true), options);
    for (std::size_t size = 12; size < bytes.size(); size += 1 + size / 30) {
      const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THROW(decoded(part), Error) << "cut to " << size << " of " << bytes.size() << " bytes";
    }
  }
}

TEST(HeifOddFiles, DamageIsSurvived) {
  for (const auto codec : {heif_compression_AV1, heif_compression_HEVC}) {
    HeifOptions options;
    options.codec = codec;
    options.xmp = "<x/>";
    options.icc = unusual_profile();
    expect_cuts_and_damage_are_survived(
        encoded_heif(varied_picture(24, 16, 8, heif_colorspace_RGB, true), options));
  }
}

TEST(HeifOddFiles, OfSequencesThePrimaryPictureIsReadAndTold) {
  const Bytes still = encoded_heif(varied_picture(16, 16, 8));
  const Bytes moving = with_box(still, "moov");
  const auto reader = raw_reader(moving);
  ASSERT_EQ(reader->info().warnings.size(), 1u);
  EXPECT_EQ(reader->info().warnings[0], "an image sequence: its primary picture is read, and no other");
  expect_same(read_part(*reader), raw_picture(still));
  const Bytes track =
      with_box(bytes_of(std::string("\0\0\0\x10", 4) + "ftypavis" + std::string(4, '\0')), "moov");
  EXPECT_EQ(error_of([&] { raw_reader(track); }), "test: an image sequence, not a picture");
}

TEST(HeifOddFiles, GainMapsAreTold) {
  const std::string expected = "its gain map is not applied: what is read is the picture without it";
  const Bytes bytes = encoded_heif(varied_picture(16, 16, 8, heif_colorspace_RGB, true));
  const Bytes apple = replaced(bytes, "urn:mpeg:mpegB:cicp:systems:auxiliary:alpha",
                               std::string("urn:com:apple:photos:2020:aux:hdrgainmap\0\0\0", 43));
  const auto reader = raw_reader(apple);
  ASSERT_EQ(reader->info().warnings.size(), 1u);
  EXPECT_EQ(reader->info().warnings[0], expected);
  EXPECT_EQ(reader->info().parts[0].channels, names_of(3));
  const Bytes iso = replaced(bytes, "ftypavif", "ftyptmap");
  ASSERT_EQ(raw_reader(iso)->info().warnings.size(), 1u);
  EXPECT_EQ(raw_reader(iso)->info().warnings[0], expected);
}

TEST(HeifOddFiles, FormatsAreKnownByTheirBrands) {
  const Bytes avif = encoded_heif(varied_picture(16, 16, 8));
  HeifOptions options;
  options.codec = heif_compression_HEVC;
  const Bytes heic = encoded_heif(varied_picture(16, 16, 8), options);
  EXPECT_EQ(raw_reader(avif)->info().format, "avif");
  EXPECT_EQ(raw_reader(heic)->info().format, "heif");
  // By a compatible brand, where the major one says less.
  EXPECT_EQ(raw_reader(replaced(avif, "ftypavif", "ftypmif1"))->info().format, "avif");
  const Bytes movie =
      replaced(replaced(replaced(heic, "ftypheic", "ftypisom"), "mif1heic", "iso2mp41"), "miaf", "avc1");
  EXPECT_NE(error_of([&] { open(movie, "a.mp4"); }).find("a video (MP4)"), std::string::npos);
}

TEST(HeifOddFiles, ColoursOfUnknownMeaningAreTold) {
  const Bytes bytes = encoded_heif(varied_picture(16, 16, 8, heif_colorspace_YCbCr));
  const std::string known("nclx\0\1\0\15\0\6", 10);
  const struct {
    Bytes bytes;
    std::string warning;
  } table[] = {
      {replaced(bytes, "colrnclx", "freenclx"),
       "no box says what its colours mean; sRGB, coded by BT.601 in full range, is assumed"},
      {replaced(bytes, known, std::string("nclx\0\3\0\15\0\6", 10)),
       "libheif does not know what its colours mean (Invalid input: Unknown NCLX color primaries); sRGB is "
       "assumed"},
      {replaced(bytes, known, std::string("nclx\0\1\0\3\0\6", 10)),
       "libheif does not know what its colours mean (Invalid input: Unknown NCLX transfer characteristics); "
       "sRGB is assumed"}};
  for (const auto& row : table) {
    const auto reader = raw_reader(row.bytes);
    ASSERT_EQ(reader->info().warnings.size(), 1u);
    EXPECT_EQ(reader->info().warnings[0], row.warning);
    EXPECT_EQ(reader->info().colour, Colour::srgb);
  }
}

}  // namespace
}  // namespace welkin::io::test
