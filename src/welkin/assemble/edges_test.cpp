#include "welkin/assemble/edges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

double depth(const std::vector<Cap>& caps, const Vec3d& d) {
  double least = kPi;
  for (const Cap& cap : caps) least = std::min(least, cap.depth(d));
  return least;
}

TEST(Edges, OfAFisheyeAreOneCap) {
  const auto caps = edges_of(sphere::AnyParameterization::make("fisheye-equidistant,fov=200"));
  ASSERT_EQ(caps.size(), 1u);
  EXPECT_NEAR(caps[0].radius, 100 * kDegree, 1e-6);
  EXPECT_NEAR(caps[0].depth(direction_at(90, 0)), 10 * kDegree, 1e-6);
}

TEST(Edges, OfHalfWorldsAreTheHorizon) {
  for (const char* name : {"half-cube", "sky-latlong", "hemi-octahedral"}) {
    const auto caps = edges_of(sphere::AnyParameterization::make(name));
    ASSERT_EQ(caps.size(), 1u) << name;
    EXPECT_NEAR(caps[0].depth(direction_at(40, 25)), 25 * kDegree, 1e-6) << name;
  }
}

TEST(Edges, OfAWholeWorldAreNone) {
  EXPECT_TRUE(edges_of(sphere::AnyParameterization::make("cube")).empty());
}

// On the horizon, a flat picture of 60° across ends 30° from its centre; above, at its vertical field of
// view.
TEST(Edges, OfAFlatPictureAreItsSides) {
  const auto caps = edges_of(sphere::AnyParameterization::make("perspective,fov=60,aspect=1.5"));
  ASSERT_EQ(caps.size(), 4u);
  EXPECT_NEAR(depth(caps, direction_at(25, 0)), 5 * kDegree, 1e-9);
  EXPECT_NEAR(depth(caps, direction_at(0, 0)), std::atan(std::tan(30 * kDegree) / 1.5), 1e-9);
  EXPECT_LT(depth(caps, direction_at(180, 0)), 0);
}

TEST(Edges, OfALatlongWindowAreMeridiansAndCirclesOfLatitude) {
  const auto caps = edges_of(sphere::AnyParameterization::make("latlong,left=-60,right=30,top=40,bottom=-5"));
  ASSERT_EQ(caps.size(), 4u);
  EXPECT_NEAR(depth(caps, direction_at(0, 37)), 3 * kDegree, 1e-9);
  EXPECT_NEAR(depth(caps, direction_at(0, -3)), 2 * kDegree, 1e-9);
}

TEST(Edges, ThatAreNoneOfTheseAreRefused) {
  EXPECT_THROW(edges_of(sphere::AnyParameterization::make("latlong,left=-150,right=150")), Error);
}

}  // namespace
}  // namespace welkin
