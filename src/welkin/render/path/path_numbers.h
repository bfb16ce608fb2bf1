#pragma once

#include <array>
#include <cstdint>

/// The numbers of paths: quasi-random where that helps, and the same on any machine.
namespace welkin::scene {

/// Bits that depend on all bits of `x` (a finalizer of two rounds; Mulvey's constants).
inline std::uint64_t scattered(std::uint64_t x) {
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  x ^= x >> 32;
  return x;
}

/// Pairs of numbers in [0, 1) for one path of a pixel. Of the paths of one batch, each pair's numbers are
/// points of a Sobol' net of two dimensions, scrambled as Owen 1995 does, by the hash of Burley 2020;
/// batches, pixels and pairs are independent of each other.
class PathNumbers {
 public:
  /// `batch`: a number for the pixel, the batch and the seed; `index`: which path of the batch.
  PathNumbers(std::uint64_t batch, std::uint32_t index) : batch_(batch), index_(index) {}

  /// Two, for one purpose.
  std::array<double, 2> pair() {
    const std::uint64_t key = scattered(batch_ ^ scattered(++used_));
    const auto low = static_cast<std::uint32_t>(key), high = static_cast<std::uint32_t>(key >> 32);
    const std::uint32_t shuffled = scrambled(index_, low ^ high);
    const std::uint64_t rest = scattered(key + index_);
    return {number(scrambled(reversed(shuffled), low), static_cast<std::uint32_t>(rest)),
            number(scrambled(second(shuffled), high), static_cast<std::uint32_t>(rest >> 32))};
  }

  /// One.
  double single() { return pair()[0]; }

 private:
  static std::uint32_t reversed(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
  }
  /// Each bit flipped by those above it (Laine & Karras 2011, with Burley's constants).
  static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
  }
  /// Sobol's second dimension.
  static std::uint32_t second(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1)
      if ((index & 1) != 0) result ^= v;
    return result;
  }
  /// 32 bits of a net, and random ones below them.
  static double number(std::uint32_t bits, std::uint32_t below) {
    const std::uint64_t both = (static_cast<std::uint64_t>(bits) << 32) | below;
    return static_cast<double>(both >> 11) * 0x1p-53;
  }

  std::uint64_t batch_;
  std::uint32_t index_;
  std::uint64_t used_ = 0;
};

}  // namespace welkin::scene
