#include <gtest/gtest.h>

#include <cmath>

#include "welkin/render/trace/traced_scene.h"

namespace welkin::scene {
namespace {

/// A triangle of the plane z = 0 with corners at 0, x, y, of one material.
Scene corner(const Material& material) {
  Scene scene;
  scene.materials.push_back(material);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.uv[0] = {{0, 1}, {1, 1}, {0, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({"corner", 0, {}, -1});
  return scene;
}

/// What a ray meets that falls onto a place of the plane.
Surface met_at(const TracedScene& scene, double x, double y) {
  const Ray ray{{static_cast<float>(x), static_cast<float>(y), 5}, {0, 0, -1}};
  return scene.surface({{x, y, 5}, {0, 0, -1}, {}, {}}, scene.closest(ray));
}

/// A picture of one texel.
Picture texel(std::array<float, 4> value) {
  Picture picture{"texel", Image(1, 1, 4)};
  std::copy(value.begin(), value.end(), picture.image.at(0, 0));
  return picture;
}

TEST(TracedSurface, ColorsOfVerticesAreInterpolated) {
  Material material;
  material.base_color = {0.5f, 1, 1};
  material.emission = {2, 2, 2};
  material.blended = true;
  for (const bool unlit : {false, true}) {
    material.unlit = unlit;
    Scene scene = corner(material);
    scene.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 0.5f}, {0, 0, 1, 0}};
    const TracedScene traced(std::move(scene));
    const MaterialPoint point = met_at(traced, 0.25, 0.125).material;
    EXPECT_NEAR(point.base_color[0], 0.5 * 0.625, 1e-6);
    EXPECT_NEAR(point.base_color[1], 0.25, 1e-6);
    EXPECT_NEAR(point.base_color[2], 0.125, 1e-6);
    EXPECT_NEAR(point.alpha, 0.625 + 0.25 / 2, 1e-6);
    EXPECT_NEAR(point.emission[1], unlit ? 0.5 : 2, 1e-6);
  }
  // A mirrored instance has its corners in another order.
  Scene mirrored = corner(material);
  mirrored.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  mirrored.instances[0].to_world.linear = Matrix3{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  EXPECT_NEAR(met_at(TracedScene(std::move(mirrored)), -0.25, 0.125).material.base_color[1], 0.25, 1e-6);
}

TEST(TracedSurface, PicturesMultiplyTheNumbersBesideThem) {
  Material material;
  material.sheen_color = {1, 0.5f, 1};
  material.sheen_roughness = 0.5f;
  material.clearcoat = 1;
  material.clearcoat_roughness = 0.5f;
  material.anisotropy = 0.8f;
  material.anisotropy_angle = 0.25f;
  material.sheen_color_map.picture = 0;
  material.sheen_roughness_map.picture = 0;
  material.clearcoat_roughness_map.picture = 0;
  material.anisotropy_map.picture = 1;
  Scene scene = corner(material);
  scene.pictures.push_back(texel({0.2f, 0.4f, 0.6f, 0.8f}));
  scene.pictures.push_back(texel({0.5f, 1, 0.25f, 1}));  // along the bitangent
  const TracedScene traced(std::move(scene));
  const Surface at = met_at(traced, 0.25, 0.25);
  const MaterialPoint& point = at.material;
  EXPECT_NEAR(point.sheen_color[0], 0.2, 1e-6);
  EXPECT_NEAR(point.sheen_color[1], 0.2, 1e-6);
  EXPECT_NEAR(point.sheen_roughness, 0.4, 1e-6);
  EXPECT_NEAR(point.clearcoat_roughness, 0.2, 1e-6);
  EXPECT_NEAR(point.anisotropy, 0.2, 1e-6);
  EXPECT_NEAR(point.anisotropy_angle, 0.25 + kPi / 2, 1e-6);
  // u goes right and v down: the tangent is +x, the bitangent +y.
  const Grain grain = grain_of(at);
  EXPECT_NEAR(grain.along.x, -std::sin(0.25), 1e-6);
  EXPECT_NEAR(grain.along.y, std::cos(0.25), 1e-6);
  EXPECT_NEAR(dot(grain.along, grain.across), 0, 1e-12);
}

}  // namespace
}  // namespace welkin::scene
