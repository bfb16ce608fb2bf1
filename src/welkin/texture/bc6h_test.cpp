#include "welkin/texture/bc6h.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/texture/bc6h_encoder.h"

namespace welkin {
namespace {

using namespace texture::bc6h;

/// A random block of a mode, whose differences fit and whose anchors' indices are below half.
Block random_block(int which, std::mt19937& random) {
  const Mode& mode = kModeTable[static_cast<std::size_t>(which)];
  const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
  Block block;
  block.mode = which;
  block.partition = mode.regions == 2 ? below(kPartitions) : 0;
  for (int c = 0; c < 3; ++c) {
    const int half = 1 << (mode.other_bits[c] - 1), last = (1 << mode.precision) - 1;
    block.endpoints[0][c] = below(last + 1);
    for (int e = 1; e < 2 * mode.regions; ++e) {
      block.endpoints[e][c] = mode.differences
                                  ? std::clamp(block.endpoints[0][c] - half + below(2 * half), 0, last)
                                  : below(last + 1);
    }
  }
  for (std::uint8_t& index : block.indices) index = static_cast<std::uint8_t>(below(1 << mode.index_bits()));
  const int anchors[2] = {
      0, mode.regions == 2 ? kPartitionTable[static_cast<std::size_t>(block.partition)].anchor : 0};
  for (const int anchor : anchors)
    block.indices[anchor] = static_cast<std::uint8_t>(block.indices[anchor] % (1 << (mode.index_bits() - 1)));
  return block;
}

TEST(Bc6hBlock, IsUnpackedAsItWasPackedInEveryMode) {
  std::mt19937 random(1);
  for (int mode = 0; mode < kModes; ++mode) {
    for (int round = 0; round < 200; ++round) {
      const Block block = random_block(mode, random);
      ASSERT_TRUE(fits(block));
      std::byte bytes[16];
      pack(block, bytes);
      Block again;
      ASSERT_TRUE(unpack(bytes, false, again));
      EXPECT_EQ(again.mode, mode);
      EXPECT_EQ(again.partition, block.partition);
      EXPECT_EQ(std::memcmp(again.endpoints, block.endpoints, sizeof block.endpoints), 0) << mode;
      EXPECT_EQ(std::memcmp(again.indices, block.indices, sizeof block.indices), 0) << mode;
    }
  }
}

/// Every bit of a block means something: what is unpacked packs to the same bits.
TEST(Bc6hBlock, LosesNoBit) {
  std::mt19937 random(2);
  int packed = 0;
  for (int round = 0; round < 20000; ++round) {
    std::byte bytes[16], again[16];
    for (std::byte& each : bytes) each = static_cast<std::byte>(random() & 255);
    Block block;
    if (!unpack(bytes, false, block) || !fits(block)) continue;
    pack(block, again);
    ASSERT_EQ(std::memcmp(bytes, again, 16), 0) << block.mode;
    ++packed;
  }
  EXPECT_GT(packed, 4000);
}

/// The bytes by hand, from the specification's layout of mode 11: 5 bits of mode, then R G B of A and of B by
/// 10 bits, then indices of 4 bits, the first of 3.
TEST(Bc6hBlock, ModeElevenIsAsItIsWritten) {
  unsigned long long low = 0x03, high = 0;
  const auto put = [&](unsigned long long value, int at, int bits) {
    for (int i = 0; i < bits; ++i) (at + i < 64 ? low : high) |= (value >> i & 1) << ((at + i) % 64);
  };
  put(1023, 5, 10);   // R of A
  put(512, 15, 10);   // G of A
  put(0, 25, 10);     // B of A
  put(0, 35, 10);     // R of B
  put(512, 45, 10);   // G of B
  put(1023, 55, 10);  // B of B
  put(7, 65, 3);      // index of texel 0
  put(15, 68, 4);     // of texel 1
  std::byte bytes[16];
  for (int i = 0; i < 8; ++i) {
    bytes[i] = static_cast<std::byte>(low >> (8 * i) & 255);
    bytes[8 + i] = static_cast<std::byte>(high >> (8 * i) & 255);
  }
  std::uint16_t halves[48];
  decode(bytes, false, halves);
  // Texel 1 is B: 0, (512 << 16 | 0x8000) >> 10 = 32800, 65535; times 31/64.
  EXPECT_EQ(halves[3], 0);
  EXPECT_EQ(halves[4], 32800 * 31 >> 6);
  EXPECT_EQ(halves[5], kLargestHalf);
  // Texel 0 lies at 30/64, texel 2 is A.
  EXPECT_EQ(halves[0], ((65535 * 34 + 32) >> 6) * 31 >> 6);
  EXPECT_EQ(halves[6], kLargestHalf);
  EXPECT_EQ(halves[8], 0);
}

TEST(Bc6hBlock, ReservedModesAreBlack) {
  for (const unsigned code : {0x13u, 0x17u, 0x1bu, 0x1fu}) {
    std::byte bytes[16];
    std::fill(std::begin(bytes), std::end(bytes), std::byte{0xff});
    bytes[0] = static_cast<std::byte>(0xe0u | code);
    std::uint16_t halves[48];
    decode(bytes, false, halves);
    for (const std::uint16_t half : halves) EXPECT_EQ(half, 0);
  }
}

/// Of the signed format: the largest and the least value of mode 11.
TEST(Bc6hBlock, SignedEndpointsAreTwosComplement) {
  Block block;
  block.mode = 10;
  const int stored[2][3] = {{0x1ff, 0x200, 0x3ff}, {0, 0, 0}};  // 511, −512, −1
  for (int c = 0; c < 3; ++c) {
    block.endpoints[0][c] = stored[0][c];
    block.endpoints[1][c] = stored[1][c];
  }
  std::byte bytes[16];
  pack(block, bytes);
  float texels[48];
  decode_bc6h(bytes, true, {texels, 4, 4, 3, 12});
  EXPECT_EQ(texels[0], 65504.0f);
  EXPECT_EQ(texels[1], -65504.0f);
  EXPECT_LT(texels[2], 0.0f);
}

std::vector<float> smooth_picture(int width, int height) {
  std::vector<float> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(width),
                  v = static_cast<float>(y) / static_cast<float>(height);
      texels.insert(texels.end(), {0.2f + u, 0.5f + 0.3f * v, std::exp2(4 * u * v)});
    }
  }
  return texels;
}

