#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/texture/astc_endpoints.h"
#include "welkin/texture/astc_hdr.h"
#include "welkin/texture/bc6h_block.h"
#include "welkin/texture/uastc_encoder.h"
#include "welkin/texture/uastc_to_bc6h.h"

namespace welkin {
namespace {

using namespace texture::uastc;
using texture::ErrorScale;
using texture::kLargestHalf;
using texture::astc::kBlockBytes;
using texture::astc::kTexels;

/// Every shape's ranges are the ones that ASTC derives from its bits.
TEST(UastcShapes, FillTheBlock) {
  for (const Shape& shape : kShapeTable) {
    texture::astc::Block block;
    block.weight_range = shape.weight_range;
    block.partitions = shape.partitions;
    std::fill_n(block.modes, shape.partitions, shape.mode);
    EXPECT_EQ(texture::astc::endpoint_range_of(block), shape.endpoint_range);
  }
}

TEST(UastcShapes, PartitionsAreThoseOfBc6h) {
  std::set<unsigned> wanted, found;
  for (const auto& each : texture::bc6h::kPartitionTable) wanted.insert(each.second);
  for (const Partition& each : Tables::get().partitions) {
    const unsigned second = (each.second & 1) != 0 ? each.second ^ 0xffffu : each.second;
    EXPECT_EQ(wanted.count(second), 1u) << each.seed;
    found.insert(second);
  }
  EXPECT_EQ(found.size(), static_cast<std::size_t>(kPartitions));
}

/// Endpoints that a layout's precision holds come back exactly where the range stores every byte, and in
/// other ranges within a few of its steps.
TEST(UastcEndpoints, StoreWhatFits) {
  std::mt19937 random(1);
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (const int levels : {256, 192, 128, 80, 64, 40}) {
    const StoredValues& range = StoredValues::of(texture::astc::range_of(levels));
    for (int layout = 0; layout < 8; ++layout) {
      const auto& bits = texture::astc::kDirectModes[layout];
      const int unit = 1 << bits.shift, half = 1 << (bits.d - 1);
      for (int round = 0; round < 500; ++round) {
        const int a = between(1 << (bits.a - 1), (1 << bits.a) - 1) * unit,
                  c = between(0, std::min((1 << bits.c) - 1, a / unit)) * unit;
        float ends[2][3];
        const auto major = static_cast<std::size_t>(between(0, 2));
        bool possible = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const int b = k == major ? 0 : between(0, (1 << bits.b) - 1) * unit,
                    d = k == major ? 0 : between(-half, half - 1) * unit;
          ends[1][k] = static_cast<float>(a - b);
          ends[0][k] = static_cast<float>(a - b - c - d);
          possible = possible && a - b >= 0 && a - b - c - d >= 0 && a - b - c - d < 4096;
        }
        // The largest channel must be the only one.
        for (std::size_t k = 0; k < 3; ++k)
          possible = possible && (k == major || ends[1][k] < ends[1][major]);
        if (!possible) continue;
        const StoredEnds stored = store_direct(ends, layout, range);
        for (std::size_t e = 0; e < 2; ++e) {
          for (std::size_t k = 0; k < 3; ++k) {
            const float step =
                levels == 256 ? 0 : 6.0f * static_cast<float>(unit) * 256 / static_cast<float>(levels);
            EXPECT_NEAR(static_cast<float>(stored.ends[e][k]), ends[e][k], step) << levels << " " << layout;
          }
        }
        for (const std::uint8_t value : stored.values) {
          const auto& values = texture::astc::endpoint_values(texture::astc::range_of(levels));
          EXPECT_EQ(values[range.code[value]], value);
        }
      }
    }
  }
}

TEST(UastcEndpoints, StoreScalesThatFit) {
  std::mt19937 random(2);
  const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
  const StoredValues& range = StoredValues::of(texture::astc::range_of(256));
  for (int layout = 0; layout < kScaleLayouts; ++layout) {
    const auto& bits = texture::astc::kScaleModes[layout];
    const int unit = 1 << bits.shift;
    for (int round = 0; round < 1000; ++round) {
      const int largest = below(1 << bits.largest), major = layout == 5 ? 0 : below(3);
      float end[3];
      bool possible = true;
      for (int c = 0; c < 3; ++c) {
        const int value = layout == 5  ? below(1 << bits.other)
                          : c == major ? largest
                                       : largest - 1 - below((1 << bits.other) - 1);
        possible = possible && value >= 0;
        end[c] = static_cast<float>(value * unit);
      }
      const int scale = below(1 << bits.scale) * unit;
      if (!possible) continue;
      const StoredEnds stored = store_scale(end, static_cast<float>(scale), layout, range);
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(stored.ends[1][c], static_cast<int>(end[c])) << layout;
        EXPECT_EQ(stored.ends[0][c], std::max(static_cast<int>(end[c]) - scale, 0)) << layout;
      }
    }
  }
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
  std::vector<std::byte> blocks(astc_bytes(width, height));
  const ClampedValues counts =
      encode_uastc_hdr({texels.data(), width, height, 3, 3 * width}, quality, blocks);
  if (clamped != nullptr) *clamped = counts;
  std::vector<float> decoded(texels.size());
  decode_astc_hdr(blocks, {decoded.data(), width, height, 3, 3 * width});
  return decoded;
}

