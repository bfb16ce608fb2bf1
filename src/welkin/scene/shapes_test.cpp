#include "welkin/scene/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "welkin/scene/scene.h"
#include "welkin/scene/shape_cases.h"

namespace welkin::scene {
namespace {

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

// A rod of even radius: a cylinder and a ball. Bent, its volume stays (Pappus), as the bend is even.
TEST(Shapes, TubesAndLathesEncloseTheirBodies) {
  const double r = 0.2, straight = kPi * r * r * 2 + 4 * kPi / 3 * r * r * r;
  const Mesh rod = lathe_mesh(rod_profile(2, r, r), 96, 192);
  EXPECT_NEAR(volume_of(rod), straight, straight * 2e-3);
  EXPECT_TRUE(is_closed(rod));
  EXPECT_GT(worst_agreement(rod), 0.99);
  const auto bow = [](double t) { return Vec3d{std::cos(2 * t), std::sin(2 * t), 0.3}; };
  EXPECT_NEAR(curve_length(bow), 2, 2e-5);
  const Mesh tube = tube_mesh(bow, rod_profile(2, r, r), 96, 192);
  EXPECT_NEAR(volume_of(tube), straight, straight * 2e-3);
  EXPECT_TRUE(is_closed(tube));
  EXPECT_GT(worst_agreement(tube), 0.99);
  const Mesh cone = tube_mesh(bow, rod_profile(2, 0.3, 0.1), 96, 192);
  EXPECT_TRUE(is_closed(cone));
  EXPECT_GT(worst_agreement(cone), 0.98);
}

TEST(Shapes, CurvesGoThroughTheirPoints) {
  const std::vector<Vec3d> points{{0, 0, 0}, {1, 2, 0}, {3, 1, -1}, {4, 4, 2}};
  const auto curve = curve_through(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(length(curve(static_cast<double>(i) / 3) - points[i]), 0, 1e-12);
  EXPECT_ANY_THROW(curve_through({{0, 0, 0}}));
}

// Vertices lie on the surface; between them it bulges by less than h²/8r for cells of side h.
TEST(Shapes, ImplicitSurfacesAreWhereTheFunctionIsZero) {
  const Vec3d middle{0.3, -0.2, 0.1};
  const auto ball = [&](const Vec3d& p) { return length(p - middle) - 0.8; };
  const Mesh mesh = implicit_mesh(ball, {{-1, -1, -1}, {1.5, 1.3, 1.7}}, 50);
  EXPECT_TRUE(is_closed(mesh));
  const double volume = 4 * kPi / 3 * 0.512;
  EXPECT_NEAR(volume_of(mesh), volume, volume * 3e-3);
  EXPECT_GT(worst_agreement(mesh), 0.99);
  for (const Vec3<float>& p : mesh.positions) ASSERT_NEAR(ball({p.x, p.y, p.z}), 0, 1e-6);
  // A surface that leaves its box, or a function that runs ahead of position, is refused.
  EXPECT_ANY_THROW(implicit_mesh(ball, {{-0.4, -1, -1}, {2, 1, 1}}, 50));
  EXPECT_ANY_THROW(implicit_mesh(ball, {{-1, -1, -1}, {0.5, 1, 1}}, 50));
  const auto hasty = [&](const Vec3d& p) { return 8 * ball(p); };
  EXPECT_ANY_THROW(implicit_mesh(hasty, {{-1, -1, -1}, {1.5, 1.3, 1.7}}, 50));
}

/// Whether the ends of every edge are, to the bit, those of another triangle's the other way round.
bool joins_exactly(const Mesh& mesh) {
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto at = [&](std::uint32_t i) {
    const Vec3<float>& p = mesh.positions[i];
    return Point{p.x, p.y, p.z};
  };
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = at(t[i]), to = at(t[(i + 1) % 3]);
      ++edges[{from, to}];
      --edges[{to, from}];
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

// Rays go through gaps of the last bit.
TEST(Shapes, BodiesHaveNoGaps) {
  EXPECT_TRUE(joins_exactly(sphere_mesh(12)));
  EXPECT_TRUE(joins_exactly(torus_mesh(0.3, 12, 8)));
  EXPECT_TRUE(joins_exactly(box_mesh()));
  EXPECT_FALSE(joins_exactly(square_mesh()));
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
