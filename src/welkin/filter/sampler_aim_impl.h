#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "welkin/filter/sampler_aim.h"

/// Included by one source file per instruction set; see sphere/kernels_impl.h for the reason why everything
/// carries `Wide` in its template arguments.
namespace welkin {

template <class Wide>
struct AimOf {
  using Pack = xsimd::batch<float, Wide>;
  using Ints = xsimd::batch<std::int32_t, Wide>;
  static constexpr std::size_t kSize = Pack::size;

  static AimKernels kernels() { return {&many, &one}; }

 private:
  static bool many(const FloatOrientation& orientation, const StridedDirections& from,
                   const AimedDirections& to, std::size_t count) {
    bool all = true;
    std::size_t start = 0;
    for (; start + kSize <= count; start += kSize) {
      all &= from.stride == 1
                 ? aim(orientation, Pack::load_unaligned(from.x + start),
                       Pack::load_unaligned(from.y + start), Pack::load_unaligned(from.z + start), to, start)
                 : aim_strided(orientation, from, to, start, kSize);
    }
    if (start < count) all &= aim_strided(orientation, from, to, start, count - start);
    return all;
  }

  /// A pack of `here` directions that are apart in memory; the last fills it up.
  static bool aim_strided(const FloatOrientation& orientation, const StridedDirections& from,
                          const AimedDirections& to, std::size_t start, std::size_t here) {
    alignas(64) float x[kSize], y[kSize], z[kSize];
    for (std::size_t i = 0; i < kSize; ++i) {
      const std::size_t at = (start + (i < here ? i : here - 1)) * from.stride;
      x[i] = from.x[at];
      y[i] = from.y[at];
      z[i] = from.z[at];
    }
    return aim(orientation, Pack::load_aligned(x), Pack::load_aligned(y), Pack::load_aligned(z), to, start);
  }

  static bool one(const FloatOrientation& orientation, const float* direction, float* to) {
    Pack x(direction[0]), y(direction[1]), z(direction[2]);
    const auto usable = aim(orientation, x, y, z);
    x.store_aligned(to);
    y.store_aligned(to + sphere::kLanes);
    z.store_aligned(to + 2 * sphere::kLanes);
    return xsimd::all(usable);
  }

  static bool aim(const FloatOrientation& orientation, Pack x, Pack y, Pack z, const AimedDirections& to,
                  std::size_t at) {
    const auto usable = aim(orientation, x, y, z);
    x.store_unaligned(to.x + at);
    y.store_unaligned(to.y + at);
    z.store_unaligned(to.z + at);
    xsimd::select(usable, Pack(1.0f), Pack(0.0f)).store_unaligned(to.usable + at);
    return xsimd::all(usable);
  }

  /// Returns which are usable.
  static Mask<Pack> aim(const FloatOrientation& orientation, Pack& x, Pack& y, Pack& z) {
    // The exponent of the longest component, as a power of two p, and 1/p, made by subtracting exponents; at
    // least 2^−126, and 2^127 for subnormal numbers. Then the sum of the magnitudes is from 2^−22 to 12, or 0
    // for a zero, or infinite or NaN where a component is.
    const Pack longest = xsimd::max(xsimd::abs(x), xsimd::max(xsimd::abs(y), xsimd::abs(z)));
    const Ints power = xsimd::bitwise_cast<Ints>(longest) & Ints(0x7f800000);
    const Pack scale = xsimd::bitwise_cast<Pack>(xsimd::max(Ints(0x7f000000) - power, Ints(0x00800000)));
    x *= scale;
    y *= scale;
    z *= scale;
    const Pack sum = xsimd::abs(x) + xsimd::abs(y) + xsimd::abs(z);
    const Mask<Pack> usable = (sum > Pack(0.0f)) & (sum < Pack(16.0f));
    if (!xsimd::all(usable)) {
      x = xsimd::select(usable, x, Pack(0.0f));
      y = xsimd::select(usable, y, Pack(0.0f));
      z = xsimd::select(usable, z, Pack(1.0f));
    }
    if (!orientation.identity) {
      const auto row = [&](int i) {
        const float* m = orientation.m[i];
        return xsimd::fma(Pack(m[0]), x, xsimd::fma(Pack(m[1]), y, Pack(m[2]) * z));
      };
      const Pack turned_x = row(0), turned_y = row(1), turned_z = row(2);
      x = turned_x;
      y = turned_y;
      z = turned_z;
    }
    return usable;
  }
};

}  // namespace welkin