/// One colour is exact, whatever it is.
TEST(UastcHdr, KeepsFlatBlocks) {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    const std::uint16_t colour[3] = {static_cast<std::uint16_t>(random() % (kLargestHalf + 1)),
                                     static_cast<std::uint16_t>(random() % (kLargestHalf + 1)),
                                     static_cast<std::uint16_t>(round == 0 ? kLargestHalf : random() % 1024)};
    std::vector<std::uint16_t> halves(3 * kTexels);
    for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = colour[i % 3];
    std::byte bytes[kBlockBytes];
    encoder_baseline()(halves.data(), 1, {1, false, 0, 1, 1, 0}, bytes);
    std::uint16_t decoded[4 * kTexels];
    texture::astc::decode(bytes, decoded);
    for (int i = 0; i < kTexels; ++i) {
      for (int c = 0; c < 3; ++c) ASSERT_EQ(decoded[4 * i + c], colour[c]);
      ASSERT_EQ(decoded[4 * i + 3], 0x3c00);
    }
  }
}

/// A longer search is never worse by more than the metrics differ. The blocks' colours span up to a fifth of
/// a factor of two along one line and less beside it, in 16 steps: an error of about a hundredth of that.
TEST(UastcHdr, EncodesSmoothPictures) {
  const std::vector<float> texels = smooth_picture(64, 48);
  const double fast = rmsle(texels, coded(texels, 64, 48, TextureQuality::fast));
  const double normal = rmsle(texels, coded(texels, 64, 48, TextureQuality::normal));
  const double best = rmsle(texels, coded(texels, 64, 48, TextureQuality::best));
  EXPECT_LT(fast, 6e-3);
  EXPECT_LT(normal, fast * 1.001);
  EXPECT_LT(best, normal * 1.001);
}

/// Two colours on both sides of an edge are two partitions.
TEST(UastcHdr, KeepsEdgesBetweenTwoColours) {
  std::vector<float> texels;
  for (int i = 0; i < 16; ++i) {
    const bool right = i % 4 >= 2;
    texels.insert(texels.end(), {right ? 1000.0f : 0.01f, right ? 2.0f : 0.5f, right ? 0.1f : 30.0f});
  }
  const std::vector<float> decoded = coded(texels, 4, 4, TextureQuality::fast);
  for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_NEAR(decoded[i] / texels[i], 1, 0.1) << i;
}

/// A bright texel doesn't push those beside it to black.
TEST(UastcHdr, KeepsDarkTexelsBesideASun) {
  std::vector<float> texels(48, 0.05f);
  texels[15] = texels[16] = texels[17] = 50000.0f;
  const std::vector<float> decoded = coded(texels, 4, 4, TextureQuality::fast);
  for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_NEAR(std::log(decoded[i] / texels[i]), 0, 0.7) << i;
}

