#pragma once

#include <algorithm>

#include "welkin/filter/fetch_impl.h"
#include "welkin/filter/reconstruction.h"

/// Included by one source file per instruction set, as fetch_impl.h.
namespace welkin {

template <class Wide, class Four>
class ReconstructionOf {
 public:
  using Pack = xsimd::batch<float, Wide>;
  static constexpr std::ptrdiff_t kSize = static_cast<std::ptrdiff_t>(Pack::size);

  static void reconstruct(const LevelView& level, const Reconstruction& how, ReconstructedTexels& out) {
    const std::ptrdiff_t channels = out.channels, row = out.width * channels;
    const float* first = level.texels + out.chart * level.chart_stride + out.y * level.row_stride +
                         static_cast<std::ptrdiff_t>(out.x) * channels;
    // Slopes along x of the rows that a_xy reads.
    constexpr int kReach = kReconstructionReach;
    const std::ptrdiff_t slope_row = row + 16;
    float* const slopes = out.scratch.data();
    float* const light = slopes + (out.height + 2 * kReach) * slope_row;
    float* const bright = light + slope_row;
    for (std::ptrdiff_t i = 0, c = 0; i < slope_row; ++i) {
      bright[i] = how.bright[c];
      c = c + 1 == channels ? 0 : c + 1;
    }
    for (int y = -kReach; y < out.height + kReach; ++y) {
      const float* texels = first + y * level.row_stride;
      float* slope = slopes + (y + kReach) * slope_row;
      for (std::ptrdiff_t i = 0; i < row; i += kSize) odd(texels + i, channels).store_unaligned(slope + i);
    }
    for (int y = 0; y < out.height; ++y) {
      const float* texels = first + y * level.row_stride;
      const float* slope = slopes + (y + kReach) * slope_row;
      for (std::ptrdiff_t i = 0; i < row; i += kSize) {
        const Pack m = Pack::load_unaligned(texels + i);
        Coefficients a{m,
                       Pack::load_unaligned(slope + i),
                       odd(texels + i, level.row_stride),
                       even(texels + i, channels),
                       odd(slope + i, slope_row),
                       even(texels + i, level.row_stride)};
        Pack low = m, high = m, sum(0.0f);
        for (int k = -1; k <= 1; ++k) {
          for (int j = -1; j <= 1; ++j) {
            const Pack near = Pack::load_unaligned(texels + i + k * level.row_stride + j * channels);
            low = xsimd::min(low, near);
            high = xsimd::max(high, near);
            sum += near;
          }
        }
        // A light has an edge eight times as high as what is beside it, or is one or two texels alone.
        const Pack alone = high - Pack(3.5f / 9) * sum;
        const Pack far_above = Pack::load_unaligned(bright + i);
        const Pack edge = high - xsimd::max(Pack(8.0f) * low, far_above);
        const Pack faint = Pack(0.125f) * far_above - high;
        const auto is_light = (edge > Pack(0.0f)) | ((alone > Pack(0.0f)) & (faint < Pack(0.0f)));
        const Pack uneven =
            xsimd::select(high - low > Pack(kUneven / 8) * far_above, Pack(float{kIsUneven}), Pack(0.0f));
        xsimd::select(is_light, Pack(float{kIsLight}), uneven).store_unaligned(light + i);
        if (how.limited) {
          const Pack lowest = lowest_point(a), highest = highest_point(a), zero(0.0f);
          const Pack beyond = Pack(kBeyond) * (high - low);
          // Deep beside a light, it keeps to half the smallest.
          const Pack shallow = xsimd::min(low, zero) - Pack(kUndershoot) * xsimd::abs(m);
          const Pack strict = xsimd::min(low, xsimd::max(Pack(0.5f) * low, zero));
          const Pack positive = xsimd::select(lowest + Pack(kDeep) * xsimd::abs(m) < zero, strict, shallow);
          limit(a, lowest, xsimd::max(positive, low - beyond), highest, high + beyond);
        }
        store(a, out, y, i);
      }
      std::uint8_t* beside = out.hard.data() + static_cast<std::ptrdiff_t>(y) * out.width;
      for (int x = 0; x < out.width; ++x) {
        float any = 0;
        for (std::ptrdiff_t c = 0; c < channels; ++c) any = std::max(any, light[x * channels + c]);
        beside[x] = static_cast<std::uint8_t>(any);
      }
    }
  }

