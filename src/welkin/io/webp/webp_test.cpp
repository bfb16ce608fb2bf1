#include <cmath>

#include "welkin/io/colour/transfer.h"
#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

WriteOptions lossless() {
  WriteOptions options;
  options.quality = 100;
  return options;
}

TEST(Webp, LosslessComesBackExactly) {
  for (const int channels : {3, 4}) {
    const Bytes bytes = encoded("webp", noise(31, 17, channels), lossless());
    EXPECT_EQ(info_of(bytes).parts[0].compression, "lossless");
    EXPECT_EQ(info_of(bytes).parts[0].channels, names_of(channels));
    EXPECT_EQ(info_of(bytes).colour, Colour::srgb);
    const Image once = decoded(bytes);
    // Half a code, steepened by decoding; of the product with alpha, half a code of that too.
    const float tolerance = 0.5f / 255 * (2.4f / 1.055f + (channels == 4 ? 1 : 0)) + 1e-7f;
    EXPECT_LE(largest_difference(once, noise(31, 17, channels)), tolerance);
    expect_same(decoded(encoded("webp", once, lossless())), once);
  }
}

TEST(Webp, ColoursUnderZeroAlphaStay) {
  Image image = noise(8, 8, 4);
  for (int i = 0; i < 64; ++i) image.at(0, 0)[4 * i + 3] = 0;
  Image once(8, 8, 3);
  const Bytes bytes = encoded("webp", image, lossless());
  open(bytes, "test")->read(0, std::vector{0, 1, 2}, once.view());
  for (int i = 0; i < 64; ++i) EXPECT_NEAR(once.at(0, 0)[3 * i], image.at(0, 0)[4 * i], 0.005f);
}

TEST(Webp, GreyIsStoredThreeTimes) {
  const Image grey = decoded(encoded("webp", noise(5, 5, 1), lossless()));
  const Image with_alpha = decoded(encoded("webp", noise(5, 5, 2), lossless()));
  ASSERT_EQ(grey.channels(), 3);
  ASSERT_EQ(with_alpha.channels(), 4);
  for (int i = 0; i < 25; ++i) {
    EXPECT_EQ(grey.at(0, 0)[3 * i], grey.at(0, 0)[3 * i + 2]);
    EXPECT_EQ(with_alpha.at(0, 0)[4 * i], with_alpha.at(0, 0)[4 * i + 1]);
  }
  Image negative(1, 1, 1);
  *negative.at(0, 0) = -1;
  WriteReport report;
  encoded("webp", negative, {}, &report);
  EXPECT_EQ(report.below, 1u);
}

TEST(Webp, LossyIsNearAndSmaller) {
  Image image(64, 64, 3);
  for (int i = 0; i < 64 * 64 * 3; ++i)
    image.at(0, 0)[i] = 0.5f + 0.3f * std::sin(0.002f * static_cast<float>(i));
  WriteOptions options;
  options.quality = 90;
  const Bytes bytes = encoded("webp", image, options);
  EXPECT_EQ(info_of(bytes).parts[0].compression, "lossy");
  // Its colour is at half resolution and its luma in 16…235, so a few codes are lost at any quality.
  EXPECT_LE(largest_difference(decoded(bytes), image), 0.06f);
  options.quality = 100;
  options.compression = "lossy";
  EXPECT_EQ(info_of(encoded("webp", image, options)).parts[0].compression, "lossy");
  options.compression = "lossless";
  options.quality = 50;
  EXPECT_EQ(info_of(encoded("webp", image, options)).parts[0].compression, "lossless");
}

TEST(Webp, TooLargeIsRefusedClearly) {
  EXPECT_NE(error_of([] {
              encoded("webp", Image(16384, 1, 1));
            }).find("too large for WebP, whose sides are at most 16383"),
            std::string::npos);
}

TEST(Webp, TruncationIsAnError) {
  // Of a RIFF chunk of odd length the last byte is padding, which the decoder needs not see.
  expect_truncation_is_an_error(encoded("webp", noise(9, 7, 3), lossless()), 1);
  expect_truncation_is_an_error(encoded("webp", noise(9, 7, 4)), 1);
}

}  // namespace
}  // namespace welkin::io::test
