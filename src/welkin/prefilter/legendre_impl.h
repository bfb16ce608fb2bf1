#pragma once

#include <algorithm>
#include <cstring>

#include "welkin/prefilter/lanes.h"
#include "welkin/prefilter/legendre.h"

/// Sums of Legendre functions over latitudes (analysis) and over degrees (synthesis), for one order m.
namespace welkin::prefilter {

/// `kParts` values for every latitude and degree: real and imaginary parts of the channels.
template <class Arch, int kParts>
struct Legendre {
  using V = Lanes<float, Arch>;
  using D = Lanes<double, Arch>;

  /// Q of a block of packs at the first degree whose Q is not negligible, for one parity.
  template <int kBlock>
  struct Start {
    int index;  ///< l − m of `now`; past the end when all are negligible
    V now[kBlock], before[kBlock];
  };

  /// Smaller values are negligible; from here on the recurrence runs in float32.
  static constexpr double kThreshold = 1e-12;

  template <int kBlock>
  static Start<kBlock> start(const Latitudes& latitudes, const Recurrence& r, int pack, int parity,
                             int last) {
    D now[kBlock], before[kBlock], square[kBlock];
    double largest = 0;
    for (int b = 0; b < kBlock; ++b) {
      const std::size_t lane = static_cast<std::size_t>(pack + b) * 8;
      const D x = D::load(&latitudes.cosine[lane]);
      square[b] = x * x;
      D first =
          D::exp(D::fma(D(static_cast<double>(r.m)), D::load(&latitudes.log_sine[lane]), D(r.log_first)));
      if (parity == 1) first = first * x * D(r.next_ratio);
      now[b] = first * D(1 / r.scale[static_cast<std::size_t>(parity)]);
      before[b] = D(0.0);
      largest = std::max(largest, D::abs(now[b]).largest());
    }
    int index = parity;
    while (largest < kThreshold && index <= last) {
      // Four steps to an evaluation of the size: it grows by less than 1e10 in these.
      for (int step = 0; step < 4 && index <= last; ++step, index += 2) {
        const D factor(r.factor[static_cast<std::size_t>(index)]),
            center(r.center[static_cast<std::size_t>(index)]);
        for (int b = 0; b < kBlock; ++b) {
          const D next = D::fms(factor * (square[b] - center), now[b], before[b]);
          before[b] = now[b];
          now[b] = next;
        }
      }
      for (int b = 0; b < kBlock; ++b) largest = std::max(largest, D::abs(now[b]).largest());
    }
    Start<kBlock> out;
    out.index = index;
    for (int b = 0; b < kBlock; ++b) {
      out.now[b] = narrow(now[b]);
      out.before[b] = narrow(before[b]);
    }
    return out;
  }

  /// To float; what would soon be denormal is flushed to zero.
  static V narrow(const D& from) {
    alignas(64) double wide[8];
    alignas(64) float values[8];
    from.store(wide);
    for (int i = 0; i < 8; ++i)
      values[i] = wide[i] > 1e-34 || wide[i] < -1e-34 ? static_cast<float>(wide[i]) : 0.0f;
    return V::load(values);
  }

  template <int kBlock>
  static void analyse_block(const Latitudes& latitudes, const Recurrence& r, int pack, int parity, int last,
                            const float* rows, float* sums) {
    Start<kBlock> s = start<kBlock>(latitudes, r, pack, parity, last);
    V square[kBlock];
    const float* data[kBlock];
    for (int b = 0; b < kBlock; ++b) {
      square[b] = V::load(&latitudes.cosine_squared[static_cast<std::size_t>(pack + b) * 8]);
      data[b] = rows + static_cast<std::ptrdiff_t>((pack + b) * 2 + parity) * kParts * 8;
    }
    for (int i = s.index; i <= last; i += 2) {
      float* sum = sums + static_cast<std::ptrdiff_t>(i) * kParts * 8;
      for (int part = 0; part < kParts; ++part) {
        V total = V::load(sum + part * 8);
        for (int b = 0; b < kBlock; ++b) total = V::fma(s.now[b], V::load(data[b] + part * 8), total);
        total.store(sum + part * 8);
      }
      const V factor(r.factor32[static_cast<std::size_t>(i)]),
          center(r.center32[static_cast<std::size_t>(i)]);
      for (int b = 0; b < kBlock; ++b) {
        const V next = V::fms(factor * (square[b] - center), s.now[b], s.before[b]);
        s.before[b] = s.now[b];
        s.now[b] = next;
      }
    }
  }