/// Up to the largest half, beside nothing too, though no block but one of one colour holds more than 65216.
TEST(UastcHdr, KeepsTheBrightest) {
  std::mt19937 random(6);
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint16_t> halves(3 * kTexels);
    for (auto& half : halves)
      half = static_cast<std::uint16_t>(
          random() % 3 == 0 && round % 2 == 0 ? 0u : 0x7bff - random() % (1u << round % 8));
    for (const Search& search : {Search{1, false, 0, 1, 1, 0}, Search{2, true, 1, 3, 2, 1}}) {
      std::byte bytes[kBlockBytes];
      std::uint16_t decoded[4 * kTexels];
      encoder_baseline()(halves.data(), 1, search, bytes);
      texture::astc::decode(bytes, decoded);
      for (int i = 0; i < 3 * kTexels; ++i) {
        const std::uint16_t half = decoded[i / 3 * 4 + i % 3];
        if (round % 2 == 1) {
          ASSERT_NEAR(half, halves[static_cast<std::size_t>(i)], 150) << round;
        }
      }
      EXPECT_GT(*std::max_element(decoded, decoded + 4 * kTexels), 0x7400) << round;
    }
  }
}

/// What is written keeps to UASTC HDR: its shapes, one mode and endpoints below the limit, for any halves.
TEST(UastcHdr, WritesOnlyWhatBecomesBc6h) {
  std::mt19937 random(4);
  std::set<std::pair<int, int>> shapes;
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::uint16_t> halves(3 * kTexels);
    const std::uint_fast32_t base = random() % (kLargestHalf + 1),
                             spread = std::uint_fast32_t{1} << random() % 15;
    for (auto& half : halves)
      half = static_cast<std::uint16_t>(std::min(base + random() % spread, std::uint_fast32_t{kLargestHalf}));
    if (round % 2 == 0) {  // greys in two halves
      for (std::size_t i = 0; i < halves.size(); i += 3) halves[i + 1] = halves[i + 2] = halves[i];
    }
    std::byte bytes[kBlockBytes];
    encoder_baseline()(halves.data(), 1, {2, true, 1, 3, 1, 1}, bytes);
    texture::astc::Block block;
    ASSERT_TRUE(texture::astc::unpack(bytes, block));
    if (block.one_colour) continue;
    const auto found = std::find_if(kShapeTable.begin(), kShapeTable.end(), [&](const Shape& shape) {
      return shape.partitions == block.partitions && shape.mode == block.modes[0] &&
             shape.weight_range == block.weight_range && shape.endpoint_range == block.endpoint_range;
    });
    ASSERT_NE(found, kShapeTable.end());
    ASSERT_FALSE(block.two_planes);
    ASSERT_EQ(block.grid_width * block.grid_height, kTexels);
    if (block.partitions == 2) {
      const auto& known = Tables::get().partitions;
      ASSERT_TRUE(std::any_of(known.begin(), known.end(),
                              [&](const Partition& each) { return each.seed == block.seed; }));
    }
    std::uint8_t values[12];
    for (int i = 0; i < block.endpoint_count(); ++i)
      values[i] = texture::astc::endpoint_values(block.endpoint_range)[block.endpoints[i]];
    for (int r = 0; r < block.partitions; ++r) {
      const auto ends = texture::astc::endpoints_of(block.modes[r], values + r * found->values());
      for (const auto& colour : ends.colour) {
        for (int c = 0; c < 3; ++c) ASSERT_LE(colour[c] >> 4, kLargestEnd);
      }
    }
    shapes.insert({block.partitions, block.modes[0]});
  }
  EXPECT_EQ(shapes.size(), 4u);
}

