#include "welkin/camera/view.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/camera/camera_cases.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/borders.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

Map smooth_world(const char* parameterization, int width) {
  return cases::coloured_world(parameterization, width, [](const Vec3d& d) {
    return cases::Colour{1 + d.x, 1 + d.y * d.z, 1 + 0.5 * std::sin(3 * d.z)};
  });
}

Camera camera_of(const char* lens) {
  Camera camera;
  camera.lens = lens;
  camera.size = {96, 54};
  camera.rotation = rotation_of({140, 35, 20});
  return camera;
}

const char* const kLenses[] = {"perspective",   "pannini",     "pannini,d=0.6,vertical=0.5,fov=140",
                               "stereographic", "equidistant", "equisolid",
                               "orthographic",  "cylindrical", "dome,tilt=20,fov=220",
                               "little-planet", "latlong"};

/// The picture is the world, whatever lens it is seen through and whatever map it is seen in.
TEST(View, ShowsTheWorldInEveryPixel) {
  const Map world = smooth_world("cube", 128);
  for (const char* lens : kLenses) {
    const Map picture = view(world, camera_of(lens), {.filter = Filter::bicubic, .borders = false});
    for (int y = 0; y < picture.height(); y += 7) {
      for (int x = 0; x < picture.width(); x += 7) {
        const double u = (x + 0.5) / picture.width(), v = (y + 0.5) / picture.height();
        const float* found = picture.level.chart(0).at(x, y);
        if (!picture.parameterization.valid(0, u, v)) {
          if (is_outside_texel(picture.parameterization, {picture.width(), picture.height()}, 0, x, y)) {
            EXPECT_EQ(found[0], 0) << lens;
          }
          continue;
        }
        const Vec3d d = transpose(picture.orientation) * picture.parameterization.to_sphere(0, u, v);
        // A cubic on texels of 1/80: third derivatives of 13 times (1/80)³.
        EXPECT_NEAR(found[0], 1 + d.x, 1e-3) << lens;
        EXPECT_NEAR(found[1], 1 + d.y * d.z, 1e-3) << lens;
        EXPECT_NEAR(found[2], 1 + 0.5 * std::sin(3 * d.z), 1e-3) << lens;
      }
    }
  }
}

/// A picture is a map: looked up along the world's directions it is the world that it shows.
TEST(View, CanBeLookedUpAsAMap) {
  const Map world = smooth_world("latlong", 256);
  for (const char* lens : kLenses) {
    const Map picture = view(world, camera_of(lens));
    const auto p = picture.parameterization;
    const Vec3d ahead = transpose(picture.orientation) * p.to_sphere(0, 0.45, 0.55);
    const Sampler sampler(picture.clone(), {.filter = Filter::bicubic});
    EXPECT_NEAR(sampler.rgb(ahead)[0], 1 + ahead.x, 5e-3) << lens;
  }
}

TEST(View, OfAConstantIsConstant) {
  Map world(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int y = -kBorder; y < 32 + kBorder; ++y)
    std::fill_n(world.level.chart(0).at(-kBorder, y), 3 * (64 + 2 * kBorder), 0.7f);
  for (const char* lens : kLenses) {
    const Map picture = view(world, camera_of(lens));
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const bool shown = picture.parameterization.valid(0, (x + 0.5) / 96, (y + 0.5) / 54);
        ASSERT_NEAR(picture.level.chart(0).at(x, y)[1], shown ? 0.7f : 0.0f, shown ? 1e-6f : 0.7f) << lens;
      }
    }
  }
}

TEST(View, PairsPutTheLeftEyeFirst) {
  Map left(sphere::AnyParameterization::make("latlong"), 64, 32, 1);
  Map right = left.clone();
  for (int y = -kBorder; y < 32 + kBorder; ++y)
    std::fill_n(left.level.chart(0).at(-kBorder, y), 64 + 2 * kBorder, 1.0f);
  const Image beside = view_pair(left, right, camera_of("perspective"), Pair::left_right);
  ASSERT_EQ(beside.width(), 2 * 96);
  ASSERT_EQ(beside.height(), 54);
  EXPECT_NEAR(*beside.at(95, 30), 1, 1e-6);
  EXPECT_EQ(*beside.at(96, 30), 0);
  const Image above = view_pair(left, right, camera_of("perspective"), Pair::top_bottom);
  ASSERT_EQ(above.height(), 2 * 54);
  EXPECT_NEAR(*above.at(30, 53), 1, 1e-6);
  EXPECT_EQ(*above.at(30, 54), 0);
  const Map colour(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  EXPECT_THROW(view_pair(left, colour, camera_of("perspective"), Pair::left_right), Error);
}

}  // namespace
}  // namespace welkin