double rmsle(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::log(static_cast<double>(a[i]) + 1) - std::log(static_cast<double>(b[i]) + 1);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<float> coded(const std::vector<float>& texels, int width, int height, TextureQuality quality,
                         ClampedValues* clamped = nullptr) {
  std::vector<std::byte> blocks(bc6h_bytes(width, height));
  const ClampedValues counts = encode_bc6h({texels.data(), width, height, 3, 3 * width}, quality, blocks);
  if (clamped != nullptr) *clamped = counts;
  std::vector<float> decoded(texels.size());
  decode_bc6h(blocks, false, {decoded.data(), width, height, 3, 3 * width});
  return decoded;
}

/// One colour is exact, whatever it is.
TEST(Bc6h, KeepsFlatBlocks) {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    std::vector<std::uint16_t> halves(48);
    const std::uint16_t colour[3] = {static_cast<std::uint16_t>(random() % (kLargestHalf + 1)),
                                     static_cast<std::uint16_t>(random() % (kLargestHalf + 1)),
                                     static_cast<std::uint16_t>(round == 0 ? kLargestHalf : random() % 1024)};
    for (std::size_t i = 0; i < 48; ++i) halves[i] = colour[i % 3];
    std::byte bytes[16];
    encoder_baseline()(halves.data(), 1, {1, 1, 1, false, false}, bytes);
    std::uint16_t decoded[48];
    decode(bytes, false, decoded);
    for (std::size_t i = 0; i < 48; ++i) ASSERT_EQ(decoded[i], halves[i]);
  }
}

/// A longer search is never worse by more than the metrics differ. The blocks' colours span up to a fifth of
/// a factor of two along one line and less beside it, in 16 steps: an error of about a hundredth of that.
TEST(Bc6h, EncodesSmoothPictures) {
  const std::vector<float> texels = smooth_picture(64, 48);
  const double fast = rmsle(texels, coded(texels, 64, 48, TextureQuality::fast));
  const double normal = rmsle(texels, coded(texels, 64, 48, TextureQuality::normal));
  const double best = rmsle(texels, coded(texels, 64, 48, TextureQuality::best));
  EXPECT_LT(fast, 5e-3);
  EXPECT_LT(normal, fast * 1.001);
  EXPECT_LT(best, normal * 1.001);
}

