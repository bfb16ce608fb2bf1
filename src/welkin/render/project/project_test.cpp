#include "welkin/render/project/project.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/filter/resample.h"
#include "welkin/measure/compare.h"
#include "welkin/render/project/project_cases.h"

namespace welkin::scene {
namespace {

constexpr const char* kShapes[] = {
    "cube",   "octahedral", "octahedral-equal-area", "latlong", "paraboloid", "eac", "equal-area", "healpix",
    "sphere", "angular"};

MapFrame frame(const char* name, int height) {
  const auto p = sphere::AnyParameterization::make(name);
  return {p, {static_cast<int>(std::lround(height * p.aspect())), height}};
}

/// ∫ of a channel over the sphere.
double integral(const Map& map, int channel) {
  double sum = 0;
  std::vector<float> angles(static_cast<std::size_t>(map.width()));
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      texel_solid_angles(map.parameterization, map.width(), map.height(), chart, y, angles.data());
      for (int x = 0; x < map.width(); ++x)
        sum += static_cast<double>(angles[static_cast<std::size_t>(x)]) *
               static_cast<double>(map.level.chart(chart).at(x, y)[channel]);
    }
  }
  return sum;
}

template <class Check>
void each_texel(const Map& map, const Check& check) {
  for (int chart = 0; chart < map.charts(); ++chart)
    for (int y = 0; y < map.height(); ++y)
      for (int x = 0; x < map.width(); ++x)
        if (map.parameterization.valid(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height()))
          check(map.level.chart(chart).at(x, y));
}

TEST(Project, AConstantRoomIsConstant) {
  Scene room;
  add_lamp(room, {0, 0, 0}, 3, 0.7f, 24);
  const TracedScene scene(std::move(room));
  for (const char* shape : kShapes) {
    const Map map = project({scene, EmissionShading()}, {0.5, -1, 0.25}, frame(shape, 16), {.samples = 2});
    each_texel(map, [&](const float* texel) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel[c], 0.7f, 1e-6f) << shape;
    });
  }
}

// Texels of both are means over solid angles, so a finer projection, converted, is the coarser one. What is
// left is the antialiasing of edges: 8×8 rays of the coarse texel find an edge to an eighth of its side or
// so, and a few texels in a hundred have edges.
TEST(Project, CubeAndOctahedronAgree) {
  const TracedScene scene(furnished_room());
  const EmissionShading glow;
  const Vec3d place{0.1, 0.2, 0.3};
  const Map fine = project({scene, glow}, place, frame("octahedral", 256), {.samples = 4});
  const Map coarse = project({scene, glow}, place, frame("cube", 24), {.samples = 8});
  Map converted(coarse.parameterization, 24, 24, 3);
  resample(fine, converted);
  EXPECT_LT(compare(coarse, converted).all.relative_rmse, 0.01);
  // Two places do not see the same.
  const Map elsewhere = project({scene, glow}, {-0.1, 0.2, 0.3}, frame("cube", 24), {.samples = 8});
  EXPECT_GT(compare(coarse, elsewhere).all.relative_rmse, 0.05);
}

TEST(Project, ALampIsItsSolidAngle) {
  Scene lamp;
  const Vec3d centre{1, 2, -2};
  const double radius = 0.4;
  add_lamp(lamp, centre, radius, 5);
  const TracedScene scene(std::move(lamp));
  const double sine = radius / length(centre), wanted = 5 * 2 * kPi * (1 - std::sqrt(1 - sine * sine));
  for (const char* shape : kShapes) {
    // A disc of 0.15 rad in texels of 0.06 and less, each with 64 rays: 0.3 % of its area.
    const Map map = project({scene, EmissionShading()}, {0, 0, 0}, frame(shape, 64), {.samples = 8});
    EXPECT_NEAR(integral(map, 0) / wanted, 1, 0.01) << shape;
  }
}

