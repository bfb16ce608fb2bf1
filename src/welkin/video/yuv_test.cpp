#include "welkin/video/yuv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/io/colour/transfer.h"

namespace welkin::video::test {
namespace {

StreamInfo info_of(int width, int height, Chroma chroma, int bits = 8, bool full = false) {
  StreamInfo info;
  info.width = width;
  info.height = height;
  info.chroma = chroma;
  info.channels = chroma == Chroma::mono ? 1 : 3;
  info.bits = bits;
  info.full_range = full;
  return info;
}

Image decoded(const StreamInfo& info, std::span<const std::byte> planes, const StreamColour& colour = {}) {
  Image image(info.width, info.height, info.channels);
  decode_yuv(info, colour, planes, image.view());
  return image;
}

/// One pixel of 4:4:4.
std::vector<double> pixel(int y, int cb, int cr, const StreamColour& colour, bool full = false) {
  const std::byte planes[3] = {std::byte(y), std::byte(cb), std::byte(cr)};
  const Image image = decoded(info_of(1, 1, Chroma::c444, 8, full), planes, colour);
  std::vector<double> encoded;
  for (int c = 0; c < 3; ++c) encoded.push_back(io::linear_to_srgb(static_cast<double>(image.at(0, 0)[c])));
  return encoded;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& wanted, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], tolerance) << i;
}

/// The bars of ITU-R BT.801 and what BT.709 says of them, in codes.
TEST(Yuv, KnownColours) {
  const StreamColour bt601{YuvMatrix::bt601}, bt709{YuvMatrix::bt709};
  expect_near(pixel(16, 128, 128, bt601), {0, 0, 0}, 1e-6);
  expect_near(pixel(235, 128, 128, bt601), {1, 1, 1}, 1e-6);
  expect_near(pixel(0, 128, 128, bt601, true), {0, 0, 0}, 1e-6);
  expect_near(pixel(255, 128, 128, bt709, true), {1, 1, 1}, 1e-6);
  expect_near(pixel(81, 90, 240, bt601), {1, 0, 0}, 0.006);
  expect_near(pixel(145, 54, 34, bt601), {0, 1, 0}, 0.006);
  expect_near(pixel(41, 240, 110, bt601), {0, 0, 1}, 0.006);
  expect_near(pixel(63, 102, 240, bt709), {1, 0, 0}, 0.006);
  expect_near(pixel(173, 42, 26, bt709), {0, 1, 0}, 0.006);
  expect_near(pixel(32, 240, 118, bt709), {0, 0, 1}, 0.006);
}

/// A colour that varies slowly comes back, however chroma is sampled; 4:4:4 to the rounding.
TEST(Yuv, SlowColoursComeBack) {
  for (const Chroma chroma :
       {Chroma::c420jpeg, Chroma::c420mpeg2, Chroma::c420paldv, Chroma::c422, Chroma::c444}) {
    for (const int bits : {8, 10, 16}) {
      for (const bool full : {false, true}) {
        const StreamInfo info = info_of(33, 17, chroma, bits, full);
        Image image(33, 17, 3);
        for (int y = 0; y < 17; ++y) {
          for (int x = 0; x < 33; ++x) {
            const double values[3] = {0.2 + x / 60.0, 0.3 + y / 60.0, 0.7 - x / 90.0};
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(io::srgb_to_linear(values[c]));
          }
        }
        std::vector<std::byte> planes(yuv_bytes(info));
        encode_yuv(info, {}, image.view(), planes);
        const Image again = decoded(info, planes);
        double largest = 0;
        for (int y = 0; y < 17; ++y) {
          for (int x = 0; x < 33; ++x) {
            for (int c = 0; c < 3; ++c)
              largest =
                  std::max(largest, std::fabs(io::linear_to_srgb(static_cast<double>(again.at(x, y)[c])) -
                                              io::linear_to_srgb(static_cast<double>(image.at(x, y)[c]))));
          }
        }
        // Half a step of luma and of chroma, times the matrix; at borders the last sample is repeated, half a
        // pixel of slope.
        const double step = 1.0 / (full ? (1 << bits) - 1 : 219 << (bits - 8));
        EXPECT_LT(largest, 1.7 * step + (chroma == Chroma::c444 ? 1e-5 : 0.015))
            << static_cast<int>(chroma) << " " << bits;
      }
    }
  }
}

/// Codes come back unchanged where nothing is averaged.
TEST(Yuv, CodesComeBack) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> luma(60, 180), chroma(118, 138);
  const StreamInfo info = info_of(19, 7, Chroma::c444);
  std::vector<std::byte> planes(yuv_bytes(info)), again(planes.size());
  ASSERT_EQ(planes.size(), 3u * 19 * 7);
  for (std::size_t i = 0; i < planes.size(); ++i)
    planes[i] = static_cast<std::byte>(i < planes.size() / 3 ? luma(random) : chroma(random));
  encode_yuv(info, {}, decoded(info, planes).view(), again);
  EXPECT_EQ(again, planes);
}

TEST(Yuv, BytesOfOddSizes) {
  EXPECT_EQ(yuv_bytes(info_of(5, 3, Chroma::c420jpeg)), 15u + 2 * 3 * 2);
  EXPECT_EQ(yuv_bytes(info_of(5, 3, Chroma::c422)), 15u + 2 * 3 * 3);
  EXPECT_EQ(yuv_bytes(info_of(5, 3, Chroma::mono, 10)), 30u);
}

}  // namespace
}  // namespace welkin::video::test
