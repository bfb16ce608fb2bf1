#pragma once

#include <vector>

namespace welkin::scene {

/// What rough glass, seen from one side, loses of even light by counting each ray's first facet alone: 1 − E,
/// E what GGX's facets (Walter et al. 2007, exact Fresnel reflectance) reflect and let through once.
class GlassLoss {
 public:
  /// `eta` is the index behind the surface over that before it.
  explicit GlassLoss(double eta);

  /// n·v and roughness (√α) are clamped to 0 … 1. Absolute error 2e-3, 5e-3 at grazing angles.
  double at(double cosine, double roughness) const;
  /// The mean over the hemisphere of what `at` gives, 2 ∫ … μ dμ, exactly.
  double average(double roughness) const;

 private:
  std::vector<double> losses_;    // roughness by roughness, over the root of the cosine
  std::vector<double> averages_;  // of each roughness
};

/// How what rough glass scatters more than once leaves it (Kulla & Conty 2017, for dielectrics): on both
/// sides with its loss as the direction's weight, so that even light stays even, and f(v, l) η² = f(l, v)
/// across.
class GlassEnergy {
 public:
  /// `ior` is the index of the inside; outside is 1.
  explicit GlassEnergy(double ior);

  /// Of the side that the viewer is on.
  const GlassLoss& before(bool from_behind) const { return from_behind ? inside_ : outside_; }
  const GlassLoss& behind(bool from_behind) const { return from_behind ? outside_ : inside_; }
  /// The share of the viewer's loss that is let through; the rest is reflected.
  double through(bool from_behind, double roughness) const;

 private:
  double ior_;
  GlassLoss outside_, inside_;
  double mean_let_through_;  // of one facet, from the outside, over the hemisphere
};

/// Made when an index is first asked for: some 150 ms.
const GlassEnergy& glass_energy(double ior);

}  // namespace welkin::scene
