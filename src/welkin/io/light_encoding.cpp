#include "welkin/io/light_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parameter.h"
#include "welkin/io/hdr/rgbe.h"
#include "welkin/io/image_file.h"

namespace welkin::io {
namespace {

using Kind = LightEncoding::Kind;
using Pixel = std::array<std::uint8_t, 4>;

constexpr double kGamma = 2.2;
constexpr double kRgbdLargest = 255, kRgbpLargest = 64;

constexpr const char* kNames[] = {"rgbm", "rgbd", "rgbp", "rgbe"};

std::uint8_t rounded(double share) {
  return static_cast<std::uint8_t>(std::clamp(255 * share + 0.5, 0.0, 255.0));
}

/// (r/255)^2.2.
const std::array<float, 256>& linear_of_gamma() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255, kGamma));
    return made;
  }();
  return table;
}

void decode_pixel(Kind kind, double range, const std::uint8_t* p, float* rgb) {
  switch (kind) {
    case Kind::rgbm: {
      const double scale = range * p[3] / (255.0 * 255.0);
      for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(p[c] * scale);
      return;
    }
    case Kind::rgbd: {
      // Nothing writes a divisor of 0; it is read as the least.
      const float scale = 255.0f / static_cast<float>(std::max<int>(p[3], 1));
      for (int c = 0; c < 3; ++c) rgb[c] = linear_of_gamma()[p[c]] * scale;
      return;
    }
    case Kind::rgbp: {
      const double scale = (8 - 7 * p[3] / 255.0) / 255.0;
      for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(p[c] * scale * (p[c] * scale));
      return;
    }
    case Kind::rgbe:
      decode_rgbe(p, p + 1, p + 2, p + 3, 1, rgb);
      return;
  }
}

/// Of values that are finite and in range.
Pixel encode_pixel(Kind kind, double range, const double* rgb) {
  const double largest = std::max({rgb[0], rgb[1], rgb[2]});
  Pixel p{};
  switch (kind) {
    case Kind::rgbm: {
      // The least multiplier that reaches the largest value.
      p[3] = static_cast<std::uint8_t>(std::min(255.0, std::ceil(255 * largest / range)));
      if (p[3] == 0) return p;
      for (std::size_t c = 0; c < 3; ++c) p[c] = rounded(rgb[c] / range * 255 / p[3]);
      return p;
    }
    case Kind::rgbd: {
      p[3] = static_cast<std::uint8_t>(largest > 1 ? std::max(1.0, std::floor(255 / largest)) : 255);
      for (std::size_t c = 0; c < 3; ++c) p[c] = rounded(std::pow(rgb[c] * p[3] / 255, 1 / kGamma));
      return p;
    }
    case Kind::rgbp: {
      // The engine rounds it up, and clips the largest value a little.
      const double root = std::clamp(std::sqrt(largest), 1.0, 8.0);
      p[3] = static_cast<std::uint8_t>(std::floor(255 * (8 - root) / 7));
      const double scale = 8 - 7 * p[3] / 255.0;
      for (std::size_t c = 0; c < 3; ++c) p[c] = rounded(std::sqrt(rgb[c]) / scale);
      return p;
    }
    case Kind::rgbe:
      encode_rgbe(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]),
                  p.data());
      return p;
  }
  return p;
}

}  // namespace

std::vector<std::string> light_encoding_names() {
  return {std::begin(kNames), std::end(kNames)};
}

LightEncoding LightEncoding::from_name(std::string_view text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const std::string name(text.substr(0, comma));
  const auto found = std::find(std::begin(kNames), std::end(kNames), name);
  if (found == std::end(kNames))
    throw Error(ErrorKind::bad_request, unknown_name("encoding", name, light_encoding_names()));
  LightEncoding encoding;
  encoding.kind = static_cast<Kind>(found - std::begin(kNames));
  if (comma == text.size()) return encoding;
  std::vector<Parameter> parameters;
  if (encoding.kind == Kind::rgbm) parameters.push_back({"range", 6, 1, 65504, "its largest value"});
  encoding.range = parse_parameter(name, parameters, text.substr(comma + 1)).value;
  return encoding;
}

std::string LightEncoding::text() const {
  const std::string name = kNames[static_cast<int>(kind)];
  return kind == Kind::rgbm ? name + ",range=" + number_text(range) : name;
}

double LightEncoding::largest() const {
  switch (kind) {
    case Kind::rgbm:
      return range;
    case Kind::rgbd:
      return kRgbdLargest;
    case Kind::rgbp:
      return kRgbpLargest;
    case Kind::rgbe:
      break;
  }
  return static_cast<double>(kLargestRgbe);
}

void LightEncoding::decode(const std::uint8_t* rgba, std::size_t count, float* rgb) const {
  for (std::size_t i = 0; i < count; ++i) decode_pixel(kind, range, rgba + 4 * i, rgb + 3 * i);
}

void LightEncoding::encode(const float* rgb, std::size_t stride, std::size_t count, std::uint8_t* rgba,
                           WriteReport& report) const {
  const double most = largest();
  for (std::size_t i = 0; i < count; ++i) {
    double values[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(rgb[i * stride + c]);
      report.not_finite += std::isfinite(value) ? 0u : 1u;
      report.below += value < 0 && std::isfinite(value) ? 1u : 0u;
      report.above += value > most && std::isfinite(value) ? 1u : 0u;
      values[c] = value > 0 ? std::min(value, most) : 0;  // NaN is 0
    }
    const Pixel pixel = encode_pixel(kind, range, values);
    std::copy(pixel.begin(), pixel.end(), rgba + 4 * i);
    float decoded[3];
    decode_pixel(kind, range, pixel.data(), decoded);
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(rgb[i * stride + c]);
      if (!std::isfinite(value)) continue;
      const double error = static_cast<double>(decoded[c]) - value;
      report.squares += value * value;
      report.error_squares += error * error;
    }
  }
}

}  // namespace welkin::io
