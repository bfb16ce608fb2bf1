#pragma once

#include <cstdint>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "welkin/filter/fetch.h"
#include "welkin/sphere/kernels.h"

/// Included by one source file per instruction set; everything carries its architecture in its template
/// arguments, for the reason given in sphere/kernels_impl.h. `Wide` computes positions and weights, a pack of
/// samples at a time; `Four` holds four neighbouring values of one texel row, so one load brings all channels
/// of a texel.
namespace welkin {

/// Four lanes for the baseline: the default instruction set where it has four, as SSE2 and NEON do, else
/// SSE2.
#ifdef __SSE2__
using BaselineFour = std::conditional_t<xsimd::batch<float>::size == 4, xsimd::default_arch, xsimd::sse2>;
#else
using BaselineFour = xsimd::default_arch;
#endif

template <class Wide>
inline constexpr std::size_t kPackSize = xsimd::batch<float, Wide>::size;

/// Texel (x, y) and the fractions to its right and downward neighbour, for a pack of positions.
template <class Wide>
struct Positions {
  static constexpr std::size_t kSize = kPackSize<Wide>;
  using Pack = xsimd::batch<float, Wide>;
  using Ints = xsimd::batch<std::int32_t, Wide>;

  alignas(64) std::int32_t chart[kSize];
  alignas(64) std::int32_t x[kSize];
  alignas(64) std::int32_t y[kSize];
  Pack fx, fy;

  Positions(const LevelView& level, const float* charts, const float* us, const float* vs, float offset) {
    // NaN becomes the smallest position, so every one stays inside the border; without an offset, in the
    // chart.
    const auto locate = [offset](const float* from, int size, Pack& fraction, std::int32_t* to) {
      const Pack extent(static_cast<float>(size));
      Pack x = xsimd::fma(Pack::load_unaligned(from), extent, Pack(-offset));
      x = xsimd::select(x >= Pack(-2 * offset), x, Pack(-2 * offset));
      x = xsimd::min(x, extent - Pack(1.0f / 256));
      const Pack whole = xsimd::floor(x);
      fraction = x - whole;
      xsimd::to_int(whole).store_unaligned(to);
    };
    locate(us, level.width, fx, x);
    locate(vs, level.height, fy, y);
    const Pack c = Pack::load_unaligned(charts);
    const Pack last(static_cast<float>(level.charts - 1));
    xsimd::to_int(xsimd::min(xsimd::select(c >= Pack(0.0f), c, Pack(0.0f)), last)).store_unaligned(chart);
  }

  template <int C>
  const float* texel(const LevelView& level, std::size_t i) const {
    const int channels = C > 0 ? C : level.channels;
    return level.texels + chart[i] * level.chart_stride + y[i] * level.row_stride + x[i] * channels;
  }
};

/// The fetch kernels for C channels, or for any number (C = 0), four at a time.
template <class Wide, class Four, int C>
struct FetchOf {
  using Pack = xsimd::batch<float, Wide>;
  using Value = xsimd::batch<float, Four>;
  static_assert(Value::size == 4);
  static constexpr std::size_t kSize = kPackSize<Wide>;

  static int channels(const LevelView& level) { return C > 0 ? C : level.channels; }

  /// Samples of the pack that begins at `start`.
  static std::size_t in_pack(std::size_t start, std::size_t count) {
    return count - start < kSize ? count - start : kSize;
  }

  static void nearest(const LevelView& level, const float* chart, const float* u, const float* v, float* out,
                      std::size_t count) {
    const int n = channels(level);
    for (std::size_t start = 0; start < count; start += kSize) {
      const Positions<Wide> positions(level, chart + start, u + start, v + start, 0.0f);
      for (std::size_t i = 0, here = in_pack(start, count); i < here; ++i) {
        const float* texel = positions.template texel<C>(level, i);
        float* to = out + (start + i) * static_cast<std::size_t>(n);
        for (int c = 0; c < n; c += 4) Value::load_unaligned(texel + c).store_unaligned(to + c);
      }
    }
  }

  /// Between a texel and its neighbours to the right and below.
  static void tent(const LevelView& level, const float* texel, float fx, float fy, float* to) {
    const int n = channels(level);
    const Value right(fx), down(fy);
    for (int c = 0; c < n; c += 4) {
      const float* a = texel + c;
      const float* b = a + level.row_stride;
      const Value a0 = Value::load_unaligned(a), a1 = Value::load_unaligned(a + n);
      const Value b0 = Value::load_unaligned(b), b1 = Value::load_unaligned(b + n);
      const Value left_side = xsimd::fma(down, b0 - a0, a0);
      const Value right_side = xsimd::fma(down, b1 - a1, a1);
      xsimd::fma(right, right_side - left_side, left_side).store_unaligned(to + c);
    }
  }

