#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/math/angles.h"
#include "welkin/math/vec_precision.h"
#include "welkin/scene/aimed_camera.h"
#include "welkin/scene/scene_parts.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

constexpr double kReach = 120;      // from the middle to the edges
constexpr double kWater = -1.4;     // its level
constexpr double kTreeLine = 17.0;  // above it none grow

/// 0…1, from whole numbers; always the same.
double hashed(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                    static_cast<std::uint32_t>(y) * 0xd8163841u ^ static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return static_cast<double>(h ^ (h >> 16)) / 4294967295.0;
}

/// Smooth noise, −1…1, that varies over lengths of about 1.
double noise(const Vec3d& p) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto blend = [](double f) { return f * f * f * (f * (6 * f - 15) + 10); };
  const double sx = blend(p.x - fx), sy = blend(p.y - fy), sz = blend(p.z - fz);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const double weight = (x ? sx : 1 - sx) * (y ? sy : 1 - sy) * (z ? sz : 1 - sz);
    sum += weight * hashed(static_cast<std::int32_t>(fx) + x, static_cast<std::int32_t>(fy) + y,
                           static_cast<std::int32_t>(fz) + z);
  }
  return 2 * sum - 1;
}

double noise_sum(Vec3d p, int octaves) {
  double sum = 0, weight = 0.55;
  for (int i = 0; i < octaves; ++i, weight *= 0.5) {
    sum += weight * noise(p);
    p = 2.03 * p + Vec3d{17.3, 5.1, 9.7};
  }
  return sum;
}

/// A meadow in the middle, a lake beside it, hills, and mountains all around.
double height_at(double x, double z) {
  const double r = std::hypot(x, z);
  const double hills = 8 * noise_sum({x / 34, 0.5, z / 34}, 5) + 1.5;
  const double ridge = 1 - std::abs(noise_sum({x / 46, 7.5, z / 46}, 6));
  const double mountains = smooth_step(52, 104, r) * (12 + 34 * ridge * ridge);
  const double lake = 5.5 * (1 - smooth_step(7, 21, std::hypot(x - 17, z + 21)));
  return smooth_step(5, 24, r) * hills + mountains - lake;
}

/// By differences over ± those steps.
Vec3d normal_at(double x, double z, double step_x = 0.05, double step_z = 0.05) {
  return normalize(Vec3d{(height_at(x - step_x, z) - height_at(x + step_x, z)) / step_x, 2,
                         (height_at(x, z - step_z) - height_at(x, z + step_z)) / step_z});
}

/// Finer in the middle, where one stands.
double spread(double u) {
  const double s = 2 * u - 1;
  return kReach * (0.3 * s + 0.7 * s * s * s);
}

Vec3d mixed(const Vec3d& a, const Vec3d& b, double share) {
  return (1 - share) * a + share * b;
}

/// What grows or lies there: reflectance.
Vec3d ground_color(double x, double z) {
  const double h = height_at(x, z), steep = 1 - normal_at(x, z).y, rough = noise_sum({x / 3, 3.5, z / 3}, 4);
  Vec3d color = mixed({0.09, 0.15, 0.03}, {0.24, 0.22, 0.07},
                      smooth_step(-0.4, 0.5, noise_sum({x / 15, 1.5, z / 15}, 3)));
  color = mixed(color, {0.2, 0.18, 0.16}, smooth_step(0.2, 0.34, steep + 0.1 * rough));
  color = mixed(color, {0.22, 0.2, 0.19}, smooth_step(kTreeLine - 3, kTreeLine + 8, h + 4 * rough));
  color = mixed(color, {0.82, 0.85, 0.9}, smooth_step(26, 31, h + 5 * rough - 14 * steep));
  color = mixed({0.42, 0.36, 0.24}, color, smooth_step(kWater + 0.15, kWater + 0.8, h + 0.3 * rough));
  return (1 + 0.35 * rough) * color;
}

Picture ground_picture() {
  constexpr int kSize = 512;
  Picture picture{"ground", Image(kSize, kSize, 3), Wrap::clamp, Wrap::clamp};
  parallel_for(kSize, [&](int y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec3d color = ground_color(spread((x + 0.5) / kSize), spread((y + 0.5) / kSize));
      float* texel = picture.image.at(x, y);
      texel[0] = static_cast<float>(color.x);
      texel[1] = static_cast<float>(color.y);
      texel[2] = static_cast<float>(color.z);
    }
  });
  return picture;
}

