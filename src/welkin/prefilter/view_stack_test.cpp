#include "welkin/prefilter/view_stack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"
#include "welkin/prefilter/view_bake.h"
#include "welkin/prefilter/view_reference.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

Map constant(float value) {
  Map map(sphere::AnyParameterization::make("cube"), 4, 4, 3);
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = 0; y < 4; ++y) std::fill_n(map.level.chart(chart).row(y), 12, value);
  }
  fill_borders(map);
  return map;
}

/// Views whose value tells view and level: 10·view + level.
ViewChains numbered(int views, int levels) {
  ViewChains stack;
  stack.notes = {"ggx", "reflected", default_view_cosines(views), {levels, {}}, {levels, {}}};
  for (int view = 0; view < views; ++view) {
    Chain& chain = stack.views.emplace_back();
    for (int k = 0; k < levels; ++k) {
      Map map = constant(static_cast<float>(10 * view + k));
      if (k > 0) {
        map = Map(map.parameterization, 4 >> k, 4 >> k, 3);
        for (int chart = 0; chart < 6; ++chart) {
          for (int y = 0; y < map.height(); ++y)
            std::fill_n(map.level.chart(chart).row(y), 3 * map.width(), static_cast<float>(10 * view + k));
        }
        fill_borders(map);
      }
      chain.levels.push_back(std::move(map));
      chain.notes.roughness.push_back(0.5 * k);
      stack.notes.lift.values.push_back(0.1 * view);
      stack.notes.albedo.values.push_back(view + 0.5 * k);
    }
  }
  return stack;
}

Vec3d view_at(const Vec3d& normal, double cosine) {
  const Vec3d level = normalize(cross(normal, Vec3d{0.2, 0.3, 0.9}));
  return cosine * normal + std::sqrt(1 - cosine * cosine) * level;
}

TEST(ViewStack, IsLinearBetweenViewsAndLevels) {
  const ViewStack stack(numbered(4, 3));
  const Vec3d normal = normalize(Vec3d{1, 2, 3});
  for (const double root : {0.125, 0.2, 0.5, 0.8, 0.875}) {
    for (const double level : {0.0, 0.5, 1.0, 2.0}) {
      const double expected = 10 * (root * 4 - 0.5) + level;
      EXPECT_NEAR(static_cast<double>(stack.rgb(normal, view_at(normal, root * root), level)[1]), expected,
                  1e-4);
      EXPECT_NEAR(stack.albedo(root * root, level), root * 4 - 0.5 + 0.5 * level, 1e-9);
    }
  }
  // Before the first and beyond the last angle, and from below: as there.
  EXPECT_NEAR(static_cast<double>(stack.rgb(normal, view_at(normal, 0.001))[0]), 0, 1e-6);
  EXPECT_NEAR(static_cast<double>(stack.rgb(normal, view_at(normal, -0.5))[0]), 0, 1e-6);
  EXPECT_NEAR(static_cast<double>(stack.rgb(normal, normal)[0]), 30, 1e-4);
  EXPECT_EQ(stack.level_of(0.25), 0.5);
  EXPECT_EQ(stack.level_of(1), 2);
  EXPECT_THROW(stack.level_of(1.5), Error);
  EXPECT_THROW(stack.rgb(normal, normal, 2.5), Error);
  EXPECT_THROW(stack.rgb(normal, normal, -1), Error);
  std::array<float, 2> two;
  EXPECT_THROW(stack.look_up(normal, normal, two), Error);
}

TEST(ViewStack, LiftTurnsFromReflectedToNormal) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 50; ++i) {
    const Vec3d normal = normalize(Vec3d{unit(random), unit(random), unit(random)});
    const Vec3d view = view_at(normal, 0.05 + 0.94 * std::fabs(unit(random)));
    const double angle = angle_between(normal, view);
    for (const double lift : {-0.1, 0.0, 0.3, 1.0, 2.0}) {
      const Vec3d d = ViewStack::look_up_direction(normal, view, lift);
      EXPECT_NEAR(length(d), 1, 1e-9);
      EXPECT_NEAR(dot(d, cross(normal, view)), 0, 1e-9);
      EXPECT_NEAR(angle_between(d, normal), std::fabs(1 - lift) * angle, 1e-7);
    }
    EXPECT_NEAR(length(ViewStack::look_up_direction(normal, view, 1) - normal), 0, 1e-9);
    EXPECT_NEAR(length(ViewStack::look_up_direction(normal, view, 2) - view), 0, 1e-9);
  }
  const Vec3d up{0, 1, 0};
  EXPECT_NEAR(length(ViewStack::look_up_direction(up, up, 0.7) - up), 0, 1e-9);
}