/// As BC6H a block is about what it is as ASTC: what the search weighs as much.
TEST(UastcHdr, BecomesBc6hOfTheSameTexels) {
  const std::vector<float> texels = smooth_picture(64, 48);
  std::vector<std::byte> blocks(astc_bytes(64, 48));
  encode_uastc_hdr({texels.data(), 64, 48, 3, 192}, TextureQuality::normal, blocks);
  const auto log = [](std::uint16_t half) { return static_cast<double>(ErrorScale::get().log[half]); };
  double sum = 0;
  for (std::size_t at = 0; at < blocks.size(); at += kBlockBytes) {
    std::uint16_t as_astc[4 * kTexels], as_bc6h[3 * kTexels];
    texture::astc::decode(&blocks[at], as_astc);
    ASSERT_TRUE(decode_as_bc6h(&blocks[at], as_bc6h));
    for (int i = 0; i < 3 * kTexels; ++i)
      sum += std::pow(log(as_astc[i / 3 * 4 + i % 3]) - log(as_bc6h[i]), 2);
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(3 * blocks.size())), 5e-3);
}

/// BC6H isn't made of other ASTC: a grid of 4×2 weights.
TEST(UastcHdr, OtherAstcDoesNotBecomeBc6h) {
  texture::astc::Block block;
  block.grid_height = 2;
  block.weight_range = texture::astc::range_of(16);
  block.modes[0] = 11;
  block.endpoint_range = texture::astc::endpoint_range_of(block);
  std::byte bytes[kBlockBytes];
  texture::astc::pack(block, bytes);
  std::uint16_t halves[3 * kTexels];
  EXPECT_FALSE(decode_as_bc6h(bytes, halves));
}

TEST(UastcHdr, ClampsWhatItCannotHoldAndCountsIt) {
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

/// Blocks at the edge of a picture that isn't a multiple of 4 hold what its texels are.
TEST(UastcHdr, RepeatsTheEdge) {
  const std::vector<float> texels = smooth_picture(13, 6);
  EXPECT_LT(rmsle(texels, coded(texels, 13, 6, TextureQuality::normal)), 3e-2);
}

TEST(UastcHdr, DecodesToThreeChannelsOrFour) {
  const std::vector<float> grey(16, 0.75f);
  std::vector<std::byte> blocks(16);
  encode_uastc_hdr({grey.data(), 4, 4, 1, 4}, TextureQuality::fast, blocks);
  std::vector<float> rgb(48), rgba(64);
  decode_astc_hdr(blocks, {rgb.data(), 4, 4, 3, 12});
  decode_astc_hdr(blocks, {rgba.data(), 4, 4, 4, 16});
  for (const float value : rgb) EXPECT_EQ(value, 0.75f);
  for (std::size_t i = 0; i < rgba.size(); ++i) EXPECT_EQ(rgba[i], i % 4 == 3 ? 1.0f : 0.75f);
  std::vector<float> two(32);
  EXPECT_THROW(decode_astc_hdr(blocks, {two.data(), 4, 4, 2, 8}), Error);
  EXPECT_THROW(decode_astc_hdr(blocks, {rgb.data(), 8, 2, 3, 24}), Error);
}

#ifdef WELKIN_HAS_AVX2
/// Both instruction sets reach the same error.
TEST(UastcHdr, InstructionSetsAgree) {
  if (instruction_set() != InstructionSet::avx2) GTEST_SKIP();
  std::mt19937 random(5);
  std::vector<std::uint16_t> halves(48 * 200);
  for (std::size_t i = 0; i < halves.size(); ++i)
    halves[i] = static_cast<std::uint16_t>(8000 + i / 48 * 40 + random() % 2000);
  double errors[2] = {};
  for (int set = 0; set < 2; ++set) {
    std::vector<std::byte> blocks(16 * 200);
    (set == 0 ? encoder_baseline() : encoder_avx2())(halves.data(), 200, {2, true, 1, 3, 2, 1},
                                                     blocks.data());
    for (std::size_t b = 0; b < 200; ++b) {
      std::uint16_t decoded[64];
      texture::astc::decode(&blocks[16 * b], decoded);
      for (std::size_t i = 0; i < 48; ++i) {
        const auto log = [](std::uint16_t half) { return static_cast<double>(ErrorScale::get().log[half]); };
        errors[set] += std::pow(log(decoded[i / 3 * 4 + i % 3]) - log(halves[48 * b + i]), 2);
      }
    }
  }
  EXPECT_NEAR(errors[0] / errors[1], 1, 0.01);
}
#endif

}  // namespace
}  // namespace welkin
