#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "welkin/math/vec.h"
#include "welkin/render/radiance.h"
#include "welkin/render/trace/surface.h"

/// The sheen of cloth (glTF's KHR_materials_sheen), over what lies under it: in paths, under lamps, and
/// looked up.
///
/// f = colour · D(n·h) V(n·l, n·v)/max(1, E(n·v), E(n·l)): Charlie's D (Estevez & Kulla 2017), V of Neubelt &
/// Pettineo 2013, and E their albedo (brdf::charlie_albedo), which is above 1 at grazing angles, where the
/// model makes light. The last factor takes that back, alike in both directions.
namespace welkin::scene {

/// Smoother cloth looks as this: its sheen is a line along outlines.
inline constexpr double kLeastSheenRoughness = 0.07;

/// Whether a surface has a sheen.
inline bool is_cloth(const MaterialPoint& at) {
  const auto& color = at.sheen_color;
  return std::max({color[0], color[1], color[2]}) > 0;
}

/// Integrals of f of white cloth over the light's direction.
struct SheenSum {
  double unbounded = 0;     ///< E of brdf::charlie_albedo
  double albedo = 0;        ///< Ē = ∫ f n·l dω ≤ min(1, E)
  double largest = 0;       ///< ∫ max(Ē(v), Ē(l)) n·l dω/π
  double along_normal = 0;  ///< ∫ f n·l (l·n) dω/Ē: of the mean direction
  double along_view = 0;    ///< the same across the normal, towards the viewer
};

/// They over n·v and roughness, from a table: absolute error 5e-3 at grazing angles, 1e-3 elsewhere.
class SheenSums {
 public:
  SheenSums();
  /// n·v is clamped to 0 … 1, roughness to kLeastSheenRoughness … 1.
  SheenSum at(double nv, double roughness) const;

 private:
  std::vector<SheenSum> texels_;
};
/// Made at first use.
const SheenSums& sheen_sums();

/// A surface's sheen as a viewer sees it. Directions are of the surface's own frame, with the normal at +z.
class Sheen {
 public:
  /// None, which lets all through.
  Sheen() = default;
  Sheen(const MaterialPoint& at, double nv);

  /// Whether there is any.
  explicit operator bool() const { return most_ > 0; }
  /// What is reflected of light from everywhere.
  Radiance albedo() const { return sum_.albedo * color_; }
  /// What is let through to what lies under it, and back: min(1 − c Ē(v), 1 − c Ē(l)), c the largest of the
  /// colour's components (brdf::sheen_albedo_scaling).
  double passed(double nl) const;
  /// The mean of `passed` of light from everywhere on a Lambertian surface.
  double passed_diffuse() const { return 1 - most_ * sum_.largest; }
  /// f, sr⁻¹; n·l above 0.
  Radiance value(const Vec3d& view, const Vec3d& light) const;

  /// A direction above the surface from two numbers of 0 … 1, and its density, sr⁻¹.
  /// @{
  static Vec3d draw(double u1, double u2);
  static double density(double nl);
  /// @}

  /// Where light that is filtered with the lobe `charlie` is looked up in place of the sheen's own lobe: the
  /// mean direction of both is the same, in direction and length, so that of worlds whose harmonics are of
  /// degree 0 and 1 the light is exact.
  struct LookUp {
    Vec3d direction;   ///< in the world, of unit length
    double roughness;  ///< of the lobe
  };
  LookUp look_up(const Surface& at) const;

 private:
  Radiance color_{};
  double most_ = 0, roughness_ = 1;
  SheenSum sum_;
};

}  // namespace welkin::scene
