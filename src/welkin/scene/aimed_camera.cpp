#include "welkin/scene/aimed_camera.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"

namespace welkin::scene {

SceneCamera aimed_camera(const Vec3d& position, const Vec3d& target, double vertical_fov) {
  require(vertical_fov > 0 && vertical_fov < 180, "a field of view is between 0 and 180 degrees");
  const Vec3d way = target - position;
  require(length(way) > 0 && std::isfinite(length(way)), "a camera looks at another point than its own");
  const Vec3d ahead = normalize(way);
  // Straight up or down, the top of the picture is −Z or +Z.
  const bool steep = std::abs(ahead.y) > 1 - 1e-9;
  const Vec3d above = steep ? Vec3d{0, 0, ahead.y > 0 ? 1.0 : -1.0} : Vec3d{0, 1, 0};
  const Vec3d left = normalize(cross(above, ahead)), up = cross(ahead, left);
  SceneCamera camera;
  camera.name = "camera";
  camera.position = position;
  camera.rotation.rows = {{{left.x, up.x, ahead.x}, {left.y, up.y, ahead.y}, {left.z, up.z, ahead.z}}};
  camera.vertical_fov = vertical_fov;
  return camera;
}

SceneCamera camera_seeing(const Bounds& box, const Vec3d& from, double vertical_fov, double aspect) {
  require(aspect > 0 && std::isfinite(aspect), "a picture's width over its height is over 0");
  const Vec3d middle = 0.5 * (box.least + box.most);
  require(length(from) > 0 && std::isfinite(length(from)), "a camera stands in some direction");
  const Vec3d out = normalize(from);
  SceneCamera camera = aimed_camera(middle + out, middle, vertical_fov);
  const Matrix3 to_camera = transpose(camera.rotation);
  const double up_slope = std::tan(vertical_fov / 2 * kDegree), side_slope = aspect * up_slope;
  // A corner is seen where its distance ahead is at least its height and breadth over the slopes.
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d at{corner & 1 ? box.most.x : box.least.x, corner & 2 ? box.most.y : box.least.y,
                   corner & 4 ? box.most.z : box.least.z};
    const Vec3d seen = to_camera * (at - middle);
    distance =
        std::max({distance, std::abs(seen.x) / side_slope - seen.z, std::abs(seen.y) / up_slope - seen.z});
  }
  constexpr double kMargin = 1.06;
  camera.position = middle + (kMargin * std::max(distance, 1e-6)) * out;
  camera.aspect = aspect;
  return camera;
}

}  // namespace welkin::scene
