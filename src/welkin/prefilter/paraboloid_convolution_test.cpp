#include "welkin/prefilter/paraboloid_convolution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/math/angles.h"
#include "welkin/measure/compare.h"
#include "welkin/prefilter/bake.h"
#include "welkin/prefilter/prefilter_cases.h"
#include "welkin/prefilter/verify.h"

namespace welkin {
namespace {

using cases::refusal;
using lobe::AnyLobe;
using prefilter_cases::landscape;
using sphere::AnyParameterization;

AnyLobe phong(double exponent) {
  return AnyLobe::make("phong,exponent=" + std::to_string(exponent));
}

/// Kautz, Vázquez, Heidrich & Seidel 2000, the table of §5: faces of 512, lobes clamped at 0.1, filters of at
/// most 7 texels.
struct Row {
  int exponent, small, large, small_shrink, large_shrink;
};
constexpr Row kTable[] = {{10, 174, 260, 32, 64},
                          {50, 78, 136, 16, 32},
                          {100, 56, 100, 8, 16},
                          {250, 36, 66, 8, 16},
                          {500, 26, 48, 4, 8}};

TEST(ParaboloidConvolution, FiltersAreThoseOfTheTable) {
  for (const Row& row : kTable) {
    const ParaboloidFilters filters = paraboloid_filters(phong(row.exponent), 512);
    EXPECT_EQ(filters.small.diameter, row.small) << row.exponent;
    EXPECT_EQ(filters.large.diameter, row.large) << row.exponent;
    EXPECT_EQ(filters.small.shrink, row.small_shrink) << row.exponent;
    EXPECT_EQ(filters.large.shrink, row.large_shrink) << row.exponent;
    EXPECT_NEAR(filters.angle, std::acos(std::pow(0.1, 1.0 / row.exponent)), 1e-12);
  }
}

/// Of any lobe and clamp: where the weight has fallen to it.
TEST(ParaboloidConvolution, FiltersEndWhereTheLobeHasFallenToTheClamp) {
  for (const char* spec :
       {"ggx,roughness=0.3", "phong,exponent=7", "blinn,exponent=40", "ggx,roughness=0.01"}) {
    const AnyLobe lobe = AnyLobe::make(spec);
    for (const double clamp : {0.5, 0.1, 0.01}) {
      const double angle = paraboloid_filters(lobe, 256, {.clamp = clamp}).angle;
      EXPECT_NEAR(lobe.weight(1 - std::cos(angle)) / lobe.weight(0), clamp, 1e-3 * clamp) << spec;
    }
  }
  EXPECT_NEAR(paraboloid_filters(AnyLobe::make("ggx,roughness=1"), 256).angle, kPi / 2, 0.3);
}

/// The ratio of the two filters is 2 where they are small: texels at the rim measure a quarter of those at
/// the centre.
TEST(ParaboloidConvolution, TheLargeFilterIsTwiceTheSmallOne) {
  const ParaboloidFilters filters = paraboloid_filters(phong(1e6), 1 << 20);
  EXPECT_NEAR(static_cast<double>(filters.large.diameter) / filters.small.diameter, 2, 0.01);
}

TEST(ParaboloidConvolution, AConstantMapStaysAsItIs) {
  const Map source = prefilter_cases::filled("paraboloid", 64, 64, 3.25f, 3);
  for (const double exponent : {1.0, 10.0, 500.0}) {
    const Map made = convolve_paraboloid(source, phong(exponent), {40, 40});
    cases::for_each_valid_texel(made, [&](int chart, int x, int y) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(made.level.chart(chart).at(x, y)[c], 3.25f, 1e-5f);
    });
  }
}

/// The definition, written down in float64 without shrinking: weights by distance in the plane, over the
/// faces as they go on past their edges; blended by d².
TEST(ParaboloidConvolution, IsTheSumsOfTwoFiltersBlended) {
  constexpr int kFace = 48;
  Map source = cases::rendered("paraboloid", kFace, cases::smooth);
  source.orientation = rotation_from_yaw_pitch_roll(10, 20, 30);
  const AnyLobe lobe = phong(60);
  const ParaboloidFilters filters = paraboloid_filters(lobe, kFace, {.largest_filter = 64});
  ASSERT_EQ(filters.large.shrink, 1);
  const Map made = convolve_paraboloid(source, lobe, {kFace, kFace}, {.largest_filter = 64});
  const auto& p = source.parameterization;
  const auto filtered = [&](int chart, int x, int y, bool large) {
    const int reach = (large ? filters.large : filters.small).diameter / 2;
    double sum = 0, weights = 0;
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        const double radius = std::hypot(i, j) * 2 / kFace;
        const double angle = large ? kPi / 2 - 2 * std::atan(1 - radius) : 2 * std::atan(radius);
        if (angle > filters.angle) continue;
        const double weight = std::pow(std::cos(angle), 60);
        // The map's function itself: bilinear look-ups in the border differ by 1e-3.
        sum += weight * cases::smooth(p.to_sphere(chart, (x + i + 0.5) / kFace, (y + j + 0.5) / kFace));
        weights += weight;
      }
    }
    return sum / weights;
  };
  cases::for_each_valid_texel(made, [&](int chart, int x, int y) {
    const double right = 2 * (x + 0.5) / kFace - 1, up = 2 * (y + 0.5) / kFace - 1;
    const double d2 = right * right + up * up;
    const double wanted = (1 - d2) * filtered(chart, x, y, false) + d2 * filtered(chart, x, y, true);
    EXPECT_NEAR(static_cast<double>(*made.level.chart(chart).at(x, y)), wanted, 2e-3);
  });
  EXPECT_EQ(made.orientation, source.orientation);
}

