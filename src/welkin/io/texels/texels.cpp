#include "welkin/io/texels/texels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/io/byte_order.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/io/shared_exponent.h"
#include "welkin/io/small_float.h"
#include "welkin/texture/astc_hdr.h"
#include "welkin/texture/bc6h.h"

namespace welkin::io::texels {
namespace {

static_assert(std::endian::native == std::endian::little, "texels are stored as they lie in memory");

/// Texels that are encoded together: their planes stay in the innermost cache.
constexpr int kSegment = 256;

template <class T>
using Plane = std::array<T, kSegment>;
/// R, G, B, A. Of grey only the first and A are filled.
using Planes = std::array<Plane<float>, 4>;
/// Which planes are R, G and B.
using Colours = std::array<std::size_t, 3>;
constexpr Colours kGrey{0, 0, 0}, kRgb{0, 1, 2};

constexpr auto kInfinityBits = static_cast<std::int32_t>(0x7f800000u);

/// Counts of one segment; 32 bits, that the loops become SIMD.
struct Counts {
  std::int32_t above = 0, below = 0, not_finite = 0;
};

void add(const Counts& counts, WriteReport& report) {
  report.above += static_cast<std::uint64_t>(counts.above);
  report.below += static_cast<std::uint64_t>(counts.below);
  report.not_finite += static_cast<std::uint64_t>(counts.not_finite);
}

void gather(const float* in, int channels, int count, float* plane) {
  for (int i = 0; i < count; ++i) plane[i] = in[static_cast<std::ptrdiff_t>(i) * channels];
}

void to_halves(const float* plane, int count, std::uint16_t* out, WriteReport& report) {
  constexpr auto kLargest =
      static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(largest_small_float<10>()));
  Counts counts;
  for (int i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(plane[i]);
    const auto magnitude = static_cast<std::int32_t>(bits & 0x7fffffffu);
    const bool above = (magnitude > kLargest) & (magnitude < kInfinityBits);
    counts.above += above ? 1 : 0;
    const auto clipped = static_cast<std::uint32_t>(above ? kLargest : magnitude);
    out[i] = static_cast<std::uint16_t>(small_float_of<10>(clipped) | (bits >> 16 & 0x8000u));
  }
  add(counts, report);
}

template <int kMantissaBits>
void to_small_floats(const float* plane, int count, std::uint32_t* out, WriteReport& report) {
  constexpr auto kLargest =
      static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(largest_small_float<kMantissaBits>()));
  Counts counts;
  for (int i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(plane[i]);
    const auto magnitude = static_cast<std::int32_t>(bits & 0x7fffffffu);
    const bool above = (magnitude > kLargest) & (magnitude < kInfinityBits);
    const bool below = (static_cast<std::int32_t>(bits) < 0) & (magnitude > 0) & (magnitude <= kInfinityBits);
    counts.below += below ? 1 : 0;
    counts.above += (above & !below) ? 1 : 0;
    const std::int32_t clipped = above ? kLargest : magnitude;
    out[i] = small_float_of<kMantissaBits>(static_cast<std::uint32_t>(below ? 0 : clipped));
  }
  add(counts, report);
}

/// Values into [0, kLargestSharedExponent], in place.
void to_shared_exponent_range(float* plane, int count, WriteReport& report) {
  constexpr float kLargest = kLargestSharedExponent;
  Counts counts;
  for (int i = 0; i < count; ++i) {
    const float x = plane[i];
    const auto magnitude = static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(x) & 0x7fffffffu);
    const bool finite = magnitude < kInfinityBits;
    counts.not_finite += finite ? 0 : 1;
    counts.below += (finite & (x < 0)) ? 1 : 0;
    counts.above += (finite & (x > kLargest)) ? 1 : 0;
    const float positive = x > 0 ? x : 0.0f;  // 0 of NaN
    plane[i] = positive < kLargest ? positive : kLargest;
  }
  add(counts, report);
}

