#pragma once

#include <xsimd/xsimd.hpp>

#include "welkin/filter/area.h"
#include "welkin/filter/fetch_impl.h"

/// Included by one source file per instruction set; see fetch_impl.h for `Wide`, `Four` and the reason for
/// them.
namespace welkin {

template <class Wide, class Four, int C>
struct AreaMeanOf {
  using Pack = xsimd::batch<float, Wide>;
  using Value = xsimd::batch<float, Four>;
  static constexpr int kSize = static_cast<int>(Pack::size);

  /// ∫ of the tent max(0, 1 − |t|) up to t.
  static Pack tent_integral(const Pack& t) {
    const Pack c = xsimd::min(xsimd::max(t, Pack(-1.0f)), Pack(1.0f));
    return Pack(0.5f) + c - Pack(0.5f) * c * xsimd::abs(c);
  }

  /// The columns x for which |value + slope·x| ≤ reach, intersected with [first, last].
  static void narrow_columns(float value, float slope, float reach, float& first, float& last) {
    if (slope < 0) {
      value = -value;
      slope = -slope;
    }
    if (slope > 1e-12f) {
      const float low = (-reach - value) / slope, high = (reach - value) / slope;
      first = low > first ? low : first;
      last = high < last ? high : last;
    } else if (value > reach || value < -reach) {
      last = first - 1;
    }
  }

  static void run(const LevelView& level, const Parallelogram* areas, float* out, std::size_t count) {
    const int n = C > 0 ? C : level.channels;
    alignas(64) float ramp[kSize];
    for (int i = 0; i < kSize; ++i) ramp[i] = static_cast<float>(i);
    const Pack steps = Pack::load_aligned(ramp);
    for (std::size_t k = 0; k < count; ++k)
      mean(level, areas[k], steps, out + k * static_cast<std::size_t>(n));
  }

  static void mean(const LevelView& level, const Parallelogram& area, const Pack& steps, float* out) {
    const int n = C > 0 ? C : level.channels;
    // Texels per unit of a and b, perpendicular to the sides.
    const float length_a = 1.0f / root(area.across[0] * area.across[0] + area.across[1] * area.across[1]);
    const float length_b = 1.0f / root(area.down[0] * area.down[0] + area.down[1] * area.down[1]);
    const float half_a = 0.5f * length_a, half_b = 0.5f * length_b;
    const float reach_a = 0.5f + 1.0f / length_a, reach_b = 0.5f + 1.0f / length_b;
    // The bounding box: the corners are ±½ along the inverse's columns, and a tent reaches one texel further.
    const float determinant = area.across[0] * area.down[1] - area.across[1] * area.down[0];
    const float inverse = 1.0f / positive(determinant);
    const float extent_x = 0.5f * inverse * (positive(area.down[1]) + positive(area.across[1])) + 1.0f;
    const float extent_y = 0.5f * inverse * (positive(area.down[0]) + positive(area.across[0])) + 1.0f;
    const int first_row = round_down(area.y - extent_y - 0.5f) + 1,
              last_row = round_down(area.y + extent_y - 0.5f);

    for (int c = 0; c < n; c += 4) Value(0.0f).store_unaligned(out + c);
    Value sum(0.0f);
    Pack total(0.0f);
    alignas(64) float weights[kSize];
    for (int row = first_row; row <= last_row; ++row) {
      const float dy = static_cast<float>(row) + 0.5f - area.y;
      // Columns are relative to the centre here: a = a0 + across[0]·x.
      const float a0 = area.across[1] * dy, b0 = area.down[1] * dy;
      float first = -extent_x, last = extent_x;
      narrow_columns(a0, area.across[0], reach_a, first, last);
      narrow_columns(b0, area.down[0], reach_b, first, last);
      const int from = round_down(area.x + first - 0.5f) + 1, to = round_down(area.x + last - 0.5f);
      const float* texel = level.texels + area.chart * level.chart_stride + row * level.row_stride + from * n;
      for (int column = from; column <= to; column += kSize, texel += kSize * n) {
        const Pack x = steps + Pack(static_cast<float>(column) + 0.5f - area.x);
        const Pack a = xsimd::fma(Pack(area.across[0]), x, Pack(a0));
        const Pack b = xsimd::fma(Pack(area.down[0]), x, Pack(b0));
        const Pack ta = a * Pack(length_a), tb = b * Pack(length_b);
        Pack w = (tent_integral(ta + Pack(half_a)) - tent_integral(ta - Pack(half_a))) *
                 (tent_integral(tb + Pack(half_b)) - tent_integral(tb - Pack(half_b)));
        w *= xsimd::fma(Pack(area.gradient[0]), a, xsimd::fma(Pack(area.gradient[1]), b, Pack(1.0f)));
        const int columns = to - column + 1 < kSize ? to - column + 1 : kSize;
        w = xsimd::select(steps < Pack(static_cast<float>(columns)), w, Pack(0.0f));
        total += w;
        w.store_aligned(weights);
        for (int i = 0; i < columns; ++i) {
          if (C > 0 && C <= 4) {
            sum = xsimd::fma(Value(weights[i]), Value::load_unaligned(texel + i * n), sum);
          } else {
            for (int c = 0; c < n; ++c) out[c] += weights[i] * texel[i * n + c];
          }
        }
      }
    }
    const float weight = xsimd::hadd(total);
    const float scale = weight > 0 ? 1.0f / weight : 0.0f;
    if (C > 0 && C <= 4) {
      (sum * Value(scale)).store_unaligned(out);
    } else {
      for (int c = 0; c < n; ++c) out[c] *= scale;
    }
  }

  // Scalar helpers are members, so that they too carry the instruction set in their names.
  static float positive(float x) { return x < 0 ? -x : x; }
  static float root(float x) { return xsimd::sqrt(Value(x)).get(0); }
  static int round_down(float x) {
    const int whole = static_cast<int>(x);
    return whole - (static_cast<float>(whole) > x ? 1 : 0);
  }
};

template <class Wide, class Four>
AreaMean area_mean_of(int channels) {
  switch (channels) {
    case 1:
      return &AreaMeanOf<Wide, Four, 1>::run;
    case 3:
      return &AreaMeanOf<Wide, Four, 3>::run;
    case 4:
      return &AreaMeanOf<Wide, Four, 4>::run;
    default:
      return &AreaMeanOf<Wide, Four, 0>::run;
  }
}

}  // namespace welkin
