#include "welkin/io/texels/texels.h"

#include <gtest/gtest.h>
#include <half.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "welkin/io/shared_exponent.h"
#include "welkin/io/small_float.h"

namespace welkin::io::texels {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float float_of(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}
std::uint32_t bits_of(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

/// Positive floats around all that rounding can do: every 2^12-th of them, and what lies beside each.
template <class Check>
void for_many_magnitudes(float largest, const Check& check) {
  const std::uint32_t end = bits_of(largest);
  for (std::uint32_t bits = 0; bits <= end; bits += 1u << 12) {
    if (bits > 0) check(bits - 1);
    check(bits);
    if (bits < end) check(bits + 1);
  }
}

TEST(SmallFloat, OfTenBitsIsTheHalf) {
  const auto check = [](std::uint32_t bits) {
    ASSERT_EQ(small_float_of<10>(bits), imath_float_to_half(float_of(bits))) << float_of(bits);
  };
  for_many_magnitudes(65504, check);
  check(bits_of(kInfinity));
  check(bits_of(kNan));
  check(0x7f800001);
  for (std::uint32_t half = 0; half < 0x8000; ++half)
    ASSERT_EQ(bits_of(float_of_small<10>(half)),
              bits_of(imath_half_to_float(static_cast<std::uint16_t>(half))));
}

/// Nearest by searching: neither neighbour is nearer, and of two that are as near the even one is taken.
template <int kMantissaBits>
void expect_nearest() {
  const auto value = [](std::uint32_t code) {
    return static_cast<double>(float_of_small<kMantissaBits>(code));
  };
  constexpr std::uint32_t kInfinityCode = 31u << kMantissaBits;
  EXPECT_EQ(float_of_small<kMantissaBits>(kInfinityCode - 1), largest_small_float<kMantissaBits>());
  EXPECT_EQ(float_of_small<kMantissaBits>(kInfinityCode), kInfinity);
  EXPECT_TRUE(std::isnan(float_of_small<kMantissaBits>(kInfinityCode + 1)));
  EXPECT_EQ(small_float_of<kMantissaBits>(bits_of(kInfinity)), kInfinityCode);
  EXPECT_GT(small_float_of<kMantissaBits>(0x7f800001), kInfinityCode);
  for_many_magnitudes(largest_small_float<kMantissaBits>(), [&](std::uint32_t bits) {
    const auto x = static_cast<double>(float_of(bits));
    const std::uint32_t code = small_float_of<kMantissaBits>(bits);
    ASSERT_LT(code, kInfinityCode);
    const double error = std::fabs(value(code) - x);
    if (code > 0) {
      const double below = std::fabs(value(code - 1) - x);
      ASSERT_TRUE(error < below || (error == below && code % 2 == 0)) << x;
    }
    if (code + 1 < kInfinityCode) {
      const double above = std::fabs(value(code + 1) - x);
      ASSERT_TRUE(error < above || (error == above && code % 2 == 0)) << x;
    }
  });
}

TEST(SmallFloat, OfSixAndFiveBitsIsTheNearest) {
  expect_nearest<6>();
  expect_nearest<5>();
}

/// The extension's formulas, in float64, which holds every step exactly.
std::uint32_t shared_exponent_reference(double r, double g, double b) {
  constexpr int kBits = 9, kBias = 15;
  const double largest = std::max({r, g, b});
  const int floor_log2 = largest > 0 ? std::ilogb(largest) : -kBias - 1;
  int exponent = std::max(-kBias - 1, floor_log2) + 1 + kBias;
  const auto mantissa = [&](double x) {
    return static_cast<std::uint32_t>(std::floor(x / std::ldexp(1, exponent - kBias - kBits) + 0.5));
  };
  if (mantissa(largest) == 1u << kBits) ++exponent;
  return static_cast<std::uint32_t>(exponent) << 27 | mantissa(b) << 18 | mantissa(g) << 9 | mantissa(r);
}

TEST(SharedExponent, RoundsAsTheExtensionDemands) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint32_t> positive(0, bits_of(kLargestSharedExponent));
  for (int i = 0; i < 1000000; ++i) {
    float v[3];
    // Magnitudes near each other, so that no mantissa is always 0; some on ties, some beside.
    const std::uint32_t base = positive(random);
    for (float& x : v) {
      std::uint32_t bits =
          std::min(base + static_cast<std::uint32_t>(random() >> 6), bits_of(kLargestSharedExponent));
      if (i % 3 == 0) bits &= ~0x3fffu;
      if (i % 7 == 0 && bits > 0) bits -= 1;
      x = float_of(bits);
    }
    ASSERT_EQ(shared_exponent_of(v[0], v[1], v[2]), shared_exponent_reference(v[0], v[1], v[2]))
        << v[0] << " " << v[1] << " " << v[2];
  }
  // The largest float below ½ of the least step: the sum with ½ would round to 1.
  const float half_step = std::nextafter(0x1p-25f, 0.0f);
  EXPECT_EQ(shared_exponent_of(half_step, 0, 0), 0u);
  EXPECT_EQ(shared_exponent_of(0x1p-25f, 0, 0), 1u);
  EXPECT_EQ(shared_exponent_of(0, 0, 0), 0u);
}

TEST(SharedExponent, KeepsWhatItHolds) {
  for (std::uint32_t exponent = 0; exponent < 32; ++exponent) {
    // The largest mantissa is at least 256 unless the exponent is 0.
    for (std::uint32_t largest = exponent == 0 ? 0 : 256; largest < 512; ++largest) {
      const std::uint32_t texel =
          exponent << 27 | (largest / 3) << 18 | largest << 9 | (511 - largest) % (largest + 1);
      float rgb[3];
      values_of_shared_exponent(texel, rgb);
      ASSERT_EQ(shared_exponent_of(rgb[0], rgb[1], rgb[2]), texel);
    }
  }
  float rgb[3];
  values_of_shared_exponent(31u << 27 | 511, rgb);
  EXPECT_EQ(rgb[0], kLargestSharedExponent);
}

struct Encoded {
  std::vector<std::byte> bytes;
  WriteReport report;
};

Encoded encoded(PixelType type, std::vector<int> order, const std::vector<float>& in, int channels) {
  const TexelEncoder encoder(type, std::move(order), Colour::linear);
  const auto count = static_cast<int>(in.size()) / channels;
  Encoded result;
  result.bytes.resize(static_cast<std::size_t>(count) * format_for(type).bytes());
  encoder.encode(in.data(), channels, count, result.bytes.data(), result.report);
  return result;
}

std::vector<float> decoded(PixelType type, const Encoded& from) {
  const std::size_t texels = from.bytes.size() / format_for(type).bytes();
  std::vector<float> values(texels * (format_for(type).packed() ? 3 : 4));
  if (type == PixelType::float32) std::memcpy(values.data(), from.bytes.data(), from.bytes.size());
  if (type == PixelType::half) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint16_t half;
      std::memcpy(&half, &from.bytes[2 * i], sizeof half);
      values[i] = imath_half_to_float(half);
    }
  }
  if (format_for(type).packed())
    decode_packed(type, from.bytes.data(), static_cast<int>(texels), values.data());
  return values;
}

