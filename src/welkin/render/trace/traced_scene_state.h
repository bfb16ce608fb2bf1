#pragma once

#include <array>
#include <memory>
#include <vector>

#include "welkin/render/trace/embree_functions.h"
#include "welkin/render/trace/texture.h"
#include "welkin/render/trace/traced_scene.h"

namespace welkin::scene {

/// An instance's mesh in the world. Embree reads 16 bytes of each vertex, so there is one more than is used.
struct WorldMesh {
  const Mesh* mesh;
  const Material* material;
  std::vector<Vec3<float>> positions, normals;
  std::vector<std::array<float, 4>> tangents;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

class TracedScene::State {
 public:
  /// What scenes have in common whose instances stand elsewhere.
  struct Shared {
    explicit Shared(Scene given) : scene(std::move(given)) {
      scene.check();
      for (const Picture& picture : scene.pictures) textures.emplace_back(picture);
    }
    Scene scene;
    std::vector<Texture> textures;
  };

  State(std::shared_ptr<const Shared> given, const std::vector<Transform>& to_world,
        const std::vector<bool>& hidden);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::shared_ptr<const Shared> shared;
  std::vector<WorldMesh> meshes;  // one an instance
  const EmbreeFunctions& rt = embree();
  RTCDevice device = nullptr;
  RTCScene traced = nullptr;
  double largest = 1;  // of all coordinates

  /// `color`: of the vertices.
  MaterialPoint material_at(const Material& material, const std::array<float, 4>& color,
                            const std::array<std::array<double, 2>, 3> (&uv)[2]) const;
  std::array<float, 4> look_up(const PictureUse& use,
                               const std::array<std::array<double, 2>, 3> (&uv)[2]) const;
  void bend_normal(Surface& at, const std::array<std::array<double, 2>, 3> (&uv)[2]) const;
};

}  // namespace welkin::scene
