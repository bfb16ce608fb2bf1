#include "welkin/io/exr/chunk.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <string>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "welkin/base/error.h"

// Pixels are loaded as the file has them, little-endian.
static_assert(std::endian::native == std::endian::little);

namespace welkin::io::exr {
namespace {

/// A count n ≥ 0 stands for n + 1 copies of the next byte, n < 0 for −n bytes as they are.
void expand_runs(std::span<const std::byte> packed, std::span<std::byte> to) {
  std::size_t in = 0, out = 0;
  while (in < packed.size()) {
    const int count = static_cast<std::int8_t>(packed[in++]);
    const auto length = static_cast<std::size_t>(count < 0 ? -count : count + 1);
    if ((count < 0 ? length : 1) > packed.size() - in || length > to.size() - out)
      throw Error(ErrorKind::damaged, "run-length data is damaged");
    if (count < 0) {
      std::memcpy(to.data() + out, packed.data() + in, length);
      in += length;
    } else {
      std::memset(to.data() + out, static_cast<int>(packed[in++]), length);
    }
    out += length;
  }
  if (out != to.size()) throw Error(ErrorKind::damaged, "run-length data ends early");
}

/// Binary16 to binary32. The exponent is re-biased by an addition; a subnormal becomes a normal number by
/// subtracting 2^-14 from 2^-14 + m·2^-24, which is exact.
inline float float_of_half(std::uint16_t half) {
  constexpr std::uint32_t kRebias = (127 - 15) << 23;
  const std::uint32_t magnitude = (half & 0x7fffu) << 13;
  const std::uint32_t exponent = magnitude & (0x7c00u << 13);
  const std::uint32_t normal = magnitude + kRebias + (exponent == (0x7c00u << 13) ? kRebias : 0);
  const float subnormal =
      std::bit_cast<float>(magnitude + kRebias + (1u << 23)) - std::bit_cast<float>(kRebias + (1u << 23));
  const std::uint32_t bits = exponent == 0 ? std::bit_cast<std::uint32_t>(subnormal) : normal;
  return std::bit_cast<float>(bits | (half & 0x8000u) << 16);
}

#ifdef __SSE2__
/// The same for four halves in the lower 16 bits of each lane.
inline __m128i floats_of_halves(__m128i half) {
  const __m128i rebias = _mm_set1_epi32((127 - 15) << 23);
  const __m128i min_normal = _mm_set1_epi32((127 - 14) << 23);
  const __m128i magnitude = _mm_and_si128(half, _mm_set1_epi32(0x7fff));
  const __m128i shifted = _mm_slli_epi32(magnitude, 13);
  const __m128i no_number = _mm_cmpgt_epi32(magnitude, _mm_set1_epi32(0x7bff));
  const __m128i is_subnormal = _mm_cmpgt_epi32(_mm_set1_epi32(0x400), magnitude);
  const __m128i normal = _mm_add_epi32(_mm_add_epi32(shifted, rebias), _mm_and_si128(no_number, rebias));
  const __m128i subnormal = _mm_castps_si128(
      _mm_sub_ps(_mm_castsi128_ps(_mm_add_epi32(shifted, min_normal)), _mm_castsi128_ps(min_normal)));
  const __m128i chosen =
      _mm_or_si128(_mm_and_si128(is_subnormal, subnormal), _mm_andnot_si128(is_subnormal, normal));
  return _mm_or_si128(chosen, _mm_slli_epi32(_mm_xor_si128(half, magnitude), 16));
}
#endif

/// Pixels that are converted at a time: their planes stay in the first-level cache.
constexpr int kBlock = 256;

/// Interleaves floats of 1 to 4 channels, each at any address, into pixels of `stride` values.
void store_pixels(const std::array<const std::byte*, 4>& from, int channels, int count, float* to,
                  int stride) {
  int i = 0;
#ifdef __SSE2__
  const auto load = [&](std::size_t c) {
    return _mm_loadu_ps(reinterpret_cast<const float*>(from[c] + 4 * i));
  };
  if (channels == 3 && stride == 3) {
    for (; i + 4 <= count; i += 4) {
      const __m128 r = load(0), g = load(1), b = load(2);
      const __m128 rg01 = _mm_unpacklo_ps(r, g), rg23 = _mm_unpackhi_ps(r, g);
      const __m128 b0r1 = _mm_shuffle_ps(b, rg01, _MM_SHUFFLE(2, 2, 0, 0));
      const __m128 g1b1 = _mm_shuffle_ps(rg01, b, _MM_SHUFFLE(1, 1, 3, 3));
      const __m128 b23rg3 = _mm_shuffle_ps(b, rg23, _MM_SHUFFLE(3, 2, 3, 2));
      _mm_storeu_ps(to + 3 * i, _mm_shuffle_ps(rg01, b0r1, _MM_SHUFFLE(2, 0, 1, 0)));
      _mm_storeu_ps(to + 3 * i + 4, _mm_shuffle_ps(g1b1, rg23, _MM_SHUFFLE(1, 0, 2, 0)));
      _mm_storeu_ps(to + 3 * i + 8, _mm_shuffle_ps(b23rg3, b23rg3, _MM_SHUFFLE(1, 3, 2, 0)));
    }
  } else if (channels == 4) {
    for (; i + 4 <= count; i += 4) {
      __m128 pixels[4]{load(0), load(1), load(2), load(3)};
      _MM_TRANSPOSE4_PS(pixels[0], pixels[1], pixels[2], pixels[3]);
      for (int k = 0; k < 4; ++k) _mm_storeu_ps(to + (i + k) * stride, pixels[k]);
    }
  }
#endif
  for (; i < count; ++i)
    for (int c = 0; c < channels; ++c)
      std::memcpy(to + i * stride + c, from[static_cast<std::size_t>(c)] + 4 * i, sizeof(float));
}

}  // namespace

bool unpacks_here(Compression compression) {
  return compression <= Compression::zip;
}

void ChunkUnpacker::Free::operator()(libdeflate_decompressor* p) const {
  libdeflate_free_decompressor(p);
}

ChunkUnpacker::ChunkUnpacker() : inflater_(libdeflate_alloc_decompressor()) {
  if (!inflater_) throw std::bad_alloc();
}

std::span<const std::byte> ChunkUnpacker::unpack(Compression compression, std::span<const std::byte> packed,
                                                 std::size_t size) {
  if (packed.size() == size) return packed;  // a chunk that would not shrink is stored as it is
  if (compression == Compression::none) throw Error(ErrorKind::damaged, "the chunk has too few bytes");
  if (coded_.size() < size) {
    coded_.resize(size);
    bytes_.resize(size);
  }
  const std::span<std::byte> coded = std::span(coded_).first(size), bytes = std::span(bytes_).first(size);
  if (compression == Compression::rle) {
    expand_runs(packed, coded);
  } else {
    std::size_t inflated = 0;
    const auto result = libdeflate_zlib_decompress(inflater_.get(), packed.data(), packed.size(),
                                                   coded.data(), coded.size(), &inflated);
    if (result == LIBDEFLATE_SHORT_OUTPUT || (result == LIBDEFLATE_SUCCESS && inflated != size))
      throw Error(ErrorKind::damaged, "deflated data ends early");
    if (result != LIBDEFLATE_SUCCESS) throw Error(ErrorKind::damaged, "deflated data is damaged");
  }
  undo_differences(coded);
  interleave_halves(coded, bytes);
  return bytes;
}

void undo_differences(std::span<std::byte> bytes) {
  std::size_t i = 0;
  std::uint8_t sum = 128;
#ifdef __SSE2__
  // Sums of 16 bytes in four doubling steps; only the carry of the last byte runs from one group to the next.
  const __m128i bias = _mm_set1_epi8(-128);
  __m128i carry = bias;
  for (; i + 16 <= bytes.size(); i += 16) {
    __m128i* const at = reinterpret_cast<__m128i*>(bytes.data() + i);
    __m128i x = _mm_add_epi8(_mm_loadu_si128(at), bias);
    x = _mm_add_epi8(x, _mm_slli_si128(x, 1));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 2));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 4));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 8));
    x = _mm_add_epi8(x, carry);
    _mm_storeu_si128(at, x);
    carry = _mm_unpackhi_epi8(x, x);
    carry = _mm_shuffle_epi32(_mm_shufflehi_epi16(carry, 0xff), 0xff);
  }
  sum = static_cast<std::uint8_t>(_mm_cvtsi128_si32(carry));
