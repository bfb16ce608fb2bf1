#include "welkin/io/decode_pixels.h"

#include <half.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "welkin/io/byte_order.h"
#include "welkin/io/colour/transfer.h"

namespace welkin::io {
namespace {

/// The loop of all types: `value(channel, stored)` converts one value. With kChannels > 0 all channels are
/// wanted, in order, and the compiler unrolls them.
template <class T, int kChannels, class F>
void convert(const std::byte* stored, std::size_t stored_channels, std::span<const int> channels, int count,
             float* out, std::ptrdiff_t step, F value) {
  for (int i = 0; i < count; ++i, stored += stored_channels * sizeof(T), out += step) {
    if constexpr (kChannels > 0) {
      for (std::size_t k = 0; k < kChannels; ++k) out[k] = value(k, load_native<T>(stored + k * sizeof(T)));
    } else {
      for (std::size_t k = 0; k < channels.size(); ++k) {
        const auto channel = static_cast<std::size_t>(channels[k]);
        out[k] = value(channel, load_native<T>(stored + channel * sizeof(T)));
      }
    }
  }
}

template <class T, class F>
void convert(const std::byte* stored, std::size_t stored_channels, std::span<const int> channels, int count,
             float* out, std::ptrdiff_t step, F value) {
  bool in_order = channels.size() == stored_channels;
  for (std::size_t k = 0; k < channels.size(); ++k) in_order = in_order && channels[k] == static_cast<int>(k);
  const auto run = [&](auto kernel) { kernel(stored, stored_channels, channels, count, out, step, value); };
  if (in_order && stored_channels == 1) return run(convert<T, 1, F>);
  if (in_order && stored_channels == 3) return run(convert<T, 3, F>);
  if (in_order && stored_channels == 4) return run(convert<T, 4, F>);
  run(convert<T, 0, F>);
}

}  // namespace

std::size_t size_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return 1;
    case PixelType::uint16:
    case PixelType::half:
      return 2;
    case PixelType::uint32:
    case PixelType::float32:
      return 4;
    case PixelType::rgb9e5:
    case PixelType::r11g11b10:
    case PixelType::bc6h:
    case PixelType::uastc_hdr:
    case PixelType::astc_hdr:
      break;
  }
  assert(false);
  return 0;
}

std::vector<bool> srgb_channels(std::span<const std::string> names, Colour colour) {
  assert(colour != Colour::automatic);
  std::vector<bool> srgb;
  for (const std::string& name : names) srgb.push_back(colour == Colour::srgb && name != "A");
  return srgb;
}

PixelDecoder::PixelDecoder(PixelType type, std::vector<bool> srgb)
    : type_(type),
      srgb_(srgb.begin(), srgb.end()),
      all_linear_(std::count(srgb.begin(), srgb.end(), true) == 0) {
  for (const bool encoded : srgb) {
    if (type == PixelType::uint8) tables_.push_back((encoded ? srgb8_to_linear() : unorm8_to_float()).data());
    if (type == PixelType::uint16)
      tables_.push_back((encoded ? srgb16_to_linear() : unorm16_to_float()).data());
  }
}

void PixelDecoder::decode(const void* stored, std::span<const int> channels, int count, float* out,
                          std::ptrdiff_t step) const {
  const auto* bytes = static_cast<const std::byte*>(stored);
  const auto by_table = [this](std::size_t channel, auto value) { return tables_[channel][value]; };
  const auto linear = [this](std::size_t channel, double value) {
    return static_cast<float>(srgb_[channel] != 0 ? srgb_to_linear(value) : value);
  };
  switch (type_) {
    case PixelType::uint8:
      return convert<std::uint8_t>(bytes, srgb_.size(), channels, count, out, step, by_table);
    case PixelType::uint16:
      return convert<std::uint16_t>(bytes, srgb_.size(), channels, count, out, step, by_table);
    case PixelType::uint32:
      return convert<std::uint32_t>(
          bytes, srgb_.size(), channels, count, out, step,
          [&](std::size_t channel, std::uint32_t value) { return linear(channel, value / 4294967295.0); });
    case PixelType::half:
      return convert<std::uint16_t>(bytes, srgb_.size(), channels, count, out, step,
                                    [&](std::size_t channel, std::uint16_t value) {
                                      const float x = imath_half_to_float(value);
                                      return srgb_[channel] != 0 ? linear(channel, x) : x;
                                    });
    case PixelType::float32:
      if (all_linear_) {
        return convert<float>(bytes, srgb_.size(), channels, count, out, step,
                              [](std::size_t, float x) { return x; });
      }
      return convert<float>(
          bytes, srgb_.size(), channels, count, out, step,
          [&](std::size_t channel, float x) { return srgb_[channel] != 0 ? linear(channel, x) : x; });
    case PixelType::rgb9e5:
    case PixelType::r11g11b10:
    case PixelType::bc6h:
    case PixelType::uastc_hdr:
    case PixelType::astc_hdr:
      assert(false);
  }
}

void PixelDecoder::decode_rows(const std::byte* stored, std::size_t stride, std::span<const int> channels,
                               ImageView<float> out) const {
  tbb::parallel_for(tbb::blocked_range<int>(0, out.height, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      decode(stored + static_cast<std::size_t>(y) * stride, channels, out.width, out.row(y), out.channels);
    }
  });
}

}  // namespace welkin::io
