#pragma once

#include <bit>
#include <cmath>
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
  Eight times(float factor) const {
    Eight r;
    for (int i = 0; i < 8; ++i) r.v[i] = factor * v[i];
    return r;
  }
  void load_sums(const float* from) { std::memcpy(v, from, sizeof v); }
  void keep() {}
  /// Each four over their last; 0 where that isn't positive.
  Eight over_last() const {
    Eight r;
    for (int i = 0; i < 8; ++i) r.v[i] = v[i | 3] > 0 ? v[i] / v[i | 3] : 0;
    return r;
  }
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
  Eight times(float factor) const { return {_mm256_mul_ps(_mm256_set1_ps(factor), v)}; }
  void load_sums(const float* from) { v = _mm256_loadu_ps(from); }
  /// Keeps a compiler from loading once for each use.
  void keep() { __asm__("" : "+x"(v)); }
  Eight over_last() const {
    const __m256 last = _mm256_permute_ps(v, 0xff);
    return {_mm256_and_ps(_mm256_cmp_ps(last, _mm256_setzero_ps(), _CMP_GT_OQ), _mm256_div_ps(v, last))};
  }
  void store_sums(float* to) const { _mm256_storeu_ps(to, v); }
};
#endif

template <class Wide>
struct GaussianOf {
  using Pack = xsimd::batch<float, Wide>;
  using Ints = xsimd::batch<std::int32_t, Wide>;
  static constexpr std::size_t kSize = Pack::size;
  static constexpr float kHalfPi = 1.57079632679490f;

  static void spread(const GaussianSpread& cone, GaussianTaps& taps, std::size_t at) {
    const Pack sigma(cone.sigma);
    for (std::size_t i = 0; i < cone.count; i += kSize) {
      const Pack angle = sigma * Pack::load_unaligned(cone.nodes + i);
      const auto turned = xsimd::sincos(angle);
      const Pack along = turned.first, ahead = turned.second;
      const auto store = [&](int k, float* to) {
        xsimd::fma(along, Pack(cone.axis[k]), ahead * Pack(cone.direction[k])).store_unaligned(to + at + i);
      };
      store(0, taps.x);
      store(1, taps.y);
      store(2, taps.z);
    }
  }

  using Rows = float (*)[GaussianTaps::kRoom];

  /// `factor` times the weights of the quadratic B-spline at the texels −1, 0, 1 about the nearest, which is
  /// f ∈ [−½, ½] away.
  static void store_weights(const Pack& f, const Pack& factor, Rows to, std::size_t i) {
    const Pack half(0.5f), before = half - f, after = half + f, halved = half * factor;
    (halved * before * before).store_unaligned(to[0] + i);
    (factor * (Pack(0.75f) - f * f)).store_unaligned(to[1] + i);
    (halved * after * after).store_unaligned(to[2] + i);
  }