  static void bilinear(const LevelView& level, const float* chart, const float* u, const float* v, float* out,
                       std::size_t count) {
    const auto n = static_cast<std::size_t>(channels(level));
    // Texels of a run of samples are asked for before the first is read: in large maps they come from far.
    constexpr std::size_t kRun = 32;
    static_assert(kRun % kSize == 0);
    alignas(64) float fx[kRun], fy[kRun];
    const float* texels[kRun];
    if (count <= kSize) {
      const Positions<Wide> positions(level, chart, u, v, 0.5f);
      positions.fx.store_aligned(fx);
      positions.fy.store_aligned(fy);
      for (std::size_t i = 0; i < count; ++i)
        tent(level, positions.template texel<C>(level, i), fx[i], fy[i], out + i * n);
      return;
    }
    for (std::size_t first = 0; first < count; first += kRun) {
      const std::size_t run = count - first < kRun ? count - first : kRun;
      for (std::size_t start = 0; start < run; start += kSize) {
        const std::size_t at = first + start;
        const Positions<Wide> positions(level, chart + at, u + at, v + at, 0.5f);
        positions.fx.store_aligned(fx + start);
        positions.fy.store_aligned(fy + start);
        for (std::size_t i = 0, here = in_pack(start, run); i < here; ++i) {
          const float* texel = positions.template texel<C>(level, i);
          texels[start + i] = texel;
          __builtin_prefetch(texel);
          __builtin_prefetch(texel + level.row_stride);
        }
      }
      for (std::size_t i = 0; i < run; ++i) tent(level, texels[i], fx[i], fy[i], out + (first + i) * n);
    }
  }

  /// Weights of Keys' cubic convolution for the texels at −1, 0, 1, 2 of a fraction f.
  /// R. Keys, "Cubic convolution interpolation for digital image processing", 1981, eq. 4 with a = −½.
  struct Cubic {
    static constexpr int kTaps = 4;
    static constexpr int kBefore = 1;
    static void weights(const Pack& f, Pack* w) {
      const Pack half(0.5f), one(1.0f);
      const Pack g = one - f;
      w[0] = -half * f * g * g;
      w[1] = one + f * f * (Pack(1.5f) * f - Pack(2.5f));
      w[2] = one + g * g * (Pack(1.5f) * g - Pack(2.5f));
      w[3] = -half * g * f * f;
    }
  };

  /// Values of the cubic B-spline at the texels −1, 0, 1, 2: a grid of spline coefficients is read with it.
  struct BSpline {
    static constexpr int kTaps = 4;
    static constexpr int kBefore = 1;
    static void weights(const Pack& f, Pack* w) {
      const Pack sixth(1.0f / 6), half(0.5f), two_thirds(2.0f / 3);
      const Pack g = Pack(1.0f) - f;
      w[0] = sixth * g * g * g;
      w[1] = two_thirds + f * f * (half * f - Pack(1.0f));
      w[2] = two_thirds + g * g * (half * g - Pack(1.0f));
      w[3] = sixth * f * f * f;
    }
  };

  /// sinc(t)·sinc(t/A) for the 2A texels around a position, divided by their sum (C. Duchon, "Lanczos
  /// filtering in one and two dimensions", 1979). sin(π(f−k)) = ±sin πf, and sin(π(f−k)/A) follows by the
  /// addition theorem.
  template <int A>
  struct Lanczos {
    static_assert(A == 3 || A == 4);
    static constexpr int kTaps = 2 * A;
    static constexpr int kBefore = A - 1;
    static void weights(const Pack& f, Pack* w) {
      constexpr float kPiF = 3.14159265358979f;
      constexpr float kH = 0.866025403784439f, kR = 0.707106781186548f;
      // sin and cos of πk/A for k = 1−A … A.
      constexpr float kSine[2][8] = {{-kH, -kH, 0, kH, kH, 0}, {-kR, -1, -kR, 0, kR, 1, kR, 0}};
      constexpr float kCosine[2][8] = {{-0.5f, 0.5f, 1, 0.5f, -0.5f, -1}, {-kR, 0, kR, 1, kR, 0, -kR, -1}};
      const Pack s1 = xsimd::sin(Pack(kPiF) * f);
      const Pack sa = xsimd::sin(Pack(kPiF / A) * f), ca = xsimd::cos(Pack(kPiF / A) * f);
      Pack sum(0.0f);
      for (int tap = 0; tap < kTaps; ++tap) {
        const int k = tap - kBefore;
        const Pack t = f - Pack(static_cast<float>(k));
        const Pack sine = k % 2 == 0 ? s1 : -s1;
        const Pack window = sa * Pack(kCosine[A - 3][tap]) - ca * Pack(kSine[A - 3][tap]);
        const Pack value = Pack(A / (kPiF * kPiF)) * sine * window / (t * t);
        w[tap] = xsimd::select(xsimd::abs(t) < Pack(1e-3f), Pack(1.0f), value);
        sum += w[tap];
      }
      const Pack scale = Pack(1.0f) / sum;
      for (int tap = 0; tap < kTaps; ++tap) w[tap] *= scale;
    }
  };

