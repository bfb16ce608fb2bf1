#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace welkin::io {

/// Correctly rounded sRGB codes: `encoder(x)` is round(levels·linear_to_srgb(x)) for every float x in [0, 1],
/// without computing a power.
///
/// A piecewise linear estimate over the bits of x (128 pieces per octave: off by at most 0.03/128² of the
/// value, so 0.12 of a 16-bit code) is at most one code away from the truth; comparing x with the exact
/// thresholds of the estimated code and of the next settles it.
class SrgbEncoder {
 public:
  /// `levels` is the largest code, 255 or 65535.
  explicit SrgbEncoder(int levels);

  int operator()(float linear) const {
    int code = static_cast<int>(estimate(linear) + 0.5f);
    code += linear >= thresholds_[static_cast<std::size_t>(code) + 1] ? 1 : 0;
    code -= linear < thresholds_[static_cast<std::size_t>(code)] ? 1 : 0;
    return code;
  }

 private:
  static constexpr std::uint32_t kFirst = 0x3b000000;  ///< the bits of 2^-9, below the knee
  static constexpr int kFractionBits = 16;

  float estimate(float linear) const {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(linear);
    if (linear < 0x1p-9f) return linear * straight_;  // −0 too, whose bits are the largest
    const std::uint32_t piece = (bits - kFirst) >> kFractionBits;
    const float fraction = static_cast<float>(bits & ((1u << kFractionBits) - 1)) / (1 << kFractionBits);
    return knots_[piece] + (knots_[piece + 1] - knots_[piece]) * fraction;
  }

  float straight_;
  std::vector<float> knots_;
  std::vector<float> thresholds_;  ///< [k]: the smallest float of code k; then infinity
};

/// Made at first use.
const SrgbEncoder& srgb8_encoder();
const SrgbEncoder& srgb16_encoder();

}  // namespace welkin::io