/// Shrinking first changes little of a map without detail, and the faces' centres agree with the exact
/// result.
TEST(ParaboloidConvolution, IsAnApproximationOfTheExactResult) {
  const Map source = cases::rendered("paraboloid", 128, cases::smooth);
  for (const double exponent : {10.0, 100.0}) {
    const Map made = convolve_paraboloid(source, phong(exponent), {64, 64});
    const Map exact = prefilter_cases::prefiltered(source, "paraboloid", {64, 64}, phong(exponent).spec());
    const double error = compare(exact, made).all.relative_rmse;
    EXPECT_LT(error, 0.03) << exponent;
    // It is none without an error.
    EXPECT_GT(error, 1e-4) << exponent;
  }
  // Lamps: the lobe is cut at a tenth, and circles are displaced.
  const Map lamps = landscape("paraboloid", 128, 128);
  const Map made = convolve_paraboloid(lamps, phong(50), {64, 64});
  const Map exact = prefilter_cases::prefiltered(lamps, "paraboloid", {64, 64}, "phong,exponent=50");
  const double error = compare(exact, made).all.relative_rmse;
  EXPECT_LT(error, 0.3);
  EXPECT_GT(error, 0.01);
}

TEST(ParaboloidConvolution, BothHalvesAgreeAtTheRim) {
  const Map source = cases::rendered("paraboloid", 128, cases::smooth);
  const Map made = convolve_paraboloid(source, phong(20), {128, 128});
  const Sampler sampler = Sampler::borrow(made);
  for (int i = 0; i < 360; ++i) {
    const double a = i * kPi / 180;
    float front = 0, back = 0;
    sampler.look_up(Vec3d{std::cos(a), std::sin(a), 1e-6}, {&front, 1});
    sampler.look_up(Vec3d{std::cos(a), std::sin(a), -1e-6}, {&back, 1});
    EXPECT_NEAR(front, back, 0.02f);
  }
}

TEST(ParaboloidConvolution, BakesChainsAndVerifiesThem) {
  const Map source = landscape("latlong", 128, 64, 3);
  BakeOptions options;
  options.lobe = AnyLobe::make("phong");
  options.target = AnyParameterization::make("paraboloid");
  options.size = ChartSize{64, 64};
  options.levels = 4;
  options.method = BakeMethod::paraboloid_convolution;
  options.prefilter.orientation = rotation_from_yaw_pitch_roll(90, 0, 0);
  const BakePlan plan(source, options);
  const Chain chain = plan.run(source);
  ASSERT_EQ(chain.levels.size(), 4u);
  EXPECT_EQ(plan.methods()[1].name, "convolution");
  EXPECT_EQ(chain.levels[3].width(), 8);
  EXPECT_EQ(chain.levels[2].orientation, options.prefilter.orientation);
  VerifyOptions verify;
  verify.prefilter = options.prefilter;
  verify.own_texels = true;
  const auto found = verify_prefilter(source, chain.levels, plan.levels(), verify);
  for (std::size_t i = 1; i < found.size(); ++i) {
    ASSERT_TRUE(found[i].energy);
    EXPECT_GT(found[i].reference.relative_rmse, 1e-3);
    EXPECT_LT(found[i].reference.relative_rmse, 0.5);
    EXPECT_NEAR(*found[i].energy, 1, 0.1);
    EXPECT_FALSE(found[i].furnace);
  }
  // With the lobe's integral, as the exact method has it.
  options.lobe = AnyLobe::make("phong,exponent=20");
  options.chain = false;
  options.levels = 0;
  options.prefilter.scale = LobeScale::integral;
  const Map scaled = std::move(bake(source, options).levels.front());
  options.prefilter.scale = LobeScale::average;
  const Map plain = std::move(bake(source, options).levels.front());
  EXPECT_NEAR(*scaled.level.chart(0).at(32, 32) / *plain.level.chart(0).at(32, 32), options.lobe.integral(),
              1e-4);
}

