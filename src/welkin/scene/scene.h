#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/math/rotation.h"
#include "welkin/math/vec.h"

/// @file
/// Scenes: triangles, what they are made of, and where they stand. Right-handed, +Y up, as the world of maps;
/// lengths have no unit of their own.
namespace welkin::scene {

/// How a picture goes on past its edges.
enum class Wrap {
  repeat,  ///< from the other edge
  mirror,  ///< turned over
  clamp,   ///< its outermost texels
};

/// A picture that surfaces wear. Values are linear; u goes right, v down, (0, 0) the top left corner.
struct Picture {
  std::string name;            ///< for messages
  Image image;                 ///< 1 to 4 channels
  Wrap across = Wrap::repeat;  ///< left and right
  Wrap down = Wrap::repeat;    ///< up and down
};

/// Where a material's value comes from a picture: uv' = offset + rotation(angle) · (scale · uv).
struct PictureUse {
  int picture = -1;                     ///< of Scene::pictures; −1: none
  int uv_set = 0;                       ///< 0 or 1: of Mesh::uv
  std::array<float, 2> offset = {};     ///< added last
  std::array<float, 2> scale = {1, 1};  ///< multiplied first
  float angle = 0;                      ///< counterclockwise about (0, 0) in the picture, radians

  /// Whether there is one.
  explicit operator bool() const { return picture >= 0; }
};

/// What a surface is made of, as in glTF 2.0 and its extensions: a picture's value multiplies the number
/// beside it.
struct Material {
  std::string name;                             ///< for messages, and for choosing it
  std::array<float, 3> base_color = {1, 1, 1};  ///< reflectance: diffuse, or of a metal along the normal
  float alpha = 1;                              ///< coverage
  float metallic = 0;                           ///< 0 … 1
  float roughness = 1;                          ///< 0 … 1; α of GGX is its square
  std::array<float, 3> emission = {};           ///< radiance that it gives off
  float ior = 1.5f;                             ///< index of refraction, ≥ 1
  float transmission = 0;                       ///< the share of what isn't reflected that passes through
  float clearcoat = 0;                          ///< weight of a coat of ior 1.5
  float clearcoat_roughness = 0;                ///< of the coat
  std::array<float, 3> sheen_color = {};        ///< of cloth, over all but the coat
  float sheen_roughness = 0;                    ///< of cloth, 0 … 1; α of Charlie is its square
  float anisotropy = 0;                         ///< strength, 0 … 1: α grows to 1 along its direction
  float anisotropy_angle = 0;                   ///< from the tangent, counterclockwise, radians
  float normal_scale = 1;                       ///< of the normal map's x and y
  float alpha_cutoff = 0.5f;                    ///< of `masked`
  bool masked = false;                          ///< alpha is 0 or 1, cut at the cut-off
  bool blended = false;                         ///< alpha is coverage; where neither is set it counts as 1
  bool two_sided = false;                       ///< seen from behind as well
  PictureUse base_map = {};                     ///< R G B × base_color, A × alpha
  PictureUse metallic_roughness_map = {};       ///< G × roughness, B × metallic
  PictureUse normal_map = {};                   ///< R G B = (n + 1)/2 in the frame of tangents
  PictureUse emission_map = {};                 ///< R G B × emission
  PictureUse transmission_map = {};             ///< R × transmission
  PictureUse clearcoat_map = {};                ///< R × clearcoat
  PictureUse clearcoat_roughness_map = {};      ///< G × clearcoat_roughness
  PictureUse sheen_color_map = {};              ///< R G B × sheen_color
  PictureUse sheen_roughness_map = {};          ///< A × sheen_roughness
  PictureUse anisotropy_map = {};  ///< R G = (d + 1)/2, turned by anisotropy_angle; B × anisotropy
  bool unlit = false;              ///< emission is its base colour, by which vertices' colours multiply too
};

/// Triangles of one material.
struct Mesh {
  std::string name;                            ///< for messages
  std::vector<Vec3<float>> positions;          ///< of vertices
  std::vector<Vec3<float>> normals;            ///< one a vertex, of unit length; empty: flat triangles
  std::vector<std::array<float, 4>> tangents;  ///< x, y, z and ±1: bitangent = ±1 · n × t; may be empty
  std::vector<std::array<float, 2>> uv[2];     ///< two sets; may be empty
  std::vector<std::array<float, 4>> colors;    ///< × base colour and alpha, linear; empty: white
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise seen from the front
  int material = 0;                                     ///< of Scene::materials
};

/// A linear map and a shift: linear · p + origin.
struct Transform {
  Matrix3 linear = {};       ///< invertible; needn't be a rotation
  Vec3d origin = {0, 0, 0};  ///< where the mesh's origin stands
};

/// Points, directions of surfaces' normals (of any length), and transforms one after the other.
/// @{
WELKIN_API Vec3d point_to(const Transform& to, const Vec3d& point);
WELKIN_API Vec3d normal_to(const Transform& to, const Vec3d& normal);
WELKIN_API Transform operator*(const Transform& second, const Transform& first);
/// @}

/// A mesh somewhere.
struct Instance {
  std::string name;         ///< of the node; for choosing it
  int mesh = 0;             ///< of Scene::meshes
  Transform to_world = {};  ///< from the mesh's space
  int material = -1;        ///< in place of the mesh's; −1: the mesh's
};

/// A camera of the scene: perspective.
struct SceneCamera {
  std::string name;                   ///< for choosing it
  Vec3d position = {0, 0, 0};         ///< in the world
  Matrix3 rotation = {};              ///< as Camera::rotation: right −X, up +Y, ahead +Z to the world
  double vertical_fov = 45;           ///< degrees
  std::optional<double> aspect = {};  ///< width over height
};

/// A light without extent.
struct PointLight {
  /// How it shines.
  enum class Kind {
    point,        ///< shines all around
    spot,         ///< within a cone
    directional,  ///< from infinitely far
  };
  Kind kind = Kind::point;                     ///< which
  std::string name;                            ///< for messages
  Vec3d position = {0, 0, 0};                  ///< of point and spot
  Vec3d direction = {0, -1, 0};                ///< in which spot and directional shine, of unit length
  std::array<float, 3> intensity = {1, 1, 1};  ///< radiant intensity, or of directional the irradiance
  double inner_cone = 0;                       ///< spot: half-angle of full light, radians
  double outer_cone = kPi / 4;                 ///< spot: half-angle beyond which there is none, radians
};

/// All of it. Moved, not copied.
struct Scene {
  std::vector<Picture> pictures;      ///< worn by materials
  std::vector<Material> materials;    ///< at least one where there are meshes
  std::vector<Mesh> meshes;           ///< shapes
  std::vector<Instance> instances;    ///< what is seen
  std::vector<SceneCamera> cameras;   ///< to choose from
  std::vector<PointLight> lights;     ///< besides the world's
  std::vector<std::string> warnings;  ///< what reading left out or mended, each said once

