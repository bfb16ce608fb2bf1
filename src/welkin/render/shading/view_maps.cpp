#include "welkin/render/shading/view_maps.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/render/shading/texture_coordinates.h"

namespace welkin::scene {
namespace {

/// The third row of a frame: the direction of its viewer.
Vec3d viewer_of(const Matrix3& to_eye) {
  return {to_eye.rows[2][0], to_eye.rows[2][1], to_eye.rows[2][2]};
}

std::array<float, 3> bilinear(const Image& picture, const SphereMapPlace& place) {
  const int last = picture.width() - 1;
  const double x = std::clamp(place[0] * picture.width() - 0.5, 0.0, 1.0 * last);
  const double y = std::clamp(place[1] * picture.height() - 0.5, 0.0, 1.0 * last);
  const int i = std::min(static_cast<int>(x), std::max(last - 1, 0)),
            j = std::min(static_cast<int>(y), std::max(last - 1, 0));
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  std::array<float, 3> value{};
  for (int c = 0; c < 3; ++c) {
    const auto at = [&](int dx, int dy) {
      return picture.at(std::min(i + dx, last), std::min(j + dy, last))[c];
    };
    value[static_cast<std::size_t>(c)] =
        (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
  }
  return value;
}

}  // namespace

Matrix3 eye_towards(const Vec3d& view) {
  const Vec3d z = normalize(view);
  const Vec3d x = normalize(std::abs(z.y) < 0.999 ? cross({0, 1, 0}, z) : cross({0, 0, -1}, z));
  const Vec3d y = cross(z, x);
  return {{{{x.x, x.y, x.z}, {y.x, y.y, y.z}, {z.x, z.y, z.z}}}};
}

std::vector<Vec3d> even_directions(int count) {
  require(count >= 3 && count <= 1000, "views are 3 to 1000");
  std::vector<Vec3d> all;
  const double golden = kPi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, radius = std::sqrt(1 - y * y);
    all.push_back({radius * std::cos(golden * i), y, radius * std::sin(golden * i)});
  }
  return all;
}

std::vector<ViewMap> view_maps(const std::vector<Vec3d>& views, int size,
                               const std::function<std::array<float, 3>(const Vec3d&, const Vec3d&)>& shown) {
  require(size >= 2 && size <= 8192, "a view map has 2 to 8192 texels a side");
  std::vector<ViewMap> maps;
  for (const Vec3d& view : views) maps.push_back({eye_towards(view), Image(size, size, 3)});
  parallel_for(static_cast<int>(maps.size()) * size, [&](int index) {
    ViewMap& map = maps[static_cast<std::size_t>(index / size)];
    const int row = index % size;
    const Matrix3 to_world = transpose(map.to_eye);
    const Vec3d view = viewer_of(map.to_eye);
    for (int column = 0; column < size; ++column) {
      double x = 2 * (column + 0.5) / size - 1, y = 1 - 2 * (row + 0.5) / size;
      const double r = std::hypot(x, y);
      if (r > 1) {
        x /= r;
        y /= r;
      }
      const Vec3d normal = to_world * Vec3d{x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))};
      const auto value = shown(normal, view);
      std::copy(value.begin(), value.end(), map.picture.at(column, row));
    }
  });
  return maps;
}

WarpedViews::WarpedViews(std::vector<ViewMap> maps) : maps_(std::move(maps)) {
  require(maps_.size() >= 3, "three views at least are blended");
  for (const ViewMap& map : maps_) {
    require(map.picture.width() == map.picture.height() && map.picture.channels() >= 3,
            "a view map is square and has R, G and B");
    require(is_orthonormal(map.to_eye), "a viewer's frame is orthonormal");
  }
}

std::array<float, 3> WarpedViews::rgb(const Vec3d& normal, const Vec3d& view) const {
  // The three nearest.
  std::array<std::size_t, 3> nearest{};
  std::array<double, 3> cosines{-2, -2, -2};
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    double cosine = dot(viewer_of(maps_[i].to_eye), view);
    std::size_t index = i;
    for (std::size_t k = 0; k < 3; ++k) {
      if (cosine > cosines[k]) {
        std::swap(cosine, cosines[k]);
        std::swap(index, nearest[k]);
      }
    }
  }
  // view = Σ weight · viewer, as far as that is between them.
  const Vec3d a = viewer_of(maps_[nearest[0]].to_eye), b = viewer_of(maps_[nearest[1]].to_eye),
              c = viewer_of(maps_[nearest[2]].to_eye);
  const double volume = dot(a, cross(b, c));
  std::array<double, 3> weights{1, 0, 0};
  if (std::abs(volume) > 1e-9) {
    weights = {dot(view, cross(b, c)) / volume, dot(a, cross(view, c)) / volume,
               dot(a, cross(b, view)) / volume};
    for (double& weight : weights) weight = std::max(weight, 0.0);
  }
  const Vec3d r = 2 * dot(normal, view) * normal - view;
  std::array<float, 3> sum{};
  double total = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const ViewMap& map = maps_[nearest[k]];
    const Vec3d half = r + viewer_of(map.to_eye);
    // What is reflected straight away from a viewer cannot be in the map.
    const double size = length(half), weight = weights[k] * std::min(1.0, size * size);
    if (!(weight > 0)) continue;
    const auto value = bilinear(map.picture, sphere_map_of_normal(map.to_eye * ((1 / size) * half)));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += static_cast<float>(weight) * value[i];
    total += weight;
  }
  if (total > 0) {
    for (float& value : sum) value /= static_cast<float>(total);
  }
  return sum;
}

}  // namespace welkin::scene
