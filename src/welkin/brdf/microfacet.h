#pragma once

#include "welkin/math/scalar.h"

/// @file
/// The factors of reflection by microfacets: how normals are distributed, how they hide each other, what each
/// reflects. A BRDF is f = D · V · F, with V = G2/(4 (n·l)(n·v)), the *visibility*.
///
/// All are templates on double, float or SIMD packs. Cosines `nl`, `nv` (light, view), `nh` (half vector h to
/// the normal) and `vh` (view to h) lie in 0…1 and α in 0…1, α = roughness². Nothing is limited or checked:
/// what isn't finite is stated. Relative error: a few times the type's, where not stated. Sources: Walter,
/// Marschner, Li & Torrance 2007; Heitz 2014.
namespace welkin::brdf {

// Distributions of normals.

/// GGX from sin²θh, which is precise for narrow lobes, where the cosine isn't: D = α²/(π (α² + (1 − α²)
/// sin²θh)²), sr⁻¹; ∫ D cos θh dω = 1. At α = 0 it is 0, on the axis NaN. Walter et al. 2007, eq. 33.
template <class T>
T ggx_distribution_from_sine(const T& sine_squared, const T& alpha) {
  const T a = alpha * alpha, root = a + (constant<T>(1) - a) * sine_squared;
  return a / (constant<T>(kPi) * root * root);
}

/// The same from cos θh.
template <class T>
T ggx_distribution(const T& nh, const T& alpha) {
  return ggx_distribution_from_sine<T>((constant<T>(1) - nh) * (constant<T>(1) + nh), alpha);
}

/// Charlie, of cloth: D = (2 + 1/α) sin^(1/α)θh/2π, sr⁻¹, from sin²θh; ∫ D cos θh dω = 1. α must be above 0.
/// Relative error: the type's, times 1/α. Estevez & Kulla 2017, eq. 2.
template <class T>
T charlie_distribution_from_sine(const T& sine_squared, const T& alpha) {
  const T zero = constant<T>(0), inverse = constant<T>(1) / alpha;
  const T power = exp(constant<T>(0.5) * inverse * log(sine_squared));
  return select(sine_squared > zero, (constant<T>(2) + inverse) * power * constant<T>(0.5 / kPi), zero);
}

/// The same from cos θh.
template <class T>
T charlie_distribution(const T& nh, const T& alpha) {
  return charlie_distribution_from_sine<T>((constant<T>(1) - nh) * (constant<T>(1) + nh), alpha);
}

// Masking and shadowing of GGX.

/// √(α² + (1 − α²) c²) = c √(1 + α² tan²θ), of which all of Smith's terms for GGX are made.
template <class T>
T ggx_root(const T& cosine, const T& alpha) {
  const T a = alpha * alpha;
  return sqrt(a + (constant<T>(1) - a) * cosine * cosine);
}

/// Smith's Λ = (√(1 + α² tan²θ) − 1)/2; infinite at the horizon. Heitz 2014, eq. 72.
template <class T>
T ggx_lambda(const T& cosine, const T& alpha) {
  return constant<T>(0.5) * (ggx_root(cosine, alpha) - cosine) / cosine;
}

/// Smith's G1 = 1/(1 + Λ): the share of facets that are seen. 0/0 at α = 0 on the horizon. Walter et al.
/// 2007, eq. 34.
template <class T>
T ggx_g1(const T& cosine, const T& alpha) {
  return constant<T>(2) * cosine / (cosine + ggx_root(cosine, alpha));
}

/// G2 = 1/(1 + Λ(l) + Λ(v)): masking and shadowing, correlated by the facets' height. 0/0 where both are on
/// the horizon. Heitz 2014, eq. 99.
template <class T>
T ggx_g2_correlated(const T& nl, const T& nv, const T& alpha) {
  return constant<T>(2) * nl * nv / (nl * ggx_root(nv, alpha) + nv * ggx_root(nl, alpha));
}

/// G2 = G1(l) G1(v): as if masking and shadowing were independent. Heitz 2014, eq. 98.
template <class T>
T ggx_g2_separable(const T& nl, const T& nv, const T& alpha) {
  return ggx_g1(nl, alpha) * ggx_g1(nv, alpha);
}

/// V of ggx_g2_correlated: ½/(n·l √… + n·v √…), finite unless both are on the horizon or α = 0 and one of
/// them is.
template <class T>
T ggx_visibility_correlated(const T& nl, const T& nv, const T& alpha) {
  return constant<T>(0.5) / (nl * ggx_root(nv, alpha) + nv * ggx_root(nl, alpha));
}

/// V of ggx_g2_separable: 1/((n·l + √…)(n·v + √…)), finite unless α = 0 and one of them is on the horizon.
template <class T>
T ggx_visibility_separable(const T& nl, const T& nv, const T& alpha) {
  return constant<T>(1) / ((nl + ggx_root(nl, alpha)) * (nv + ggx_root(nv, alpha)));
}

/// Schlick's approximation of G1, with its own k: c/(c (1 − k) + k). k = α/2 for pre-filtered light: Karis
/// 2013, p. 3.
template <class T>
T schlick_g1(const T& cosine, const T& k) {
  return cosine / (cosine * (constant<T>(1) - k) + k);
}

/// V of two of schlick_g1: ¼/((n·l (1 − k) + k)(n·v (1 − k) + k)).
template <class T>
T schlick_visibility(const T& nl, const T& nv, const T& k) {
  const T rest = constant<T>(1) - k;
  return constant<T>(0.25) / ((nl * rest + k) * (nv * rest + k));
}

/// V of ggx_g2_correlated without its roots: ½/mix(2 n·l n·v, n·l + n·v, α). Hammon 2017, p. 82.
template <class T>
T ggx_visibility_approximate(const T& nl, const T& nv, const T& alpha) {
  const T rest = constant<T>(1) - alpha;
  return constant<T>(0.5) / (constant<T>(2) * nl * nv * rest + (nl + nv) * alpha);
}

// Masking and shadowing of cloth.

/// V = 1/(4 (n·l + n·v − n·l n·v)), which hides less than facets would. Neubelt & Pettineo 2013.
template <class T>
T neubelt_visibility(const T& nl, const T& nv) {
  return constant<T>(0.25) / (nl + nv - nl * nv);
}

/// Charlie's Λ, a fit: exp L(c) below c = ½, exp(2 L(½) − L(1 − c)) above, L(x) = a/(1 + b x^k) + d x + e,
/// with coefficients mixed by (1 − α)². Estevez & Kulla 2017, eq. 3 and table 1.
template <class T>
T charlie_lambda(const T& cosine, const T& alpha) {
  const T one = constant<T>(1), mix = (one - alpha) * (one - alpha);
  const auto mixed = [&](double rough, double smooth) {
    return constant<T>(rough) + mix * constant<T>(smooth - rough);
  };
  const T a = mixed(21.5473, 25.3245), b = mixed(3.82987, 3.32435), k = mixed(0.19823, 0.16801),
          d = mixed(-1.97760, -1.27393), e = mixed(-4.32054, -4.85967);
  const auto curve = [&](const T& x) {
    // 0^k is 0: the smallest numbers' powers would not be.
    const T power = select(x > constant<T>(0), exp(k * log(x)), constant<T>(0));
    return a / (one + b * power) + d * x + e;
  };
  const T half = constant<T>(0.5);
  const auto below = cosine < half;
  const T value = curve(select(below, cosine, one - cosine));
  return exp(select(below, value, constant<T>(2) * curve(half) - value));
}

/// V = 1/((1 + Λ(l) + Λ(v)) 4 n·l n·v); infinite on the horizon. Estevez & Kulla 2017, without their
/// softening of the terminator.
template <class T>
T charlie_visibility(const T& nl, const T& nv, const T& alpha) {
  return constant<T>(0.25) /
         ((constant<T>(1) + charlie_lambda(nl, alpha) + charlie_lambda(nv, alpha)) * nl * nv);
}

// Fresnel.

/// Schlick's weight of f90: Fc = (1 − c)⁵. Schlick 1994, eq. 15.
template <class T>
T schlick_weight(const T& cosine) {
  const T x = constant<T>(1) - cosine, square = x * x;
  return square * square * x;
}

/// F = f0 + (f90 − f0)(1 − c)⁵.
template <class T>
T fresnel_schlick(const T& f0, const T& f90, const T& cosine) {
  return f0 + (f90 - f0) * schlick_weight(cosine);
}

/// Unpolarised light at a boundary of transparent media, η = index behind over index in front, above 0:
///
///     F = (g − c)²/(2 (g + c)²) · (1 + ((c (g + c) − 1)/(c (g − c) + 1))²),  g² = η² + c² − 1
///
/// 1 where g² < 0: total reflection, for η < 1. Of precision near η = 1 too, as g − c = (η² − 1)/(g + c).
/// Cook & Torrance 1982.
template <class T>
T fresnel_dielectric(const T& cosine, const T& eta) {
  const T zero = constant<T>(0), one = constant<T>(1), step = (eta - one) * (eta + one);
  const T square = step + cosine * cosine;
  const T g = sqrt(max(square, zero)), sum = g + cosine;
  // Where both are 0 there is no boundary (η = 1) and nothing is reflected, or total reflection begins.
  const T difference = select(sum > zero, step / select(sum > zero, sum, one), zero);
  const T ratio = select(sum > zero, difference / select(sum > zero, sum, one), zero);
  const T parallel = (cosine * sum - one) / (cosine * difference + one);
  const T value = constant<T>(0.5) * ratio * ratio * (one + parallel * parallel);
  return select(square < zero, one, value);
}

/// Unpolarised light at a metal, whose index is n + ik over that of what is in front, n above 0, k not
/// negative: the mean of the two polarisations, with a² + b² = √((n² − k² − sin²)² + 4 n² k²). With k = 0 it
/// is fresnel_dielectric. Born & Wolf 1999, §14.2.
template <class T>
T fresnel_conductor(const T& cosine, const T& n, const T& k) {
  const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2);
  const T c2 = cosine * cosine, s2 = (one - cosine) * (one + cosine), n2 = n * n, k2 = k * k;
  const T real = (n - one) * (n + one) + c2 - k2, both = constant<T>(4) * n2 * k2;
  const T length = sqrt(real * real + both);
  // a² = (length + real)/2, without cancellation where real < 0.
  const T other = length - real;
  const T a_squared = select(real < zero, constant<T>(0.5) * both / select(other > zero, other, one),
                             constant<T>(0.5) * (length + real));
  const T a = sqrt(max(a_squared, zero));
  const auto quotient = [&](const T& less, const T& whole) {
    return select(whole > zero, less / select(whole > zero, whole, one), zero);
  };
  const T cross = two * a * cosine;
  const T s = quotient(length + c2 - cross, length + c2 + cross);
  const T with = c2 * length + s2 * s2, across = cross * s2;
  const T p_over_s = quotient(with - across, with + across);
  return constant<T>(0.5) * s * (one + p_over_s);
}

/// Reflectance along the normal, from η: ((η − 1)/(η + 1))².
template <class T>
T f0_of_eta(const T& eta) {
  const T ratio = (eta - constant<T>(1)) / (eta + constant<T>(1));
  return ratio * ratio;
}

/// The same of a metal: ((n − 1)² + k²)/((n + 1)² + k²).
template <class T>
T f0_of_conductor(const T& n, const T& k) {
  const T less = n - constant<T>(1), more = n + constant<T>(1);
  return (less * less + k * k) / (more * more + k * k);
}

}  // namespace welkin::brdf