/// Grey is counted by its blue, which has the least range.
void encode_r11g11b10(const Planes& planes, const Colours& colours, int count, std::byte* out,
                      WriteReport& report) {
  WriteReport uncounted;
  Plane<std::uint32_t> r, g, b;
  WriteReport& of_red_and_green = colours == kGrey ? uncounted : report;
  to_small_floats<6>(planes[colours[0]].data(), count, r.data(), of_red_and_green);
  to_small_floats<6>(planes[colours[1]].data(), count, g.data(), of_red_and_green);
  to_small_floats<5>(planes[colours[2]].data(), count, b.data(), report);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) r[i] |= g[i] << 11 | b[i] << 22;
  std::memcpy(out, r.data(), static_cast<std::size_t>(count) * sizeof r[0]);
}

void encode_rgb9e5(Planes& planes, const Colours& colours, int count, std::byte* out, WriteReport& report) {
  to_shared_exponent_range(planes[0].data(), count, report);
  for (std::size_t k = 1; k <= colours[2]; ++k) to_shared_exponent_range(planes[k].data(), count, report);
  const float *r = planes[colours[0]].data(), *g = planes[colours[1]].data(), *b = planes[colours[2]].data();
  Plane<std::uint32_t> texels;
  for (int i = 0; i < count; ++i) texels[static_cast<std::size_t>(i)] = shared_exponent_of(r[i], g[i], b[i]);
  std::memcpy(out, texels.data(), static_cast<std::size_t>(count) * sizeof texels[0]);
}

template <class T>
void interleave(const T* r, const T* g, const T* b, const T* a, int count, std::byte* out) {
  for (int i = 0; i < count; ++i) {
    const T texel[4] = {r[i], g[i], b[i], a[i]};
    std::memcpy(out + static_cast<std::size_t>(i) * sizeof texel, texel, sizeof texel);
  }
}

void encode_srgb(float* plane, int count) {
  for (int i = 0; i < count; ++i) plane[i] = static_cast<float>(linear_to_srgb(plane[i]));
}

void encode_segment(PixelType type, Planes& planes, const Colours& colours, int count, std::byte* out,
                    WriteReport& report) {
  if (type == PixelType::r11g11b10) return encode_r11g11b10(planes, colours, count, out, report);
  if (type == PixelType::rgb9e5) return encode_rgb9e5(planes, colours, count, out, report);
  const auto interleaved = [&](const auto& stored) {
    interleave(stored[colours[0]].data(), stored[colours[1]].data(), stored[colours[2]].data(),
               stored[3].data(), count, out);
  };
  if (type == PixelType::float32) return interleaved(planes);
  std::array<Plane<std::uint16_t>, 4> halves;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k <= colours[2] || k == 3) to_halves(planes[k].data(), count, halves[k].data(), report);
  }
  interleaved(halves);
}

template <class T>
void decode_snorm(const std::byte* stored, std::size_t count, float* values) {
  constexpr auto kLargest = static_cast<double>(std::numeric_limits<T>::max());
  for (std::size_t i = 0; i < count; ++i) {
    const double value = static_cast<double>(load_native<T>(stored + i * sizeof(T)));
    values[i] = static_cast<float>(std::max(-1.0, value / kLargest));
  }
}

/// A channel inside a word.
struct Field {
  std::size_t channel;
  int shift, bits;
};

std::vector<Field> fields_of(const TexelFormat& format) {
  std::vector<Field> fields;
  int end = 8 * static_cast<int>(format.type_size);
  for (std::string_view text = format.fields; !text.empty();) {
    const std::size_t channel = format.channels.find(text.front());
    const std::size_t digits = std::min(text.find_first_not_of("0123456789", 1), text.size()) - 1;
    const int bits = std::stoi(std::string(text.substr(1, digits)));
    end -= bits;
    fields.push_back({channel, end, bits});
    text.remove_prefix(1 + digits);
  }
  assert(end == 0 && fields.size() == format.channels.size());
  return fields;
}

