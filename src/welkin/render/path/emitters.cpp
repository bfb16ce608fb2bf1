#include "welkin/render/path/emitters.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/vec_precision.h"

namespace welkin::scene {
namespace {

double brightness(const Scene& scene, const Instance& instance) {
  const auto& emission = material_of(scene, instance).emission;
  return 0.2126 * emission[0] + 0.7152 * emission[1] + 0.0722 * emission[2];
}

}  // namespace

Emitters::Emitters(const Scene& scene) : scene_(scene), part_of_(scene.instances.size(), -1) {
  double sum = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const double glow = brightness(scene, scene.instances[i]);
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(scene.instances[i].mesh)];
    if (!(glow > 0) || mesh.triangles.empty()) continue;
    part_of_[i] = static_cast<std::int64_t>(parts_.size());
    parts_.push_back({i, glow, ends_.size()});
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Corners c = corners(i, t);
      sum += glow * 0.5 * length(cross(c.e1, c.e2));
      ends_.push_back(sum);
    }
  }
  if (!(sum > 0)) ends_.clear();
  for (double& end : ends_) end /= sum;
  for (Part& part : parts_) part.density /= sum;
}

Emitters::Corners Emitters::corners(std::uint32_t instance, std::uint32_t triangle) const {
  const Instance& placed = scene_.instances[instance];
  const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(placed.mesh)];
  auto vertices = mesh.triangles[triangle];
  // As TracedScene turns the triangles of mirrored meshes.
  if (determinant(placed.to_world.linear) < 0) std::swap(vertices[1], vertices[2]);
  const auto at = [&](std::size_t k) {
    return point_to(placed.to_world, to_double(mesh.positions[vertices[k]]));
  };
  const Vec3d p0 = at(0);
  return {p0, at(1) - p0, at(2) - p0};
}

Emitters::Drawn Emitters::draw(double which, double u1, double u2) const {
  const auto found = std::upper_bound(ends_.begin(), ends_.end() - 1, which);
  const auto index = static_cast<std::size_t>(found - ends_.begin());
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), index,
                                      [](std::size_t i, const Part& part) { return i < part.first; });
  const Part& part = *(after - 1);
  const auto triangle = static_cast<std::uint32_t>(index - part.first);
  const double root = std::sqrt(u1), b1 = root * (1 - u2), b2 = root * u2;
  const Corners c = corners(part.instance, triangle);
  return {{0, part.instance, triangle, static_cast<float>(b1), static_cast<float>(b2)},
          c.p0 + b1 * c.e1 + b2 * c.e2};
}

double Emitters::density(std::uint32_t instance) const {
  const std::int64_t part = part_of_[instance];
  return part < 0 || ends_.empty() ? 0 : parts_[static_cast<std::size_t>(part)].density;
}

}  // namespace welkin::scene
