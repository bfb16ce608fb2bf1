#include "welkin/scene/built_in.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"
#include "welkin/scene/aimed_camera.h"
#include "welkin/scene/shape_cases.h"

namespace welkin::scene {
namespace {

/// How far a point lies from the middle of a camera's picture: 1 on the nearest edge, over 1 outside;
/// infinite behind.
double off_middle(const SceneCamera& camera, const Vec3d& p) {
  const Vec3d seen = transpose(camera.rotation) * (p - camera.position);
  if (!(seen.z > 0)) return HUGE_VAL;
  const double up = std::tan(camera.vertical_fov / 2 * kDegree);
  return std::max(std::abs(seen.y) / (seen.z * up),
                  std::abs(seen.x) / (seen.z * up * camera.aspect.value_or(1)));
}

/// The scene as it is by default, made once.
const Scene& usual(const std::string& name) {
  static std::map<std::string, Scene> made;
  const auto known = made.find(name);
  return known != made.end() ? known->second : made.emplace(name, built_in(name)).first->second;
}

TEST(BuiltIn, AllAreSoundAndSeenWhole) {
  for (const std::string& name : built_in_names()) {
    SCOPED_TRACE(name);
    EXPECT_FALSE(built_in_description(name).empty());
    const Scene& scene = usual(name);
    EXPECT_NO_THROW(scene.check());
    ASSERT_FALSE(scene.cameras.empty());
    const SceneCamera& camera = scene.cameras[0];
    EXPECT_TRUE(is_orthonormal(camera.rotation));
    EXPECT_GT(determinant(camera.rotation), 0);
    if (name == "room") continue;  // seen from inside
    double most = 0;
    for (const Instance& instance : scene.instances) {
      for (const Vec3<float>& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].positions)
        most = std::max(most, off_middle(camera, point_to(instance.to_world, {p.x, p.y, p.z})));
    }
    EXPECT_LT(most, 1);
    EXPECT_GT(most, 0.5) << "and not from too far";
  }
}

TEST(BuiltIn, BodiesAreClosedAndFaceOutwards) {
  for (const std::string& name : built_in_names()) {
    for (const Mesh& mesh : usual(name).meshes) {
      SCOPED_TRACE(name + ": " + mesh.name);
      // Trunks are of six sides, whose edges are 30° from their middles, and trees have creases.
      EXPECT_GT(mean_agreement(mesh), name == "landscape" ? 0.68 : 0.98);
      if (name != "landscape" && mesh.name != "creature") {
        EXPECT_GT(worst_agreement(mesh), 0.3);
      }
      const bool open =
          mesh.name == "floor" || mesh.name == "wall" || mesh.name == "ground" || mesh.name == "water";
      if (open) continue;
      EXPECT_TRUE(is_closed(mesh));
      EXPECT_GT(volume_of(mesh), 0);
    }
  }
}

TEST(BuiltIn, HasAsManyTrianglesAsAskedFor) {
  for (const std::string& name : built_in_names()) {
    SCOPED_TRACE(name);
    for (const double count : {20'000.0, 100'000.0}) {
      if (name == "landscape" && count < 75'000) continue;  // its plants aren't made of fewer
      const Scene scene = built_in(name, {static_cast<int>(count)});
      EXPECT_NEAR(static_cast<double>(triangle_count(scene)), count, 0.1 * count);
    }
    EXPECT_NO_THROW(built_in(name, {64}).check());
  }
}

TEST(BuiltIn, IsTheSameEveryTime) {
  const Scene b = built_in("landscape");
  const Scene& a = usual("landscape");
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i)
    EXPECT_EQ(a.instances[i].to_world.linear, b.instances[i].to_world.linear);
  EXPECT_EQ(a.meshes[0].triangles, b.meshes[0].triangles);
}

// The room encloses its camera: whatever leaves it meets a wall from the front.
TEST(BuiltIn, TheRoomIsClosed) {
  const Scene room = built_in("room");
  double volume = 0;
  for (const Instance& instance : room.instances) {
    const Mesh& mesh = room.meshes[static_cast<std::size_t>(instance.mesh)];
    if (mesh.name != "wall") continue;
    for (const auto& t : mesh.triangles) {
      Vec3d p[3];
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3<float>& at = mesh.positions[t[i]];
        p[i] = point_to(instance.to_world, {at.x, at.y, at.z});
      }
      volume += dot(p[0], cross(p[1], p[2])) / 6;
    }
  }
  EXPECT_NEAR(volume, -5.0 * 3 * 6, 1e-4);
}

TEST(BuiltIn, RefusesUnknownNamesAndNumbers) {
  try {
    built_in("teapod");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_request);
    EXPECT_NE(std::string(error.what()).find("did you mean 'teapot'"), std::string::npos) << error.what();
  }
  EXPECT_THROW(built_in_description(""), Error);
  for (const int count : {-1, 1, 63, 10'000'001}) EXPECT_THROW(built_in("sphere", {count}), Error) << count;
}

TEST(AimedCamera, LooksWhereItIsTold) {
  const SceneCamera camera = aimed_camera({1, 2, 3}, {4, -2, 3});
  EXPECT_NEAR(length(camera.rotation * Vec3d{0, 0, 1} - Vec3d{0.6, -0.8, 0}), 0, 1e-12);
  EXPECT_GT((camera.rotation * Vec3d{0, 1, 0}).y, 0);
  EXPECT_NEAR((camera.rotation * Vec3d{1, 0, 0}).y, 0, 1e-12) << "the horizon is level";
  EXPECT_TRUE(is_orthonormal(aimed_camera({0, 0, 0}, {0, 5, 0}).rotation));
  EXPECT_THROW(aimed_camera({1, 1, 1}, {1, 1, 1}), Error);
  EXPECT_THROW(aimed_camera({0, 0, 0}, {1, 1, 1}, 180), Error);
  EXPECT_THROW(camera_seeing({{0, 0, 0}, {1, 1, 1}}, {0, 0, 0}), Error);
}

}  // namespace
}  // namespace welkin::scene