TEST(TexelEncoder, PutsChannelsWhereTheyBelong) {
  // More texels than are encoded at once; five channels, of which four are used, in another order.
  constexpr int kCount = 700, kChannels = 5;
  std::vector<float> in(kCount * kChannels);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>(i % 31) / 8;
  for (const auto type : {PixelType::float32, PixelType::half, PixelType::rgb9e5, PixelType::r11g11b10}) {
    const std::size_t stored = format_for(type).packed() ? 3 : 4;
    for (const std::vector<int>& order : {std::vector{3}, std::vector{3, 1}, std::vector{0, 1, 2},
                                          std::vector{4, 2, 0}, std::vector{2, 0, 1, 3}}) {
      if (stored == 3 && order.size() % 2 == 0) continue;
      const auto out = decoded(type, encoded(type, order, in, kChannels));
      for (std::size_t i = 0; i < kCount; ++i) {
        for (std::size_t k = 0; k < stored; ++k) {
          const std::size_t from = order.size() > 2 ? k : k < 3 ? 0 : 1;
          const float expected = from < order.size() && (k < 3 || order.size() % 2 == 0)
                                     ? in[i * kChannels + static_cast<std::size_t>(order[from])]
                                     : 1.0f;
          // Multiples of 1/8 below 4 are exact in each type but rgb9e5's, whose step here is 2^-7 too.
          ASSERT_EQ(out[i * stored + k], expected) << i << " " << k;
        }
      }
    }
  }
}

TEST(TexelEncoder, LastTexelIsNotReadPast) {
  for (int count = 1; count < 5; ++count) {
    const std::vector<float> in(static_cast<std::size_t>(count) * 3,
                                0.5f);  // exactly as long: for sanitizers
    const auto out = decoded(PixelType::float32, encoded(PixelType::float32, {0, 1, 2}, in, 3));
    for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i], i % 4 == 3 ? 1.0f : 0.5f);
  }
}

TEST(TexelEncoder, ClipsAndCounts) {
  const std::vector<float> in = {70000, -70000, 65024, 65100, -2, -0.0f, kInfinity, -kInfinity, kNan};
  const auto check = [&](PixelType type, WriteReport expected, const std::vector<float>& reds) {
    const Encoded out = encoded(type, {0}, in, 1);
    EXPECT_EQ(out.report.above, expected.above) << name_of(type);
    EXPECT_EQ(out.report.below, expected.below) << name_of(type);
    EXPECT_EQ(out.report.not_finite, expected.not_finite) << name_of(type);
    const std::vector<float> values = decoded(type, out);
    const std::size_t stored = format_for(type).packed() ? 3 : 4;
    for (std::size_t i = 0; i < reds.size(); ++i) {
      if (std::isnan(reds[i])) {
        EXPECT_TRUE(std::isnan(values[i * stored])) << name_of(type) << i;
      } else {
        EXPECT_EQ(values[i * stored], reds[i]) << name_of(type) << i;
      }
    }
  };
  check(PixelType::float32, {0, 0, 0}, in);
  check(PixelType::half, {2, 0, 0}, {65504, -65504, 65024, 65088, -2, 0, kInfinity, -kInfinity, kNan});
  // Grey is counted by blue, which holds up to 64512.
  check(PixelType::r11g11b10, {3, 3, 0}, {65024, 0, 65024, 65024, 0, 0, kInfinity, 0, kNan});
  check(PixelType::rgb9e5, {1, 2, 3}, {65408, 0, 65024, 65152, 0, 0, 65408, 0, 0});
}

}  // namespace
}  // namespace welkin::io::texels
