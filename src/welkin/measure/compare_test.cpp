#include "welkin/measure/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// A smooth map in [0.2, 0.8].
std::array<float, 3> smooth(const Vec3d& d) {
  return {static_cast<float>(0.5 + 0.3 * d.x), static_cast<float>(0.5 + 0.3 * d.y * d.z),
          static_cast<float>(0.5 - 0.3 * d.y)};
}

Map smooth_map(const std::string& parameterization, int width, int height, const Matrix3& orientation = {}) {
  return render(smooth, AnyParameterization::make(parameterization), width, height,
                {.samples = 2, .orientation = orientation});
}

template <class Body>
void for_each_texel(Map& map, const Body& body) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) body(map.level.chart(chart).at(x, y));
    }
  }
  fill_borders(map);
}

TEST(Compare, AMapEqualsItself) {
  for (const char* name : {"latlong", "cube", "angular", "half-cube"}) {
    const Map a = smooth_map(name, 64, 64);
    const Comparison c = compare(a, a);
    EXPECT_TRUE(c.texel_by_texel);
    EXPECT_EQ(c.all.rmse, 0) << name;
    EXPECT_EQ(c.all.maximum_absolute, 0) << name;
    EXPECT_EQ(c.all.maximum_relative, 0) << name;
    EXPECT_EQ(c.all.energy_ratio, 1) << name;
    EXPECT_EQ(c.all.psnr, std::numeric_limits<double>::infinity()) << name;
    EXPECT_NEAR(c.solid_angle, a.parameterization.coverage(), 1e-9) << name;
    EXPECT_EQ(c.skipped, 0u);
  }
}

TEST(Compare, AKnownErrorIsMeasuredAsItIs) {
  const Map a = smooth_map("cube", 32, 32);
  Map b = smooth_map("cube", 32, 32);
  for_each_texel(b, [](float* texel) {
    for (int c = 0; c < 3; ++c) texel[c] += 0.01f;
  });
  const Comparison c = compare(a, b);
  EXPECT_EQ(c.peak, 1);
  EXPECT_EQ(c.texels, 6u * 32u * 32u);
  // A float near ½ is rounded by 3e-8.
  for (const ErrorMeasures& e : {c.all, c.channels[0], c.channels[1], c.channels[2]}) {
    EXPECT_NEAR(e.rmse, 0.01, 1e-7) << e.name;
    EXPECT_NEAR(e.mean_absolute, 0.01, 1e-7) << e.name;
    EXPECT_NEAR(e.maximum_absolute, 0.01, 1e-7) << e.name;
    EXPECT_NEAR(e.psnr, 40, 1e-4) << e.name;
    EXPECT_NEAR(e.mean_b - e.mean_a, 0.01, 1e-7) << e.name;
    EXPECT_NEAR(e.energy_ratio, 1.02, 1e-3) << e.name;
    EXPECT_NEAR(e.relative_rmse, 0.01 / e.rms_a, 1e-6) << e.name;
  }
  // ⟨(½ + 0.3 x)²⟩ = ¼ + 0.03.
  EXPECT_NEAR(c.channels[0].rms_a, std::sqrt(0.28), 2e-4);
}

TEST(Compare, RmsleIsTheErrorOfTheLogarithm) {
  const Map a = smooth_map("cube", 16, 16);
  Map b = a.clone();
  for_each_texel(b, [](float* texel) {
    for (int c = 0; c < 3; ++c) texel[c] = (1 + texel[c]) * 1.02f - 1;
    texel[2] = texel[2] - texel[2];
  });
  const Comparison c = compare(a, b);
  EXPECT_NEAR(c.channels[0].rmsle, std::log(1.02), 1e-6);
  EXPECT_NEAR(c.channels[1].rmsle, std::log(1.02), 1e-6);
  EXPECT_GT(c.channels[2].rmsle, 0.1);
  // What is negative counts as 0.
  for_each_texel(b, [](float* texel) { texel[2] = -1; });
  EXPECT_EQ(compare(a, b).channels[2].rmsle, c.channels[2].rmsle);
}

