#include "welkin/scene/shapes.h"

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/vec_precision.h"

namespace welkin::scene {
namespace {

constexpr int kMostCells = 10'000'000;

bool has_area(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto& p = mesh.positions;
  return length(cross(p[triangle[1]] - p[triangle[0]], p[triangle[2]] - p[triangle[0]])) > 1e-12f;
}

}  // namespace

Mesh grid_mesh(const std::function<GridPoint(double u, double v)>& point, int columns, int rows) {
  require(columns >= 1 && rows >= 1 && columns <= kMostCells / rows, "a grid has 1 to 10,000,000 cells");
  Mesh mesh;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double u = static_cast<double>(column) / columns, v = static_cast<double>(row) / rows;
      const GridPoint at = point(u, v);
      mesh.positions.push_back(to_float(at.position));
      mesh.normals.push_back(to_float(normalize(at.normal)));
      mesh.uv[0].push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  }
  const auto index = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = index(column, row), b = index(column + 1, row), c = index(column + 1, row + 1),
                          d = index(column, row + 1);
      for (const std::array<std::uint32_t, 3>& triangle : {std::array{a, d, c}, std::array{a, c, b}})
        if (has_area(mesh, triangle)) mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

Mesh sphere_mesh(int rows) {
  require(rows >= 2, "a sphere has two rows at least");
  Mesh mesh = grid_mesh(
      [](double u, double v) {
        // From −Z by way of −X, as u goes right seen from outside; from the top down.
        // Where it closes, vertices are the same to the bit, or rays go through between them.
        const double azimuth = u < 1 ? 2 * kPi * u : 0, polar = kPi * v, s = v < 1 ? std::sin(polar) : 0;
        const Vec3d d{-s * std::sin(azimuth), std::cos(polar), -s * std::cos(azimuth)};
        return GridPoint{d, d};
      },
      2 * rows, rows);
  mesh.name = "sphere";
  return mesh;
}

Mesh torus_mesh(double tube, int around, int across) {
  require(tube > 0 && tube < 1, "a torus's tube is thinner than its ring");
  Mesh mesh = grid_mesh(
      [tube](double u, double v) {
        const double azimuth = u < 1 ? 2 * kPi * u : 0, turn = v < 1 ? kPi * (1 - 2 * v) : kPi;
        const Vec3d out{-std::sin(azimuth), 0, -std::cos(azimuth)};
        const Vec3d normal = std::cos(turn) * out + Vec3d{0, std::sin(turn), 0};
        return GridPoint{out + tube * normal, normal};
      },
      around, across);
  mesh.name = "torus";
  return mesh;
}

Mesh square_mesh(int cells) {
  Mesh mesh = grid_mesh(
      [](double u, double v) {
        return GridPoint{{2 * u - 1, 0, 2 * v - 1}, {0, 1, 0}};
      },
      cells, cells);
  mesh.name = "square";
  return mesh;
}

Mesh box_mesh() {
  Mesh mesh;
  mesh.name = "box";
  const Mesh face = square_mesh();
  // The rotations that take +Y to each side.
  const Matrix3 turns[] = {rotation_from_yaw_pitch_roll(0, 0, 0),  rotation_from_yaw_pitch_roll(0, 180, 0),
                           rotation_from_yaw_pitch_roll(0, 90, 0), rotation_from_yaw_pitch_roll(0, -90, 0),
                           rotation_from_yaw_pitch_roll(0, 0, 90), rotation_from_yaw_pitch_roll(0, 0, -90)};
  for (const Matrix3& turn : turns) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t i = 0; i < face.positions.size(); ++i) {
      mesh.positions.push_back(turn * (face.positions[i] + Vec3<float>{0, 1, 0}));
      mesh.normals.push_back(turn * face.normals[i]);
      mesh.uv[0].push_back(face.uv[0][i]);
    }
    for (const auto& triangle : face.triangles)
      mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
  return mesh;
}

}  // namespace welkin::scene