/// The point of it: from grazing angles a look-up along the fitted axis is closer to the whole integral than
/// one along the reflected direction, and a retro-reflector is found where it reflects.
TEST(ViewStack, FittedAxisIsCloserToTheIntegral) {
  const Map map = render(synth::make("sky"), sphere::AnyParameterization::make("latlong"), 128, 64);
  const ViewReference reference(map);
  const auto retro = brdf::AnyBrdf::from_function("retro", 0.2, [](const Vec3d& view, const Vec3d& light) {
    const Vec3d away = light - view;
    return 1e-3 + 0.5 * std::exp(-12 * dot(away, away));
  });
  for (const auto& brdf :
       {brdf::AnyBrdf::make("ggx,roughness=0.6"), brdf::AnyBrdf::make("ward,roughness=0.6"), retro}) {
    std::array<double, 2> error{};
    for (const bool fitted : {false, true}) {
      ViewBakeOptions options;
      options.brdf = brdf;
      options.view_cosines = {0.1, 0.25, 0.5};
      options.axis = fitted ? brdf::LobeAxis::fitted : brdf::LobeAxis::reflected;
      options.bake.size = {32, 32};
      options.bake.chain = false;
      const ViewStack stack(bake_views(map, options));
      std::mt19937 random(6);
      std::normal_distribution<double> normal_distribution;
      for (int i = 0; i < 30; ++i) {
        const Vec3d normal = normalize(
            Vec3d{normal_distribution(random), normal_distribution(random), normal_distribution(random)});
        const Vec3d view = view_at(normal, options.view_cosines[static_cast<std::size_t>(i % 3)]);
        std::array<double, 3> exact;
        reference.evaluate(brdf, normal, view, exact, 1e-5);
        const auto found = stack.rgb(normal, view);
        for (std::size_t c = 0; c < 3; ++c) {
          const double off = static_cast<double>(found[c]) - exact[c];
          error[fitted ? 1 : 0] += off * off;
        }
      }
    }
    EXPECT_LT(std::sqrt(error[1]), 0.6 * std::sqrt(error[0])) << brdf.spec();
  }
}

TEST(ViewReference, IsTheIntegral) {
  // Of the map y + 2: the mean of the lobe's directions.
  const Map map = [] {
    Map made(sphere::AnyParameterization::make("cube"), 64, 64, 1);
    for (int chart = 0; chart < 6; ++chart) {
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x)
          *made.level.chart(chart).at(x, y) = static_cast<float>(
              2 + made.parameterization.to_sphere(chart, (x + 0.5) / 64, (y + 0.5) / 64).y);
      }
    }
    fill_borders(made);
    return made;
  }();
  const ViewReference reference(map);
  for (const double roughness : {0.25, 0.5, 1.0}) {
    for (const double cosine : {0.1, 0.5, 1.0}) {
      const brdf::AnyBrdf brdf = brdf::AnyBrdf::make("ggx").with_roughness(roughness);
      const brdf::LobePoints points = brdf::lobe_points(brdf, cosine);
      const Vec3d normal = normalize(Vec3d{0.2, 1, 0.4}), view = view_at(normal, cosine);
      const Vec3d level = view - dot(view, normal) * normal;
      const Vec3d along = length(level) > 1e-9 ? normalize(level) : normalize(cross(normal, Vec3d{1, 0, 0}));
      const Vec3d across = cross(normal, along);
      double sum = 0, whole = 0;
      for (std::size_t i = 0; i < points.weights.size(); ++i) {
        const Vec3d& d = points.directions[i];
        sum += points.weights[i] * (2 + d.x * along.y + d.y * across.y + d.z * normal.y);
        whole += points.weights[i];
      }
      std::array<double, 1> found;
      reference.evaluate(brdf, normal, view, found);
      EXPECT_NEAR(found[0], sum / whole, 2e-3)
          << roughness << " " << cosine;  // texels of 1.4°, constant each
    }
  }
  std::array<double, 1> room;
  EXPECT_THROW(reference.evaluate(brdf::AnyBrdf::make("ggx,roughness=0"), {0, 1, 0}, {0, 1, 0}, room), Error);
  EXPECT_THROW(reference.evaluate(brdf::AnyBrdf::make("ggx"), {0, 1, 0}, {0, -1, 0}, room), Error);
}

TEST(ViewChains, AnglesAndPositions) {
  const std::vector<double> cosines = default_view_cosines(4);
  EXPECT_EQ(cosines.size(), 4u);
  EXPECT_DOUBLE_EQ(cosines[0], 1.0 / 64);
  EXPECT_DOUBLE_EQ(cosines[3], 49.0 / 64);
  EXPECT_THROW(default_view_cosines(0), Error);
  const ViewPosition between = view_position(cosines, 0.25);
  EXPECT_EQ(between.below, 1u);
  EXPECT_EQ(between.above, 2u);
  EXPECT_NEAR(between.part, 0.5, 1e-12);
  EXPECT_EQ(view_position(cosines, -1).above, 0u);
  EXPECT_EQ(view_position(cosines, 1).below, 3u);
}

}  // namespace
}  // namespace welkin
