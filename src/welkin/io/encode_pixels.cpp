#include "welkin/io/encode_pixels.h"

#include <half.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>

#include "welkin/io/colour/srgb_encoder.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/decode_pixels.h"

namespace welkin::io {
namespace {

/// x clamped to [0, 1]; counts what is lost.
float to_unit_range(float x, WriteReport& report) {
  if (x >= 0 && x <= 1) [[likely]] {
    return x;
  }
  if (!std::isfinite(x)) {
    ++report.not_finite;
    return x > 0 ? 1.0f : 0.0f;
  }
  ++(x < 0 ? report.below : report.above);
  return x < 0 ? 0.0f : 1.0f;
}

/// round(largest·x) for x in [0, 1], in float64: exact for 8 and 16 bits.
template <class T>
T quantized(double x) {
  constexpr double kLargest = static_cast<double>(static_cast<T>(-1));
  return static_cast<T>(std::fmin(kLargest, std::floor(kLargest * x + 0.5)));
}

std::uint16_t to_half(float x, WriteReport& report) {
  constexpr float kLargest = 65504;
  if (std::fabs(x) > kLargest && std::isfinite(x)) {
    ++report.above;
    x = std::copysign(kLargest, x);
  }
  return imath_float_to_half(x);
}

/// Every `step`-th value of `in` to every `stored_step`-th of type T.
template <class T, class F>
void encode_channel(const float* in, int step, int count, std::byte* stored, std::size_t stored_step,
                    F code_of) {
  for (int i = 0; i < count; ++i, in += step, stored += stored_step) {
    const T code = code_of(*in);
    std::memcpy(stored, &code, sizeof code);
  }
}

}  // namespace

double WriteReport::relative_rmse() const {
  return squares > 0 ? std::sqrt(error_squares / squares) : 0;
}

WriteReport operator+(const WriteReport& a, const WriteReport& b) {
  return {a.above + b.above, a.below + b.below, a.not_finite + b.not_finite, a.squares + b.squares,
          a.error_squares + b.error_squares};
}

PixelEncoder::PixelEncoder(PixelType type, std::vector<int> order, std::vector<bool> srgb,
                           std::optional<int> alpha)
    : type_(type), order_(std::move(order)), srgb_(std::move(srgb)), alpha_(alpha) {
  assert(order_.size() == srgb_.size());
}

std::size_t PixelEncoder::pixel_bytes() const {
  return order_.size() * size_of(type_);
}

void PixelEncoder::encode(const float* in, int image_channels, int count, std::byte* stored,
                          WriteReport& report) const {
  if (!alpha_) return encode_as_they_are(in, image_channels, count, stored, report);
  const auto end = std::find(order_.begin(), order_.end(), *alpha_);
  const std::set<int> colours(order_.begin(), end);
  std::vector<float> straight(in, in + static_cast<std::ptrdiff_t>(count) * image_channels);
  for (float* pixel = straight.data(); pixel < straight.data() + straight.size(); pixel += image_channels) {
    const float alpha = pixel[*alpha_];
    if (!(alpha > 0)) continue;
    for (const int c : colours) pixel[c] /= alpha;
  }
  encode_as_they_are(straight.data(), image_channels, count, stored, report);
}

void PixelEncoder::encode_as_they_are(const float* in, int image_channels, int count, std::byte* stored,
                                      WriteReport& total) const {
  WriteReport uncounted;
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const auto own = order_.begin() + static_cast<std::ptrdiff_t>(k);
    WriteReport& report = std::find(order_.begin(), own, *own) == own ? total : uncounted;
    const auto encode_as = [&]<class T>(T, auto code_of) {
      encode_channel<T>(in + order_[k], image_channels, count, stored + k * sizeof(T), pixel_bytes(),
                        code_of);
    };
    const bool srgb = srgb_[k];
    switch (type_) {
      case PixelType::uint8:
        if (srgb) {
          encode_as(std::uint8_t{}, [&, &encoder = srgb8_encoder()](float x) {
            return static_cast<std::uint8_t>(encoder(to_unit_range(x, report)));
          });
        } else {
          encode_as(std::uint8_t{},
                    [&](float x) { return quantized<std::uint8_t>(to_unit_range(x, report)); });
        }
        break;
      case PixelType::uint16:
        if (srgb) {
          encode_as(std::uint16_t{}, [&, &encoder = srgb16_encoder()](float x) {
            return static_cast<std::uint16_t>(encoder(to_unit_range(x, report)));
          });
        } else {
          encode_as(std::uint16_t{},
                    [&](float x) { return quantized<std::uint16_t>(to_unit_range(x, report)); });
        }
        break;
      case PixelType::uint32:
        encode_as(std::uint32_t{}, [&](float x) {
          const double unit = to_unit_range(x, report);
          return quantized<std::uint32_t>(srgb ? linear_to_srgb(unit) : unit);
        });
        break;
      case PixelType::half:
        encode_as(std::uint16_t{},
                  [&](float x) { return to_half(srgb ? static_cast<float>(linear_to_srgb(x)) : x, report); });
        break;
      case PixelType::float32:
        encode_as(float{}, [&](float x) { return srgb ? static_cast<float>(linear_to_srgb(x)) : x; });
        break;
      case PixelType::rgb9e5:
      case PixelType::r11g11b10:
      case PixelType::bc6h:
      case PixelType::uastc_hdr:
      case PixelType::astc_hdr:
        assert(false);
    }
  }
}

WriteReport PixelEncoder::encode_rows(ImageView<const float> image, std::byte* stored,
                                      std::size_t stride) const {
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, image.height, 8), WriteReport{},
      [&](const tbb::blocked_range<int>& rows, WriteReport report) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
          encode(image.row(y), image.channels, image.width, stored + static_cast<std::size_t>(y) * stride,
                 report);
        }
        return report;
      },
      [](const WriteReport& a, const WriteReport& b) { return a + b; });
}

}  // namespace welkin::io