  template <int C>
  static void means(const ReconstructedTexels& texels, const QuadraturePoints& across,
                    const QuadraturePoints& downwards, const Quadrilateral* areas, std::size_t count,
                    float* out) {
    using Values = xsimd::batch<float, Four>;
    using Ints = xsimd::batch<std::int32_t, Four>;
    const int channels = C > 0 ? C : texels.channels;
    const std::ptrdiff_t plane = texels.plane();
    // All points of a texel, four at a time; the last four are filled up with points of no weight.
    const int points = across.count * downwards.count, packs = (points + 3) / 4;
    alignas(64) float s[kMaxQuadrature], t[kMaxQuadrature], rule[kMaxQuadrature];
    for (int i = 0; i < 4 * packs; ++i) {
      const int column = i < points ? i % across.count : 0, row = i < points ? i / across.count : 0;
      s[i] = across.offset[column];
      t[i] = downwards.offset[row];
      rule[i] = i < points ? across.weight[column] * downwards.weight[row] : 0.0f;
    }
    const Values first_x(static_cast<float>(texels.x)), first_y(static_cast<float>(texels.y));
    const Values last_x(static_cast<float>(texels.width - 1)), last_y(static_cast<float>(texels.height - 1));
    const Values zero(0.0f), half(0.5f);
    const Ints row_step(texels.width * channels), texel_step(channels);
    for (std::size_t i = 0; i < count; ++i, out += channels) {
      const Quadrilateral& q = areas[i];
      alignas(16) float x[kMaxQuadrature], y[kMaxQuadrature], weight[kMaxQuadrature];
      alignas(16) std::int32_t at[kMaxQuadrature];
      Values total(0.0f);
      for (int k = 0; k < 4 * packs; k += 4) {
        const Values right = Values::load_aligned(s + k), down = Values::load_aligned(t + k);
        const auto between = [&](const float* corner) {
          const Values top = xsimd::fma(right, Values(corner[1] - corner[0]), Values(corner[0]));
          const Values bottom = xsimd::fma(right, Values(corner[3] - corner[2]), Values(corner[2]));
          return xsimd::fma(down, bottom - top, top);
        };
        const Values px = between(q.x) - first_x, py = between(q.y) - first_y;
        // NaN becomes 0.
        const Values column = xsimd::min(xsimd::floor(xsimd::select(px > zero, px, zero)), last_x),
                     row = xsimd::min(xsimd::floor(xsimd::select(py > zero, py, zero)), last_y);
        (px - column - half).store_aligned(x + k);
        (py - row - half).store_aligned(y + k);
        (xsimd::to_int(row) * row_step + xsimd::to_int(column) * texel_step).store_aligned(at + k);
        const Values w = Values::load_aligned(rule + k) * between(q.weight);
        w.store_aligned(weight + k);
        total += w;
      }
      const float scale = 1.0f / xsimd::hadd(total);
      for (int first = 0; first < channels; first += 4) {
        // Means are weighted by solid angle. What differs from them within a texel adds up to nothing over
        // it, and is not weighted in turn. What differs from the first mean is summed up, so that even areas
        // stay even to the last bit.
        const Values twelfth(1.0f / 12);
        const auto mean_at = [&](const float* a) {
          const auto of = [&](int n) { return Values::load_unaligned(a + n * plane); };
          return xsimd::fma(twelfth, of(3) + of(5), of(0));
        };
        const Values base = mean_at(texels.coefficients.data() + at[0] + first);
        Values means_sum(0.0f), rest(0.0f);
        for (int k = 0; k < points; ++k) {
          const float* a = texels.coefficients.data() + at[k] + first;
          const auto of = [&](int n) { return Values::load_unaligned(a + n * plane); };
          const Values px(x[k]), py(y[k]), xx = of(3), yy = of(5);
          const Values curved = twelfth * (xx + yy);
          const Values within = xsimd::fma(px, xsimd::fma(px, xx, xsimd::fma(py, of(4), of(1))),
                                           xsimd::fma(py, xsimd::fma(py, yy, of(2)), Values(0.0f) - curved));
          means_sum = xsimd::fma(Values(weight[k]), of(0) + curved - base, means_sum);
          rest = xsimd::fma(Values(rule[k]), within, rest);
        }
        alignas(16) float values[4];
        (xsimd::fma(means_sum, Values(scale), base) + rest).store_aligned(values);
        for (int c = 0; c < 4 && first + c < channels; ++c) out[first + c] = values[c];
      }
    }
  }

