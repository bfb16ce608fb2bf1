#include "welkin/filter/sample.h"

#include <gtest/gtest.h>

#include <random>

#include "welkin/map/borders.h"
#include "welkin/map/pyramid.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// Along the direction of a texel's centre every filter gives that texel, whatever the direction's length;
/// the map's orientation turns the question.
TEST(Sample, GivesTexelsAtTheirCentres) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0, 2);
  for (const std::string& name : sphere::parameterization_names()) {
    Map map(AnyParameterization::make(name), 16, 16, 3);
    const auto& p = map.parameterization;
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < 16; ++y) {
        for (int i = 0; i < 48; ++i) map.level.chart(chart).row(y)[i] = value(random);
      }
    }
    fill_borders(map);
    map.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
    for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
      const double u = 6.5 / 16, v = 5.5 / 16;
      if (!p.valid(0, u, v)) continue;
      const Vec3d d = 7.0 * (transpose(map.orientation) * p.to_sphere(0, u, v));
      float out[3];
      sample(map, map.level, {&d, 1}, filter, out);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[c], map.level.chart(0).at(6, 5)[c], 1e-4) << name;
    }
  }
}

TEST(Sample, IsZeroWhereTheMapShowsNothing) {
  Map map(AnyParameterization::make("fisheye-equidistant"), 8, 8, 1);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) *map.level.chart(0).at(x, y) = 5;
  }
  fill_borders(map);
  const Vec3d directions[2] = {{0, 0.2, 1}, {0, 0.2, -1}};
  float out[2];
  sample(map, map.level, directions, Filter::bilinear, out);
  EXPECT_FLOAT_EQ(out[0], 5);
  EXPECT_EQ(out[1], 0);
}

}  // namespace
}  // namespace welkin
