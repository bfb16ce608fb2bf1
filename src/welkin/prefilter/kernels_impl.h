#pragma once

#include <algorithm>
#include <cstring>

#include "welkin/lobe/kernels_impl.h"
#include "welkin/prefilter/fft_impl.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/legendre_impl.h"
#include "welkin/prefilter/near_impl.h"
#include "welkin/prefilter/sampled_lobe.h"

/// Included by one source file per instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h.
namespace welkin::prefilter {

/// A SampledLobe with the interface that lobe/kernels_impl.h needs.
template <class Arch>
struct Sampled {
  using Pack = xsimd::batch<float, Arch>;
  using Ints = xsimd::batch<std::int32_t, Arch>;
  const float* values;
  Pack core, scale;

  template <class T>
  Pack weight(const T& s) const {
    const Pack chord = xsimd::sqrt(Pack(2.0f) * s);
    const Pack position =
        xsimd::min(scale * chord / (chord + core), Pack(static_cast<float>(SampledLobe::kSteps)));
    const Ints index = xsimd::to_int(position);
    const Pack part = position - xsimd::to_float(index);
    const Pack below = Pack::gather(values, index), above = Pack::gather(values + 1, index);
    return xsimd::fma(part, above - below, below);
  }
};

template <class Arch>
struct KernelsOf {
  using V = Lanes<float, Arch>;

  /// Columns [begin, end) of a row of points, channels interleaved, before they are spread along the row.
  static void mix_rows(const SpreadRows& r, int row, int begin, int end, float* out) {
    const int n = r.picture.channels, half = r.picture.width / 2 * n;
    const RowSpread::Tap* taps = r.down.taps.data();
    const RowSpread::Tap *first = taps + r.down.first.data()[row],
                         *last = taps + r.down.first.data()[row + 1];
    for (int start = begin * n; start < end * n;) {
      const int limit = start < half ? half : 2 * half;
      const int stop = end * n < limit ? end * n : limit;
      const std::ptrdiff_t across = start < half ? half : -half;
      for (int i = start; i < stop; i += 32) {
        V sum[4] = {V(0.0f), V(0.0f), V(0.0f), V(0.0f)};
        for (const RowSpread::Tap* tap = first; tap != last; ++tap) {
          const float* from =
              r.picture.data + tap->row * r.picture.row_stride + (tap->opposite ? across : 0) + i;
          const V weight(tap->weight);
          for (int k = 0; k < 4; ++k) sum[k] = V::fma(weight, V::load(from + 8 * k), sum[k]);
        }
        for (int k = 0; k < 4; ++k) sum[k].store(out + (i - begin * n) + 8 * k);
      }
      start = stop;
    }
  }

  static void spread_rows(const SpreadRows& r, int pack, float* lanes, float* work) {
    const int columns = r.along.columns, reach = r.along.reach, width = r.picture.width;
    const int kChunk = columns > 128 ? columns : 128;  // columns of the picture; a power of two, as `columns`
    const int n = r.picture.channels, height = static_cast<int>(r.down.first.size()) - 1, half = height / 2;
    const std::ptrdiff_t row_length = kChunk * n + 64;
    // The rows as they are, with what lies past either end: [channel][column][16].
    float* rows = work;
    const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(width + 2 * reach) * 16;
    float* mixed = work + plane * n;
    for (int begin = 0; begin < width; begin += kChunk) {
      const int end = begin + kChunk < width ? begin + kChunk : width;
      for (int lane = 0; lane < 16; ++lane) {
        const int north = pack * 8 + lane % 8;
        float* row = mixed + lane * row_length;
        if (north >= half) {
          std::memset(row, 0, static_cast<std::size_t>(row_length) * sizeof(float));
        } else {
          mix_rows(r, lane < 8 ? north : height - 1 - north, begin, end, row);
        }
      }
      for (int x = begin; x < end; ++x) {
        for (int c = 0; c < n; ++c) {
          float* to = rows + c * plane + static_cast<std::ptrdiff_t>(x + reach) * 16;
          const float* from = mixed + (x - begin) * n + c;
          for (int lane = 0; lane < 16; ++lane) to[lane] = from[lane * row_length];
        }
      }
    }
    for (int c = 0; c < n; ++c) {
      float* at = rows + c * plane;
      const std::size_t bytes = static_cast<std::size_t>(reach) * 16 * sizeof(float);
      std::memcpy(at, at + static_cast<std::ptrdiff_t>(width) * 16, bytes);
      std::memcpy(at + static_cast<std::ptrdiff_t>(width + reach) * 16,
                  at + static_cast<std::ptrdiff_t>(reach) * 16, bytes);
      spread_columns(r, at, lanes + static_cast<std::ptrdiff_t>(c) * (width / columns) * 16);
    }
  }

  /// Along the rows: each weight is the sum of the texels around it times `along`.
  static void spread_columns(const SpreadRows& r, const float* rows, float* lanes) {
    const int width = r.picture.width / r.along.columns, taps = static_cast<int>(r.along.along.size());
    const float* along = r.along.along.data();
    for (int x = 0; x < width; ++x, rows += static_cast<std::ptrdiff_t>(r.along.columns) * 16, lanes += 16) {
      V low(0.0f), high(0.0f);
      for (int tap = 0; tap < taps; ++tap) {
        const V weight(along[tap]);
        low = V::fma(weight, V::load(rows + tap * 16), low);
        high = V::fma(weight, V::load(rows + tap * 16 + 8), high);
      }
      low.store(lanes);
      high.store(lanes + 8);
    }
  }

  /// With F the transform of north + i·south: north = (Fₘ + F̄₋ₘ)/2, south = (Fₘ − F̄₋ₘ)/2i.
  static void rows_to_orders(const FftPlan& plan, float* lanes, float* work, const float* factors, int degree,
                             int packs, int parts, float* orders) {
    const float* f = Fft<Arch>::forward(plan, lanes, work);
    const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(packs) * 2 * parts * 8;
    for (int m = 0; m <= degree; ++m, orders += step) {
      // Beyond the row's length orders repeat.
      const int position = m % plan.length;
      const float* a = f + static_cast<std::ptrdiff_t>(position) * 16;
      const float* b = f + static_cast<std::ptrdiff_t>(position == 0 ? 0 : plan.length - position) * 16;
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
        &Near<Arch>::rows_to_near,
        {&Near<Arch>::template near<1>, &Near<Arch>::template near<2>, &Near<Arch>::template near<3>},
        &Fft<Arch>::inverse,
        &sampled_sums,
        {&Legendre<Arch, 2>::analyse, &Legendre<Arch, 4>::analyse, &Legendre<Arch, 6>::analyse},
        {&Legendre<Arch, 2>::synthesise, &Legendre<Arch, 4>::synthesise, &Legendre<Arch, 6>::synthesise}};
    return kernels;
  }
};

}  // namespace welkin::prefilter