// A body all around that shows a function of the direction is projected as that function is drawn, in all
// charts and across their edges.
TEST(Project, EdgesHaveNoSeams) {
  Scene around;
  add_lamp(around, {0, 0, 0}, 2, 0, 64);
  const TracedScene scene(std::move(around));
  for (const char* shape : kShapes) {
    const MapFrame to = frame(shape, 24);
    const Map map = project({scene, DirectionShading()}, {0, 0, 0}, to, {.samples = 3});
    const Map drawn = welkin::render([](const Vec3d& d) { return DirectionShading::of(d); },
                                     to.parameterization, to.size.width, to.size.height, {.samples = 3});
    for (int chart = 0; chart < map.charts(); ++chart)
      for (int y = -kBorder; y < map.height() + kBorder; ++y)
        for (int x = -kBorder; x < map.width() + kBorder; ++x)
          for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(map.level.chart(chart).at(x, y)[c], drawn.level.chart(chart).at(x, y)[c], 2e-5)
                << shape << " " << chart << " " << x << " " << y;
  }
}

TEST(Project, DepthIsTheDistance) {
  Scene around;
  add_lamp(around, {0, 0, 0}, 5, 1, 192);
  const TracedScene scene(std::move(around));
  ProjectOptions options;
  options.depth = DepthChannels::moments;
  options.coverage = true;
  // The ball's triangles lie inside it by (π/192)²/2·5 at most.
  const Map middle = project({scene, EmissionShading()}, {0, 0, 0}, frame("octahedral", 32), options);
  ASSERT_EQ(middle.channel_names, (std::vector<std::string>{"R", "G", "B", "A", "Z", "Z2"}));
  each_texel(middle, [](const float* texel) {
    ASSERT_NEAR(texel[3], 1, 1e-5);
    ASSERT_NEAR(texel[4], 5, 1e-3);
    ASSERT_NEAR(texel[5], 25, 1e-2);
  });
  // From elsewhere: −p·d + √((p·d)² + 25 − p²), and the texel's mean is its middle's to its square.
  const Vec3d place{1, 2, -3};
  const Map moved = project({scene, EmissionShading()}, place, frame("cube", 64), options);
  for (int chart = 0; chart < 6; ++chart) {
    const Vec3d d = moved.parameterization.to_sphere(chart, 20.5 / 64, 45.5 / 64);
    const double b = dot(place, d), distance = -b + std::sqrt(b * b + 25 - dot(place, place));
    EXPECT_NEAR(moved.level.chart(chart).at(20, 45)[4], distance, 0.01);
  }
  // What is farther counts as the farthest, and so does what isn't met.
  options.farthest = 4;
  const Map cut = project({scene, EmissionShading()}, {0, 0, 0}, frame("octahedral", 8), options);
  const Map empty =
      project({TracedScene(Scene{}), EmissionShading()}, {0, 0, 0}, frame("octahedral", 8), options);
  for (const Map* map : {&cut, &empty})
    each_texel(*map, [](const float* texel) {
      ASSERT_NEAR(texel[4], 4, 1e-5);
      ASSERT_NEAR(texel[5], 16, 1e-4);
    });
}

// Past all surfaces the background is what converting it gives, to the bit.
TEST(Project, TheSkyIsTheMap) {
  const World world(synth_map("studio"));
  const EmissionShading glow;
  const TracedScene nothing{Scene{}};
  const Map seen = project({nothing, glow, &world}, {3, 2, 1}, frame("octahedral", 48));
  Map converted(seen.parameterization, 48, 48, 3);
  resample(world.map(), converted);
  EXPECT_EQ(compare(converted, seen).all.maximum_absolute, 0);
  // A black ball hides its part of it; the rest of the texels at its outline is by cones.
  Scene ball;
  add_lamp(ball, {0, 0, 2}, 1, 0);
  const Map partly = project({TracedScene(std::move(ball)), glow, &world}, {0, 0, 0}, frame("octahedral", 48),
                             {.samples = 8, .coverage = true});
  double least = 1;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      const float* texel = partly.level.chart(0).at(x, y);
      const float* sky = converted.level.chart(0).at(x, y);
      if (texel[3] == 0) {
        ASSERT_EQ(texel[0], sky[0]);
      } else if (texel[3] == 1) {
        ASSERT_EQ(texel[0], 0);
        least = 0;
      }
    }
  }
  EXPECT_EQ(least, 0);
}