#endif
  for (; i < bytes.size(); ++i) {
    sum = static_cast<std::uint8_t>(sum + static_cast<std::uint8_t>(bytes[i]) + 128);
    bytes[i] = std::byte{sum};
  }
}

void interleave_halves(std::span<const std::byte> from, std::span<std::byte> to) {
  const std::size_t half = (from.size() + 1) / 2, pairs = from.size() / 2;
  const std::byte* const even = from.data();
  const std::byte* const odd = from.data() + half;
  std::size_t i = 0;
#ifdef __SSE2__
  for (; i + 16 <= pairs; i += 16) {
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(even + i));
    const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(odd + i));
    __m128i* const at = reinterpret_cast<__m128i*>(to.data() + 2 * i);
    _mm_storeu_si128(at, _mm_unpacklo_epi8(a, b));
    _mm_storeu_si128(at + 1, _mm_unpackhi_epi8(a, b));
  }
#endif
  for (; i < pairs; ++i) {
    to[2 * i] = even[i];
    to[2 * i + 1] = odd[i];
  }
  if (half > pairs) to[2 * pairs] = even[pairs];
}

void convert_to_float(StoredType type, const std::byte* from, int count, float* to) {
  switch (type) {
    case StoredType::float32:
      std::memcpy(to, from, static_cast<std::size_t>(count) * sizeof(float));
      return;
    case StoredType::half: {
      int i = 0;
#ifdef __SSE2__
      for (; i + 8 <= count; i += 8) {
        const __m128i halves = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + 2 * i));
        const __m128i zero = _mm_setzero_si128();
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i),
                         floats_of_halves(_mm_unpacklo_epi16(halves, zero)));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i + 4),
                         floats_of_halves(_mm_unpackhi_epi16(halves, zero)));
      }
