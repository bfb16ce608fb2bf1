#include "welkin/camera/motion_blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/camera/camera_cases.h"
#include "welkin/camera/camera_path.h"
#include "welkin/camera/view.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

/// Bands and squares with hard edges.
Map patterned_world(const char* parameterization, int width) {
  return cases::coloured_world(parameterization, width, [](const Vec3d& d) {
    return cases::Colour{1 + d.x, std::sin(14 * std::atan2(d.x, d.z)) * std::sin(9 * d.y) > 0 ? 1.0 : 0.1,
                         std::fabs(d.y) < 0.05 ? 0.2 : 0.8};
  });
}

/// Turns, rolls and zooms.
Camera moving(double frame) {
  Camera camera;
  camera.size = {160, 90};
  camera.rotation = rotation_of({20 + 6 * frame, -10 + 3 * frame, 8 * frame});
  camera.fov = 80 - 2 * frame;
  return camera;
}

double relative_rmse(const Map& picture, const std::vector<double>& wanted) {
  double error = 0, all = 0;
  std::size_t i = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int k = 0; k < picture.width() * picture.channels(); ++k, ++i) {
      const double difference = static_cast<double>(picture.level.chart(0).row(y)[k]) - wanted[i];
      error += difference * difference;
      all += wanted[i] * wanted[i];
    }
  }
  return std::sqrt(error / all);
}

std::vector<double> mean_of_views(const Map& world, const std::function<Camera(double)>& camera,
                                  const Shutter& shutter, int count) {
  std::vector<double> sum;
  for (int i = 0; i < count; ++i) {
    const Map picture = view(world, camera(shutter.open + (shutter.close - shutter.open) * (i + 0.5) / count),
                             {.borders = false});
    if (sum.empty())
      sum.resize(static_cast<std::size_t>(picture.width() * picture.height() * picture.channels()));
    std::size_t k = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width() * picture.channels(); ++x, ++k)
        sum[k] += static_cast<double>(picture.level.chart(0).row(y)[x]) / count;
    }
  }
  return sum;
}

TEST(MotionBlur, IsTheMeanOfSharpViews) {
  for (const char* parameterization : {"latlong", "cube"}) {
    const Map world = patterned_world(parameterization, parameterization[0] == 'l' ? 1024 : 256);
    const Shutter shutter{0.5, 1.5};
    const double way = swept_pixels(moving, shutter);
    EXPECT_GT(way, 10) << "7 degrees and more of 80, 160 pixels wide";
    EXPECT_LT(way, 40);
    EXPECT_LT(relative_rmse(blurred_view(world, moving, shutter), mean_of_views(world, moving, shutter, 64)),
              0.01)
        << parameterization;
  }
}

/// Of coarse pictures of a fine world, the pyramid's levels are read.
TEST(MotionBlur, MinifiedTheSame) {
  const Map world = patterned_world("latlong", 4096);
  const Shutter shutter{0, 1};
  EXPECT_LT(relative_rmse(blurred_view(world, moving, shutter), mean_of_views(world, moving, shutter, 64)),
            0.01);
}

/// Values of a picture, row by row.
std::vector<float> values_of(const Map& picture) {
  std::vector<float> values;
  for (int y = 0; y < picture.height(); ++y) {
    const float* row = picture.level.chart(0).row(y);
    values.insert(values.end(), row, row + picture.width() * picture.channels());
  }
  return values;
}

/// Frames that read the world itself, and others that read levels of its pyramid, from several threads.
TEST(MotionBlur, OfAKeptWorldIsTheSame) {
  const Map world = patterned_world("latlong", 1024);
  const BlurredWorld kept(world);
  const auto zooming = [](double frame) {
    Camera camera = moving(frame);
    camera.fov = frame < 2 ? 10 : 120;
    return camera;
  };
  parallel_for(8, [&](int frame) {
    const Shutter shutter{1.0 * frame, frame + 0.5};
    EXPECT_EQ(values_of(kept.view(zooming, shutter)), values_of(blurred_view(world, zooming, shutter)))
        << frame;
  });
}

TEST(MotionBlur, AConstantWorldStaysConstant) {
  Map world = patterned_world("cube", 64);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 64; ++y) std::fill_n(world.level.chart(face).row(y), 3 * 64, 0.7f);
  }
  fill_borders(world);
  const Map picture = blurred_view(world, moving, {0, 3});
  for (int y = 0; y < picture.height(); ++y) {
    for (int k = 0; k < 3 * picture.width(); ++k) ASSERT_NEAR(picture.level.chart(0).row(y)[k], 0.7f, 1e-6f);
  }
}

TEST(MotionBlur, OfADomeStaysInItsDisc) {
  const auto camera = [](double frame) {
    Camera dome;
    dome.lens = "dome";
    dome.size = {64, 64};
    dome.rotation = rotation_of({40 * frame, 0, 0});
    return dome;
  };
  const Map picture = blurred_view(patterned_world("latlong", 256), camera, {0, 1});
  EXPECT_EQ(picture.level.chart(0).at(0, 0)[2], 0);
  EXPECT_GT(picture.level.chart(0).at(32, 32)[2], 0.1f);
}

TEST(MotionBlur, RefusesWhatIsNoShutter) {
  const Map world = patterned_world("latlong", 64);
  EXPECT_THROW(blurred_view(world, moving, {1, 0}), Error);
  EXPECT_THROW(blurred_view(world, moving, {0, std::numeric_limits<double>::quiet_NaN()}), Error);
  EXPECT_THROW(blurred_view(world, moving, {0, 1}, {.samples = 0}), Error);
  const auto growing = [](double frame) {
    Camera camera;
    camera.size = {frame > 0.5 ? 20 : 10, 10};
    return camera;
  };
  EXPECT_THROW(blurred_view(world, growing, {0, 1}), Error);
  EXPECT_EQ(swept_pixels(moving, {1, 1}), 0);
}

}  // namespace
}  // namespace welkin
