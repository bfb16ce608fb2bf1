#pragma once

#include <array>
#include <cmath>

#include "welkin/brdf/dfg.h"
#include "welkin/brdf/microfacet.h"

/// The integrals of dfg.h by another way, for tests: over half vectors instead of lights, adaptively, in
/// float64.
namespace welkin::brdf::test {

/// ∫ f over a…b by Gauss and Kronrod's rules of 7 and 15 points, halving where they differ by more than
/// `tolerance`.
template <class F>
double adaptive(const F& f, double a, double b, double tolerance, int depth = 0) {
  // Nodes from the ends to the middle, Kronrod's weights, and Gauss's for every second. Piessens et al. 1983,
  // QUADPACK.
  constexpr std::array nodes{0.991455371120812639206854697526, 0.949107912342758524526189684048,
                             0.864864423359769072789712788641, 0.741531185599394439863864773281,
                             0.586087235467691130294144838259, 0.405845151377397166906606412077,
                             0.207784955007898467600689403773, 0.0};
  constexpr std::array kronrod{0.022935322010529224963732008059, 0.063092092629978553290700663189,
                               0.104790010322250183839876322542, 0.140653259715525918745189590510,
                               0.169004726639267902826583426599, 0.190350578064785409913256402421,
                               0.204432940075298892414161999235, 0.209482141084727828012999174892};
  constexpr std::array gauss{0.129484966168869693270611432679, 0.279705391489276667901467771424,
                             0.381830050505118944950369775489, 0.417959183673469387755102040816};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double fine = 0, coarse = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double sum = i == 7 ? f(middle) : f(middle - half * nodes[i]) + f(middle + half * nodes[i]);
    fine += kronrod[i] * sum;
    if (i % 2 == 1) coarse += gauss[i / 2] * sum;
  }
  fine *= half;
  coarse *= half;
  if (std::fabs(fine - coarse) < tolerance || depth > 30) return fine;
  return adaptive(f, a, middle, 0.6 * tolerance, depth + 1) +
         adaptive(f, middle, b, 0.6 * tolerance, depth + 1);
}

/// ∫ D V(n·l, n·v) n·l F(v·h) 4 (v·h) dω over half vectors h. The light is above the surface for 2 (v·h)(n·h)
/// > n·v, that is below θh = π/4 + ½ atan(tan θv cos φ). `inner` integrates over θh, as fits the
/// distribution.
template <class Inner>
double over_half_vectors(double nv, const Inner& inner) {
  const double sv = std::sqrt((1 - nv) * (1 + nv));
  const auto slice = [&](double phi) {
    return inner(kPi / 4 + 0.5 * std::atan2(sv * std::cos(phi), nv), std::cos(phi));
  };
  return 2 * (adaptive(slice, 0, kPi / 2, 1e-9) + adaptive(slice, kPi / 2, kPi, 1e-9));
}

/// GGX. D n·h dω is even in u = tan²θh/(α² + tan²θh).
template <class Visibility>
SplitSum ggx_by_half_vectors(double nv, double alpha, const Visibility& visibility) {
  const double sv = std::sqrt((1 - nv) * (1 + nv));
  const auto integral = [&](bool fresnel) {
    return over_half_vectors(nv, [&](double last, double cos_phi) {
      const double tangent = std::tan(last), end = tangent * tangent / (tangent * tangent + alpha * alpha);
      const auto at = [&](double u) {
        const double t2 = alpha * alpha * u / (1 - u), nh = 1 / std::sqrt(1 + t2), sh = std::sqrt(t2) * nh;
        const double vh = nv * nh + sv * sh * cos_phi, nl = 2 * vh * nh - nv;
        if (nl <= 0 || vh <= 0) return 0.0;
        return visibility(nl) * nl * 4 * vh / nh * (fresnel ? schlick_weight(vh) : 1) / (2 * kPi);
      };
      return adaptive(at, 0, end, 1e-10);
    });
  };
  return {integral(false), integral(true)};
}

template <class Visibility>
double charlie_by_half_vectors(double nv, double alpha, const Visibility& visibility) {
  const double sv = std::sqrt((1 - nv) * (1 + nv));
  return over_half_vectors(nv, [&](double last, double cos_phi) {
    const auto at = [&](double theta) {
      const double nh = std::cos(theta), sh = std::sin(theta), vh = nv * nh + sv * sh * cos_phi;
      const double nl = 2 * vh * nh - nv;
      if (nl <= 0 || vh <= 0) return 0.0;
      return charlie_distribution_from_sine(sh * sh, alpha) * visibility(nl) * nl * 4 * vh * sh;
    };
    return adaptive(at, 0, last, 1e-9);
  });
}

}  // namespace welkin::brdf::test