  /// The arc tangent of |x| ≤ 1, within 2e-8 (Abramowitz & Stegun 1964, 4.4.49).
  static Pack arc_tangent(const Pack& x) {
    const Pack x2 = x * x;
    Pack sum(0.0028662257f);
    for (const float next : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f, -0.1420889944f,
                             0.1999355085f, -0.3333314528f, 1.0f}) {
      sum = xsimd::fma(sum, x2, Pack(next));
    }
    return x * sum;
  }

  static void locate(GaussianTaps& taps, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kSize) {
      const auto face =
          sphere::cube_face_of(Vec3<Pack>{Pack::load_unaligned(taps.x + i), Pack::load_unaligned(taps.y + i),
                                          Pack::load_unaligned(taps.z + i)});
      const Pack size = Pack::load_unaligned(taps.size + i);
      const auto place = [&](const Pack& s, const Pack& factor, Rows weights) {
        // Texel k of the border's numbering has its centre at k − ½; the nearest one is the middle of three.
        const Pack at = size * xsimd::fma(Pack(1 / kHalfPi), arc_tangent(s), Pack(0.5f));
        const Pack whole = xsimd::min(xsimd::max(xsimd::floor(at), Pack(0.0f)), size - Pack(1.0f));
        store_weights(at - whole - Pack(0.5f), factor, weights, i);
        return xsimd::to_int(whole);
      };
      const Ints column = place(face.u, Pack(1.0f), taps.across);
      const Ints row = place(face.v, Pack::load_unaligned(taps.weight + i), taps.down);
      const Ints side = xsimd::to_int(size) + Ints(2);
      ((xsimd::to_int(face.chart) * side + row) * side + column).store_unaligned(taps.texel + i);
    }
  }

  static void gather(const GaussianTaps& taps, std::size_t from, std::size_t to, const std::uint16_t* values,
                     std::size_t width, std::size_t pitch, float* sums) {
    for (std::size_t part = 0; part < width; part += 8) {
      Eight<Wide> sum;
      sum.load_sums(sums + part);
      for (std::size_t i = from; i < to; ++i) {
        const std::uint16_t* texel = values + static_cast<std::size_t>(taps.texel[i]) * width + part;
        for (std::size_t r = 0; r < 3; ++r, texel += pitch) {
          Eight<Wide> line = Eight<Wide>::load(texel).times(taps.across[0][i]);
          line.add(taps.across[1][i], Eight<Wide>::load(texel + width));
          line.add(taps.across[2][i], Eight<Wide>::load(texel + 2 * width));
          sum.add(taps.down[r][i], line);
        }
      }
      sum.store_sums(sums + part);
    }
  }

  static void splat_one(FaceGrid& grid, int face, float x, float y, const float* value) {
    // Texel k of the grid, margin included, has its centre at k + ½.
    const int column = static_cast<int>(x), row = static_cast<int>(y), side = grid.side();
    if (!(x >= 1 && y >= 1 && column < side - 1 && row < side - 1)) return;
    const auto weights = [](float f, float* w) {
      const float before = 0.5f - f, after = 0.5f + f;
      w[0] = 0.5f * before * before;
      w[1] = 0.75f - f * f;
      w[2] = 0.5f * after * after;
    };
    float across[3], down[3];
    weights(x - static_cast<float>(column) - 0.5f, across);
    weights(y - static_cast<float>(row) - 0.5f, down);
    float* to = grid.at(face, column - 1, row - 1);
    const float v0 = value[0], v1 = value[1], v2 = value[2], v3 = value[3];
    for (int r = 0; r < 3; ++r, to += static_cast<std::size_t>(side) * FaceGrid::kPair) {
      for (int c = 0; c < 3; ++c) {
        const float weight = down[r] * across[c];
        float* at = to + static_cast<std::size_t>(c) * FaceGrid::kPair;
        at[0] += weight * v0;
        at[1] += weight * v1;
        at[2] += weight * v2;
        at[3] += weight * v3;
      }
    }
  }

  static void splat(const MassPoints& points, const FaceNeighbor* neighbors, FaceGrid& grid) {
    alignas(64) float face[kSize], x[kSize], y[kSize], a[kSize], b[kSize], along[kSize], aside[kSize];
    const float per_angle = static_cast<float>(grid.size()) / kHalfPi;
    const float middle = 0.5f * static_cast<float>(grid.size()) + static_cast<float>(grid.margin());
    // Beyond this angle a point is in a neighbour's margin too.
    const float edge = kHalfPi / 2 - static_cast<float>(grid.margin()) / per_angle;
    for (std::size_t start = 0; start < points.count; start += kSize) {
      const auto at = sphere::cube_face_of(Vec3<Pack>{Pack::load_unaligned(points.x + start),
                                                      Pack::load_unaligned(points.y + start),
                                                      Pack::load_unaligned(points.z + start)});
      const Pack u = xsimd::atan(at.u), v = xsimd::atan(at.v);
      at.chart.store_aligned(face);
      u.store_aligned(a);
      v.store_aligned(b);
      xsimd::fma(u, Pack(per_angle), Pack(middle)).store_aligned(x);
      xsimd::fma(v, Pack(per_angle), Pack(middle)).store_aligned(y);
      const bool near = xsimd::any((xsimd::abs(u) > Pack(edge)) | (xsimd::abs(v) > Pack(edge)));
      if (near) {
        const Pack tiny(1e-20f);
        xsimd::atan(at.v / xsimd::max(xsimd::abs(at.u), tiny)).store_aligned(along);
        xsimd::atan(at.u / xsimd::max(xsimd::abs(at.v), tiny)).store_aligned(aside);
      }
      const std::size_t here = points.count - start < kSize ? points.count - start : kSize;
      for (std::size_t i = 0; i < here; ++i) {
        const float* value = points.values + (start + i) * FaceGrid::kValues;
        const int own = static_cast<int>(face[i]);
        splat_one(grid, own, x[i], y[i], value);
        if (!near) continue;
        const auto beyond = [&](int side, float angle, float other) {
          const FaceNeighbor& n = neighbors[own * 4 + side];
          const float out = kHalfPi - angle;
          splat_one(grid, n.face, (n.out_u * out + n.along_u * other) * per_angle + middle,
                    (n.out_v * out + n.along_v * other) * per_angle + middle, value);
        };
        if (a[i] > edge) beyond(0, a[i], along[i]);
        if (-a[i] > edge) beyond(1, -a[i], along[i]);
        if (b[i] > edge) beyond(2, b[i], aside[i]);
        if (-b[i] > edge) beyond(3, -b[i], aside[i]);
      }
    }
  }

  static void weigh(const BlurWeights& blur, const float* tangents, const BlurRow* rows, std::size_t count,
                    float* first, float* second) {
    const float length = 1 / std::sqrt(1 + blur.s * blur.s + blur.t * blur.t);
    const Pack dx(blur.s * length), dy(blur.t * length), dz(length), one(1.0f), half(0.5f);
    alignas(64) float lanes[kSize];
    for (std::size_t i = 0; i < kSize; ++i) lanes[i] = static_cast<float>(i);
    const Pack lane = Pack::load_aligned(lanes);
    for (std::size_t r = 0; r < count; ++r) {
      const BlurRow& row = rows[r];
      const Pack t(tangents[row.y]), off_y(static_cast<float>(row.y) - blur.y);
      for (int i = 0; i < row.count; i += static_cast<int>(kSize)) {
        const Pack s = Pack::load_unaligned(tangents + row.x + i);
        const Pack inverse = one / xsimd::sqrt(one + s * s + t * t);
        const Pack x = s * inverse - dx, y = t * inverse - dy, z = inverse - dz;
        const Pack angle = half * (x * x + y * y + z * z);  // 1 − cos θ
        const Pack off_x = lane + Pack(static_cast<float>(row.x + i) - blur.x);
        const auto weight = [&](const BlurWeights::Gaussian& g) {
          const Pack shape = off_x * (Pack(g.xx) * off_x + Pack(g.xy) * off_y) + Pack(g.yy) * off_y * off_y;
          return xsimd::exp(shape - Pack(g.kappa) * angle);
        };
        weight(blur.gaussians[0]).store_unaligned(first + row.weight + i);
        weight(blur.gaussians[1]).store_unaligned(second + row.weight + i);
      }
    }
  }

  static void apply(const BlurRow* rows, std::size_t count, const float* first, const float* second,
                    const float* const* from, const std::ptrdiff_t* across, const std::ptrdiff_t* down,
                    float* means) {
    Eight<Wide> a[4], b[4];
    for (int k = 0; k < 4; ++k) a[k] = b[k] = Eight<Wide>::zero();
    for (std::size_t r = 0; r < count; ++r) {
      const BlurRow& row = rows[r];
      const float* at[4];
      for (int k = 0; k < 4; ++k) at[k] = from[k] + row.x * across[k] + row.y * down[k];
      for (int i = 0; i < row.count; ++i) {
        const float wa = first[row.weight + static_cast<std::size_t>(i)];
        const float wb = second[row.weight + static_cast<std::size_t>(i)];
        for (int k = 0; k < 4; ++k) {
          Eight<Wide> value;
          value.load_sums(at[k]);
          value.keep();
          a[k].add(wa, value);
          b[k].add(wb, value);
          at[k] += across[k];
        }
      }
    }
    for (int k = 0; k < 4; ++k) {
      a[k].over_last().store_sums(means + static_cast<std::size_t>(k) * 2 * FaceGrid::kPair);
      b[k].over_last().store_sums(means + static_cast<std::size_t>(k) * 2 * FaceGrid::kPair +
                                  FaceGrid::kPair);
    }
  }

  /// So many lines side by side, for their recursions' latency. Unser, Aldroubi & Eden 1993, part I; the pole
  /// is √8 − 3.
  template <int kLines>
  static void to_spline_lines(float* values, const SplineLines& lines) {
    constexpr float kPole = -0.17157287525381f;
    constexpr float kStart = 8 / (1 - kPole), kTurn = -kPole / (1 - kPole);
    // Before the first and after the last, what samples that stay as they are there would have made.
    const auto steady = [&](float factor, int i) {
      Eight<Wide> sample;
      sample.load_sums(values + i * lines.line_step);
      return sample.times(factor);
    };
    const auto step = [&](float of_sample, Eight<Wide>& last, int i) {
      Eight<Wide> here = steady(of_sample, i);
      here.add(kPole, last);
      here.store_sums(values + i * lines.line_step);
      last = here;
    };
    Eight<Wide> last[kLines];
    for (int i = 0; i < kLines; ++i) last[i] = steady(kStart, i);
    for (int k = 0; k < lines.count; ++k, values += lines.step) {
      for (int i = 0; i < kLines; ++i) step(8, last[i], i);
    }
    values -= lines.step;
    for (int i = 0; i < kLines; ++i) last[i] = steady(kTurn, i);
    for (int k = 0; k < lines.count; ++k, values -= lines.step) {
      for (int i = 0; i < kLines; ++i) step(-kPole, last[i], i);
    }
  }
  static void to_spline(float* values, const SplineLines& lines) {
    int i = 0;
    for (; i + 8 <= lines.lines; i += 8) to_spline_lines<8>(values + i * lines.line_step, lines);
    for (; i < lines.lines; ++i) to_spline_lines<1>(values + i * lines.line_step, lines);
  }

  static std::uint16_t half_of(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    std::uint32_t half;
    if (magnitude < 0x38800000u) {
      // Subnormal: adding ½ rounds the last bits away, to even.
      half = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u;
    } else {
      half = (magnitude - 0x38000000u + 0xfffu + ((magnitude >> 13) & 1u)) >> 13;
    }
    return static_cast<std::uint16_t>(half | (bits & 0x80000000u) >> 16);
  }

  static float to_halves(const float* a, const float* b, const float* factors, std::size_t texels,
                         std::uint16_t* to) {
#ifdef __F16C__
    const __m256i order = _mm256_setr_epi32(0, 1, 2, 4, 5, 6, 7, 7);
    const __m256 factor = _mm256_broadcast_ps(reinterpret_cast<const __m128*>(factors));
    __m256 most = _mm256_setzero_ps();
    for (std::size_t i = 0; i < texels; ++i, a += FaceGrid::kPair, b += FaceGrid::kPair, to += 8) {
      const __m256 both = _mm256_mul_ps(_mm256_set_m128(_mm_loadu_ps(b), _mm_loadu_ps(a)), factor);
      most = _mm256_max_ps(most, _mm256_andnot_ps(_mm256_set1_ps(-0.0f), both));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(to),
                       _mm256_cvtps_ph(_mm256_permutevar8x32_ps(both, order), _MM_FROUND_TO_NEAREST_INT));
    }
    alignas(32) float lanes[8];
    _mm256_store_ps(lanes, most);
#else
    float lanes[8] = {};
    for (std::size_t i = 0; i < texels; ++i, a += FaceGrid::kPair, b += FaceGrid::kPair, to += 8) {
      for (int c = 0; c < 3; ++c) {
        const float first = a[c] * factors[c], second = b[c] * factors[c];
        lanes[c] = std::fmax(lanes[c], std::fmax(std::fabs(first), std::fabs(second)));
        to[c] = half_of(first);
        to[3 + c] = half_of(second);
      }
    }
#endif
    float largest = 0;
    for (const float lane : lanes) largest = lane > largest ? lane : largest;
    return largest;
  }

  static const GaussianKernels& table() {
    static constexpr GaussianKernels kernels{&splat,  &weigh,  &apply,  &to_spline,
                                             &spread, &locate, &gather, &to_halves};
    return kernels;
  }
};

}  // namespace welkin