// A constant world behind anything that is as bright shows no outline: no ray's share is lost or doubled.
TEST(Project, OutlinesBeforeTheSkyKeepTheirShares) {
  Map grey(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int y = -kBorder; y < 32 + kBorder; ++y)
    for (int x = -kBorder; x < 64 + kBorder; ++x)
      for (int c = 0; c < 3; ++c) grey.level.chart(0).at(x, y)[c] = 0.5f;
  Proxy room;
  room.shape = Proxy::Shape::sphere;
  room.radius = 50;
  for (const Proxy& proxy : {Proxy{}, room}) {
    const World world(grey.clone(), proxy);
    Scene ball;
    add_lamp(ball, {0, 0, 2}, 1, 0.5f);
    ball.materials[0].alpha = 0.4f;
    ball.materials[0].blended = true;
    const Map map = project({TracedScene(std::move(ball)), EmissionShading(), &world}, {0, 0, 0},
                            frame("cube", 16), {.coverage = true});
    double most = 0;
    each_texel(map, [&](const float* texel) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel[c], 0.5f, 1e-5f);
      most = std::max(most, static_cast<double>(texel[3]));
    });
    // Two surfaces that let 0.6 through each.
    EXPECT_NEAR(most, 1 - 0.36, 1e-4);
  }
}

// Shaded once, a texel differs where light changes within it; the shares of what it sees don't.
TEST(Project, ShadedOnceItIsNearlyTheSame) {
  const TracedScene scene(furnished_room());
  const World world(synth_map("studio"));
  const auto material = make_shading("material", {world});
  const auto with = [&](bool once, const Shading& shading) {
    return project({scene, shading, &world}, {0, 0, 0}, frame("octahedral", 48),
                   {.samples = 4, .shade_once = once, .coverage = true, .depth = DepthChannels::mean});
  };
  const Map each = with(false, *material), once = with(true, *material);
  EXPECT_LT(compare(each, once).all.relative_rmse, 0.01);
  // Of one colour for each body they are the same.
  EXPECT_LT(compare(with(false, EmissionShading()), with(true, EmissionShading())).all.maximum_absolute,
            1e-5);
}

TEST(Project, TheSameForAnyNumberOfThreads) {
  const TracedScene scene(furnished_room());
  const World world(synth_map("studio"));
  const auto material = make_shading("material", {world});
  const auto made = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return project({scene, *material, &world}, {0, 0, 0}, frame("octahedral", 40));
  };
  const Map one = made(1), four = made(4);
  for (int y = 0; y < 40; ++y)
    ASSERT_EQ(std::memcmp(one.level.chart(0).row(y), four.level.chart(0).row(y), sizeof(float) * 3 * 40), 0);
}

// The map of a turned frame holds what its directions see.
TEST(Project, OrientationTurnsTheMap) {
  const TracedScene scene(furnished_room());
  MapFrame turned = frame("octahedral", 32);
  turned.orientation = rotation_of({40, 20, 10});
  const Map map = project({scene, EmissionShading()}, {0, 0, 0}, turned, {.samples = 8});
  Map straight(turned.parameterization, 32, 32, 3);
  resample(map, straight);
  const Map wanted = project({scene, EmissionShading()}, {0, 0, 0}, frame("octahedral", 32), {.samples = 8});
  EXPECT_LT(compare(wanted, straight).all.relative_rmse, 0.1);
  EXPECT_GT(compare(wanted, map).all.relative_rmse, 1e-3);
}

TEST(Project, RefusesWhatMakesNoSense) {
  const TracedScene scene(ball(8));
  const EmissionShading glow;
  const auto with = [&](const Vec3d& place, const ProjectOptions& options) {
    return project({scene, glow}, place, frame("cube", 4), options);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(with({0, nan, 0}, {}), Error);
  EXPECT_THROW(with({1e31, 0, 0}, {}), Error);
  EXPECT_THROW(with({0, 0, 0}, {.samples = 0}), Error);
  EXPECT_THROW(with({0, 0, 0}, {.samples = 65}), Error);
  for (const double farthest : {0.0, -1.0, nan, 1e31}) {
    ProjectOptions options;
    options.farthest = farthest;
    EXPECT_THROW(with({0, 0, 0}, options), Error) << farthest;
  }
  EXPECT_THROW(project({scene, glow}, {0, 0, 0}, {sphere::AnyParameterization::make("cube"), {0, 4}}), Error);
}

}  // namespace
}  // namespace welkin::scene
