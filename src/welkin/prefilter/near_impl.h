#pragma once

#include "welkin/prefilter/fft_impl.h"
#include "welkin/prefilter/near_field.h"

/// The near part of narrow lobes: see near_field.h and the layouts in kernels.h.
namespace welkin::prefilter {

template <class Arch>
struct NearRows {
  using V = Lanes<float, Arch>;

  static void store_reversed(const V& v, float* to) {
    alignas(64) float lanes[8];
    v.store(lanes);
    for (int i = 0; i < 8; ++i) to[i] = lanes[7 - i];
  }

  static void rows_to_near(const FftPlan& plan, float* lanes, float* work, const float* factors, int last,
                           int pack, int rows, std::ptrdiff_t step, std::ptrdiff_t part, float* orders) {
    const float* f = Fft<Arch>::forward(plan, lanes, work);
    for (int m = 0; m <= last; ++m, orders += step) {
      const int place = m % plan.length;
      const float* a = f + static_cast<std::ptrdiff_t>(place) * 16;
      const float* b = f + static_cast<std::ptrdiff_t>(place == 0 ? 0 : plan.length - place) * 16;
      const V half(0.5f * factors[m]);
      const V are = V::load(a), aim = V::load(a + 8), bre = V::load(b), bim = V::load(b + 8);
      (half * (are + bre)).store(orders + pack * 8);
      (half * (aim - bim)).store(orders + part + pack * 8);
      store_reversed(half * (aim + bim), orders + rows - 8 - pack * 8);
      store_reversed(half * (bre - are), orders + part + rows - 8 - pack * 8);
    }
  }

  template <int kParts>
  static void near(const NearField& field, int order, const float* from, std::ptrdiff_t part, float* to,
                   std::ptrdiff_t to_part) {
    const int width = 2 * field.reach + 1, packs = field.rows / 8;
    // Cubic Lagrange between every eighth order.
    const float t = static_cast<float>(order % 8) / 8.0f;
    const V blend[4] = {V(-t * (t - 1) * (t - 2) / 6), V((t + 1) * (t - 1) * (t - 2) / 2),
                        V(-(t + 1) * t * (t - 2) / 2), V((t + 1) * t * (t - 1) / 6)};
    const std::ptrdiff_t block = static_cast<std::ptrdiff_t>(width) * field.rows;
    const float* table = field.table.data() + (order / 8) * block;
    for (int pack = 0; pack < packs; ++pack) {
      V sum[kParts];
      for (V& each : sum) each = V(0.0f);
      if (order <= field.last_order.data()[pack]) {
        const float* in = from + pack * 8 - field.reach;
        const std::ptrdiff_t polar = field.polar.data()[pack];
        if (polar >= 0) {
          const float* k = field.polar_table.data() + polar + static_cast<std::ptrdiff_t>(order) * width * 8;
          for (int column = 0; column < width; ++column, k += 8, ++in) {
            const V weight = V::load(k);
            for (int p = 0; p < kParts; ++p) sum[p] = V::fma(weight, V::load(in + p * part), sum[p]);
          }
        } else {
          const float* k = table + pack * 8;
          for (int column = 0; column < width; ++column, k += field.rows, ++in) {
            V weight = blend[0] * V::load(k);
            for (int i = 1; i < 4; ++i) weight = V::fma(blend[i], V::load(k + i * block), weight);
            for (int p = 0; p < kParts; ++p) sum[p] = V::fma(weight, V::load(in + p * part), sum[p]);
          }
        }
      }
      for (int p = 0; p < kParts; ++p) sum[p].store(to + p * to_part + pack * 8);
    }
  }

  static float* near_to_rows(const FftPlan& plan, const float* orders, int last, int pack, int rows,
                             std::ptrdiff_t step, std::ptrdiff_t part, const float* turn, float* lanes,
                             float* work) {
    const int n = plan.length;
    std::memset(lanes + static_cast<std::ptrdiff_t>(last + 1) * 16, 0,
                static_cast<std::size_t>(n - 2 * last - 1) * 16 * sizeof(float));
    const float* upper = orders + pack * 8;
    const float* lower = orders + rows / 2 + pack * 8;
    for (int m = 0; m <= last; ++m, upper += step, lower += step) {
      const V cosine(turn[2 * m]), sine(turn[2 * m + 1]);
      const auto turned = [&](const float* at, V& re, V& im) {
        const V a = V::load(at), b = V::load(at + part);
        re = V::fms(a, cosine, b * sine);
        im = V::fma(a, sine, b * cosine);
      };
      V upper_re, upper_im, lower_re, lower_im;
      turned(upper, upper_re, upper_im);
      turned(lower, lower_re, lower_im);
      float* a = lanes + static_cast<std::ptrdiff_t>(m) * 16;
      if (m > 0) {
        float* b = lanes + static_cast<std::ptrdiff_t>(n - m) * 16;
        (upper_re + lower_im).store(b);
        (lower_re - upper_im).store(b + 8);
        (upper_re - lower_im).store(a);
        (upper_im + lower_re).store(a + 8);
      } else {
        upper_re.store(a);
        lower_re.store(a + 8);
      }
    }
    return Fft<Arch>::inverse(plan, lanes, work);
  }
};

}  // namespace welkin::prefilter