/// Two colours on both sides of an edge are two regions.
TEST(Bc6h, KeepsEdgesBetweenTwoColours) {
  std::vector<float> texels;
  for (int i = 0; i < 16; ++i) {
    const bool right = i % 4 >= 2;
    texels.insert(texels.end(), {right ? 1000.0f : 0.01f, right ? 2.0f : 0.5f, right ? 0.1f : 30.0f});
  }
  const std::vector<float> decoded = coded(texels, 4, 4, TextureQuality::fast);
  for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_NEAR(decoded[i] / texels[i], 1, 0.06) << i;
}

/// A bright texel doesn't push those beside it to black.
TEST(Bc6h, KeepsDarkTexelsBesideASun) {
  std::vector<float> texels(48, 0.05f);
  texels[15] = texels[16] = texels[17] = 50000.0f;
  const std::vector<float> decoded = coded(texels, 4, 4, TextureQuality::fast);
  for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_NEAR(std::log(decoded[i] / texels[i]), 0, 0.7) << i;
}

TEST(Bc6h, ClampsWhatItCannotHoldAndCountsIt) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::vector<float> texels(48, 1.0f);
  texels[0] = -1;
  texels[1] = -kInfinity;
  texels[5] = kInfinity;
  texels[7] = 1e9f;
  texels[8] = std::numeric_limits<float>::quiet_NaN();
  ClampedValues clamped;
  const std::vector<float> decoded = coded(texels, 4, 4, TextureQuality::best, &clamped);
  EXPECT_EQ(clamped.below, 2u);
  EXPECT_EQ(clamped.above, 2u);
  EXPECT_EQ(clamped.not_a_number, 1u);
  for (const float value : decoded) {
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 65504.0f);
  }
}

/// Blocks at the edge of a picture that isn't a multiple of 4 hold what its texels are, and nothing is
/// counted twice.
TEST(Bc6h, RepeatsTheEdge) {
  const std::vector<float> texels = smooth_picture(13, 6);
  ClampedValues clamped;
  EXPECT_LT(rmsle(texels, coded(texels, 13, 6, TextureQuality::normal, &clamped)), 3e-2);
  std::vector<float> one = {-1, -1, -1};
  coded(one, 1, 1, TextureQuality::fast, &clamped);
  EXPECT_EQ(clamped.below, 3u);
}

TEST(Bc6h, EncodesGrey) {
  const std::vector<float> grey(16, 0.75f);
  std::vector<std::byte> blocks(16);
  encode_bc6h({grey.data(), 4, 4, 1, 4}, TextureQuality::fast, blocks);
  std::vector<float> rgb(48);
  decode_bc6h(blocks, false, {rgb.data(), 4, 4, 3, 12});
  for (const float value : rgb) EXPECT_EQ(value, 0.75f);
}

TEST(Bc6h, RefusesWhatDoesNotFit) {
  const std::vector<float> texels(48, 1.0f);
  std::vector<std::byte> blocks(32);
  EXPECT_THROW(encode_bc6h({texels.data(), 4, 4, 3, 12}, TextureQuality::fast, blocks), Error);
  EXPECT_THROW(encode_bc6h({texels.data(), 4, 4, 2, 8}, TextureQuality::fast, std::span(blocks).first(16)),
               Error);
  EXPECT_THROW(bc6h_bytes(0, 4), Error);
}

#ifdef WELKIN_HAS_AVX2
/// Both instruction sets reach the same error.
TEST(Bc6h, InstructionSetsAgree) {
  if (instruction_set() != InstructionSet::avx2) GTEST_SKIP();
  std::mt19937 random(5);
  std::vector<std::uint16_t> halves(48 * 200);
  for (std::size_t i = 0; i < halves.size(); ++i)
    halves[i] = static_cast<std::uint16_t>(8000 + i / 48 * 40 + random() % 2000);
  double errors[2] = {};
  for (int set = 0; set < 2; ++set) {
    std::vector<std::byte> blocks(16 * 200);
    (set == 0 ? encoder_baseline() : encoder_avx2())(halves.data(), 200, {2, 1, 2, true, false},
                                                     blocks.data());
    for (std::size_t b = 0; b < 200; ++b) {
      std::uint16_t decoded[48];
      decode(&blocks[16 * b], false, decoded);
      for (std::size_t i = 0; i < 48; ++i) {
        const auto log = [](std::uint16_t half) { return static_cast<double>(ErrorScale::get().log[half]); };
        errors[set] += std::pow(log(decoded[i]) - log(halves[48 * b + i]), 2);
      }
    }
  }
  EXPECT_NEAR(errors[0] / errors[1], 1, 0.01);
}
#endif

}  // namespace
}  // namespace welkin
