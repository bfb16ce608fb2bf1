#include "welkin/io/texels/half_texels.h"

#include <gtest/gtest.h>
#include <half.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

namespace welkin::io::texels {
namespace {

TEST(HalfTexels, EncodingIsThatOfOneValueAfterTheOther) {
  const EncodeHalfTexels encode = encode_half_texels();
  if (encode == nullptr) GTEST_SKIP() << "this processor has no such instructions";
  std::vector<float> values;
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 49999)
    values.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  values.insert(values.end(), {0.0f, -0.0f, 65504.0f, -65504.0f, 65505.0f, 65519.9f, 1e30f, -1e30f});
  for (const int channels : {3, 4}) {
    const int count = static_cast<int>(values.size()) / channels;
    std::vector<std::byte> out(static_cast<std::size_t>(count) * 8 + 1);
    std::uint64_t above = 0, wanted_above = 0;
    encode(values.data(), channels, count, out.data() + 1, above);
    for (int i = 0; i < count; ++i) {
      for (int c = 0; c < 4; ++c) {
        std::uint16_t half;
        std::memcpy(&half, out.data() + 1 + 8 * static_cast<std::size_t>(i) + 2 * static_cast<std::size_t>(c),
                    2);
        float value = c < channels ? values[static_cast<std::size_t>(i * channels + c)] : 1.0f;
        if (std::isfinite(value) && std::fabs(value) > 65504) {
          ++wanted_above;
          value = std::copysign(65504.0f, value);
        }
        if (std::isnan(value)) {
          EXPECT_TRUE(std::isnan(imath_half_to_float(half)));
        } else {
          EXPECT_EQ(half, imath_float_to_half(value)) << value;
        }
      }
    }
    EXPECT_EQ(above, wanted_above);
  }
}

TEST(HalfTexels, DecodingIsThatOfOneValueAfterTheOther) {
  const DecodeHalfTexels decode = decode_half_texels();
  if (decode == nullptr) GTEST_SKIP() << "this processor has no such instructions";
  std::vector<std::uint16_t> halves(65536);
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = static_cast<std::uint16_t>(i * 40503u);
  const int count = 65536 / 4;
  for (const int channels : {3, 4}) {
    std::vector<float> out(static_cast<std::size_t>(count * channels) + 1, 7.0f);
    decode(reinterpret_cast<const std::byte*>(halves.data()), count, out.data(), channels);
    EXPECT_EQ(out.back(), 7.0f) << "one value too many is written";
    for (int i = 0; i < count; ++i) {
      for (int c = 0; c < channels; ++c) {
        const float found = out[static_cast<std::size_t>(i * channels + c)],
                    wanted = imath_half_to_float(halves[static_cast<std::size_t>(4 * i + c)]);
        if (std::isnan(wanted)) {
          EXPECT_TRUE(std::isnan(found));
        } else {
          EXPECT_EQ(std::bit_cast<std::uint32_t>(found), std::bit_cast<std::uint32_t>(wanted));
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin::io::texels
