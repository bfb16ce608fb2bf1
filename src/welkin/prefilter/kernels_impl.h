#pragma once

#include <algorithm>
#include <cstring>

#include "welkin/lobe/kernels_impl.h"
#include "welkin/prefilter/fft_impl.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/legendre_impl.h"
#include "welkin/prefilter/sampled_lobe.h"

/// Included by one source file per instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h.
namespace welkin::prefilter {

/// A SampledLobe as lobe/kernels_impl.h wants lobes.
template <class Arch>
struct Sampled {
  using Pack = xsimd::batch<float, Arch>;
  using Ints = xsimd::batch<std::int32_t, Arch>;
  const float* values;
  Pack core, scale;

  template <class T>
  Pack weight(const T& s) const {
    const Pack chord = xsimd::sqrt(Pack(2.0f) * s);
    const Pack place =
        xsimd::min(scale * chord / (chord + core), Pack(static_cast<float>(SampledLobe::kSteps)));
    const Ints index = xsimd::to_int(place);
    const Pack part = place - xsimd::to_float(index);
    const Pack below = Pack::gather(values, index), above = Pack::gather(values + 1, index);
    return xsimd::fma(part, above - below, below);
  }
};

template <class Arch>
struct KernelsOf {
  using V = Lanes<float, Arch>;

  /// One row of masses, channels interleaved.
  static void spread_row(const SpreadRows& r, int row, float* out, float* padded) {
    const int n = r.channels, count = r.width * n, half = count / 2;
    float* mixed = padded + n;  // a texel more on either side
    constexpr int kChunk = 1024;
    const RowSpread::Tap *begin = r.taps + r.first[row], *end = r.taps + r.first[row + 1];
    for (int start = 0; start < count;) {
      const int limit = start < half ? half : count;
      const int stop = start + kChunk < limit ? start + kChunk : limit;
      const std::ptrdiff_t across = start < half ? half : -half;
      for (int i = start; i < stop; i += 32) {
        V sum[4] = {V(0.0f), V(0.0f), V(0.0f), V(0.0f)};
        for (const RowSpread::Tap* tap = begin; tap != end; ++tap) {
          const float* from = r.texels + tap->row * r.row_stride + (tap->opposite ? across : 0) + i;
          const V weight(tap->weight);
          for (int k = 0; k < 4; ++k) sum[k] = V::fma(weight, V::load(from + 8 * k), sum[k]);
        }
        for (int k = 0; k < 4; ++k) sum[k].store(mixed + i + 8 * k);
      }
      start = stop;
    }
    if (!r.points) {
      std::memcpy(out, mixed, static_cast<std::size_t>(count) * sizeof(float));
      return;
    }
    std::memcpy(padded, mixed + count - n, static_cast<std::size_t>(n) * sizeof(float));
    std::memcpy(mixed + count, mixed, static_cast<std::size_t>(n) * sizeof(float));
    // A texel is as wide as a step: 1/24, 22/24, 1/24.
    const V side(1.0f / 24), middle(22.0f / 24);
    for (int i = 0; i < count; i += 8) {
      const V sides = V::load(mixed + i - n) + V::load(mixed + i + n);
      V::fma(middle, V::load(mixed + i), side * sides).store(out + i);
    }
  }

  static void spread_rows(const SpreadRows& r, int pack, float* lanes, float* work) {
    const int n = r.channels, count = r.width * n;
    const std::ptrdiff_t row_length = (count + 15) / 8 * 8;
    float* padded = work + 16 * row_length;
    const int half = r.height / 2;
    for (int lane = 0; lane < 16; ++lane) {
      const int north = pack * 8 + lane % 8;
      float* row = work + lane * row_length;
      if (north >= half) {
        std::memset(row, 0, static_cast<std::size_t>(row_length) * sizeof(float));
      } else {
        spread_row(r, lane < 8 ? north : r.height - 1 - north, row, padded);
      }
    }
    for (int x = 0; x < r.width; ++x) {
      for (int c = 0; c < n; ++c) {
        float* to = lanes + (static_cast<std::ptrdiff_t>(c) * r.width + x) * 16;
        const float* from = work + x * n + c;
        for (int lane = 0; lane < 16; ++lane) to[lane] = from[lane * row_length];
      }
    }
  }

