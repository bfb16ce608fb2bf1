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

  /// Adds what columns [begin, end) of a row of the picture hold.
  static void add_values(const SpreadRows& r, int row, int begin, int end) {
    const int n = r.picture.channels, count = (end - begin) * n;
    const float* from = r.picture.data + row * r.picture.row_stride + static_cast<std::ptrdiff_t>(begin) * n;
    RowValues& values = r.values[row];
    V squares[RowValues::kMostChannels], largest(values.largest), smallest(-values.smallest);
    for (V& each : squares) each = V(0.0f);
    int i = 0;
    for (; i + 8 * n <= count; i += 8 * n) {
      for (int k = 0; k < n; ++k) {
        const V value = V::load(from + i + 8 * k);
        squares[k] = V::fma(value, value, squares[k]);
        largest = V::max(largest, value);
        smallest = V::max(smallest, V(0.0f) - value);
      }
    }
    values.largest = largest.largest();
    values.smallest = -smallest.largest();
    alignas(64) float lanes[8];
    for (int k = 0; k < n; ++k) {
      squares[k].store(lanes);
      for (int lane = 0; lane < 8; ++lane)
        values.squares[(8 * k + lane) % n] += static_cast<double>(lanes[lane]);
    }
    for (; i < count; ++i) {
      values.squares[i % n] += static_cast<double>(from[i]) * static_cast<double>(from[i]);
      values.largest = std::max(values.largest, from[i]);
      values.smallest = std::min(values.smallest, from[i]);
    }
  }

  /// Of the rows of the picture that lie in the pack's rows of points.
  static void add_pack_values(const SpreadRows& r, int pack, int begin, int end) {
    const int rows = static_cast<int>(r.down.first.size()) - 1, each = r.picture.height / rows;
    const int first = pack * 8 * each, last = std::min(first + 8 * each, rows / 2 * each);
    for (int row = first; row < last; ++row) {
      add_values(r, row, begin, end);
      add_values(r, r.picture.height - 1 - row, begin, end);
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
      if (r.values != nullptr) add_pack_values(r, pack, begin, end);
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

  /// Points whose places in a group's table are found together.
  static constexpr int kPlaces = 64;

  /// Where eight or more points lie in a group's table, from one direction.
  static void places(const SampledGroup& group, const lobe::Points& points, int first, const float* direction,
                     int* indices, float* parts) {
    using Pack = xsimd::batch<float, Arch>;
    const Pack core(group.core), most(static_cast<float>(SampledGroup::kSteps));
    const Pack scale(static_cast<float>(SampledGroup::kSteps) * (2.0f + group.core) / 2.0f);
    const Pack px(direction[0]), py(direction[1]), pz(direction[2]);
    alignas(64) float x[kPlaces], y[kPlaces], z[kPlaces];
    const int count = std::min(kPlaces, points.count - first);
    for (int k = 0; k < kPlaces; ++k) {
      const int at = first + (k < count ? k : 0);
      x[k] = points.x[at], y[k] = points.y[at], z[k] = points.z[at];
    }
    for (int k = 0; k < kPlaces; k += static_cast<int>(Pack::size)) {
      const Pack dx = px - Pack::load_aligned(x + k), dy = py - Pack::load_aligned(y + k),
                 dz = pz - Pack::load_aligned(z + k);
      const Pack chord = xsimd::sqrt(dx * dx + dy * dy + dz * dz);
      const Pack position = xsimd::min(scale * chord / (chord + core), most);
      const auto index = xsimd::to_int(position);
      index.store_aligned(indices + k);
      (position - xsimd::to_float(index)).store_aligned(parts + k);
    }
  }

  /// Sums of a pack of members and up to three channels, which stay in registers.
  template <int kChannels>
  static void sum_members(const SampledGroup& group, std::size_t member, const lobe::Points& points,
                          int first, int count, int channel, const int* indices, const float* parts,
                          float* to) {
    V sum[kChannels];
    const std::size_t row = group.members;
    for (int c = 0; c < kChannels; ++c) sum[c] = V::load(to + static_cast<std::size_t>(c) * row);
    const float* light = points.weight + static_cast<std::ptrdiff_t>(first) * points.channels + channel;
    for (int k = 0; k < count; ++k, light += points.channels) {
      const float* below = group.values.data() + static_cast<std::size_t>(indices[k]) * row + member;
      const V at = V::load(below);
      const V weight = V::fma(V(parts[k]), V::load(below + row) - at, at);
      for (int c = 0; c < kChannels; ++c) sum[c] = V::fma(weight, V(light[c]), sum[c]);
    }
    for (int c = 0; c < kChannels; ++c) sum[c].store(to + static_cast<std::size_t>(c) * row);
  }

  static void group_sums(const SampledGroup& group, const lobe::Points& points, const float* x,
                         const float* y, const float* z, float* values, std::size_t count) {
    const std::size_t each = static_cast<std::size_t>(points.channels) * group.members;
    std::memset(values, 0, count * each * sizeof(float));
    alignas(64) int indices[kPlaces];
    alignas(64) float parts[kPlaces];
    for (std::size_t i = 0; i < count; ++i, values += each) {
      const float direction[3] = {x[i], y[i], z[i]};
      for (int first = 0; first < points.count; first += kPlaces) {
        const int some = std::min(kPlaces, points.count - first);
        places(group, points, first, direction, indices, parts);
        for (int channel = 0; channel < points.channels; channel += 3) {
          float* to = values + static_cast<std::size_t>(channel) * group.members;
          const auto sum = points.channels - channel == 1   ? &sum_members<1>
                           : points.channels - channel == 2 ? &sum_members<2>
                                                            : &sum_members<3>;
          for (std::size_t member = 0; member < group.members; member += SampledGroup::kPack)
            sum(group, member, points, first, some, channel, indices, parts, to + member);
        }
      }
    }
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
        &group_sums,
        {&Legendre<Arch, 2>::analyse, &Legendre<Arch, 4>::analyse, &Legendre<Arch, 6>::analyse},
        {&Legendre<Arch, 2>::synthesise, &Legendre<Arch, 4>::synthesise, &Legendre<Arch, 6>::synthesise}};
    return kernels;
  }
};

}  // namespace welkin::prefilter
