#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "welkin/scene/scene.h"

/// @file
/// What the tests of meshes measure.
namespace welkin::scene {

/// The volume that a closed mesh encloses: positive where triangles face outwards.
inline double volume_of(const Mesh& mesh) {
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
inline double worst_agreement(const Mesh& mesh) {
  double worst = 1;
  for (const auto& t : mesh.triangles) {
    const auto& p = mesh.positions;
    const Vec3<float> flat = normalize(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
    for (const std::uint32_t i : t) worst = std::min<double>(worst, dot(flat, mesh.normals[i]));
  }
  return worst;
}

/// The mean of that cosine over the mesh's area.
inline double mean_agreement(const Mesh& mesh) {
  double sum = 0, area = 0;
  for (const auto& t : mesh.triangles) {
    const auto& p = mesh.positions;
    const Vec3<float> flat = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    for (const std::uint32_t i : t) sum += static_cast<double>(dot(flat, mesh.normals[i])) / 3;
    area += static_cast<double>(length(flat));
  }
  return sum / area;
}

/// Whether every edge, by the places of its ends to the bit, lies between triangles as often this way as
/// that.
inline bool is_closed(const Mesh& mesh) {
  std::map<std::array<float, 3>, int> numbers;
  const auto number = [&](std::uint32_t index) {
    const Vec3<float>& p = mesh.positions[index];
    return numbers.emplace(std::array{p.x, p.y, p.z}, static_cast<int>(numbers.size())).first->second;
  };
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = number(t[i]), b = number(t[(i + 1) % 3]);
      if (a != b) uses[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 0; });
}

}  // namespace welkin::scene
