#pragma once

#include <bit>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/sphere/cube.h"

#ifdef __F16C__
#include <immintrin.h>
#endif

/// Included by one source file per instruction set; see sphere/kernels_impl.h for the reason why everything
/// carries the instruction set in its template arguments.
namespace welkin {

/// Eight values of a texel, as one register or two.
template <class Wide>
struct Eight {
  float v[8];

  static Eight zero() { return {}; }
  /// Of halves that are finite: exponent and mantissa moved into place, and the exponent's bias mended by a
  /// factor, which is right for subnormal numbers too.
  static Eight load(const std::uint16_t* from) {
    Eight r;
    for (int i = 0; i < 8; ++i) {
      const std::uint32_t half = from[i];
      const float magnitude = std::bit_cast<float>((half & 0x7fffu) << 13) * 0x1p112f;
      r.v[i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) | (half & 0x8000u) << 16);
    }
    return r;
  }
  void add(float weight, const Eight& b) {
    for (int i = 0; i < 8; ++i) v[i] += weight * b.v[i];
  }
  void load_sums(const float* from) { std::memcpy(v, from, sizeof v); }
  void store_sums(float* to) const { std::memcpy(to, v, sizeof v); }
};

#ifdef __F16C__
template <>
struct Eight<xsimd::fma3<xsimd::avx2>> {
  __m256 v;

  static Eight zero() { return {_mm256_setzero_ps()}; }
  static Eight load(const std::uint16_t* from) {
    return {_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)))};
  }
  void add(float weight, const Eight& b) { v = _mm256_fmadd_ps(_mm256_set1_ps(weight), b.v, v); }
  void load_sums(const float* from) { v = _mm256_loadu_ps(from); }
  void store_sums(float* to) const { _mm256_storeu_ps(to, v); }
};
#endif

template <class Wide>
struct GaussianOf {
  using Pack = xsimd::batch<float, Wide>;
  using Ints = xsimd::batch<std::int32_t, Wide>;
  static constexpr std::size_t kSize = Pack::size;

  static void spread(const GaussianSpread& cone, GaussianTaps& taps, std::size_t at) {
    const Pack sigma(cone.sigma);
    for (std::size_t i = 0; i < cone.count; i += kSize) {
      const Pack angle = sigma * Pack::load_unaligned(cone.nodes + i);
      const Pack sine = xsimd::sin(angle), cosine = xsimd::cos(angle);
      const auto store = [&](int k, float* to) {
        xsimd::fma(sine, Pack(cone.axis[k]), cosine * Pack(cone.direction[k])).store_unaligned(to + at + i);
      };
      store(0, taps.x);
      store(1, taps.y);
      store(2, taps.z);
    }
  }

  /// Weights of the quadratic B-spline at the texels −1, 0, 1 about the nearest, which is f ∈ [−½, ½] away.
  static void store_weights(const Pack& f, float (*to)[GaussianTaps::kMost + GaussianTaps::kLanes],
                            std::size_t i) {
    const Pack half(0.5f);
    const Pack before = half - f, after = half + f;
    const Pack w0 = half * before * before, w2 = half * after * after;
    w0.store_unaligned(to[0] + i);
    (Pack(0.75f) - f * f).store_unaligned(to[1] + i);
    w2.store_unaligned(to[2] + i);
  }

  static void locate(GaussianTaps& taps, std::size_t count, const std::uint16_t* values, std::size_t width) {
    alignas(64) std::int32_t chart[kSize], column[kSize], row[kSize];
    for (std::size_t i = 0; i < count; i += kSize) {
      const auto face =
          sphere::cube_face_of(Vec3<Pack>{Pack::load_unaligned(taps.x + i), Pack::load_unaligned(taps.y + i),
                                          Pack::load_unaligned(taps.z + i)});
      const Pack size = Pack::load_unaligned(taps.size + i);
      const auto place = [&](const Pack& s, std::int32_t* to,
                             float(*weights)[GaussianTaps::kMost + GaussianTaps::kLanes]) {
        // Texel k of the border's numbering has its centre at k − ½; the nearest one is the middle of three.
        const Pack at = xsimd::fma(Pack(2 / 3.14159265358979f) * xsimd::atan(s), size, Pack(0.5f) * size);
        const Pack whole = xsimd::min(xsimd::max(xsimd::floor(at), Pack(0.0f)), size - Pack(1.0f));
        store_weights(at - whole - Pack(0.5f), weights, i);
        xsimd::to_int(whole).store_aligned(to);
      };
      place(face.u, column, taps.across);
      place(face.v, row, taps.down);
      xsimd::to_int(face.chart).store_aligned(chart);
      const std::size_t here = count - i < kSize ? count - i : kSize;
      for (std::size_t k = 0; k < here; ++k) {
        const std::int64_t side = static_cast<std::int64_t>(taps.size[i + k]) + 2;
        const std::int64_t texel = taps.first[i + k] + (chart[k] * side + row[k]) * side + column[k];
        taps.texel[i + k] = texel;
        const std::uint16_t* first = values + static_cast<std::size_t>(texel) * width;
        const std::size_t pitch = static_cast<std::size_t>(side) * width;
        for (std::size_t r = 0; r < 3; ++r) {
          __builtin_prefetch(first + r * pitch);
          __builtin_prefetch(first + r * pitch + 3 * width - 1);
        }
      }
    }
  }

  static void gather(const GaussianTaps& taps, std::size_t from, std::size_t to, const std::uint16_t* values,
                     std::size_t width, float* sums) {
    for (std::size_t part = 0; part < width; part += 8) {
      Eight<Wide> sum;
      sum.load_sums(sums + part);
      for (std::size_t i = from; i < to; ++i) {
        const std::uint16_t* texel = values + static_cast<std::size_t>(taps.texel[i]) * width + part;
        const std::size_t pitch = (static_cast<std::size_t>(taps.size[i]) + 2) * width;
        for (std::size_t r = 0; r < 3; ++r, texel += pitch) {
          Eight<Wide> line = Eight<Wide>::zero();
          line.add(taps.across[0][i], Eight<Wide>::load(texel));
          line.add(taps.across[1][i], Eight<Wide>::load(texel + width));
          line.add(taps.across[2][i], Eight<Wide>::load(texel + 2 * width));
          sum.add(taps.down[r][i] * taps.weight[i], line);
        }
      }
      sum.store_sums(sums + part);
    }
  }

  static void to_halves(const float* from, std::uint16_t* to, std::size_t count) {
    std::size_t i = 0;
#ifdef __F16C__
    for (; i + 8 <= count; i += 8) {
      _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i),
                       _mm256_cvtps_ph(_mm256_loadu_ps(from + i), _MM_FROUND_TO_NEAREST_INT));
    }
#endif
    for (; i < count; ++i) {
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(from[i]);
      const std::uint32_t magnitude = bits & 0x7fffffffu;
      std::uint32_t half;
      if (magnitude < 0x38800000u) {
        // Subnormal: adding ½ rounds the last bits away, to even.
        half = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
      } else {
        half = (magnitude - 0x38000000u + 0xfffu + ((magnitude >> 13) & 1u)) >> 13;
      }
      to[i] = static_cast<std::uint16_t>(half | (bits & 0x80000000u) >> 16);
    }
  }

  static const GaussianKernels& table() {
    static constexpr GaussianKernels kernels{&spread, &locate, &gather, &to_halves};
    return kernels;
  }
};

}  // namespace welkin
