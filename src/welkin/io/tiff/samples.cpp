#include "welkin/io/tiff/samples.h"

#include <tiffio.h>

#include <bit>
#include <cassert>
#include <cmath>

#include "welkin/io/byte_order.h"

namespace welkin::io {
namespace {

using Kind = TiffSamples::Kind;

std::uint32_t load_24_bits(const std::byte* at) {
  const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(at[i]); };
  if constexpr (std::endian::native == std::endian::little) return byte(0) | byte(1) << 8 | byte(2) << 16;
  return byte(0) << 16 | byte(1) << 8 | byte(2);
}

/// One sign bit, 7 of exponent with a bias of 63, 16 of mantissa (Adobe Photoshop TIFF Technical Note 3).
float float_of_24_bits(std::uint32_t code) {
  constexpr int kBias = 63, kInfinite = 127;
  const int exponent = static_cast<int>(code >> 16 & 0x7f);
  const auto mantissa = static_cast<float>(code & 0xffff);
  float value = 0;
  if (exponent == kInfinite) {
    value = mantissa == 0 ? INFINITY : NAN;
  } else if (exponent == 0) {
    value = std::ldexp(mantissa, 1 - kBias - 16);
  } else {
    value = std::ldexp(mantissa + 65536, exponent - kBias - 16);
  }
  return (code >> 23 & 1) != 0 ? -value : value;
}

/// The bits of a row, one sample after the other.
class Bits {
 public:
  Bits(const std::byte* row, int bits) : next_(row), bits_(bits) {}
  std::uint32_t take() {
    while (held_ < bits_) {
      buffer_ = buffer_ << 8 | std::to_integer<std::uint64_t>(*next_++);
      held_ += 8;
    }
    held_ -= bits_;
    return static_cast<std::uint32_t>(buffer_ >> held_ & ((std::uint64_t{1} << bits_) - 1));
  }

 private:
  const std::byte* next_;
  int bits_;
  std::uint64_t buffer_ = 0;
  int held_ = 0;
};

/// Calls `use(i, code)` for each integer of the row.
template <class Use>
void for_integers(int bits, const std::byte* row, std::size_t count, Use use) {
  switch (bits) {
    case 8:
      for (std::size_t i = 0; i < count; ++i) use(i, std::to_integer<std::uint32_t>(row[i]));
      return;
    case 16:
      for (std::size_t i = 0; i < count; ++i) use(i, std::uint32_t{load_native<std::uint16_t>(row + 2 * i)});
      return;
    case 24:
      for (std::size_t i = 0; i < count; ++i) use(i, load_24_bits(row + 3 * i));
      return;
    case 32:
      for (std::size_t i = 0; i < count; ++i) use(i, load_native<std::uint32_t>(row + 4 * i));
      return;
    default:
      Bits packed(row, bits);
      for (std::size_t i = 0; i < count; ++i) use(i, packed.take());
  }
}

double largest_of(int bits) {
  return std::ldexp(1.0, bits) - 1;
}

}  // namespace

std::string TiffSamples::name() const {
  const std::string kinds[] = {"unsigned integers", "signed integers", "floats"};
  return std::to_string(bits) + "-bit " + kinds[static_cast<int>(kind)];
}

PixelType TiffSamples::type() const {
  if (kind == Kind::floating) return bits == 16 ? PixelType::half : PixelType::float32;
  if (kind == Kind::signed_integer) return PixelType::float32;
  if (bits <= 8) return PixelType::uint8;
  return bits <= 16 ? PixelType::uint16 : PixelType::uint32;
}

bool TiffSamples::plain() const {
  if (kind == Kind::floating) return bits == 16 || bits == 32;
  return kind == Kind::unsigned_integer && (bits == 8 || bits == 16 || bits == 32);
}

std::optional<TiffSamples> tiff_samples(int bits, int format) {
  const bool integer_size = bits >= 1 && bits <= 32;
  switch (format) {
    case SAMPLEFORMAT_UINT:
    case SAMPLEFORMAT_VOID:
      if (integer_size) return TiffSamples{Kind::unsigned_integer, bits};
      return {};
    case SAMPLEFORMAT_INT:
      if (integer_size && bits > 1) return TiffSamples{Kind::signed_integer, bits};
      return {};
    case SAMPLEFORMAT_IEEEFP:
      if (bits == 16 || bits == 24 || bits == 32 || bits == 64) return TiffSamples{Kind::floating, bits};
      return {};
    default:
      return {};
  }
}

std::string name_of_tiff_samples(int bits, int format) {
  const std::string size = std::to_string(bits) + "-bit ";
  switch (format) {
    case SAMPLEFORMAT_INT:
      return size + "signed integers";
    case SAMPLEFORMAT_IEEEFP:
      return size + "floats";
    case SAMPLEFORMAT_COMPLEXINT:
    case SAMPLEFORMAT_COMPLEXIEEEFP:
      return size + "complex numbers";
    default:
      return size + "unsigned integers";
  }
}

void unpack_tiff_samples(const TiffSamples& samples, std::size_t inverted_step, const std::byte* row,
                         std::size_t count, float* values) {
  const int bits = samples.bits;
  switch (samples.kind) {
    case Kind::unsigned_integer: {
      const double largest = largest_of(bits);
      return for_integers(bits, row, count, [&](std::size_t i, std::uint32_t code) {
        const bool inverted = inverted_step > 0 && i % inverted_step == 0;
        values[i] = static_cast<float>((inverted ? largest - code : code) / largest);
      });
    }
    case Kind::signed_integer: {
      const double largest = largest_of(bits - 1);
      const std::int64_t half = std::int64_t{1} << (bits - 1);
      return for_integers(bits, row, count, [&](std::size_t i, std::uint32_t code) {
        const std::int64_t value = code >= half ? std::int64_t{code} - 2 * half : std::int64_t{code};
        values[i] = static_cast<float>(static_cast<double>(value) / largest);
      });
    }
    case Kind::floating:
      for (std::size_t i = 0; i < count; ++i) {
        if (bits == 16) assert(false);  // PixelDecoder's
        values[i] = bits == 24   ? float_of_24_bits(load_24_bits(row + 3 * i))
                    : bits == 32 ? load_native<float>(row + 4 * i)
                                 : static_cast<float>(load_native<double>(row + 8 * i));
      }
  }
}

}  // namespace welkin::io
