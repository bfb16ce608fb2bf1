#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"
#include "welkin/scene/gltf_file.h"

namespace welkin::scene {
namespace {

[[noreturn]] void damaged(const std::string& cause) {
  throw Error(ErrorKind::damaged, cause);
}

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

Transform transform_of(const tinygltf::Node& node, const std::string& what) {
  for (const auto* values : {&node.matrix, &node.translation, &node.rotation, &node.scale})
    if (!finite(*values)) damaged(what + " has a transform that is not finite");
  Transform made;
  if (node.matrix.size() == 16) {
    // Column by column; the last row of an affine one is 0 0 0 1.
    const auto& m = node.matrix;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column) made.linear.rows[row][column] = m[4 * column + row];
    made.origin = {m[12], m[13], m[14]};
    return made;
  }
  if (node.rotation.size() == 4) {
    const auto& q = node.rotation;
    if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-20)
      made.linear = rotation_from_quaternion(q[3], q[0], q[1], q[2]);
  }
  if (node.scale.size() == 3)
    for (auto& row : made.linear.rows)
      for (std::size_t column = 0; column < 3; ++column) row[column] *= node.scale[column];
  if (node.translation.size() == 3)
    made.origin = {node.translation[0], node.translation[1], node.translation[2]};
  return made;
}

Vec3d column_of(const Matrix3& m, std::size_t column) {
  return {m.rows[0][column], m.rows[1][column], m.rows[2][column]};
}

bool is_finite(const Transform& t) {
  for (const auto& row : t.linear.rows)
    for (const double value : row)
      if (!std::isfinite(value)) return false;
  return std::isfinite(t.origin.x) && std::isfinite(t.origin.y) && std::isfinite(t.origin.z);
}

/// Walks the tree of nodes.
class NodeReader {
 public:
  NodeReader(const GltfFile& file, const GltfMeshes& meshes, Scene& scene)
      : model_(file.model), meshes_(meshes), scene_(scene), visited_(model_.nodes.size()) {}