TEST(Compare, ErrorsWeighAsTheirSolidAngle) {
  // Twice the radiance on the cap north of 60°, whose share of the sphere is (1 − sin 60°)/2.
  Map a = smooth_map("latlong", 60, 30);
  for_each_texel(a, [](float* texel) { texel[0] = texel[1] = texel[2] = 3; });
  Map b = smooth_map("latlong", 60, 30);
  for_each_texel(b, [](float* texel) { texel[0] = texel[1] = texel[2] = 3; });
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 60; ++x) {
      for (int c = 0; c < 3; ++c) b.level.chart(0).at(x, y)[c] = 6;
    }
  }
  const double share = (1 - std::sin(60 * kPi / 180)) / 2;
  const Comparison c = compare(a, b);
  EXPECT_EQ(c.peak, 3);
  EXPECT_NEAR(c.all.mean_absolute, 3 * share, 1e-3);
  EXPECT_NEAR(c.all.relative_rmse, std::sqrt(share), 1e-3);
  EXPECT_NEAR(c.all.energy_ratio, 1 + share, 1e-3);
  EXPECT_EQ(c.all.maximum_absolute, 3);
  EXPECT_EQ(c.all.maximum_relative, 1);
  EXPECT_GT(c.all.maximum_absolute_direction.y, std::sin(60 * kPi / 180));
  EXPECT_NEAR(compare(a, b, {.peak = 30}).all.psnr, c.all.psnr + 20, 1e-9);
}

