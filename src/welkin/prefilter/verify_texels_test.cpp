#include "welkin/prefilter/verify_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "welkin/math/rotation.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

TEST(VerifyTexels, RandomTexelsAreDrawnOnceAndAllOfFew) {
  for (const char* name : {"cube", "latlong", "angular", "healpix"}) {
    for (const int size : {1, 2, 5, 40}) {
      const Map level(AnyParameterization::make(name), size, size, 1);
      int positions = 0;
      for (const prefilter::Texel& t : prefilter::random_texels(level, 1 << 20, 1)) {
        positions += level.parameterization.valid(t.chart, (t.x + 0.5) / size, (t.y + 0.5) / size) ? 1 : 0;
      }
      for (const int count : {1, 64, 1000}) {
        const auto texels = prefilter::random_texels(level, count, 7);
        const std::set<prefilter::Texel> set(texels.begin(), texels.end());
        EXPECT_EQ(set.size(), texels.size()) << name << size;
        EXPECT_EQ(static_cast<int>(texels.size()), std::min(count, positions)) << name << size;
        EXPECT_EQ(texels, prefilter::random_texels(level, count, 7));
      }
    }
  }
  const Map level(AnyParameterization::make("cube"), 64, 64, 1);
  EXPECT_NE(prefilter::random_texels(level, 64, 1), prefilter::random_texels(level, 64, 2));
}

TEST(VerifyTexels, TheHotAreAllAboveTheirShareAndSpread) {
  Map level(AnyParameterization::make("cube"), 32, 32, 1);
  for (int i = 0; i < 1024; ++i) level.level.chart(2).at(i % 32, i / 32)[0] = static_cast<float>(i + 1);
  VerifyOptions options;
  options.most_hot = 16;
  const auto texels = prefilter::hot_texels(level, {}, options);
  ASSERT_EQ(texels.size(), 16u);
  float minimum = 1e9f, maximum = 0;
  for (const prefilter::Texel& t : texels) {
    const float value = *level.level.chart(t.chart).at(t.x, t.y);
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
  }
  EXPECT_EQ(maximum, 1024);
  EXPECT_GE(minimum, 512);
  EXPECT_LT(minimum, 560);
  options.most_hot = 10000;
  EXPECT_EQ(prefilter::hot_texels(level, {}, options).size(), 513u);
  // A light besides.
  EXPECT_EQ(prefilter::hot_texels(level, {{0, -1, 0}}, options).size(), 514u);
}

TEST(VerifyTexels, LightsAreTheBrightestAndApart) {
  Map source(AnyParameterization::make("cube"), 64, 64, 3);
  source.orientation = rotation_from_yaw_pitch_roll(30, 60, 90);
  const auto light = [&](const prefilter::Texel& t, float radiance) {
    for (int c = 0; c < 3; ++c) source.level.chart(t.chart).at(t.x, t.y)[c] = radiance;
  };
  const std::vector<prefilter::Texel> lamps{{4, 31, 20}, {1, 0, 0}, {2, 40, 63}};
  light(lamps[0], 1000);
  light({4, 32, 20}, 999);  // beside it, in another block
  light(lamps[1], 300);
  light(lamps[2], 50);
  const std::vector<Vec3d> lights = prefilter::brightest_lights(source, 16);
  ASSERT_EQ(lights.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(dot(lights[i], prefilter::direction_of(source, lamps[i])), 1, 1e-12) << i;
  }
  EXPECT_EQ(prefilter::brightest_lights(source, 2).size(), 2u);
}

}  // namespace
}  // namespace welkin
