#pragma once

#include "welkin/prefilter/fft_impl.h"
#include "welkin/prefilter/near_field.h"

/// The near part of narrow lobes: see near_field.h and the layouts in kernels.h.
namespace welkin::prefilter {

template <class Arch>
struct Near {
  using V = Lanes<float, Arch>;

  static void rows_to_near(const FftPlan& plan, float* lanes, float* work, const float* factors, int last,
                           const NearOrders& to) {
    const float* f = Fft<Arch>::forward(plan, lanes, work);
    float* orders = to.values;
    for (int m = 0; m <= last; ++m, orders += to.order) {
      const int position = m % plan.length;
      const float* a = f + static_cast<std::ptrdiff_t>(position) * 16;
      const float* b = f + static_cast<std::ptrdiff_t>(position == 0 ? 0 : plan.length - position) * 16;
      const V half(0.5f * factors[m]);
      const V are = V::load(a), aim = V::load(a + 8), bre = V::load(b), bim = V::load(b + 8);
      (half * (are + bre)).store(orders);
      (half * (aim - bim)).store(orders + to.part);
      (half * (aim + bim)).store(orders + to.half);
      (half * (bre - are)).store(orders + to.part + to.half);
    }
  }

  template <int kChannels>
  static void near(const NearField& field, int pack_index, int order, const NearOrders& from,
                   const NearColumns& to) {
    constexpr int kParts = 2 * kChannels;
    const NearField::Pack& pack = field.packs.data()[pack_index];
    const int width = 2 * field.reach + 1;
    // Cubic Lagrange between the table's orders.
    const float t = static_cast<float>(order % pack.stride) / static_cast<float>(pack.stride);
    const V blend[4] = {V(-t * (t - 1) * (t - 2) / 6), V((t + 1) * (t - 1) * (t - 2) / 2),
                        V(-(t + 1) * t * (t - 2) / 2), V((t + 1) * t * (t - 1) / 6)};
    const std::ptrdiff_t block = static_cast<std::ptrdiff_t>(width) * 8;
    const float* k = field.table.data() + pack.begin + (order / pack.stride) * block;
    V north[kParts], south[kParts];
    for (V& each : north) each = V(0.0f);
    for (V& each : south) each = V(0.0f);
    const float* in = from.values + order * from.order - field.reach;
    for (int column = 0; column < width; ++column, k += 8, ++in) {
      V weight = blend[0] * V::load(k);
      for (int i = 1; i < 4; ++i) weight = V::fma(blend[i], V::load(k + i * block), weight);
      for (int p = 0; p < kParts; ++p) {
        north[p] = V::fma(weight, V::load(in + p * from.part), north[p]);
        south[p] = V::fma(weight, V::load(in + p * from.part + from.half), south[p]);
      }
    }
    // north + i·south at m; conj(north) + i·conj(south) at −m; both shifted by their phases.
    const V cosine(to.phases[2 * order]), sine(to.phases[2 * order + 1]);
    float* a = to.lanes + static_cast<std::ptrdiff_t>(order) * 16;
    float* b = to.lanes + static_cast<std::ptrdiff_t>(order == 0 ? 0 : to.length - order) * 16;
    for (int c = 0; c < kChannels; ++c, a += to.channel, b += to.channel) {
      const V *n = north + 2 * c, *s = south + 2 * c;
      const V north_re = V::fms(n[0], cosine, n[1] * sine), north_im = V::fma(n[0], sine, n[1] * cosine);
      const V south_re = V::fms(s[0], cosine, s[1] * sine), south_im = V::fma(s[0], sine, s[1] * cosine);
      if (order > 0) {
        (north_re + south_im).store(b);
        (south_re - north_im).store(b + 8);
        (north_re - south_im).store(a);
        (north_im + south_re).store(a + 8);
      } else {
        north_re.store(a);
        south_re.store(a + 8);
      }
    }
  }
};

}  // namespace welkin::prefilter
