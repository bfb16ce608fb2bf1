#include <algorithm>
#include <cmath>

#include "welkin/math/unit_vector.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/trace/traced_scene_state.h"

namespace welkin::scene {
std::array<float, 4> TracedScene::State::look_up(const PictureUse& use,
                                                 const std::array<std::array<double, 2>, 3> (&uv)[2]) const {
  const auto& set = uv[use.uv_set];
  const double c = std::cos(use.angle), s = std::sin(use.angle);
  const auto turned = [&](const std::array<double, 2>& d) -> std::array<double, 2> {
    const double x = d[0] * use.scale[0], y = d[1] * use.scale[1];
    return {c * x + s * y, -s * x + c * y};
  };
  std::array<double, 2> at = turned(set[0]);
  at[0] += use.offset[0];
  at[1] += use.offset[1];
  return shared->textures[static_cast<std::size_t>(use.picture)].mean(at, turned(set[1]), turned(set[2]));
}

MaterialPoint TracedScene::State::material_at(const Material& material, const std::array<float, 4>& color,
                                              const std::array<std::array<double, 2>, 3> (&uv)[2]) const {
  MaterialPoint point = point_of(material);
  const auto times = [](std::array<float, 3>& value, const std::array<float, 4>& by) {
    for (std::size_t c = 0; c < 3; ++c) value[c] *= by[c];
  };
  times(point.base_color, color);
  point.alpha *= color[3];
  if (material.unlit) times(point.emission, color);
  if (material.base_map) {
    const auto value = look_up(material.base_map, uv);
    times(point.base_color, value);
    point.alpha *= value[3];
  }
  if (material.metallic_roughness_map) {
    const auto value = look_up(material.metallic_roughness_map, uv);
    point.roughness *= value[1];
    point.metallic *= value[2];
  }
  if (material.emission_map) times(point.emission, look_up(material.emission_map, uv));
  if (material.transmission_map) point.transmission *= look_up(material.transmission_map, uv)[0];
  if (material.clearcoat_map) point.clearcoat *= look_up(material.clearcoat_map, uv)[0];
  if (material.clearcoat_roughness_map)
    point.clearcoat_roughness *= look_up(material.clearcoat_roughness_map, uv)[1];
  if (material.sheen_color_map) times(point.sheen_color, look_up(material.sheen_color_map, uv));
  if (material.sheen_roughness_map) point.sheen_roughness *= look_up(material.sheen_roughness_map, uv)[3];
  if (material.anisotropy_map) {
    const auto value = look_up(material.anisotropy_map, uv);
    point.anisotropy *= value[2];
    point.anisotropy_angle += std::atan2(2 * value[1] - 1, 2 * value[0] - 1);
  }
  for (float* share : {&point.metallic, &point.roughness, &point.transmission, &point.clearcoat, &point.alpha,
                       &point.clearcoat_roughness, &point.sheen_roughness, &point.anisotropy})
    *share = std::clamp(*share, 0.0f, 1.0f);
  if (material.masked) point.alpha = point.alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
  if (!material.masked && !material.blended) point.alpha = 1;
  return point;
}

void TracedScene::State::bend_normal(Surface& at, const std::array<std::array<double, 2>, 3> (&uv)[2]) const {
  const Material& material = *at.material.material;
  const auto value = look_up(material.normal_map, uv);
  const double scale = material.normal_scale;
  const Vec3d bent{scale * (2 * value[0] - 1), scale * (2 * value[1] - 1), 2.0 * value[2] - 1};
  const double size = length(bent);
  if (!(size > 1e-6)) return;
  // Pictures hold unit vectors to a part in 256 or so.
  at.normal_variance = size < 0.995 ? -std::log(size) : 0;
  at.normal = normalize(bent.x * at.tangent + bent.y * at.bitangent + bent.z * at.normal);
}

Surface TracedScene::surface(const RaySpread& ray, const Hit& hit, Reflection reflection) const {
  const WorldMesh& mesh = state_->meshes[hit.instance];
  const auto& triangle = mesh.triangles[hit.triangle];
  const Vec3d p0 = to_double(mesh.positions[triangle[0]]);
  const Vec3d e1 = to_double(mesh.positions[triangle[1]]) - p0,
              e2 = to_double(mesh.positions[triangle[2]]) - p0;
  const double b1 = hit.b1, b2 = hit.b2;
  Surface at{};
  at.instance = hit.instance;
  at.position = p0 + b1 * e1 + b2 * e2;
  at.view = -1.0 * ray.direction;
  at.view_change = {-1.0 * ray.direction_change.right, -1.0 * ray.direction_change.down};
  const Vec3d front = unit_or(cross(e1, e2), at.view);
  at.from_behind = dot(front, at.view) < 0;
  const double side = at.from_behind ? -1 : 1;
  at.flat_normal = side * front;

  // The ray's neighbours meet the triangle's plane, and there have weights of the vertices.
  const double facing = dot(front, ray.direction);
  const double g11 = dot(e1, e1), g12 = dot(e1, e2), g22 = dot(e2, e2), area = g11 * g22 - g12 * g12;
  const auto moved = [&](const Vec3d& origin, const Vec3d& direction) {
    const Vec3d shift = origin + static_cast<double>(hit.distance) * direction;
    return std::abs(facing) > 1e-6 ? shift - (dot(shift, front) / facing) * ray.direction : shift;
  };
  at.position_change = {moved(ray.origin_change.right, ray.direction_change.right),
                        moved(ray.origin_change.down, ray.direction_change.down)};
  const auto weights = [&](const Vec3d& shift) -> std::array<double, 2> {
    if (!(area > 0)) return {0, 0};
    const double s1 = dot(shift, e1), s2 = dot(shift, e2);
    return {(g22 * s1 - g12 * s2) / area, (g11 * s2 - g12 * s1) / area};
  };
  const auto right = weights(at.position_change.right), down = weights(at.position_change.down);

  std::array<std::array<double, 2>, 3> uv[2] = {};  // of each set: the value, its changes right and down
  std::array<double, 2> uv_e1{}, uv_e2{};
  for (std::size_t set = 0; set < 2; ++set) {
    const auto& values = mesh.mesh->uv[set];
    if (values.empty()) continue;
    for (std::size_t c = 0; c < 2; ++c) {
      const double t0 = values[triangle[0]][c], t1 = values[triangle[1]][c] - t0,
                   t2 = values[triangle[2]][c] - t0;
      uv[set][0][c] = t0 + b1 * t1 + b2 * t2;
      uv[set][1][c] = right[0] * t1 + right[1] * t2;
      uv[set][2][c] = down[0] * t1 + down[1] * t2;
      if (set == 0) {
        uv_e1[c] = t1;
        uv_e2[c] = t2;
      }
    }
  }
  at.uv = uv[0][0];
  at.uv_right = uv[0][1];
  at.uv_down = uv[0][2];

  at.normal = at.flat_normal;
  if (!mesh.normals.empty()) {
    const Vec3d n0 = to_double(mesh.normals[triangle[0]]);
    const Vec3d d1 = to_double(mesh.normals[triangle[1]]) - n0,
                d2 = to_double(mesh.normals[triangle[2]]) - n0;
    const Vec3d sum = n0 + b1 * d1 + b2 * d2;
    const double size = length(sum);
    if (size > 1e-3) {
      const Vec3d n = (1 / size) * sum;
      const auto change = [&](const std::array<double, 2>& by) {
        const Vec3d whole = (side / size) * (by[0] * d1 + by[1] * d2);
        return whole - dot(n, whole) * n;
      };
      at.normal = side * n;
      at.normal_change = {change(right), change(down)};
    }
  }
  if (reflection == Reflection::per_vertex && !mesh.normals.empty()) {
    Vec3d sum{0, 0, 0};
    const double weight[] = {1 - b1 - b2, b1, b2};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d n = side * to_double(mesh.normals[triangle[k]]);
      const Vec3d v = unit_or(ray.origin - to_double(mesh.positions[triangle[k]]), at.view);
      sum = sum + weight[k] * (2 * dot(n, v) * n - v);
    }
    at.normal = unit_or(unit_or(sum, at.normal) + at.view, at.normal);
  }