  /// Throws Error (bad_request), naming the mesh or material, unless all indices are of something, arrays of
  /// one mesh have one length, numbers are finite, and normals of unit length to 1 %.
  WELKIN_API void check() const;
};

/// What an instance is made of. Indices are those of the scene.
inline const Material& material_of(const Scene& scene, const Instance& instance) {
  const int own = scene.meshes[static_cast<std::size_t>(instance.mesh)].material;
  return scene.materials[static_cast<std::size_t>(instance.material >= 0 ? instance.material : own)];
}

/// All pictures that a material can wear.
inline constexpr std::array kPictureUses = {
    &Material::base_map,
    &Material::metallic_roughness_map,
    &Material::normal_map,
    &Material::emission_map,
    &Material::transmission_map,
    &Material::clearcoat_map,
    &Material::clearcoat_roughness_map,
    &Material::sheen_color_map,
    &Material::sheen_roughness_map,
    &Material::anisotropy_map,
};

/// Whether anything that is seen can have a sheen.
WELKIN_API bool has_sheen(const Scene& scene);

/// The box around all instances.
struct Bounds {
  Vec3d least;  ///< of each coordinate
  Vec3d most;   ///< of each coordinate
};
/// None of a scene without triangles.
WELKIN_API std::optional<Bounds> bounds_of(const Scene& scene);

/// The places of all instances when the scene has turned by an angle about the vertical through the middle of
/// its bounds, as on a turntable: degrees, counterclockwise seen from above.
WELKIN_API std::vector<Transform> turned_places(const Scene& scene, double degrees);

/// Triangles of all instances.
WELKIN_API std::uint64_t triangle_count(const Scene& scene);

}  // namespace welkin::scene
