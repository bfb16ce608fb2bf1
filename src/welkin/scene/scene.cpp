#include "welkin/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/math/vec_precision.h"

namespace welkin::scene {
namespace {

bool finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw Error(ErrorKind::bad_request, what + " " + why);
}

void check_use(const PictureUse& use, std::size_t pictures, const std::string& material) {
  if (use.picture < -1 || use.picture >= static_cast<int>(pictures))
    refuse(material, "wears a picture that there isn't");
  if (use.uv_set < 0 || use.uv_set > 1) refuse(material, "asks for a set of texture coordinates over 1");
}

void check_material(const Material& material, std::size_t pictures) {
  const std::string what = "material '" + material.name + "'";
  for (const auto use : kPictureUses) check_use(material.*use, pictures, what);
  const float shares[] = {material.alpha,
                          material.metallic,
                          material.roughness,
                          material.clearcoat,
                          material.clearcoat_roughness,
                          material.transmission,
                          material.anisotropy,
                          material.sheen_roughness};
  for (const float share : shares)
    if (!(share >= 0 && share <= 1)) refuse(what, "has a share or roughness outside 0 … 1");
  if (!(material.ior >= 1 && std::isfinite(material.ior))) refuse(what, "has an index of refraction below 1");
  for (const auto& colour : {material.base_color, material.emission, material.sheen_color})
    for (const float value : colour)
      if (!(value >= 0 && std::isfinite(value))) refuse(what, "has a colour that is negative or not finite");
}

void check_mesh(const Mesh& mesh, std::size_t materials) {
  const std::string what = "mesh '" + mesh.name + "'";
  const std::size_t vertices = mesh.positions.size();
  if (mesh.material < 0 || mesh.material >= static_cast<int>(materials))
    refuse(what, "is of a material that there isn't");
  const auto one_each = [&](std::size_t count, const char* of) {
    if (count != 0 && count != vertices) refuse(what, std::string("has other numbers of vertices and ") + of);
  };
  one_each(mesh.normals.size(), "normals");
  one_each(mesh.tangents.size(), "tangents");
  for (const auto& set : mesh.uv) one_each(set.size(), "texture coordinates");
  one_each(mesh.colors.size(), "colours");
  for (const auto& color : mesh.colors)
    for (const float value : color)
      if (!(value >= 0 && std::isfinite(value)))
        refuse(what, "has a vertex whose colour is negative or not finite");
  for (const Vec3<float>& position : mesh.positions)
    if (!finite(to_double(position))) refuse(what, "has a vertex that is not finite");
  for (const Vec3<float>& normal : mesh.normals)
    if (!(std::abs(length(to_double(normal)) - 1) < 0.01))
      refuse(what, "has a normal that is not of unit length");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle)
      if (index >= vertices) refuse(what, "has a triangle of a vertex that there isn't");
}

}  // namespace

Vec3d point_to(const Transform& to, const Vec3d& point) {
  return to.linear * point + to.origin;
}

Vec3d normal_to(const Transform& to, const Vec3d& normal) {
  // The cofactors: the inverse transposed, times the determinant.
  const auto& m = to.linear.rows;
  const Vec3d a{m[0][0], m[0][1], m[0][2]}, b{m[1][0], m[1][1], m[1][2]}, c{m[2][0], m[2][1], m[2][2]};
  const Vec3d turned{dot(cross(b, c), normal), dot(cross(c, a), normal), dot(cross(a, b), normal)};
  return determinant(to.linear) < 0 ? -1.0 * turned : turned;
}

Transform operator*(const Transform& second, const Transform& first) {
  return {second.linear * first.linear, point_to(second, first.origin)};
}

void Scene::check() const {
  for (const Picture& picture : pictures)
    if (picture.image.width() < 1 || picture.image.channels() > 4)
      refuse("picture '" + picture.name + "'", "has no texels, or more than four channels");
  for (const Material& material : materials) check_material(material, pictures.size());
  for (const Mesh& mesh : meshes) check_mesh(mesh, materials.size());
  for (const Instance& instance : instances) {
    const std::string what = "instance '" + instance.name + "'";
    if (instance.mesh < 0 || instance.mesh >= static_cast<int>(meshes.size()))
      refuse(what, "is of a mesh that there isn't");
    if (instance.material < -1 || instance.material >= static_cast<int>(materials.size()))
      refuse(what, "is of a material that there isn't");
    const double volume = determinant(instance.to_world.linear);
    if (!std::isfinite(volume) || volume == 0 || !finite(instance.to_world.origin))
      refuse(what, "stands where its mesh has no volume, or nowhere");
  }
}

bool has_sheen(const Scene& scene) {
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
    const auto& color = material_of(scene, instance).sheen_color;
    return std::max({color[0], color[1], color[2]}) > 0;
  });
}

std::optional<Bounds> bounds_of(const Scene& scene) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Bounds box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes.at(static_cast<std::size_t>(instance.mesh));
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t index : triangle) {
        const Vec3d p = point_to(instance.to_world, to_double(mesh.positions.at(index)));
        box.least = {std::min(box.least.x, p.x), std::min(box.least.y, p.y), std::min(box.least.z, p.z)};
        box.most = {std::max(box.most.x, p.x), std::max(box.most.y, p.y), std::max(box.most.z, p.z)};
      }
    }
  }
  if (!(box.least.x <= box.most.x)) return std::nullopt;
  return box;
}

std::vector<Transform> turned_places(const Scene& scene, double degrees) {
  std::vector<Transform> places;
  const auto box = bounds_of(scene);
  const Vec3d middle = box ? 0.5 * (box->least + box->most) : Vec3d{0, 0, 0};
  const Matrix3 turn = rotation_from_yaw_pitch_roll(degrees, 0, 0);
  const Transform about{turn, middle - turn * middle};
  for (const Instance& instance : scene.instances) places.push_back(about * instance.to_world);
  return places;
}

std::uint64_t triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Instance& instance : scene.instances)
    count += scene.meshes.at(static_cast<std::size_t>(instance.mesh)).triangles.size();
  return count;
}

}  // namespace welkin::scene
