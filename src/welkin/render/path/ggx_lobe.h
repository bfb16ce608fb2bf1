#pragma once

#include <algorithm>
#include <cmath>

#include "welkin/math/vec.h"

/// GGX's microfacets in the frame of the surface, +z its normal, for drawing directions; brdf/microfacet.h
/// has the isotropic terms that they agree with.
namespace welkin::scene {

/// Flatter directions of a viewer are lifted to this n·v.
inline constexpr double kLeastCosine = 1e-4;

/// Facets of slopes' widths `x` and `y` (α of each axis), above 0.
struct GgxFacets {
  double x;
  double y;

  /// D, sr⁻¹. Heitz 2014, eq. 85.
  double distribution(const Vec3d& h) const {
    const double sx = h.x / x, sy = h.y / y, sum = sx * sx + sy * sy + h.z * h.z;
    return 1 / (kPi * x * y * sum * sum);
  }
  /// Smith's Λ of a direction on either side. Heitz 2014, eq. 86.
  double lambda(const Vec3d& d) const {
    const double ax = x * d.x, ay = y * d.y;
    return 0.5 * (std::sqrt(1 + (ax * ax + ay * ay) / (d.z * d.z)) - 1);
  }
  double g1(const Vec3d& d) const { return 1 / (1 + lambda(d)); }
  /// Masking and shadowing of two directions on one side, correlated by height.
  double g2(const Vec3d& a, const Vec3d& b) const { return 1 / (1 + lambda(a) + lambda(b)); }
  /// The density of normals that `view` sees, sr⁻¹: G1 D (v·h)/(n·v). Heitz 2018, eq. 1.
  double visible(const Vec3d& view, const Vec3d& h) const {
    return g1(view) * distribution(h) * std::max(0.0, dot(view, h)) / view.z;
  }

  /// A normal of that density from two numbers in [0, 1). Heitz 2018, appendix A.
  Vec3d draw(const Vec3d& view, double u1, double u2) const {
    const Vec3d stretched = normalize(Vec3d{x * view.x, y * view.y, view.z});
    const double square = stretched.x * stretched.x + stretched.y * stretched.y;
    const Vec3d across =
        square > 0 ? (1 / std::sqrt(square)) * Vec3d{-stretched.y, stretched.x, 0} : Vec3d{1, 0, 0};
    const Vec3d other = cross(stretched, across);
    const double r = std::sqrt(u1), phi = 2 * kPi * u2, s = 0.5 * (1 + stretched.z);
    const double t1 = r * std::cos(phi);
    const double t2 = (1 - s) * std::sqrt(std::max(0.0, 1 - t1 * t1)) + s * r * std::sin(phi);
    const Vec3d half = t1 * across + t2 * other + std::sqrt(std::max(0.0, 1 - t1 * t1 - t2 * t2)) * stretched;
    return normalize(Vec3d{x * half.x, y * half.y, std::max(1e-12, half.z)});
  }
};

/// Of a glTF material: α is the roughness' square, which along the grain grows to 1 with the anisotropy's
/// square (KHR_materials_anisotropy). α is `least` at least.
inline GgxFacets ggx_facets(double roughness, double anisotropy, double least) {
  const double alpha = std::max(roughness * roughness, least);
  return {alpha + (1 - alpha) * anisotropy * anisotropy, alpha};
}

/// The roughness of isotropic facets that reflect as much, to 3 % in the mean over azimuths: α² is the mean
/// of both.
inline double mean_roughness(const GgxFacets& facets) {
  return std::pow((facets.x * facets.x + facets.y * facets.y) / 2, 0.25);
}

}  // namespace welkin::scene