TEST(Compare, OneWorldInTwoShapesIsTheSame) {
  const Matrix3 turned = rotation_from_yaw_pitch_roll(40, 20, -70);
  const Map a = smooth_map("latlong", 512, 256);
  struct Case {
    const char* name;
    int width, height;
  };
  for (const Case& c : {Case{"cube", 128, 128}, Case{"octahedral", 256, 256}, Case{"healpix", 64, 64},
                        Case{"paraboloid", 160, 160}, Case{"cube", 400, 400}}) {
    const Map b = smooth_map(c.name, c.width, c.height, turned);
    for (const Filter filter : {Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
      const Comparison forth = compare(a, b, {.filter = filter}), back = compare(b, a, {.filter = filter});
      EXPECT_FALSE(forth.texel_by_texel);
      // Texels of h = 0.02 rad or less: h²/8 by bilinear interpolation and h²/24 by averaging, of curvatures
      // around ½.
      EXPECT_LT(forth.all.relative_rmse, 2e-4) << c.name;
      EXPECT_LT(forth.all.maximum_absolute, 2e-3) << c.name;
      EXPECT_NEAR(forth.all.energy_ratio, 1, 1e-4) << c.name;
      EXPECT_NEAR(forth.solid_angle, 4 * kPi, 1e-9) << c.name;
      // Which is the reference doesn't change where they are compared.
      EXPECT_EQ(forth.texels, back.texels) << c.name;
      EXPECT_EQ(forth.all.rmse, back.all.rmse) << c.name;
      EXPECT_EQ(forth.all.mean_a, back.all.mean_b) << c.name;
    }
  }
}

TEST(Compare, FindsTheDirectionOfTheWorstTexel) {
  const Matrix3 turned = rotation_from_yaw_pitch_roll(-30, 60, 15);
  const Map a = smooth_map("octahedral", 64, 64);
  Map b = smooth_map("cube", 128, 128, turned);
  float* spot = b.level.chart(3).at(77, 31);
  spot[1] += 5;
  const Vec3d where = transpose(turned) * b.parameterization.to_sphere(3, 77.5 / 128, 31.5 / 128);
  const Comparison c = compare(a, b);
  EXPECT_NEAR(c.all.maximum_absolute, 5, 0.01);
  EXPECT_NEAR(c.channels[1].maximum_absolute, 5, 0.01);
  EXPECT_LT(c.channels[0].maximum_absolute, 0.01);
  EXPECT_LT(angle_between(c.all.maximum_absolute_direction, where), 1e-6);
  EXPECT_LT(angle_between(c.channels[1].maximum_relative_direction, where), 1e-6);
}

TEST(Compare, OnlyWhatBothShowIsCompared) {
  const Map whole = smooth_map("latlong", 256, 128), half = smooth_map("fisheye-equidistant", 100, 100);
  const Comparison c = compare(whole, half);
  EXPECT_NEAR(c.solid_angle / (2 * kPi), 1, 0.01);
  EXPECT_LT(c.all.relative_rmse, 1e-3);
}

TEST(Compare, BadTexelsAreSkippedAndCounted) {
  const Map a = smooth_map("cube", 16, 16);
  Map b = smooth_map("cube", 16, 16);
  b.level.chart(0).at(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  b.level.chart(1).at(1, 1)[2] = std::numeric_limits<float>::infinity();
  const Comparison c = compare(a, b);
  EXPECT_EQ(c.skipped, 2u);
  EXPECT_EQ(c.texels, 6u * 256u - 2);
  EXPECT_EQ(c.all.rmse, 0);
  EXPECT_LT(c.solid_angle, 4 * kPi);

  Map nothing = smooth_map("cube", 16, 16);
  for_each_texel(nothing, [](float* texel) { texel[0] = std::numeric_limits<float>::quiet_NaN(); });
  EXPECT_EQ(compare(a, nothing).texels, 0u);
  EXPECT_EQ(compare(a, nothing).solid_angle, 0);
}

TEST(Compare, ChannelsMeetByName) {
  const auto cube = AnyParameterization::make("cube");
  Map a(cube, 4, 4, 3), b(cube, 4, 4, 4);
  for_each_texel(a, [](float* t) { t[0] = 1, t[1] = 2, t[2] = 3; });
  for_each_texel(b, [](float* t) { t[0] = 9, t[1] = 3, t[2] = 2, t[3] = 1; });
  b.channel_names = {"A", "B", "G", "R"};
  EXPECT_EQ(compare(a, b).all.rmse, 0);
  EXPECT_EQ(compare(a, b).channels.size(), 3u);

  // Alpha is measured, but not among all.
  Map with_alpha(cube, 4, 4, 4);
  for_each_texel(with_alpha, [](float* t) { t[0] = 1, t[1] = 2, t[2] = 3, t[3] = 1; });
  const Comparison c = compare(with_alpha, b);
  EXPECT_EQ(c.channels.size(), 4u);
  EXPECT_EQ(c.channels[3].maximum_absolute, 8);
  EXPECT_EQ(c.all.maximum_absolute, 0);

  Map grey(cube, 4, 4, 1), value(cube, 4, 4, 1);
  value.channel_names = {"depth"};
  EXPECT_EQ(compare(grey, value).all.rmse, 0);
  EXPECT_THROW(compare(grey, a), Error);
}

TEST(Compare, RejectsOptionsThatMakeNoSense) {
  const Map a = smooth_map("cube", 8, 8);
  Map heat = smooth_map("cube", 8, 8);
  EXPECT_THROW(compare(a, a, {.peak = -1}), Error);
  EXPECT_THROW(compare(a, a, {.heat_width = 1}, &heat), Error);
}

TEST(Compare, TheHeatMapShowsRelativeErrorByItsScale) {
  // b is 1 % off on the face +X, right everywhere else.
  Map a = smooth_map("cube", 32, 32), b = smooth_map("cube", 32, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (int c = 0; c < 3; ++c) b.level.chart(0).at(x, y)[c] *= 1.01f;
    }
  }
  Map heat = smooth_map("cube", 4, 4);
  compare(a, b, {.heat_width = 128}, &heat);
  ASSERT_EQ(heat.parameterization.name(), "latlong");
  ASSERT_EQ(heat.width(), 128);
  ASSERT_EQ(heat.height(), 64);
  const auto color_at = [&](const Vec3d& d) {
    const auto position = heat.parameterization.from_sphere(d);
    return heat.level.chart(0).at(static_cast<int>(position.u * 127.99),
                                  static_cast<int>(position.v * 63.99));
  };
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(color_at({1, 0.1, 0.1})[c], color_ramp(3.0 / 5)[c],
                1e-3);  // 1e-2 is three of five decades up
    EXPECT_NEAR(color_at({-1, 0.1, 0.1})[c], color_ramp(0)[c], 1e-6);
  }

  const Map half = smooth_map("fisheye-equidistant", 64, 64);
  compare(half, half, {.heat_width = 128}, &heat);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(color_at({0.1, 0.1, -1})[c], neutral_color()[c]);
}

TEST(ColorRamp, GetsLighterEvenlyAndStaysInRange) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const auto color = color_ramp(i / 100.0);
    const double luminance = 0.2126 * static_cast<double>(color[0]) + 0.7152 * static_cast<double>(color[1]) +
                             0.0722 * static_cast<double>(color[2]);
    EXPECT_GT(luminance, before);
    before = luminance;
    for (const float value : color) {
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
    }
  }
  EXPECT_EQ(color_ramp(-3), color_ramp(0));
  EXPECT_EQ(color_ramp(3), color_ramp(1));
  EXPECT_EQ(color_ramp(std::nan("")), color_ramp(0));
}

}  // namespace
}  // namespace welkin