double value_of_bits(std::uint32_t code, int bits, bool is_signed) {
  const double largest = static_cast<double>((std::uint32_t{1} << (is_signed ? bits - 1 : bits)) - 1);
  if (!is_signed) return code / largest;
  const auto half = std::int64_t{1} << (bits - 1);
  const std::int64_t value = code >= half ? std::int64_t{code} - 2 * half : std::int64_t{code};
  return std::max(-1.0, static_cast<double>(value) / largest);
}

void decode_fields(const TexelFormat& format, const std::byte* stored, int count, float* values) {
  const std::vector<Field> fields = fields_of(format);
  for (int i = 0; i < count; ++i, stored += format.type_size, values += fields.size()) {
    std::uint32_t word = 0;
    std::memcpy(&word, stored, format.type_size);
    for (const Field& field : fields) {
      const std::uint32_t code = word >> field.shift & ((std::uint32_t{1} << field.bits) - 1);
      values[field.channel] = static_cast<float>(value_of_bits(code, field.bits, format.is_signed));
    }
  }
}

}  // namespace

TexelEncoder::TexelEncoder(PixelType type, std::vector<int> order, Colour colour, bool two_channels,
                           TextureQuality quality)
    : type_(type),
      texel_bytes_(format_for(type, two_channels).bytes()),
      order_(std::move(order)),
      srgb_(colour == Colour::srgb),
      two_channels_(two_channels),
      quality_(quality) {
  const bool packed = is_packed(type);
  assert(packed ? order_.size() == 1 || order_.size() == 3 : !order_.empty());
  static_cast<void>(packed);
  bool in_order = !srgb_ && order_.size() >= 3;
  for (std::size_t k = 0; k < order_.size(); ++k) in_order = in_order && order_[k] == static_cast<int>(k);
  copies_ = in_order && type == PixelType::float32;
  if (in_order && type == PixelType::half) encode_halves_ = encode_half_texels();
}

void TexelEncoder::encode(const float* in, int channels, int count, std::byte* out,
                          WriteReport& report) const {
  constexpr std::size_t kTexel = 4 * sizeof(float);
  if (copies_ && channels == 4 && order_.size() == 4) {
    std::memcpy(out, in, static_cast<std::size_t>(count) * kTexel);
    return;
  }
  if (copies_ && order_.size() == 3) {
    // Four values at once where a fourth is there to be read, then 1 over it.
    constexpr float kOpaque = 1;
    for (int i = 0; i + 1 < count; ++i, in += channels, out += kTexel) {
      std::memcpy(out, in, kTexel);
      std::memcpy(out + 3 * sizeof(float), &kOpaque, sizeof kOpaque);
    }
    std::memcpy(out, in, 3 * sizeof(float));
    std::memcpy(out + 3 * sizeof(float), &kOpaque, sizeof kOpaque);
    return;
  }

  if (encode_halves_ != nullptr && channels == static_cast<int>(order_.size()) && count > 0)
    return encode_halves_(in, channels, count, out, report.above);
  if (two_channels_) return encode_two(in, channels, count, out, report);
  const bool alpha = order_.size() % 2 == 0;
  const Colours& colours = order_.size() <= 2 ? kGrey : kRgb;
  Planes planes;
  planes[3].fill(1);
  for (int n = 0; count > 0; count -= n, in += static_cast<std::ptrdiff_t>(n) * channels) {
    n = std::min(count, kSegment);
    for (std::size_t k = 0; k <= colours[2]; ++k) {
      gather(in + order_[k], channels, n, planes[k].data());
      if (srgb_) encode_srgb(planes[k].data(), n);
    }
    if (alpha) gather(in + order_.back(), channels, n, planes[3].data());
    encode_segment(type_, planes, colours, n, out, report);
    out += static_cast<std::size_t>(n) * texel_bytes_;
  }
}

