#include "welkin/light/region_lights.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <string>

#include "welkin/base/error.h"
#include "welkin/light/light_cases.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

constexpr RegionMethod kMethods[] = {RegionMethod::median_cut, RegionMethod::variance};

Map lit(const std::string& spec, int size) {
  Map map = rendered(
      spec, size, [](const Vec3d& d) { return smooth(d); }, 3);
  add_disc(map, {normalize(Vec3d{0.3, 0.8, -0.4}), 5 * kDegree, 300}, {1, 0.8, 0.6}, 4);
  return map;
}

class RegionsOfEveryParameterization : public ::testing::TestWithParam<std::string> {};

TEST_P(RegionsOfEveryParameterization, AllLightBecomesLights) {
  const Map map = lit(GetParam(), 48);
  const std::vector<double> energy = energy_of(map);
  double shown = 0;
  for (const float each : solid_angles_of(map)) shown += static_cast<double>(each);
  for (const RegionMethod method : kMethods) {
    SCOPED_TRACE(name_of(method));
    const LightSet set = region_lights(map, {.method = method, .count = 30});
    // What lies within a degree isn't cut.
    EXPECT_EQ(set.lights.size(), shown > 0.001 ? 30u : 1u);
    std::vector<double> sums(3);
    double angles = 0;
    for (const ExtractedLight& each : set.lights) {
      for (std::size_t c = 0; c < 3; ++c) sums[c] += each.irradiance[c];
      angles += each.solid_angle;
      EXPECT_NEAR(length(each.direction), 1, 1e-9);
      EXPECT_EQ(each.shape, LightShape::region);
    }
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sums[c] / energy[c], 1, 1e-6);
    EXPECT_NEAR(angles / shown, 1, 1e-5);
  }
}
INSTANTIATE_TEST_SUITE_P(Light, RegionsOfEveryParameterization, ::testing::ValuesIn(names_and_windows()),
                         test_name);

/// Each of 2ⁿ cuts leaves 40 to 60 % on either side, so all lie within (0.4/0.6)ⁿ of each other.
TEST(RegionLights, MedianCutsHalveTheLight) {
  const Map map = rendered(
      "cube", 64, [](const Vec3d& d) { return smooth(d); }, 3);
  const LightSet set = region_lights(map, {.method = RegionMethod::median_cut, .count = 16});
  ASSERT_EQ(set.lights.size(), 16u);
  EXPECT_LT(set.lights.front().luminance / set.lights.back().luminance, 2.5);
}

/// A sun is one light, however much it outshines the rest, and lies where it is: no cut goes through it.
TEST(RegionLights, ASunStaysWhole) {
  for (const char* spec : {"latlong", "cube", "octahedral"}) {
    for (const double radiance : {2000.0, 2e6}) {
      Map map = rendered(
          spec, 300, [](const Vec3d&) { return 1; }, 3);
      const Disc sun{normalize(Vec3d{0.5, 0.5, -0.7}), 1 * kDegree, radiance};
      add_disc(map, sun);
      for (const RegionMethod method : kMethods) {
        SCOPED_TRACE(testing::Message() << spec << " " << radiance << " " << name_of(method));
        const LightSet set = region_lights(map, {.method = method, .count = 64});
        EXPECT_EQ(set.lights.size(), 64u);
        if (radiance < 1e4) continue;  // as much as a region of the sky
        EXPECT_NEAR(set.lights[0].irradiance[0] / sun.irradiance(), 1, 0.02);
        EXPECT_LT(angle_between(set.lights[0].direction, sun.direction), 0.1 * kDegree);
        EXPECT_LT(set.lights[1].irradiance[0], 1);
      }
    }
  }
}

/// The more lights, the less a diffuse surface's illumination differs from the map's: the mean over
/// directions of the error of E(n) = Σ irradiance · max(n·d, 0). Centroids make it second order in the
/// regions' size, so four times as many lights have a fourth of the error; half is left for noise.
TEST(RegionLights, MoreLightsIlluminateBetter) {
  const Map map = lit("latlong", 90);
  const auto directions_of = [](int count) {
    std::vector<Vec3d> list;
    for (int i = 0; i < count; ++i) {
      const double y = 1 - 2 * (i + 0.5) / count, around = 2.399963 * i;
      list.push_back({std::sqrt(1 - y * y) * std::sin(around), y, std::sqrt(1 - y * y) * std::cos(around)});
    }
    return list;
  };
  const std::vector<Vec3d> normals = directions_of(50);
  std::vector<double> exact(normals.size());
  std::vector<float> omega(static_cast<std::size_t>(map.width()));
  for (int y = 0; y < map.height(); ++y) {
    texel_solid_angles(map.parameterization, map.width(), map.height(), 0, y, omega.data());
    for (int x = 0; x < map.width(); ++x) {
      const Vec3d d = direction_at(map, 0, x, y);
      for (std::size_t k = 0; k < normals.size(); ++k)
        exact[k] += static_cast<double>(omega[0] * map.level.chart(0).at(x, y)[0]) *
                    std::max(dot(d, normals[k]), 0.0);
    }
  }
  for (const RegionMethod method : kMethods) {
    std::vector<double> errors;
    for (const int count : {8, 32, 128}) {
      const LightSet set = region_lights(map, {.method = method, .count = count});
      double sum = 0;
      for (std::size_t k = 0; k < normals.size(); ++k) {
        double illumination = 0;
        for (const ExtractedLight& each : set.lights)
          illumination += each.irradiance[0] * std::max(dot(each.direction, normals[k]), 0.0);
        sum += std::fabs(illumination / exact[k] - 1);
      }
      errors.push_back(sum / static_cast<double>(normals.size()));
    }
    SCOPED_TRACE(testing::Message() << name_of(method) << " " << errors[0] << " " << errors[1] << " "
                                    << errors[2]);
    EXPECT_LT(errors[1], errors[0] / 2);
    EXPECT_LT(errors[2], errors[1] / 2);
  }
}

TEST(RegionLights, SmallAndBlackMaps) {
  EXPECT_TRUE(region_lights(rendered(
                                "cube", 8, [](const Vec3d&) { return 0; }, 3))
                  .lights.empty());
  Map one(sphere::AnyParameterization::make("latlong"), 1, 1, 3);
  std::fill_n(one.level.chart(0).at(0, 0), 3, 5.0f);
  const LightSet set = region_lights(one);
  ASSERT_EQ(set.lights.size(), 1u);
  EXPECT_NEAR(set.lights[0].solid_angle, 4 * kPi, 1e-3);
  EXPECT_NEAR(set.lights[0].irradiance[0], 20 * kPi, 1e-2);
  EXPECT_EQ(region_lights(lit("cube", 8), {.count = 1}).lights.size(), 1u);
  EXPECT_NE(refusal([&] { region_lights(one, {.count = 0}); }), "done");
  one.level.chart(0).at(0, 0)[1] = std::numeric_limits<float>::infinity();
  EXPECT_NE(refusal([&] { region_lights(one); }), "done");
}

TEST(RegionLights, TheSameOnAnyNumberOfThreads) {
  const Map map = lit("octahedral", 200);
  const LightSet many = region_lights(map);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const LightSet one = region_lights(map);
  ASSERT_EQ(one.lights.size(), many.lights.size());
  for (std::size_t k = 0; k < one.lights.size(); ++k)
    EXPECT_EQ(one.lights[k].irradiance, many.lights[k].irradiance);
}

}  // namespace
}  // namespace welkin
