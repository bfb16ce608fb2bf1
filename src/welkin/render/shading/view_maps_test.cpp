#include "welkin/render/shading/view_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin::scene {
namespace {

/// A smooth world along a direction.
std::array<float, 3> world(const Vec3d& d) {
  const auto value = [](double x) { return static_cast<float>(1 + 0.5 * x); };
  return {value(d.x), value(d.y * d.z), value(std::sin(3 * d.z))};
}

std::array<float, 3> mirror(const Vec3d& n, const Vec3d& v) {
  return world(2 * dot(n, v) * n - v);
}

/// The largest error over views and normals that face them by more than a cosine.
double worst_error(const WarpedViews& views,
                   const std::function<std::array<float, 3>(const Vec3d&, const Vec3d&)>& exact) {
  double worst = 0;
  for (const Vec3d& v : even_directions(40)) {
    for (const Vec3d& n : even_directions(200)) {
      if (dot(n, v) < 0.5) continue;
      const auto got = views.rgb(n, v), right = exact(n, v);
      for (std::size_t c = 0; c < 3; ++c) worst = std::max<double>(worst, std::abs(got[c] - right[c]));
    }
  }
  return worst;
}

// A mirror shows the same along a reflected direction to every viewer, so warping is exact but for the texels
// of the pictures: 1/128 of the ball's diameter, and where the map was seen at grazing angles.
TEST(WarpedViews, MirrorsAreExact) {
  const WarpedViews views(view_maps(even_directions(20), 256, mirror));
  EXPECT_LT(worst_error(views, mirror), 0.03);
}

// Diffuse light depends on the normal alone, which warping moves: where the method fails.
TEST(WarpedViews, DiffuseSurfacesAreWrong) {
  const auto diffuse = [](const Vec3d& n, const Vec3d&) { return world(n); };
  const WarpedViews few(view_maps(even_directions(12), 128, diffuse)),
      many(view_maps(even_directions(300), 128, diffuse));
  const double error = worst_error(few, diffuse);
  EXPECT_GT(error, 0.1);
  EXPECT_LT(worst_error(many, diffuse), error / 2);
}

// From a map's own direction nothing is warped.
TEST(WarpedViews, AtAMapsOwnViewItIsTheMap) {
  const auto diffuse = [](const Vec3d& n, const Vec3d&) { return world(n); };
  const std::vector<Vec3d> directions = even_directions(12);
  const WarpedViews views(view_maps(directions, 256, diffuse));
  for (const Vec3d& v : directions) {
    for (const Vec3d& n : even_directions(100)) {
      if (dot(n, v) < 0.3) continue;
      const auto got = views.rgb(n, v), right = world(n);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], right[c], 0.02);
    }
  }
}

TEST(WarpedViews, RefusesWhatCannotBeBlended) {
  EXPECT_THROW(WarpedViews({}), Error);
  EXPECT_THROW(even_directions(2), Error);
  std::vector<ViewMap> maps = view_maps(even_directions(3), 8, mirror);
  maps[1].picture = Image(8, 4, 3);
  EXPECT_THROW(WarpedViews(std::move(maps)), Error);
}

}  // namespace
}  // namespace welkin::scene