  /// With F the transform of north + i·south: north = (Fₘ + F̄₋ₘ)/2, south = (Fₘ − F̄₋ₘ)/2i.
  static void rows_to_orders(const FftPlan& plan, float* lanes, float* work, const float* factors, int degree,
                             int packs, int parts, float* orders) {
    const float* f = Fft<Arch>::forward(plan, lanes, work);
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(packs) * 2 * parts * 8;
    for (int m = 0; m <= degree; ++m, orders += step) {
      // Beyond the row's length orders come again.
      const int place = m % plan.length;
      const float* a = f + static_cast<std::ptrdiff_t>(place) * 16;
      const float* b = f + static_cast<std::ptrdiff_t>(place == 0 ? 0 : plan.length - place) * 16;
      const V half(0.5f * factors[m]);
      const V are = V::load(a), aim = V::load(a + 8), bre = V::load(b), bim = V::load(b + 8);
      const V north_re = half * (are + bre), north_im = half * (aim - bim);
      const V south_re = half * (aim + bim), south_im = half * (bre - are);
      (north_re + south_re).store(orders);
      (north_im + south_im).store(orders + 8);
      (north_re - south_re).store(orders + parts * 8);
      (north_im - south_im).store(orders + parts * 8 + 8);
    }
  }

  static float* orders_to_rows(const FftPlan& plan, const float* orders, int degree, int packs, int parts,
                               float* lanes, float* work) {
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(packs) * 2 * parts * 8;
    const int n = plan.length;
    std::memset(lanes + static_cast<std::ptrdiff_t>(degree + 1) * 16, 0,
                static_cast<std::size_t>(n - 2 * degree - 1) * 16 * sizeof(float));
    for (int m = 0; m <= degree; ++m, orders += step) {
      const V even_re = V::load(orders), even_im = V::load(orders + 8);
      const V odd_re = V::load(orders + parts * 8), odd_im = V::load(orders + parts * 8 + 8);
      const V north_re = even_re + odd_re, north_im = even_im + odd_im;
      const V south_re = even_re - odd_re, south_im = even_im - odd_im;
      // north + i·south at m; conj(north) + i·conj(south) at −m.
      float* a = lanes + static_cast<std::ptrdiff_t>(m) * 16;
      if (m > 0) {
        float* b = lanes + static_cast<std::ptrdiff_t>(n - m) * 16;
        (north_re + south_im).store(b);
        (south_re - north_im).store(b + 8);
        (north_re - south_im).store(a);
        (north_im + south_re).store(a + 8);
      } else {
        north_re.store(a);
        south_re.store(a + 8);
      }
    }
    return Fft<Arch>::inverse(plan, lanes, work);
  }

  static void sampled_sums(const void* self, const lobe::Points& points, const float* x, const float* y,
                           const float* z, float* values, std::size_t count) {
    const SampledLobe& lobe = *static_cast<const SampledLobe*>(self);
    using Pack = xsimd::batch<float, Arch>;
    const float last = 2.0f / (2.0f + lobe.core);
    const Sampled<Arch> sampled{lobe.values.data(), Pack(lobe.core),
                                Pack(static_cast<float>(SampledLobe::kSteps) / last)};
    lobe::PointSumsOf<Sampled<Arch>, Arch>::sums(&sampled, points, x, y, z, values, count);
  }

  static const Kernels& table() {
    static constexpr Kernels kernels{
        &spread_rows,
        &rows_to_orders,
        &orders_to_rows,
        &sampled_sums,
        {&Legendre<Arch, 2>::analyse, &Legendre<Arch, 4>::analyse, &Legendre<Arch, 6>::analyse},
        {&Legendre<Arch, 2>::synthesise, &Legendre<Arch, 4>::synthesise, &Legendre<Arch, 6>::synthesise}};
    return kernels;
  }
};

}  // namespace welkin::prefilter
