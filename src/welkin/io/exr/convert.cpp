#include "welkin/io/exr/convert.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace welkin::io::exr {
namespace {

constexpr float kLargestHalf = 65504.0f;

void to_halves(std::span<const float> from, std::byte* to, WriteReport& report) {
  std::uint64_t above = 0;
  for (float value : from) {
    if (std::abs(value) > kLargestHalf && std::isfinite(value)) {
      value = std::copysign(kLargestHalf, value);
      ++above;
    }
    const std::uint16_t bits = Imath::half(value).bits();
    std::memcpy(to, &bits, sizeof bits);
    to += sizeof bits;
  }
  report.above += above;
}

void to_integers(std::span<const float> from, std::byte* to, WriteReport& report) {
  constexpr double kLargest = std::numeric_limits<std::uint32_t>::max();
  for (const float value : from) {
    const double rounded = std::isfinite(value) ? std::nearbyint(static_cast<double>(value)) : 0.0;
    report.not_finite += !std::isfinite(value);
    report.below += rounded < 0.0;
    report.above += rounded > kLargest;
    const auto integer = static_cast<std::uint32_t>(std::clamp(rounded, 0.0, kLargest));
    std::memcpy(to, &integer, sizeof integer);
    to += sizeof integer;
  }
}

}  // namespace

void convert_from_float(std::span<const float> from, StoredType type, std::byte* to, WriteReport& report) {
  switch (type) {
    case StoredType::half:
      return to_halves(from, to, report);
    case StoredType::uint32:
      return to_integers(from, to, report);
    case StoredType::float32:
      std::memcpy(to, from.data(), from.size_bytes());
      return;
  }
}

}  // namespace welkin::io::exr