void TexelEncoder::encode_two(const float* in, int channels, int count, std::byte* out,
                              WriteReport& report) const {
  Plane<float> plane;
  Plane<std::uint16_t> halves;
  for (int n = 0; count > 0; count -= n, in += static_cast<std::ptrdiff_t>(n) * channels) {
    n = std::min(count, kSegment);
    for (std::size_t k = 0; k < 2; ++k) {
      gather(in + order_[k], channels, n, plane.data());
      if (srgb_) encode_srgb(plane.data(), n);
      if (type_ == PixelType::half) to_halves(plane.data(), n, halves.data(), report);
      const std::size_t bytes = texel_bytes_ / 2;
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const void* const value = type_ == PixelType::half ? static_cast<const void*>(&halves[i]) : &plane[i];
        std::memcpy(out + i * texel_bytes_ + k * bytes, value, bytes);
      }
    }
    out += static_cast<std::size_t>(n) * texel_bytes_;
  }
}

void TexelEncoder::encode(ImageView<const float> rows, std::span<std::byte> out, WriteReport& report) const {
  if (type_ == PixelType::bc6h || type_ == PixelType::uastc_hdr) return encode_blocks(rows, out, report);
  encode(rows.row(0), rows.channels, rows.width, out.data(), report);
}

void TexelEncoder::encode_blocks(ImageView<const float> rows, std::span<std::byte> out,
                                 WriteReport& report) const {
  // Channels in order, encoded, one behind the other.
  const int channels = static_cast<int>(order_.size());
  std::vector<float> values(static_cast<std::size_t>(rows.width) * static_cast<std::size_t>(rows.height) *
                            order_.size());
  float* value = values.data();
  for (int y = 0; y < rows.height; ++y) {
    const float* texel = rows.row(y);
    for (int x = 0; x < rows.width; ++x, texel += rows.channels) {
      for (const int channel : order_)
        *value++ = srgb_ ? static_cast<float>(linear_to_srgb(texel[channel])) : texel[channel];
    }
  }
  const ImageView<const float> ordered{values.data(), rows.width, rows.height, channels,
                                       std::ptrdiff_t{rows.width} * channels};
  const ClampedValues clamped = type_ == PixelType::bc6h ? encode_bc6h(ordered, quality_, out)
                                                         : encode_uastc_hdr(ordered, quality_, out);
  report.above += clamped.above;
  report.below += clamped.below;
  report.not_finite += clamped.not_a_number;
}

void decode_packed(PixelType type, const std::byte* stored, int count, float* rgb) {
  for (int i = 0; i < count; ++i, stored += sizeof(std::uint32_t), rgb += 3) {
    const auto texel = load_native<std::uint32_t>(stored);
    if (type == PixelType::rgb9e5) {
      values_of_shared_exponent(texel, rgb);
    } else {
      rgb[0] = float_of_small<6>(texel);
      rgb[1] = float_of_small<6>(texel >> 11);
      rgb[2] = float_of_small<5>(texel >> 22);
    }
  }
}

void decode_values(const TexelFormat& format, const std::byte* stored, int count, float* values) {
  const std::size_t all = static_cast<std::size_t>(count) * format.channels.size();
  switch (format.coding) {
    case Coding::packed:
      return decode_packed(format.type, stored, count, values);
    case Coding::snorm:
      return format.type_size == 1 ? decode_snorm<std::int8_t>(stored, all, values)
                                   : decode_snorm<std::int16_t>(stored, all, values);
    case Coding::doubles:
      for (std::size_t i = 0; i < all; ++i)
        values[i] = static_cast<float>(load_native<double>(stored + i * sizeof(double)));
      return;
    case Coding::fields:
      return decode_fields(format, stored, count, values);
    case Coding::blocks:
    case Coding::plain:
      break;
  }
  assert(false);
}

}  // namespace welkin::io::texels