#endif
      for (; i < count; ++i) {
        std::uint16_t half;
        std::memcpy(&half, from + 2 * i, sizeof half);
        to[i] = float_of_half(half);
      }
      return;
    }
    case StoredType::uint32:
      for (int i = 0; i < count; ++i) {
        std::uint32_t value;
        std::memcpy(&value, from + 4 * i, sizeof value);
        to[i] = static_cast<float>(value);
      }
      return;
  }
}

void store_chunk(const Part& part, const Window& window, std::span<const std::byte> bytes,
                 const Destination& destination) {
  const Window seen = intersection(window, part.display);
  if (seen.empty()) return;
  const auto line_width = static_cast<std::size_t>(window.width());

  // Bytes of one line before each stored channel.
  std::vector<std::size_t> before;
  std::size_t line_bytes = 0;
  for (const StoredChannel& channel : part.channels) {
    before.push_back(line_bytes);
    line_bytes += line_width * bytes_of(channel.type);
  }

  float planes[4][kBlock];
  std::array<const std::byte*, 4> sources{};
  const int stride = destination.out.channels;
  for (int y = seen.min_y; y <= seen.max_y; ++y) {
    const std::byte* const line = bytes.data() + static_cast<std::size_t>(y - window.min_y) * line_bytes;
    for (int x = seen.min_x; x <= seen.max_x; x += kBlock) {
      const int count = std::min(kBlock, seen.max_x - x + 1);
      float* const to = destination.out.at(x - part.display.min_x, y - part.display.min_y);
      for (int first = 0; first < stride; first += 4) {
        const int channels = std::min(4, stride - first);
        for (int c = 0; c < channels; ++c) {
          const auto stored =
              static_cast<std::size_t>(destination.channels[static_cast<std::size_t>(first + c)]);
          const StoredType type = part.channels[stored].type;
          const std::byte* from =
              line + before[stored] + static_cast<std::size_t>(x - window.min_x) * bytes_of(type);
          if (stride == 1 || type != StoredType::float32) {
            float* const plane = stride == 1 ? to : planes[c];
            convert_to_float(type, from, count, plane);
            from = reinterpret_cast<const std::byte*>(plane);
          }
          sources[static_cast<std::size_t>(c)] = from;
        }
        if (stride > 1) store_pixels(sources, channels, count, to + first, stride);
      }
    }
  }
}

}  // namespace welkin::io::exr
