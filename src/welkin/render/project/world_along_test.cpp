#include "welkin/render/project/world_along.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/render/render_cases.h"

namespace welkin::scene {
namespace {

// Beside a ball: every fourth frame is a projection, those between lie on straight lines between them.
TEST(WorldAlong, InterpolatesBetweenProjections) {
  const TracedScene scene(ball(32));
  const World sky(synth_map("studio", 64));
  const auto normals = make_shading("normals", {sky});
  const ShadedScene seen{scene, *normals, &sky};
  const auto place = [](double frame) { return Vec3d{-4 + frame, 0, -3}; };
  WorldAlong along(seen, place, {.every = 4, .size = {32, 16}});
  const Map first = along.at(0), between = along.at(1), second = along.at(4);
  EXPECT_EQ(along.made(), 2);
  const Map exact = project(seen, place(4), MapFrame(sphere::AnyParameterization::make("latlong"), {32, 16}),
                            {.samples = 2});
  double moved = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float a = first.level.chart(0).at(x, y)[c], b = second.level.chart(0).at(x, y)[c];
        EXPECT_EQ(b, exact.level.chart(0).at(x, y)[c]);
        EXPECT_NEAR(between.level.chart(0).at(x, y)[c], 0.75f * a + 0.25f * b, 1e-5f);
        moved += std::abs(a - b);
      }
    }
  }
  EXPECT_GT(moved, 1);
  EXPECT_THROW(WorldAlong(seen, place, {.every = 0}), Error);
}

// What is hidden is not met, and the rest is.
TEST(TracedScene, HiddenInstancesAreNotMet) {
  Scene two = ball(16);
  two.instances.push_back({"second", 0, {{}, {5, 0, 0}}, -1});
  const TracedScene both(std::move(two));
  const TracedScene one = both.moved({{}, {{}, {5, 0, 0}}}, {false, true});
  EXPECT_TRUE(one.closest(Ray{{0, 0, -4}, {0, 0, 1}}));
  EXPECT_FALSE(one.closest(Ray{{5, 0, -4}, {0, 0, 1}}));
  EXPECT_TRUE(both.closest(Ray{{5, 0, -4}, {0, 0, 1}}));
}

}  // namespace
}  // namespace welkin::scene