Mesh ground_mesh(double triangles) {
  const int cells = rows_for(triangles, 1, 32);
  // Normals of what the grid can show: differences over half a cell.
  const double half = 0.5 / cells;
  return grid_mesh(
      [half](double u, double v) {
        const double x = spread(u), z = spread(v);
        const double step_x = 0.5 * (spread(u + half) - spread(u - half)),
                     step_z = 0.5 * (spread(v + half) - spread(v - half));
        return GridPoint{{x, height_at(x, z), z}, normal_at(x, z, step_x, step_z)};
      },
      cells, cells);
}

/// A ball whose radius is 1 + depth · noise, where the noise varies over 1/frequency.
Mesh bumpy_mesh(int rows, double depth, double frequency, double seed) {
  const auto excess = [=](const Vec3d& p) {
    const Vec3d d = normalize(p);
    return length(p) - 1 - depth * noise(frequency * d + Vec3d{seed, 2 * seed, 3 * seed});
  };
  return grid_mesh(
      [&](double u, double v) {
        const double azimuth = u < 1 ? 2 * kPi * u : 0, polar = kPi * v, s = v < 1 ? std::sin(polar) : 0;
        const Vec3d d{-s * std::sin(azimuth), std::cos(polar), -s * std::cos(azimuth)};
        const Vec3d p = (1 - excess(d)) * d;
        constexpr double kStep = 1e-3;
        const Vec3d x{kStep, 0, 0}, y{0, kStep, 0}, z{0, 0, kStep};
        return GridPoint{
            p, {excess(p + x) - excess(p - x), excess(p + y) - excess(p - y), excess(p + z) - excess(p - z)}};
      },
      2 * rows, rows);
}

/// Four skirts of needles, 7 high.
Mesh fir_mesh(int rows) {
  const auto outline = curve_through({{1.3, 0, 0},
                                      {0.95, 1.65, 0},
                                      {1.1, 1.75, 0},
                                      {2.5, 0.95, 0},
                                      {2.25, 1.35, 0},
                                      {2.4, 1.42, 0},
                                      {3.9, 0.72, 0},
                                      {3.7, 1.02, 0},
                                      {3.85, 1.06, 0},
                                      {5.2, 0.42, 0},
                                      {5.05, 0.68, 0},
                                      {5.2, 0.7, 0},
                                      {7, 0, 0}});
  return lathe_mesh(
      [&](double t) {
        const Vec3d at = outline(t);
        return ProfilePoint{at.x, std::max(at.y, 0.0)};
      },
      std::max(6, rows / 2), rows);
}

enum Plant { kFir, kOak, kBirch, kRock, kPlants };

struct Standing {
  Plant plant;
  Vec3d at;
  double size, yaw;
};

std::vector<Standing> plants() {
  std::vector<Standing> all;
  constexpr double kCell = 4.6;
  constexpr int kHalf = 22;
  for (int row = -kHalf; row <= kHalf; ++row) {
    for (int column = -kHalf; column <= kHalf; ++column) {
      const auto chance = [&](int i) { return hashed(column, row, 100 + i); };
      const double x = kCell * (column + 0.9 * (chance(0) - 0.5)),
                   z = kCell * (row + 0.9 * (chance(1) - 0.5));
      const double y = height_at(x, z), r = std::hypot(x, z), steep = 1 - normal_at(x, z).y;
      if (r < 7.5 || y < kWater + 0.35) continue;
      const double wood = 0.5 * noise_sum({x / 22, 11.5, z / 22}, 2) + 0.42;
      if (chance(2) > wood) {
        if (chance(3) < 0.07) all.push_back({kRock, {x, y, z}, 0.3 + 0.8 * chance(4), 360 * chance(5)});
        continue;
      }
      if (y > kTreeLine || steep > 0.3) continue;
      const double needles = smooth_step(2, 10, y) + 0.35;
      const Plant plant = chance(3) < needles ? kFir : chance(6) < 0.7 ? kOak : kBirch;
      all.push_back({plant, {x, y - 0.1, z}, 0.6 + 0.6 * chance(4), 360 * chance(5)});
    }
  }
  return all;
}

