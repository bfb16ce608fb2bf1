#include "welkin/scene/shapes.h"

#include <gtest/gtest.h>

#include "welkin/scene/scene.h"

namespace welkin::scene {
namespace {

/// Six times the volume that a closed mesh encloses: positive where triangles face outwards.
double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](int i) {
      const Vec3<float>& p = mesh.positions[t[static_cast<std::size_t>(i)]];
      return Vec3d{p.x, p.y, p.z};
    };
    sum += dot(at(0), cross(at(1), at(2)));
  }
  return sum / 6;
}

/// The least cosine between a triangle's own normal and its vertices'.
double worst_agreement(const Mesh& mesh) {
  double worst = 1;
  for (const auto& t : mesh.triangles) {
    const auto& p = mesh.positions;
    const Vec3<float> flat = normalize(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
    for (const std::uint32_t i : t) worst = std::min<double>(worst, dot(flat, mesh.normals[i]));
  }
  return worst;
}

// A polyhedron inside a curved body lacks about (π/n)² of its volume.
TEST(Shapes, TrianglesFaceOutwardsAndEncloseTheBody) {
  EXPECT_NEAR(volume_of(sphere_mesh(96)), 4 * kPi / 3, 4 * kPi / 3 * 2e-3);
  EXPECT_NEAR(volume_of(torus_mesh(0.4)), 2 * kPi * kPi * 0.16, 2 * kPi * kPi * 0.16 * 2e-3);
  EXPECT_NEAR(volume_of(box_mesh()), 8, 1e-5);
}

TEST(Shapes, NormalsAgreeWithTriangles) {
  EXPECT_GT(worst_agreement(sphere_mesh(96)), 0.999);
  EXPECT_GT(worst_agreement(torus_mesh()), 0.999);
  EXPECT_GT(worst_agreement(box_mesh()), 0.999999);
  EXPECT_GT(worst_agreement(square_mesh(3)), 0.999999);
}

TEST(SceneCheck, TellsWhatDoesNotFit) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(box_mesh());
  scene.instances.push_back({"box", 0, {}, -1});
  EXPECT_NO_THROW(scene.check());
  EXPECT_EQ(triangle_count(scene), 12u);
  const auto box = bounds_of(scene);
  ASSERT_TRUE(box);
  EXPECT_DOUBLE_EQ(box->least.x, -1);
  EXPECT_DOUBLE_EQ(box->most.z, 1);
  scene.instances[0].mesh = 1;
  EXPECT_ANY_THROW(scene.check());
  scene.instances[0].mesh = 0;
  scene.meshes[0].triangles[0][1] = 99;
  EXPECT_ANY_THROW(scene.check());
}

// A mirrored, stretched surface keeps its normal at right angles, on the same side.
TEST(SceneTransform, NormalsStayAcrossTheirSurface) {
  const Transform stretched{{{{{-2, 0, 0.5}, {0, 3, 0}, {0, 0.2, 1}}}}, {1, 2, 3}};
  const Vec3d along{1, -1, 0}, other{0, 0, 1}, normal = cross(along, other);
  const Vec3d turned = normal_to(stretched, normal);
  EXPECT_NEAR(dot(turned, stretched.linear * along), 0, 1e-12);
  EXPECT_NEAR(dot(turned, stretched.linear * other), 0, 1e-12);
  EXPECT_GT(dot(turned, stretched.linear * normal), 0);
}

}  // namespace
}  // namespace welkin::scene
