#include "welkin/base/error.h"
#include "welkin/scene/gltf_file.h"

namespace welkin::scene {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Lists, strips and fans of vertices 0 … count−1, or of those that `indices` names.
Triangles triangles_of(int mode, std::size_t count, const std::vector<std::uint32_t>* indices) {
  const std::size_t corners = indices ? indices->size() : count;
  const auto vertex = [&](std::size_t i) { return indices ? (*indices)[i] : static_cast<std::uint32_t>(i); };
  Triangles triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(corners / 3);
    for (std::size_t i = 0; i + 2 < corners; i += 3)
      triangles.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    // Every second triangle of a strip is turned over.
    for (std::size_t i = 0; i + 2 < corners; ++i)
      triangles.push_back({vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)});
  } else {
    for (std::size_t i = 1; i + 1 < corners; ++i) triangles.push_back({vertex(i), vertex(i + 1), vertex(0)});
  }
  return triangles;
}

template <std::size_t N>
std::vector<std::array<float, N>> grouped(const std::vector<float>& values) {
  std::vector<std::array<float, N>> groups(values.size() / N);
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) groups[i][k] = values[i * N + k];
  return groups;
}

std::vector<Vec3<float>> as_vectors(const std::vector<float>& values) {
  std::vector<Vec3<float>> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return vectors;
}

/// R G B, or R G B A; already linear, as the specification says.
std::vector<std::array<float, 4>> read_colors(const GltfFile& file, int accessor, const std::string& what) {
  const auto& accessors = file.model.accessors;
  const bool opaque = static_cast<std::size_t>(accessor) < accessors.size() &&
                      accessors[static_cast<std::size_t>(accessor)].type == TINYGLTF_TYPE_VEC3;
  if (!opaque) return grouped<4>(read_floats(file, accessor, 4, what));
  std::vector<std::array<float, 4>> colors;
  for (const auto& rgb : grouped<3>(read_floats(file, accessor, 3, what)))
    colors.push_back({rgb[0], rgb[1], rgb[2], 1});
  return colors;
}

Mesh read_primitive(const GltfFile& file, const tinygltf::Primitive& primitive, const std::string& name,
                    Scene& scene) {
  Mesh mesh;
  mesh.name = name;
  const auto accessor = [&](const char* attribute) {
    const auto at = primitive.attributes.find(attribute);
    return at == primitive.attributes.end() ? -1 : at->second;
  };
  const std::string what = "mesh '" + name + "'";
  mesh.positions = as_vectors(read_floats(file, accessor("POSITION"), 3, what + ": positions"));
  const auto check_count = [&](std::size_t count, const char* of) {
    if (count != mesh.positions.size())
      throw Error(ErrorKind::damaged, what + " has other numbers of positions and " + of);
  };
  if (accessor("NORMAL") >= 0) {
    mesh.normals = as_vectors(read_floats(file, accessor("NORMAL"), 3, what + ": normals"));
    check_count(mesh.normals.size(), "normals");
  }
  if (accessor("TANGENT") >= 0) {
    mesh.tangents = grouped<4>(read_floats(file, accessor("TANGENT"), 4, what + ": tangents"));
    check_count(mesh.tangents.size(), "tangents");
  }
  constexpr const char* kSets[] = {"TEXCOORD_0", "TEXCOORD_1"};
  for (std::size_t set = 0; set < 2; ++set) {
    if (accessor(kSets[set]) < 0) continue;
    mesh.uv[set] = grouped<2>(read_floats(file, accessor(kSets[set]), 2, what + ": texture coordinates"));
    check_count(mesh.uv[set].size(), "texture coordinates");
  }
  if (accessor("COLOR_0") >= 0) {
    mesh.colors = read_colors(file, accessor("COLOR_0"), what + ": colours");
    check_count(mesh.colors.size(), "colours");
  }
  if (primitive.indices >= 0) {
    const auto indices = read_indices(file, primitive.indices, what + ": indices");
    mesh.triangles = triangles_of(primitive.mode, 0, &indices);
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t i : t)
        if (i >= mesh.positions.size())
          throw Error(ErrorKind::damaged, what + " has a triangle of vertex " + std::to_string(i) + ", and " +
                                              std::to_string(mesh.positions.size()) + " vertices");
  } else {
    mesh.triangles = triangles_of(primitive.mode, mesh.positions.size(), nullptr);
  }
  const auto materials = static_cast<int>(scene.materials.size());
  if (primitive.material >= materials - 1)
    throw Error(ErrorKind::damaged, what + " is of a material that there isn't");
  mesh.material = primitive.material >= 0 ? primitive.material : materials - 1;
  if (accessor("JOINTS_0") >= 0) warn(scene, "skins are not read: what has one stands as it was modelled");
  if (!primitive.targets.empty())
    warn(scene, "morph targets are not read: meshes stand as they were modelled");
  return mesh;
}

/// The texture coordinates by which a material asks for tangents; −1: it doesn't.
int tangent_set_of(const Material& material) {
  if (material.normal_map) return material.normal_map.uv_set;
  if (material.anisotropy == 0) return -1;
  return material.anisotropy_map ? material.anisotropy_map.uv_set : 0;
}

}  // namespace

GltfMeshes read_gltf_meshes(const GltfFile& file, Scene& scene) {
  GltfMeshes all;
  Mended mended;
  std::uint64_t elements = 0;
  for (std::size_t i = 0; i < file.model.meshes.size(); ++i) {
    const tinygltf::Mesh& from = file.model.meshes[i];
    std::string name = from.name.empty() ? "mesh " + std::to_string(i) : from.name;
    std::vector<int> parts;
    for (const tinygltf::Primitive& primitive : from.primitives) {
      if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
          primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        warn(scene, "points and lines are left out");
        continue;
      }
      if (!primitive.attributes.contains("POSITION")) {
        warn(scene, "mesh '" + name + "' has a part without positions, which is left out");
        continue;
      }
      Mesh mesh = read_primitive(file, primitive, name, scene);
      elements += mesh.positions.size() + mesh.triangles.size();
      if (elements > kMostElements)
        throw Error(ErrorKind::too_large, "has over 200,000,000 vertices and triangles");
      mend_mesh(mesh, tangent_set_of(scene.materials[static_cast<std::size_t>(mesh.material)]), mended);
      if (mesh.triangles.empty()) continue;
      parts.push_back(static_cast<int>(scene.meshes.size()));
      scene.meshes.push_back(std::move(mesh));
    }
    all.push_back(std::move(parts));
  }
  warn_of(scene, mended);
  return all;
}

}  // namespace welkin::scene
