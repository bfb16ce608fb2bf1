#include "welkin/texture/error_scale.h"

#include <cmath>

namespace welkin::texture {
namespace {

/// Of radiance: below it errors count as absolute ones.
constexpr double kFloor = 0.01;

double value_of(int half) {
  const int exponent = half >> 10, mantissa = half & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

}  // namespace

const ErrorScale& ErrorScale::get() {
  static const ErrorScale scale = [] {
    ErrorScale made;
    for (int half = 0; half <= kLargestHalf; ++half) {
      const auto i = static_cast<std::size_t>(half);
      const double value = value_of(half),
                   step = half < 1024 ? std::ldexp(1, -24) : std::ldexp(1, (half >> 10) - 25);
      made.log[i] = static_cast<float>(std::log(value + kFloor));
      const double slope = step / (value + kFloor);
      made.slope[i] = static_cast<float>(slope * slope);
    }
    return made;
  }();
  return scale;
}

PartitionMasks PartitionMasks::of(std::span<const std::uint16_t> partitions) {
  PartitionMasks made{};
  for (std::size_t i = 0; i < made.second.size(); ++i) {
    for (std::size_t p = 0; p < partitions.size(); ++p)
      made.second[i][p] = static_cast<float>(partitions[p] >> i & 1);
  }
  return made;
}

}  // namespace welkin::texture