  void read(const std::vector<int>& roots) {
    std::vector<std::pair<int, Transform>> waiting;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) waiting.emplace_back(*root, Transform{});
    while (!waiting.empty()) {
      const auto [index, parent] = waiting.back();
      waiting.pop_back();
      if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size())
        damaged("there is no node " + std::to_string(index));
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
      const std::string name = node.name.empty() ? "node " + std::to_string(index) : node.name;
      if (visited_[static_cast<std::size_t>(index)])
        damaged("node '" + name + "' has two parents, or is its own ancestor");
      visited_[static_cast<std::size_t>(index)] = true;
      const Transform to_world = parent * transform_of(node, "node '" + name + "'");
      if (!is_finite(to_world)) damaged("node '" + name + "' stands nowhere: its transform is not finite");
      add_mesh(node, name, to_world);
      add_camera(node, name, to_world);
      add_light(node, name, to_world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        waiting.emplace_back(*child, to_world);
    }
  }

 private:
  void add_mesh(const tinygltf::Node& node, const std::string& name, const Transform& to_world) {
    if (node.mesh < 0) return;
    if (static_cast<std::size_t>(node.mesh) >= meshes_.size())
      damaged("node '" + name + "' is of a mesh that there isn't");
    const double volume = determinant(to_world.linear);
    if (!(std::abs(volume) > 0) || !std::isfinite(volume)) {
      warn(scene_, "node '" + name + "' is scaled to nothing, and left out");
      return;
    }
    for (const int mesh : meshes_[static_cast<std::size_t>(node.mesh)]) {
      if (scene_.instances.size() >= kMostInstances)
        throw Error(ErrorKind::too_large, "has over 10,000,000 instances");
      scene_.instances.push_back({name, mesh, to_world, -1});
    }
  }

  void add_camera(const tinygltf::Node& node, const std::string& name, const Transform& to_world) {
    if (node.camera < 0) return;
    if (static_cast<std::size_t>(node.camera) >= model_.cameras.size())
      damaged("node '" + name + "' is of a camera that there isn't");
    const tinygltf::Camera& from = model_.cameras[static_cast<std::size_t>(node.camera)];
    const double fov = from.perspective.yfov / kDegree;
    // It looks along −Z, its right is +X.
    const Vec3d back = column_of(to_world.linear, 2),
                left = -1.0 * cross(column_of(to_world.linear, 1), back);
    if (from.type != "perspective" || !(fov > 0 && fov < 180) || !(length(back) > 0) || !(length(left) > 0)) {
      warn(scene_, "camera '" + name + "' is left out: only perspective ones are read, of 0 to 180 degrees");
      return;
    }
    SceneCamera camera;
    camera.name = from.name.empty() ? name : from.name;
    camera.position = to_world.origin;
    const Vec3d x = normalize(left), z = normalize(-1.0 * back), y = cross(z, x);
    camera.rotation.rows = {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
    camera.vertical_fov = fov;
    const double aspect = from.perspective.aspectRatio;
    if (aspect > 0 && std::isfinite(aspect)) camera.aspect = aspect;
    scene_.cameras.push_back(std::move(camera));
  }

  void add_light(const tinygltf::Node& node, const std::string& name, const Transform& to_world) {
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end()) return;
    const double index = number_of(extension->second, "light", -1);
    if (!(index >= 0 && index < static_cast<double>(model_.lights.size())))
      damaged("node '" + name + "' is of a light that there isn't");
    const tinygltf::Light& from = model_.lights[static_cast<std::size_t>(index)];
    PointLight light;
    light.name = from.name.empty() ? name : from.name;
    light.position = to_world.origin;
    if (from.type == "spot") {
      light.kind = PointLight::Kind::spot;
    } else if (from.type == "directional") {
      light.kind = PointLight::Kind::directional;
    } else if (from.type != "point") {
      warn(scene_, "light '" + light.name + "' is of the unknown type '" + from.type + "', and left out");
      return;
    }
    const Vec3d way = -1.0 * column_of(to_world.linear, 2);
    if (length(way) > 0) light.direction = normalize(way);
    for (std::size_t i = 0; i < 3; ++i) {
      const double color = from.color.size() == 3 ? from.color[i] : 1;
      light.intensity[i] = static_cast<float>(std::clamp(from.intensity * color, 0.0, 1e30));
    }
    light.outer_cone = std::clamp(from.spot.outerConeAngle, 0.0, kPi / 2);
    light.inner_cone = std::clamp(from.spot.innerConeAngle, 0.0, light.outer_cone);
    if (from.range > 0) warn(scene_, "the ranges of lights are not read: their light falls off for ever");
    scene_.lights.push_back(std::move(light));
  }

  const tinygltf::Model& model_;
  const GltfMeshes& meshes_;
  Scene& scene_;
  std::vector<bool> visited_;
};

}  // namespace

void read_gltf_nodes(const GltfFile& file, const GltfMeshes& meshes, Scene& scene) {
  const tinygltf::Model& model = file.model;
  NodeReader reader(file, meshes, scene);
  if (!model.scenes.empty()) {
    const int chosen = model.defaultScene >= 0 ? model.defaultScene : 0;
    if (static_cast<std::size_t>(chosen) >= model.scenes.size())
      damaged("there is no scene " + std::to_string(chosen));
    if (model.scenes.size() > 1)
      warn(scene, "has " + std::to_string(model.scenes.size()) + " scenes; number " + std::to_string(chosen) +
                      " is read");
    reader.read(model.scenes[static_cast<std::size_t>(chosen)].nodes);
    return;
  }
  // Without scenes: all nodes that are nobody's children.
  std::vector<bool> is_child(model.nodes.size());
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i)
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  reader.read(roots);
}

}  // namespace welkin::scene
