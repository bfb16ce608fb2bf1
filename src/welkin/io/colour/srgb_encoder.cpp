#include "welkin/io/colour/srgb_encoder.h"

#include <cmath>
#include <limits>

#include "welkin/io/colour/transfer.h"

namespace welkin::io {

SrgbEncoder::SrgbEncoder(int levels) : straight_(static_cast<float>(12.92 * levels)) {
  constexpr std::uint32_t kOne = 0x3f800000;
  // One piece past 1.0, whose second knot is read with a fraction of 0.
  for (std::uint32_t bits = kFirst; bits <= kOne + (1u << kFractionBits); bits += 1u << kFractionBits) {
    const double knot = std::fmin(1.0, std::bit_cast<float>(bits));
    knots_.push_back(static_cast<float>(levels * linear_to_srgb(knot)));
  }

  // The inverse finds each threshold to a few units in the last place; the formula itself then decides.
  const float infinity = std::numeric_limits<float>::infinity();
  const auto reaches = [&](float x, int code) {
    return std::floor(levels * linear_to_srgb(x) + 0.5) >= code;
  };
  thresholds_.resize(static_cast<std::size_t>(levels) + 2);
  thresholds_.front() = -infinity;
  thresholds_.back() = infinity;
  for (int code = 1; code <= levels; ++code) {
    float x = static_cast<float>(srgb_to_linear((code - 0.5) / levels));
    while (reaches(x, code)) x = std::nextafter(x, -infinity);
    while (!reaches(x, code)) x = std::nextafter(x, infinity);
    thresholds_[static_cast<std::size_t>(code)] = x;
  }
}

const SrgbEncoder& srgb8_encoder() {
  static const SrgbEncoder encoder(255);
  return encoder;
}

const SrgbEncoder& srgb16_encoder() {
  static const SrgbEncoder encoder(65535);
  return encoder;
}

}  // namespace welkin::io
