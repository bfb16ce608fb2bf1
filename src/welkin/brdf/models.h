#pragma once

#include <algorithm>
#include <cmath>

#include "welkin/brdf/microfacet.h"
#include "welkin/lobe/angle.h"
#include "welkin/math/vec.h"

/// The BRDFs that have a formula, one struct each: parameters that are visited, `value(view, light)` for
/// directions above the surface, `width()`.
namespace welkin::brdf {

/// The half vector, unit length. view + light isn't 0: both are above the surface.
inline Vec3d half_vector(const Vec3d& view, const Vec3d& light) {
  return normalize(view + light);
}

/// D · V · F of GGX with Smith's masking, correlated by height; α = roughness².
struct GgxBrdf {
  static constexpr const char* kName = "ggx";
  static constexpr const char* kDescription = "microfacets of GGX with height-correlated masking, D·V·F";
  static constexpr const char* kSource =
      "Trowbridge & Reitz 1975; Walter et al. 2007, eq. 33; Heitz 2014, eq. 99; Fresnel: Schlick 1994";

  double roughness = 0.5, f0 = 1;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("roughness", roughness, 0.0, 1.0, "√α; 0 is a mirror");
    visit("f0", f0, 0.0, 1.0, "reflectance along the normal, by Schlick's Fresnel term; 1: all is reflected");
  }

  double value(const Vec3d& view, const Vec3d& light) const {
    const Vec3d h = half_vector(view, light);
    const double alpha = roughness * roughness;
    return ggx_distribution_from_sine(h.x * h.x + h.y * h.y, alpha) *
           ggx_visibility_correlated(light.z, view.z, alpha) * fresnel_schlick(f0, 1.0, dot(view, h));
  }
  double width() const { return 2 * roughness * roughness; }
};

/// exp(−tan²θh/α²)/(4π α² √(cos θi cos θr)); α = roughness².
struct WardBrdf {
  static constexpr const char* kName = "ward";
  static constexpr const char* kDescription = "Ward's isotropic Gaussian of the half vector's slope";
  static constexpr const char* kSource = "Ward 1992, eq. 4";

  double roughness = 0.5;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("roughness", roughness, 0.0, 1.0, "√α, α the slope's standard deviation times √2; 0 is a mirror");
  }

  double value(const Vec3d& view, const Vec3d& light) const {
    const Vec3d h = half_vector(view, light);
    const double square = roughness * roughness * roughness * roughness;
    const double slope = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    return std::exp(-slope / square) / (4 * kPi * square * std::sqrt(light.z * view.z));
  }
  double width() const { return 2 * roughness * roughness; }
};

}  // namespace welkin::brdf