void merge(Mesh& mesh, const Mesh& other, const Vec3d& scale, const Vec3d& at) {
  const Transform to = placed(at, scale);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i < other.positions.size(); ++i) {
    const Vec3<float>&p = other.positions[i], &n = other.normals[i];
    mesh.positions.push_back(to_float(point_to(to, {p.x, p.y, p.z})));
    mesh.normals.push_back(to_float(normalize(normal_to(to, {n.x, n.y, n.z}))));
    mesh.uv[0].push_back(other.uv[0][i]);
  }
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Meshes of all plants, each of about so many triangles.
std::array<std::vector<int>, kPlants> add_plants(Scene& scene, double triangles) {
  const int bark = add_material(scene, paint("bark", {0.09f, 0.06f, 0.04f}));
  const int white_bark = add_material(scene, paint("white bark", {0.55f, 0.53f, 0.48f}));
  const int needles = add_material(scene, paint("needles", {0.03f, 0.075f, 0.03f}));
  const int leaves = add_material(scene, paint("leaves", {0.07f, 0.14f, 0.025f}));
  const int light_leaves = add_material(scene, paint("light leaves", {0.2f, 0.24f, 0.04f}));
  const int stone = add_material(scene, paint("stone", {0.24f, 0.23f, 0.22f}));
  const auto trunk = [&](double height, double radius) {
    const int rows = rows_for(0.12 * triangles, 1, 5);
    return lathe_mesh(rod_profile(height, radius, 0.45 * radius), std::max(6, rows), std::max(5, rows));
  };
  const auto crown = [&](const std::vector<std::array<double, 4>>& balls, double seed) {
    Mesh mesh;
    const int rows = rows_for(0.88 * triangles / static_cast<double>(balls.size()), 2, 4);
    for (const auto& [x, y, z, radius] : balls)
      merge(mesh, bumpy_mesh(rows, 0.22, 3.1, seed += 1.7), {radius, 0.85 * radius, radius}, {x, y, z});
    return mesh;
  };
  const Mesh oak =
      crown({{0, 3.6, 0, 1.5}, {0.95, 3.1, 0.3, 1.05}, {-0.8, 3.0, 0.55, 1.1}, {-0.1, 3.05, -1.0, 1.0}}, 3);
  const Mesh birch = crown({{0, 4.3, 0, 0.95}, {0.25, 3.2, 0.1, 1.0}, {-0.2, 5.3, 0, 0.65}}, 31);
  std::array<std::vector<int>, kPlants> meshes;
  meshes[kFir] = {add_mesh(scene, fir_mesh(rows_for(0.88 * triangles, 0.5, 12)), "fir", needles),
                  add_mesh(scene, trunk(1.6, 0.22), "fir: trunk", bark)};
  meshes[kOak] = {add_mesh(scene, oak, "oak", leaves), add_mesh(scene, trunk(2.8, 0.24), "oak: trunk", bark)};
  meshes[kBirch] = {add_mesh(scene, birch, "birch", light_leaves),
                    add_mesh(scene, trunk(4.2, 0.14), "birch: trunk", white_bark)};
  meshes[kRock] = {add_mesh(scene, bumpy_mesh(rows_for(triangles, 2, 4), 0.3, 1.6, 77), "rock", stone)};
  return meshes;
}

}  // namespace

Scene make_landscape(int triangles) {
  Scene scene;
  const double all = triangles > 0 ? triangles : 200'000;
  Material water = paint("water", {0.015f, 0.04f, 0.05f}, 0.02f);
  water.ior = 1.33f;
  constexpr double kWet = 62;  // beyond, the ground is higher everywhere
  add_object(scene, square_mesh(16), "water", add_material(scene, std::move(water)),
             placed({0, kWater, 0}, {kWet, 1, kWet}));

  const std::vector<Standing> standing = plants();
  const auto meshes = add_plants(scene, 0.55 * all / static_cast<double>(standing.size()));
  for (const Standing& each : standing) {
    const double s = each.size;
    for (const int mesh : meshes[each.plant])
      add_instance(scene, scene.meshes[static_cast<std::size_t>(mesh)].name, mesh,
                   placed(each.at, {s, each.plant == kRock ? 0.7 * s : s, s}, each.yaw));
  }
  // The ground has the rest of the triangles.
  scene.pictures.push_back(ground_picture());
  Material ground = paint("ground", {1, 1, 1}, 1);
  ground.base_map.picture = 0;
  add_object(scene, ground_mesh(all - static_cast<double>(triangle_count(scene))), "ground",
             add_material(scene, std::move(ground)));
  SceneCamera overview = camera_seeing(*bounds_of(scene), {-0.45, 0.75, 1}, 35, 16.0 / 9);
  overview.name = "overview";
  scene.cameras.push_back(std::move(overview));
  SceneCamera meadow = aimed_camera({-3.5, 2.2, 5.5}, {3, 1.4, -6}, 50);
  meadow.name = "meadow";
  scene.cameras.push_back(std::move(meadow));
  return scene;
}

}  // namespace welkin::scene