 protected:
  struct Coefficients {
    Pack m, x, y, xx, xy, yy;
  };

  /// The values from `i` on of a row.
  static void store(const Coefficients& a, ReconstructedTexels& out, int y, std::ptrdiff_t i) {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(out.width) * out.channels, here = row - i;
    const Pack values[kCoefficients] = {a.m - Pack(1.0f / 12) * (a.xx + a.yy), a.x, a.y, a.xx, a.xy, a.yy};
    float* to = out.coefficients.data() + y * row + i;
    for (int k = 0; k < kCoefficients; ++k, to += out.plane()) {
      if (here >= kSize) {
        values[k].store_unaligned(to);
      } else {
        alignas(64) float part[Pack::size];
        values[k].store_aligned(part);
        std::copy_n(part, here, to);
      }
    }
  }

  static Pack odd(const float* at, std::ptrdiff_t step) {
    Pack sum(0.0f);
    for (int j = 1; j <= 4; ++j) {
      sum = xsimd::fma(Pack(kOddTaps[j - 1]),
                       Pack::load_unaligned(at + j * step) - Pack::load_unaligned(at - j * step), sum);
    }
    return sum;
  }
  static Pack even(const float* at, std::ptrdiff_t step) {
    const Pack twice = Pack(2.0f) * Pack::load_unaligned(at);
    Pack sum(0.0f);
    for (int j = 1; j <= 4; ++j) {
      sum = xsimd::fma(Pack(kEvenTaps[j - 1]),
                       (Pack::load_unaligned(at + j * step) + Pack::load_unaligned(at - j * step)) - twice,
                       sum);
    }
    return sum;
  }

  /// The lowest of nine points: corners, middles of sides, centre.
  static Pack lowest_point(const Coefficients& a) {
    const Pack half(0.5f), quarter(0.25f);
    const Pack m = a.m - Pack(1.0f / 12) * (a.xx + a.yy);
    const Pack x = half * a.x, y = half * a.y, twist = quarter * a.xy;
    const Pack sides = xsimd::min(m + quarter * a.xx - xsimd::abs(x), m + quarter * a.yy - xsimd::abs(y));
    return xsimd::min(xsimd::min(sides, m), m + quarter * (a.xx + a.yy) + lowest_corner(x, y, twist));
  }
  static Pack highest_point(const Coefficients& a) {
    const Pack zero(0.0f);
    return zero - lowest_point({zero - a.m, zero - a.x, zero - a.y, zero - a.xx, zero - a.xy, zero - a.yy});
  }
  static Pack lowest_corner(const Pack& x, const Pack& y, const Pack& twist) {
    return xsimd::min(twist - xsimd::abs(x + y), Pack(0.0f) - twist - xsimd::abs(x - y));
  }

  static void limit(Coefficients& a, const Pack& lowest, const Pack& floor, const Pack& highest,
                    const Pack& ceiling) {
    // NaN stays NaN.
    const Pack down = xsimd::select(lowest < floor, (a.m - floor) / (a.m - lowest), Pack(1.0f));
    const Pack up = xsimd::select(highest > ceiling, (ceiling - a.m) / (highest - a.m), Pack(1.0f));
    const Pack share = xsimd::min(down, up);
    a.x *= share;
    a.y *= share;
    a.xx *= share;
    a.xy *= share;
    a.yy *= share;
  }
};

}  // namespace welkin
