#pragma once

#include <array>
#include <optional>

#include "welkin/render/path/ggx_lobe.h"
#include "welkin/render/path/glass_energy.h"
#include "welkin/render/radiance.h"
#include "welkin/render/shading/sheen.h"
#include "welkin/render/trace/surface.h"

namespace welkin::scene {

/// A direction that was drawn.
struct BsdfSample {
  Vec3d direction;       ///< away from the surface, of unit length
  Radiance weight;       ///< f |cos| / pdf; of a mirror's direction its reflectance over its probability
  double pdf = 0;        ///< probability per solid angle; of a mirror's direction 0
  bool mirror = false;   ///< one of finitely many directions: has no density
  bool through = false;  ///< on the side away from the viewer
};

/// How a material scatters light at one place (glTF 2.0's metallic-roughness model, as paths need it): what
/// MaterialShading approximates.
///
/// From the outside in: a clear coat (GGX, F₀ 0.04); the sheen of cloth (Sheen); below it, by shares,
/// - metal, and dielectric: GGX with Smith's correlated masking and Schlick's F, F₀ mixed of both; what is
///   scattered between facets more than once (Kulla & Conty 2017); under it a Lambertian base that gets what
///   the layer above lets through on the way in and out, (1 − R(v))(1 − R(l))/(1 − R̄);
/// - `transmission` of the dielectric: rough glass (Walter et al. 2007) with exact Fresnel reflectance, the
///   base colour's root at each boundary, so that a body of two has the colour; what such facets scatter more
///   than once goes to both sides (GlassEnergy).
///
/// Roughness below kMirrorRoughness is a mirror. Radiance is carried over boundaries by 1/η², as it is
/// compressed there.
///
/// **Laws**: f(v, l) = f(l, v) for two directions on one side; across, f(v, l) η² = f(l, v). ∫ f |cos| dω ≤ 1
/// (times 1/η² across), and = 1 for white materials without a coat, to the error of their tables.
/// What anisotropic facets lose is made up for by isotropic ones: to 3 % in the mean over azimuths.
/// A coat lets through min(1 − E(v), 1 − E(l)): up to 6 % is lost.
class Bsdf {
 public:
  static constexpr double kMirrorRoughness = 1e-3;

  explicit Bsdf(const Surface& at);

  /// f, sr⁻¹, without the cosine, of everything but mirrors. 0 for directions between the shaded and the flat
  /// surface.
  Radiance evaluate(const Vec3d& light) const;
  /// The probability per solid angle of `sample` drawing this direction, but for mirrors.
  double pdf(const Vec3d& light) const;
  /// A direction from three numbers in [0, 1): which lobe, and where in it. None where light is absorbed.
  std::optional<BsdfSample> sample(double lobe, double u1, double u2) const;
  /// Whether there is anything but mirrors.
  bool scatters() const;

 private:
  enum Lobe { coat, cloth, specular, multiple, diffuse, glass, glass_again, kLobes };
  static constexpr std::array kAll{coat, cloth, specular, multiple, diffuse, glass, glass_again};

  Vec3d to_local(const Vec3d& d) const;
  Vec3d to_world(const Vec3d& d) const;
  bool is_mirror(Lobe lobe) const;
  bool on_one_side(const Vec3d& world, const Vec3d& local) const;
  /// What the coat and the cloth below it let through.
  double below_coat(double cosine) const;
  /// What the coat lets through.
  double through_coat(double cosine) const;
  void share_with_sheen(double others);
  Radiance value(Lobe lobe, const Vec3d& light) const;
  double density(Lobe lobe, const Vec3d& light) const;
  std::optional<BsdfSample> mirrored(Lobe lobe, double u) const;
  std::optional<Vec3d> drawn(Lobe lobe, double u, double u1, double u2) const;
  Vec3d flat_side(const Vec3d& world) const;
  void set_glass_losses(double ior, bool from_behind);
  /// Where light that glass scatters more than once comes from: ∫ again |cos| dω = 1.
  double again(double cosine) const;

  Vec3d tangent_, bitangent_, normal_, flat_;  // the frame, in the world; the triangle's normal
  Vec3d view_;                                 // in the frame
  GgxFacets facets_, coat_facets_;
  Sheen sheen_;
  double roughness_, coat_roughness_;
  double coat_, glass_, eta_;
  Radiance tint_;                                              // of a boundary of glass
  Radiance f0_, often_, base_;                                 // of the opaque share
  Radiance mean_under_;                                        // 1 − R̄, channel by channel
  double f90_, opaque_, lost_view_, mean_lost_, coat_albedo_;  // 1 − E(v), 1 − Ē
  const GlassLoss *before_ = nullptr, *behind_ = nullptr;      // of rough glass
  double lost_in_glass_ = 0, again_through_ = 0;  // of the viewer's direction; the share that is let through
  std::array<double, kLobes> probability_{};

  Radiance reflectance(double cosine) const;
};

}  // namespace welkin::scene
