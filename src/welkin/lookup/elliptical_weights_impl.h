#pragma once

#include <xsimd/xsimd.hpp>

#include "welkin/lookup/elliptical_weights.h"

/// Included by one source file per instruction set; see sphere/kernels_impl.h for the reason why everything
/// carries `Wide` in its template arguments.
namespace welkin {

template <class Wide>
struct WeighOf {
  using Pack = xsimd::batch<float, Wide>;

  static void weigh(const EllipticalWeight& weight, const float* x, const float* y, const float* z,
                    float* weights, std::size_t count) {
    const Pack last(weight.reach * weight.reach);
    for (std::size_t i = 0; i < count; i += Pack::size) {
      const Pack dx = Pack::load_aligned(x + i), dy = Pack::load_aligned(y + i),
                 dz = Pack::load_aligned(z + i);
      const auto along = [&](const Vec3<float>& axis) {
        return xsimd::fma(dx, Pack(axis.x), xsimd::fma(dy, Pack(axis.y), dz * Pack(axis.z)));
      };
      const Pack px = along(weight.right), py = along(weight.down), pz = along(weight.normal);
      const Pack form = Pack(weight.xx) * px * px + Pack(weight.xy) * px * py + Pack(weight.yy) * py * py;
      const Pack distance = squared_stretch(pz) * form;
      const Pack value = xsimd::exp(Pack(-0.5f) * distance);
      xsimd::select(distance <= last, value, Pack(0.0f)).store_aligned(weights + i);
    }
  }

 private:
  /// acos(z)/√(1 − z) for 0 ≤ z ≤ 1, absolute error 2e-8 (Abramowitz & Stegun 1964, 4.4.46).
  static Pack arc_over_root(const Pack& z) {
    Pack sum(-0.0012624911f);
    for (const float each : {0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f,
                             -0.2145988016f, 1.5707963050f}) {
      sum = xsimd::fma(sum, z, Pack(each));
    }
    return sum;
  }

  /// (θ / sin θ)², θ the angle whose cosine is z.
  static Pack squared_stretch(const Pack& z) {
    const Pack one(1.0f);
    // z ≥ 0: θ²/(1 − z²), of which (1 − z) cancels.
    const Pack magnitude = xsimd::min(xsimd::abs(z), one);
    const Pack arc = arc_over_root(magnitude);
    const Pack near = arc * arc / (one + magnitude);
    // z < 0: θ = π − acos(−z).
    const Pack theta = Pack(3.14159265f) - arc * xsimd::sqrt(one - magnitude);
    const Pack far = theta * theta / xsimd::max(one - magnitude * magnitude, Pack(1e-7f));
    return xsimd::select(z >= Pack(0.0f), near, far);
  }
};

}  // namespace welkin