  /// Limits an interpolated value to near the range [minimum, maximum] of the texels around it: half a range
  /// beyond on either side, and never below half the minimum, so positive radiance stays positive.
  static Value limit_overshoot(const Value& value, const Value& minimum, const Value& maximum) {
    const Value half(0.5f);
    const Value margin = half * (maximum - minimum);
    const Value floor = xsimd::max(minimum - margin, xsimd::min(minimum, half * minimum));
    const Value limited = xsimd::min(xsimd::max(value, floor), maximum + margin);
    return xsimd::select(value == value, limited, value);  // NaN stays NaN
  }

  /// Separable kernel over kTaps × kTaps texels; with `kClamped`, limited to near the range of the inner 4×4
  /// texels.
  template <class Kernel, bool kClamped>
  static void separable(const LevelView& level, const float* chart, const float* u, const float* v,
                        float* out, std::size_t count) {
    constexpr int kTaps = Kernel::kTaps, kBefore = Kernel::kBefore;
    constexpr int kInner = (kTaps - 4) / 2;
    const int n = channels(level);
    alignas(64) float wx[kTaps][kSize], wy[kTaps][kSize];
    for (std::size_t start = 0; start < count; start += kSize) {
      const Positions<Wide> positions(level, chart + start, u + start, v + start, 0.5f);
      Pack w[kTaps];
      Kernel::weights(positions.fx, w);
      for (int tap = 0; tap < kTaps; ++tap) w[tap].store_aligned(wx[tap]);
      Kernel::weights(positions.fy, w);
      for (int tap = 0; tap < kTaps; ++tap) w[tap].store_aligned(wy[tap]);
      for (std::size_t i = 0, here = in_pack(start, count); i < here; ++i) {
        const float* texel = positions.template texel<C>(level, i) - kBefore * level.row_stride - kBefore * n;
        float* to = out + (start + i) * static_cast<std::size_t>(n);
        for (int c = 0; c < n; c += 4) {
          Value sum(0.0f), minimum(3.4e38f), maximum(-3.4e38f);
          for (int row = 0; row < kTaps; ++row) {
            const float* from = texel + row * level.row_stride + c;
            Value line(0.0f);
            for (int column = 0; column < kTaps; ++column) {
              const Value value = Value::load_unaligned(from + column * n);
              line = xsimd::fma(Value(wx[column][i]), value, line);
              if (kClamped && row >= kInner && row < kInner + 4 && column >= kInner && column < kInner + 4) {
                minimum = xsimd::min(minimum, value);
                maximum = xsimd::max(maximum, value);
              }
            }
            sum = xsimd::fma(Value(wy[row][i]), line, sum);
          }
          if (kClamped) sum = limit_overshoot(sum, minimum, maximum);
          sum.store_unaligned(to + c);
        }
      }
    }
  }

  static FetchKernels table() {
    return {&nearest,
            &bilinear,
            &separable<BSpline, false>,
            {&separable<Cubic, false>, &separable<Cubic, true>},
            {&separable<Lanczos<3>, false>, &separable<Lanczos<3>, true>},
            {&separable<Lanczos<4>, false>, &separable<Lanczos<4>, true>}};
  }
};

template <class Wide, class Four>
struct FetchTable {
  static FetchKernels of(int channels) {
    switch (channels) {
      case 1:
        return FetchOf<Wide, Four, 1>::table();
      case 3:
        return FetchOf<Wide, Four, 3>::table();
      case 4:
        return FetchOf<Wide, Four, 4>::table();
      default:
        return FetchOf<Wide, Four, 0>::table();
    }
  }
};

}  // namespace welkin
