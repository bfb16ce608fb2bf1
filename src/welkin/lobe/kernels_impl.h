#pragma once

#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "welkin/lobe/all.h"
#include "welkin/lobe/kernels.h"

/// Included by one source file per instruction set. Everything here carries the instruction set `Arch` in its
/// template arguments: an inline function without it, compiled for AVX2, could be the copy that the linker
/// keeps for the baseline (tests/kernels_test.sh looks for such symbols).
namespace welkin::lobe {

template <class L, class Arch>
struct WeightsOf {
  using Pack = xsimd::batch<float, Arch>;
  static constexpr std::size_t kStep = Pack::size;
  static_assert(kLanes % kStep == 0);

  static void weights(const void* self, const float* s, float* weights, std::size_t count) {
    // Of a copy the compiler knows that the stores don't change it, and works its constants out once.
    using Held = std::conditional_t<std::is_trivially_copyable_v<L>, const L, const L&>;
    Held lobe = *static_cast<const L*>(self);
    for (std::size_t i = 0; i < count; i += kStep) {
      lobe.template weight<Pack>(Pack::load_unaligned(s + i)).store_unaligned(weights + i);
    }
  }
};

template <class L, class Arch>
struct PointSumsOf {
  using Pack = xsimd::batch<float, Arch>;
  static constexpr std::size_t kStep = Pack::size;

  static void sums(const void* self, const Points& points, const float* x, const float* y, const float* z,
                   float* values, std::size_t count) {
    const L& lobe = *static_cast<const L*>(self);
    for (int first = 0; first < points.channels; first += 3) {
      const int channels = points.channels - first;
      if (channels == 1) {
        group<1>(lobe, points, first, x, y, z, values, count);
      } else if (channels == 2) {
        group<2>(lobe, points, first, x, y, z, values, count);
      } else {
        group<3>(lobe, points, first, x, y, z, values, count);
      }
    }
  }

  template <int kChannels>
  static void group(const L& lobe, const Points& points, int first, const float* x, const float* y,
                    const float* z, float* values, std::size_t count) {
    const std::ptrdiff_t n = points.channels;
    for (std::size_t i = 0; i < count; i += kStep) {
      const Pack px = Pack::load_unaligned(x + i), py = Pack::load_unaligned(y + i),
                 pz = Pack::load_unaligned(z + i);
      Pack sum[kChannels];
      for (Pack& each : sum) each = Pack(0.0f);
      const float* light = points.weight + first;
      for (int k = 0; k < points.count; ++k, light += n) {
        const Pack dx = px - Pack(points.x[k]), dy = py - Pack(points.y[k]), dz = pz - Pack(points.z[k]);
        const Pack weight = lobe.template weight<Pack>(Pack(0.5f) * (dx * dx + dy * dy + dz * dz));
        for (int c = 0; c < kChannels; ++c) sum[c] = xsimd::fma(weight, Pack(light[c]), sum[c]);
      }
      alignas(64) float lanes[kStep];
      for (int c = 0; c < kChannels; ++c) {
        sum[c].store_aligned(lanes);
        float* to = values + static_cast<std::ptrdiff_t>(i) * n + first + c;
        for (std::size_t lane = 0; lane < kStep && i + lane < count; ++lane) {
          to[static_cast<std::ptrdiff_t>(lane) * n] += lanes[lane];
        }
      }
    }
  }
};

template <class Arch, class... L>
PointSums point_sums_at(TypeList<L...>, std::size_t index) {
  static constexpr PointSums table[] = {&PointSumsOf<L, Arch>::sums...};
  return table[index];
}

template <class Arch, class... L>
Weights weights_at(TypeList<L...>, std::size_t index) {
  static constexpr Weights table[] = {&WeightsOf<L, Arch>::weights...};
  return table[index];
}

/// With D_l = P_l − P_(l−1) the recurrence (l+1) P_(l+1) = (2l+1)(1 − s) P_l − l P_(l−1) becomes
/// (l+1) D_(l+1) = l D_l − (2l+1) s P_l, which keeps the precision of a small s.
template <class Arch>
struct Legendre {
  using Pack = xsimd::batch<double, Arch>;
  static constexpr std::size_t kStep = Pack::size;
  static constexpr std::size_t kPacks = kLanes / kStep;

  static void sums(const double* s, const double* weights, std::size_t count, int degree, double* sums) {
    for (std::size_t i = 0; i < count; i += kLanes) block(s + i, weights + i, degree, sums);
  }

  static void block(const double* s, const double* weights, int degree, double* sums) {
    Pack position[kPacks], weight[kPacks], value[kPacks], difference[kPacks];
    for (std::size_t k = 0; k < kPacks; ++k) {
      position[k] = Pack::load_unaligned(s + k * kStep);
      weight[k] = Pack::load_unaligned(weights + k * kStep);
      value[k] = Pack(1.0);
      difference[k] = Pack(0.0);
    }
    for (int l = 0; l <= degree; ++l) {
      const Pack keep(l / (l + 1.0)), bend((2 * l + 1) / (l + 1.0));
      Pack sum(0.0);
      for (std::size_t k = 0; k < kPacks; ++k) {
        sum += weight[k] * value[k];
        difference[k] = keep * difference[k] - bend * position[k] * value[k];
        value[k] += difference[k];
      }
      sums[l] += xsimd::hadd(sum);
    }
  }
};

}  // namespace welkin::lobe
