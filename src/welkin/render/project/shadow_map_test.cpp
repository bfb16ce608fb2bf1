#include "welkin/render/project/shadow_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "welkin/base/error.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/project/project_cases.h"

namespace welkin::scene {
namespace {

const Vec3d kLight{0.6, 2.5, -0.8};

/// A floor, a ball and a box over it.
Scene still_life() {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(square_mesh());
  scene.meshes.push_back(sphere_mesh(96));
  scene.meshes.push_back(box_mesh());
  scene.instances.push_back({"floor", 0, scaled({6, 1, 6}, {0, -1, 0}), -1});
  scene.instances.push_back({"ball", 1, scaled({0.7, 0.7, 0.7}, {-0.6, 0.1, 0.2}), -1});
  scene.instances.push_back({"box", 2, scaled({0.3, 0.6, 0.3}, {0.9, -0.4, 0.6}), -1});
  PointLight light;
  light.position = kLight;
  light.intensity = {8, 8, 8};
  scene.lights.push_back(light);
  return scene;
}

/// Places that the light may reach, as a viewer all around sees them.
std::vector<Surface> lit_places(const TracedScene& scene, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Surface> places;
  const Vec3d eye{0.2, 3, 0.1};
  while (static_cast<int>(places.size()) < count) {
    RaySpread ray{};
    ray.origin = eye;
    ray.direction = normalize(Vec3d{normal(random), normal(random) - 1, normal(random)});
    const Hit hit = scene.closest({to_float(ray.origin), to_float(ray.direction)});
    if (!hit) continue;
    const Surface at = scene.surface(ray, hit);
    // Along the outline that a ball shows the light, its facets shadow each other, whatever the texels.
    if (dot(at.flat_normal, normalize(kLight - at.position)) > 0.1) places.push_back(at);
  }
  return places;
}

/// Whether the light sees the plane of a surface along a direction from it.
bool sees(const TracedScene& scene, const Surface& at, const Vec3d& direction) {
  const double facing = dot(at.flat_normal, direction);
  if (!(facing < 0)) return false;
  const double distance = dot(at.flat_normal, at.position - kLight) / facing;
  const Hit hit = scene.closest({to_float(kLight), to_float(direction)});
  return static_cast<double>(hit.distance) > (1 - 2e-4) * distance;
}

// Where the map and a ray to the light disagree, the border of a shadow is within a texel or so.
TEST(ShadowMap, DisagreesWithRaysAtBordersAlone) {
  const TracedScene scene(still_life());
  const auto places = lit_places(scene, 20000, 3);
  double shares[2] = {};
  for (const int size : {256, 1024}) {
    const ShadowMap map(scene, kLight, {.size = size});
    int wrong = 0, shadowed = 0;
    for (const Surface& at : places) {
      const Vec3d way = normalize(at.position - kLight);
      const bool truth = sees(scene, at, way);
      shadowed += truth ? 0 : 1;
      if ((map.visibility(at.position, at.flat_normal) >= 0.5) == truth) continue;
      ++wrong;
      // The octahedron's texels are up to 2.2 times as long as a square of their mean area.
      const double reach = 2.2 * std::sqrt(4 * kPi) / size;
      const Vec3d x = normalize(cross(way, std::abs(way.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0})),
                  y = cross(way, x);
      bool border = false;
      for (int ring = 1; ring <= 4 && !border; ++ring) {
        for (int k = 0; k < 24 && !border; ++k) {
          const double angle = k * kPi / 12, r = reach * ring / 4;
          border =
              sees(scene, at, normalize(way + r * std::cos(angle) * x + r * std::sin(angle) * y)) != truth;
        }
      }
      EXPECT_TRUE(border) << size << ": " << at.position.x << " " << at.position.y << " " << at.position.z;
    }
    EXPECT_GT(shadowed, 500);
    shares[size == 256 ? 0 : 1] = static_cast<double>(wrong) / static_cast<double>(places.size());
  }
  EXPECT_LT(shares[0], 0.01);
  // The border is a line: its share goes with a texel's side.
  EXPECT_LT(shares[1], 0.5 * shares[0]);
}

// Nothing is between a light and the walls of its room: a texel away from their edges no surface shadows
// itself, however it is met.
TEST(ShadowMap, ARoomWithoutThingsHasNoShadow) {
  Scene room;
  room.materials.emplace_back();
  room.meshes.push_back(inside_out(box_mesh()));
  room.instances.push_back({"room", 0, scaled({2, 1.5, 3}, {0, 0, 0}), -1});
  const TracedScene scene(std::move(room));
  const Vec3d light{0.4, 0.3, -0.5};
  std::mt19937 random(9);
  std::uniform_real_distribution<double> along(-0.9, 0.9);
  for (const bool moments : {false, true}) {
    const ShadowMap map(scene, light, {.size = 256, .moments = moments});
    for (int k = 0; k < 3000; ++k) {
      Vec3d place{2 * along(random), 1.5 * along(random), 3 * along(random)}, normal{0, 0, 0};
      const double side = k & 1 ? 1 : -1;
      switch (k % 3) {
        case 0:
          place.x = 2 * side;
          normal.x = -side;
          break;
        case 1:
          place.y = 1.5 * side;
          normal.y = -side;
          break;
        default:
          place.z = 3 * side;
          normal.z = -side;
      }
      // Of moments, slopes within a texel have a variance, and the bound is not tight.
      ASSERT_GE(map.visibility(place, normal), moments ? 0.4 : 1 - 1e-12)
          << place.x << " " << place.y << " " << place.z;
    }
  }
}

// A bound on the share that is lit: in the middle of a shadow little, out of it nearly all.
TEST(ShadowMap, MomentsAgreeAwayFromBorders) {
  const TracedScene scene(still_life());
  const ShadowMap map(scene, kLight, {.size = 256, .moments = true});
  const auto shadow_of = [&](const Vec3d& occluder, double height) {
    const Vec3d way = occluder - kLight;
    return kLight + ((height - kLight.y) / way.y) * way;
  };
  EXPECT_LT(map.visibility(shadow_of({-0.6, 0.1, 0.2}, -1), {0, 1, 0}), 0.1);
  EXPECT_GT(map.visibility({3, -1, -3}, {0, 1, 0}), 0.9);
}

// Lit by maps a picture is what it is by rays, but at the borders of shadows.
TEST(ShadowMap, LightsThrowTheSameShadowsByMapsAndByRays) {
  const TracedScene scene(still_life());
  const auto places = lit_places(scene, 4000, 11);
  const auto lit = [&](Shadows shadows) {
    std::vector<Rgb> radiance(places.size());
    with_lights(std::make_unique<EmissionShading>(), scene, shadows)->shade(places, radiance);
    return radiance;
  };
  const auto none = lit(Shadows::none), map = lit(Shadows::map), traced = lit(Shadows::traced);
  double all = 0, wrong = 0, dark = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LE(traced[i][0], none[i][0]);
    all += none[i][0];
    wrong += std::abs(map[i][0] - traced[i][0]);
    dark += none[i][0] - traced[i][0];
  }
  EXPECT_GT(dark, 0.02 * all);
  EXPECT_LT(wrong, 0.005 * all);
}

// White and rough, straight below a light of intensity I at distance d: I/(π d²) of diffuse light, less what
// is mirrored, and GGX's few per cent.
TEST(ShadowMap, LightsFallWithTheSquareOfDistance) {
  Scene floor = still_life();
  floor.instances.resize(1);
  floor.materials[0].ior = 1;
  const TracedScene scene(std::move(floor));
  const auto shading = with_lights(std::make_unique<EmissionShading>(), scene);
  for (const double x : {0.6, 2.6}) {
    RaySpread ray{};
    ray.origin = {x, 5, -0.8};
    ray.direction = {0, -1, 0};
    const Surface at = scene.surface(ray, scene.closest({to_float(ray.origin), to_float(ray.direction)}));
    Rgb radiance;
    shading->shade({&at, 1}, {&radiance, 1});
    const double across = x - 0.6, square = across * across + 3.5 * 3.5, cosine = 3.5 / std::sqrt(square);
    EXPECT_NEAR(radiance[0], 8 * cosine / (kPi * square), 1e-3 * radiance[0]) << x;
  }
}

TEST(ShadowMap, RefusesWhatMakesNoSense) {
  const TracedScene scene(still_life());
  EXPECT_THROW(ShadowMap(scene, kLight, {.size = 15}), Error);
  EXPECT_THROW(ShadowMap(scene, kLight, {.size = 16385}), Error);
  EXPECT_THROW(ShadowMap(scene, kLight, {.bias = -1}), Error);
  EXPECT_THROW(ShadowMap(scene, {std::numeric_limits<double>::quiet_NaN(), 0, 0}), Error);
  // At the light itself there is nothing between.
  EXPECT_EQ(ShadowMap(scene, kLight, {.size = 16}).visibility(kLight, {0, 1, 0}), 1);
}

}  // namespace
}  // namespace welkin::scene
