#pragma once

#include <array>

#include "welkin/base/export.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/math/vec.h"
#include "welkin/scene/scene.h"

/// @file
/// What a ray meets: a place on a surface, what it is made of there, and how both change from pixel to pixel
/// (ray differentials: Igehy 1999).
namespace welkin::scene {

/// How a vector changes from a pixel to the next.
struct Change {
  Vec3d right = {0, 0, 0};  ///< to the one at its right
  Vec3d down = {0, 0, 0};   ///< to the one below
};

/// A ray, and how it changes from pixel to pixel.
struct RaySpread {
  Vec3d origin;             ///< in the world
  Vec3d direction;          ///< of unit length
  Change origin_change;     ///< 0 of a pinhole
  Change direction_change;  ///< of the unit vector
};

/// A material at one place, its pictures looked up.
struct MaterialPoint {
  const Material* material;          ///< where it is from
  std::array<float, 3> base_color;   ///< as Material
  std::array<float, 3> emission;     ///< as Material
  float alpha;                       ///< as Material
  float metallic;                    ///< as Material
  float roughness;                   ///< as Material
  float transmission;                ///< as Material
  float clearcoat;                   ///< as Material
  float clearcoat_roughness;         ///< as Material
  std::array<float, 3> sheen_color;  ///< as Material
  float sheen_roughness;             ///< as Material
  float anisotropy;                  ///< as Material
  float anisotropy_angle;            ///< as Material
};

/// A material where it wears no pictures.
inline MaterialPoint point_of(const Material& material) {
  return {&material,
          material.base_color,
          material.emission,
          material.alpha,
          material.metallic,
          material.roughness,
          material.transmission,
          material.clearcoat,
          material.clearcoat_roughness,
          material.sheen_color,
          material.sheen_roughness,
          material.anisotropy,
          material.anisotropy_angle};
}

/// A place on a surface, seen from somewhere.
struct Surface {
  Vec3d position;                  ///< in the world
  Change position_change;          ///< along the plane of the triangle
  Vec3d flat_normal;               ///< the triangle's, on the viewer's side, of unit length
  Vec3d normal;                    ///< as shaded, on the viewer's side, of unit length
  Change normal_change;            ///< of the unit vector, without a normal map's
  Vec3d tangent;                   ///< across `normal`, along the picture's u, of unit length
  Vec3d bitangent;                 ///< across both
  Vec3d view;                      ///< towards the viewer, of unit length
  Change view_change;              ///< of the unit vector
  std::array<double, 2> uv;        ///< texture coordinates, set 0; 0 where there are none
  std::array<double, 2> uv_right;  ///< their change to the pixel at the right
  std::array<double, 2> uv_down;   ///< to the one below
  /// Of the normals that a normal map has within the pixel, per axis: tilts, radians². The mean normal's
  /// length is exp(−variance).
  double normal_variance = 0;
  bool from_behind = false;    ///< whether the triangle's back is seen
  std::uint32_t instance = 0;  ///< of Scene::instances
  MaterialPoint material;      ///< what is there
};

/// The direction across `normal` along which an anisotropic surface is rougher, and the one across both, of
/// unit length.
struct Grain {
  Vec3d along;   ///< of larger α
  Vec3d across;  ///< of the material's own
};
/// By the surface's tangents and its material's angle.
WELKIN_API Grain grain_of(const Surface& surface);

/// The direction in which a mirror reflects what the viewer sees, r = 2(n·v)n − v, and how it changes.
WELKIN_API RayDifferential reflected(const Surface& surface);

/// The direction in which a ray from the viewer goes on behind the surface, bent once (Snell's law), and how
/// it changes; the reflected one where it is reflected totally. `eta`: index behind over index in front.
WELKIN_API RayDifferential refracted(const Surface& surface, double eta);

}  // namespace welkin::scene