  const double det = uv_e1[0] * uv_e2[1] - uv_e1[1] * uv_e2[0];
  Vec3d along = {0, 0, 0}, other = {0, 0, 0};
  double handed = 1;
  if (!mesh.tangents.empty()) {
    const auto& t0 = mesh.tangents[triangle[0]];
    const auto& t1 = mesh.tangents[triangle[1]];
    const auto& t2 = mesh.tangents[triangle[2]];
    const auto mixed = [&](std::size_t c) { return t0[c] + b1 * (t1[c] - t0[c]) + b2 * (t2[c] - t0[c]); };
    along = {mixed(0), mixed(1), mixed(2)};
    handed = t0[3] < 0 ? -1 : 1;
  } else if (std::abs(det) > 1e-20) {
    along = (1 / det) * (uv_e2[1] * e1 - uv_e1[1] * e2);
    // v goes down in pictures, bitangents up.
    other = (-1 / det) * (uv_e1[0] * e2 - uv_e2[0] * e1);
    handed = dot(cross(side * at.normal, along), other) < 0 ? -1 : 1;
  }
  const Vec3d level = along - dot(along, at.normal) * at.normal;
  const double long_enough = length(level);
  at.tangent = long_enough > 1e-300 ? (1 / long_enough) * level : across(at.normal);
  at.bitangent = (handed * side) * cross(at.normal, at.tangent);
  std::array<float, 4> color{1, 1, 1, 1};
  if (const auto& colors = mesh.mesh->colors; !colors.empty()) {
    const float weight[] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
    color = {};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 4; ++c) color[c] += weight[k] * colors[triangle[k]][c];
  }
  at.material = state_->material_at(*mesh.material, color, uv);
  if (mesh.material->normal_map) state_->bend_normal(at, uv);

  // Near outlines interpolated normals turn away from the viewer.
  constexpr double kLeastCosine = 1e-3;
  const double cosine = dot(at.normal, at.view);
  if (cosine < kLeastCosine) at.normal = normalize(at.normal + (kLeastCosine - cosine) * at.view);
  return at;
}

}  // namespace welkin::scene