TEST(ParaboloidConvolution, RefusesWhatItCannotDo) {
  const Map cube = cases::make_map("cube", 8);
  EXPECT_NE(refusal([&] {
              convolve_paraboloid(cube, phong(10), {8, 8});
            }).find("not cube"),
            std::string::npos);
  const Map map = prefilter_cases::filled("paraboloid", 16, 16, 1);
  EXPECT_NE(refusal([&] { convolve_paraboloid(map, phong(10), {8, 4}); }).find("square"), std::string::npos);
  EXPECT_NE(refusal([&] { paraboloid_filters(phong(10), 0); }), "done");
  EXPECT_NE(refusal([&] { paraboloid_filters(phong(10), 8, {.clamp = 0}); }), "done");
  EXPECT_NE(refusal([&] { paraboloid_filters(phong(10), 8, {.largest_filter = 2}); }), "done");
  BakeOptions options;
  options.method = BakeMethod::paraboloid_convolution;
  EXPECT_NE(refusal([&] { bake(map, options); }).find("makes paraboloid maps, not cube"), std::string::npos);
  Map bad = prefilter_cases::filled("paraboloid", 16, 16, 1);
  *bad.level.chart(0).at(8, 8) = std::nanf("");
  options.target = AnyParameterization::make("paraboloid");
  EXPECT_NE(refusal([&] { bake(bad, options); }).find("NaN"), std::string::npos);
  EXPECT_NE(refusal([] { bake_method_from_name("paraboloid"); }).find("paraboloid-convolution"),
            std::string::npos);
}

/// The smallest faces, and lobes narrower than a texel.
TEST(ParaboloidConvolution, TheSmallestMaps) {
  for (const int face : {1, 2, 3}) {
    const Map source = prefilter_cases::filled("paraboloid", face, face, 2);
    for (const double exponent : {1.0, 50.0, 1e6})
      EXPECT_NEAR(*convolve_paraboloid(source, phong(exponent), {1, 1}).level.chart(1).at(0, 0), 2, 1e-5);
  }
}

/// Kautz et al. 2000, §5: "up to 25 %" for large radii; little for small ones; none at the centre. Against
/// directions on the sphere.
TEST(ParaboloidConvolution, DistortionOfCircles) {
  const AnyParameterization p = AnyParameterization::make("paraboloid");
  const auto at = [&](double x, double y) { return p.to_sphere(0, (x + 1) / 2, (y + 1) / 2); };
  for (const double radius : {0.05, 0.2, 0.5}) {
    for (const double distance : {0.0, 0.3, 1.0}) {
      double least = 10, largest = 0;
      for (int i = 0; i < 360; ++i) {
        const double a = i * kPi / 180;
        const double angle =
            angle_between(at(distance, 0), at(distance + radius * std::cos(a), radius * std::sin(a)));
        least = std::min(least, angle);
        largest = std::max(largest, angle);
      }
      EXPECT_NEAR(circle_distortion(radius, distance), (largest - least) / (largest + least), 1e-9);
    }
    EXPECT_NEAR(circle_distortion(radius, 0), 0, 1e-15);
  }
  EXPECT_NEAR(circle_distortion(0.5059, 1), 0.25, 0.01);
  EXPECT_LT(circle_distortion(0.05, 1), 0.03);
}

}  // namespace
}  // namespace welkin