  /// out[(l − m)·kParts + part] = Σ over latitudes P̄ₗᵐ · rows. `rows`: packs × parity × kParts × 8 lanes,
  /// parity 0 the north plus the south, 1 the north less the south. `work` has (degree − m + 1)·kParts·8
  /// values.
  static void analyse(const Latitudes& latitudes, const Recurrence& r, int degree, const float* rows,
                      float* work, float* out) {
    const int last = degree - r.m;
    std::memset(work, 0, static_cast<std::size_t>(last + 1) * kParts * 8 * sizeof(float));
    int pack = 0;
    while (pack < latitudes.packs && latitudes.last_order[static_cast<std::size_t>(pack)] < r.m) ++pack;
    for (; pack + 4 <= latitudes.packs; pack += 4) {
      for (int parity = 0; parity < 2; ++parity)
        analyse_block<4>(latitudes, r, pack, parity, last, rows, work);
    }
    for (; pack < latitudes.packs; ++pack) {
      for (int parity = 0; parity < 2; ++parity)
        analyse_block<1>(latitudes, r, pack, parity, last, rows, work);
    }
    for (int i = 0; i <= last; ++i) {
      const float scale = static_cast<float>(r.scale[static_cast<std::size_t>(i)]);
      for (int part = 0; part < kParts; ++part) {
        out[i * kParts + part] =
            scale * V::load(work + static_cast<std::ptrdiff_t>(i * kParts + part) * 8).sum();
      }
    }
  }

  template <int kBlock>
  static void synthesise_block(const Latitudes& latitudes, const Recurrence& r, int pack, int parity,
                               int last, const float* coefficients, float* rows) {
    Start<kBlock> s = start<kBlock>(latitudes, r, pack, parity, last);
    V square[kBlock], sum[kBlock][kParts];
    for (int b = 0; b < kBlock; ++b) {
      square[b] = V::load(&latitudes.cosine_squared[static_cast<std::size_t>(pack + b) * 8]);
      for (int part = 0; part < kParts; ++part) sum[b][part] = V(0.0f);
    }
    for (int i = s.index; i <= last; i += 2) {
      const float* coefficient = coefficients + static_cast<std::ptrdiff_t>(i) * kParts;
      for (int part = 0; part < kParts; ++part) {
        const V value(coefficient[part]);
        for (int b = 0; b < kBlock; ++b) sum[b][part] = V::fma(s.now[b], value, sum[b][part]);
      }
      const V factor(r.factor32[static_cast<std::size_t>(i)]),
          center(r.center32[static_cast<std::size_t>(i)]);
      for (int b = 0; b < kBlock; ++b) {
        const V next = V::fms(factor * (square[b] - center), s.now[b], s.before[b]);
        s.before[b] = s.now[b];
        s.now[b] = next;
      }
    }
    for (int b = 0; b < kBlock; ++b) {
      float* row = rows + static_cast<std::ptrdiff_t>((pack + b) * 2 + parity) * kParts * 8;
      for (int part = 0; part < kParts; ++part) sum[b][part].store(row + part * 8);
    }
  }

  /// rows = Σ over degrees P̄ₗᵐ · coefficient, laid out as in `analyse`. `coefficients` are multiplied by sₗ
  /// already.
  static void synthesise(const Latitudes& latitudes, const Recurrence& r, int degree,
                         const float* coefficients, float* rows) {
    const int last = degree - r.m;
    int pack = 0;
    while (pack < latitudes.packs && latitudes.last_order[static_cast<std::size_t>(pack)] < r.m) ++pack;
    std::memset(rows, 0, static_cast<std::size_t>(pack) * 2 * kParts * 8 * sizeof(float));
    for (; pack + 2 <= latitudes.packs; pack += 2) {
      for (int parity = 0; parity < 2; ++parity) {
        synthesise_block<2>(latitudes, r, pack, parity, last, coefficients, rows);
      }
    }
    for (; pack < latitudes.packs; ++pack) {
      for (int parity = 0; parity < 2; ++parity) {
        synthesise_block<1>(latitudes, r, pack, parity, last, coefficients, rows);
      }
    }
  }
};

}  // namespace welkin::prefilter
