#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/unit_vector.h"
#include "welkin/math/vec_precision.h"
#include "welkin/scene/scene_input.h"

namespace welkin::scene {
namespace {

bool finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Twice a triangle's area along its normal.
Vec3d area_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3d a = to_double(mesh.positions[t[0]]);
  return cross(to_double(mesh.positions[t[1]]) - a, to_double(mesh.positions[t[2]]) - a);
}

void drop_flat_triangles(Mesh& mesh, Mended& mended) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const auto& t) { return !(length(area_of(mesh, t)) > 0); });
  mended.flat_triangles += before - mesh.triangles.size();
}

void mend_normals(Mesh& mesh, Mended& mended) {
  std::vector<std::uint8_t> lost(mesh.normals.size());
  bool any = false;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Vec3d normal = to_double(mesh.normals[i]);
    const double size = length(normal);
    lost[i] = !(size > 1e-20 && std::isfinite(size));
    any = any || lost[i];
    if (!lost[i]) mesh.normals[i] = to_float((1 / size) * normal);
  }
  if (!any) return;
  std::vector<Vec3d> sums(mesh.normals.size(), {0, 0, 0});
  for (const auto& t : mesh.triangles) {
    const Vec3d area = area_of(mesh, t);
    for (const std::uint32_t i : t)
      if (lost[i]) sums[i] = sums[i] + area;
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (!lost[i]) continue;
    mesh.normals[i] = to_float(unit_or(sums[i], {0, 1, 0}));
    ++mended.normals;
  }
}

/// Every triangle with vertices and flat normals of its own: tangents need normals.
void flatten(Mesh& mesh) {
  Mesh flat;
  flat.name = mesh.name;
  flat.material = mesh.material;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(flat.positions.size());
    const Vec3<float> normal = to_float(normalize(area_of(mesh, t)));
    for (const std::uint32_t i : t) {
      flat.positions.push_back(mesh.positions[i]);
      flat.normals.push_back(normal);
      for (std::size_t set = 0; set < 2; ++set)
        if (!mesh.uv[set].empty()) flat.uv[set].push_back(mesh.uv[set][i]);
      if (!mesh.colors.empty()) flat.colors.push_back(mesh.colors[i]);
    }
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  mesh = std::move(flat);
}

/// The gradients of u, summed at each vertex over the triangles around it.
void make_tangents(Mesh& mesh, std::size_t set) {
  if (mesh.normals.empty()) flatten(mesh);
  std::vector<Vec3d> along_u(mesh.positions.size(), {0, 0, 0}), along_v = along_u;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.uv[set][t[0]], &b = mesh.uv[set][t[1]], &c = mesh.uv[set][t[2]];
    const double ub = double{b[0]} - a[0], vb = double{b[1]} - a[1], uc = double{c[0]} - a[0],
                 vc = double{c[1]} - a[1];
    const double turn = ub * vc - uc * vb;
    if (!(std::abs(turn) > 0) || !std::isfinite(turn)) continue;
    const Vec3d pa = to_double(mesh.positions[t[0]]), pb = to_double(mesh.positions[t[1]]) - pa,
                pc = to_double(mesh.positions[t[2]]) - pa;
    // Solves p = u·U + v·V over the triangle; weighted by its area.
    const double weight = length(cross(pb, pc));
    const Vec3d u = unit_or((turn > 0 ? 1.0 : -1.0) * (vc * pb - vb * pc), {0, 0, 0}),
                v = unit_or((turn > 0 ? 1.0 : -1.0) * (ub * pc - uc * pb), {0, 0, 0});
    for (const std::uint32_t i : t) {
      along_u[i] = along_u[i] + weight * u;
      along_v[i] = along_v[i] + weight * v;
    }
  }
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3d n = to_double(mesh.normals[i]);
    const Vec3d tangent = unit_or(along_u[i] - dot(along_u[i], n) * n, across(n));
    // Texture coordinates run down: the bitangent points against v.
    const double side = dot(cross(n, tangent), along_v[i]) > 0 ? -1 : 1;
    mesh.tangents[i] = {static_cast<float>(tangent.x), static_cast<float>(tangent.y),
                        static_cast<float>(tangent.z), static_cast<float>(side)};
  }
}

void mend_colors(Mesh& mesh, Mended& mended) {
  for (auto& color : mesh.colors) {
    const auto before = color;
    for (float& value : color) value = std::isfinite(value) ? std::max(value, 0.0f) : 0;
    mended.colors += color != before;
  }
}

/// Unit length, ±1; false if any can't be.
bool settle_tangents(Mesh& mesh) {
  for (auto& tangent : mesh.tangents) {
    const Vec3d t{tangent[0], tangent[1], tangent[2]};
    const double size = length(t);
    if (!(size > 1e-20 && std::isfinite(size) && std::isfinite(tangent[3]))) return false;
    for (std::size_t i = 0; i < 3; ++i) tangent[i] = static_cast<float>(tangent[i] / size);
    tangent[3] = tangent[3] < 0 ? -1.0f : 1.0f;
  }
  return true;
}

}  // namespace

void mend_mesh(Mesh& mesh, int tangent_set, Mended& mended) {
  for (const Vec3<float>& position : mesh.positions)
    if (!finite(to_double(position)))
      throw Error(ErrorKind::bad_value, "mesh '" + mesh.name + "' has a vertex that is not finite");
  for (auto& set : mesh.uv) {
    for (auto& uv : set) {
      if (std::isfinite(uv[0]) && std::isfinite(uv[1])) continue;
      uv = {};
      ++mended.coordinates;
    }
  }
  mend_colors(mesh, mended);
  drop_flat_triangles(mesh, mended);
  mend_normals(mesh, mended);
  if (mesh.normals.empty()) mesh.tangents.clear();  // those would be about normals that it doesn't have
  if (!settle_tangents(mesh)) {
    mesh.tangents.clear();
    ++mended.tangents;
  }
  if (tangent_set < 0 || !mesh.tangents.empty()) return;
  const auto set = static_cast<std::size_t>(tangent_set);
  if (!mesh.uv[set].empty()) make_tangents(mesh, set);
}

void warn_of(Scene& scene, const Mended& mended) {
  const auto tell = [&](std::uint64_t count, const char* what) {
    if (count > 0) warn(scene, std::to_string(count) + what);
  };
  tell(mended.flat_triangles, " triangles without area were left out");
  tell(mended.normals, " normals that were zero or not finite were made from the triangles around them");
  tell(mended.tangents, " meshes had tangents that were zero or not finite, which were left out");
  tell(mended.coordinates, " texture coordinates that were not finite were set to 0");
  tell(mended.colors, " colours of vertices that were negative or not finite were set to 0");
}

}  // namespace welkin::scene
