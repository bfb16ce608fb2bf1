#pragma once

#include <xsimd/xsimd.hpp>

#include "welkin/sphere/all.h"
#include "welkin/sphere/kernels.h"

/// Included by one source file per instruction set. Everything here carries the instruction set `Arch` in its
/// template arguments: an inline function without it, compiled for AVX2, could be the copy that the linker
/// keeps for the baseline (tests/kernels_test.sh looks for such symbols).
namespace welkin::sphere {

template <class P, class Arch>
struct KernelsOf {
  using Pack = xsimd::batch<float, Arch>;
  static constexpr std::size_t kStep = Pack::size;
  static_assert(kLanes % kStep == 0);

  static Pack load(const float* from, std::size_t i) { return Pack::load_unaligned(from + i); }

  static void to_sphere(const void* self, int chart, const float* u, const float* v, float* x, float* y,
                        float* z, std::size_t count) {
    const P& p = *static_cast<const P*>(self);
    for (std::size_t i = 0; i < count; i += kStep) {
      const Vec3<Pack> d = p.template to_sphere<Pack>(chart, load(u, i), load(v, i));
      d.x.store_unaligned(x + i);
      d.y.store_unaligned(y + i);
      d.z.store_unaligned(z + i);
    }
  }

  static void from_sphere(const void* self, const float* x, const float* y, const float* z, float* chart,
                          float* u, float* v, std::size_t count) {
    const P& p = *static_cast<const P*>(self);
    for (std::size_t i = 0; i < count; i += kStep) {
      const ChartPoint<Pack> c = p.template from_sphere<Pack>(Vec3<Pack>{load(x, i), load(y, i), load(z, i)});
      c.chart.store_unaligned(chart + i);
      c.u.store_unaligned(u + i);
      c.v.store_unaligned(v + i);
    }
  }

  static void density(const void* self, int chart, const float* u, const float* v, float* out,
                      std::size_t count) {
    const P& p = *static_cast<const P*>(self);
    for (std::size_t i = 0; i < count; i += kStep) {
      const Pack density = p.template solid_angle_density<Pack>(chart, load(u, i), load(v, i));
      density.store_unaligned(out + i);
    }
  }

  static void store_mask(const Mask<Pack>& mask, float* out) {
    xsimd::select(mask, Pack(1.0f), Pack(0.0f)).store_unaligned(out);
  }

  static void valid(const void* self, int chart, const float* u, const float* v, float* mask,
                    std::size_t count) {
    const P& p = *static_cast<const P*>(self);
    for (std::size_t i = 0; i < count; i += kStep) {
      store_mask(p.template valid<Pack>(chart, load(u, i), load(v, i)), mask + i);
    }
  }

  static void covers(const void* self, const float* x, const float* y, const float* z, float* mask,
                     std::size_t count) {
    const P& p = *static_cast<const P*>(self);
    for (std::size_t i = 0; i < count; i += kStep) {
      store_mask(p.template covers<Pack>(Vec3<Pack>{load(x, i), load(y, i), load(z, i)}), mask + i);
    }
  }
};

template <class P, class Arch>
constexpr Kernels table_of() {
  using Of = KernelsOf<P, Arch>;
  return {&Of::to_sphere, &Of::from_sphere, &Of::density, &Of::valid, &Of::covers};
}

template <class Arch, class... P>
const Kernels& kernels_at(TypeList<P...>, std::size_t index) {
  static constexpr Kernels table[] = {table_of<typename KernelStructOf<P>::Type, Arch>()...};
  return table[index];
}

}  // namespace welkin::sphere
