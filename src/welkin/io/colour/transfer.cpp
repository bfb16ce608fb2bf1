#include "welkin/io/colour/transfer.h"

#include <cmath>
#include <vector>

namespace welkin::io {
namespace {

// IEC 61966-2-1:1999: a power of 2.4 above the knee, a straight line of slope 1/12.92 below it.
constexpr double kKneeEncoded = 0.04045;
constexpr double kKneeLinear = 0.0031308;
constexpr double kSlope = 12.92;
constexpr double kOffset = 0.055;
constexpr double kPower = 2.4;

template <class F>
std::vector<float> table(std::size_t size, F value_of) {
  std::vector<float> values(size);
  const double largest = static_cast<double>(size - 1);
  for (std::size_t k = 0; k < size; ++k)
    values[k] = static_cast<float>(value_of(static_cast<double>(k) / largest));
  return values;
}

double same(double x) {
  return x;
}

}  // namespace

double srgb_to_linear(double encoded) {
  const double magnitude = std::fabs(encoded);
  const double linear = magnitude <= kKneeEncoded ? magnitude / kSlope
                                                  : std::pow((magnitude + kOffset) / (1 + kOffset), kPower);
  return std::copysign(linear, encoded);
}

double linear_to_srgb(double linear) {
  const double magnitude = std::fabs(linear);
  const double encoded = magnitude <= kKneeLinear ? magnitude * kSlope
                                                  : (1 + kOffset) * std::pow(magnitude, 1 / kPower) - kOffset;
  return std::copysign(encoded, linear);
}

std::span<const float> srgb8_to_linear() {
  static const std::vector<float> values = table(256, srgb_to_linear);
  return values;
}

std::span<const float> srgb16_to_linear() {
  static const std::vector<float> values = table(65536, srgb_to_linear);
  return values;
}

std::span<const float> unorm8_to_float() {
  static const std::vector<float> values = table(256, same);
  return values;
}

std::span<const float> unorm16_to_float() {
  static const std::vector<float> values = table(65536, same);
  return values;
}

}  // namespace welkin::io
