#include <gtest/gtest.h>

#include <cmath>

#include "welkin/sphere/cube.h"
#include "welkin/sphere/latlong.h"
#include "welkin/synth/synth.h"

namespace welkin::synth {
namespace {

/// A side of the cube as someone at the centre sees it, head along `up`.
struct View {
  Vec3d forward, up;

  /// Direction of the point `right` and `down` of the middle of the side's plane.
  Vec3d at(double right, double down) const {
    return normalize(forward + right * cross(forward, up) + (-down) * up);
  }
};

/// Heads are up on the four walls; toward +Z's edge on floor and ceiling they are what the native faces say.
constexpr View kViews[6] = {{{1, 0, 0}, {0, 1, 0}},  {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, -1}},
                            {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}}};

double distance(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

class Axes : public testing::Test {
 protected:
  std::array<float, 3> ground(int face) const { return map_(kViews[face].at(0, 0.40)); }
  /// Whether the middle disc has ink there.
  bool ink(int face, double right, double down) const {
    return distance(map_(kViews[face].at(right, down)), ground(face)) > 0.05;
  }
  /// Part of the rectangle [left, right]×[top, bottom] of the middle disc that is ink.
  double ink_share(int face, double left, double right, double top, double bottom) const {
    int count = 0;
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        count += ink(face, left + (right - left) * (i + 0.5) / 40, top + (bottom - top) * (j + 0.5) / 40);
      }
    }
    return count / 1600.0;
  }

  Radiance map_ = make("axes");
};

TEST_F(Axes, ViewsAreTheNativeFacesSeenFromInside) {
  for (int face = 0; face < 6; ++face) {
    const sphere::CubeFace& native = sphere::kCubeFaces[face];
    EXPECT_EQ(dot(native.forward, kViews[face].forward), 1);
    EXPECT_EQ(dot(native.down, kViews[face].up), -1);
    EXPECT_EQ(dot(native.right, cross(kViews[face].forward, kViews[face].up)), -1);
  }
}

TEST_F(Axes, EverySideHasItsOwnColour) {
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < a; ++b) EXPECT_GT(distance(ground(a), ground(b)), 0.1) << a << ' ' << b;
  }
}

// A capital is 0.4 of the plane high: its top is above the sign's.
TEST_F(Axes, TheSignStandsLeftOfTheLetter) {
  for (int face = 0; face < 6; ++face) {
    EXPECT_EQ(ink_share(face, -0.38, -0.02, -0.22, -0.16), 0) << face;
    EXPECT_GT(ink_share(face, 0.02, 0.30, -0.22, -0.16), 0.2) << face;
    EXPECT_EQ(ink_share(face, -0.38, -0.02, 0.16, 0.22), 0) << face;
  }
}

TEST_F(Axes, PlusHasAnUprightAndMinusHasNone) {
  for (int face = 0; face < 6; ++face) {
    EXPECT_TRUE(ink(face, -0.192, 0)) << face;
    EXPECT_EQ(ink(face, -0.192, -0.08), face % 2 == 0) << face;
  }
}

TEST_F(Axes, YStandsOnItsFootAndZLeansRight) {
  for (const int face : {2, 3}) {
    EXPECT_LT(ink_share(face, 0.02, 0.30, 0.10, 0.18), 0.5 * ink_share(face, 0.02, 0.30, -0.18, -0.10))
        << face;
    EXPECT_TRUE(ink(face, 0.16, 0.15)) << face;
    EXPECT_FALSE(ink(face, 0.16, -0.15)) << face;
  }
  for (const int face : {4, 5}) {
    EXPECT_TRUE(ink(face, 0.172 + 0.064, -0.1)) << face;
    EXPECT_FALSE(ink(face, 0.172 - 0.064, -0.1)) << face;
    EXPECT_TRUE(ink(face, 0.172 - 0.064, 0.1)) << face;
    EXPECT_FALSE(ink(face, 0.172 + 0.064, 0.1)) << face;
  }
}

// Toward each edge stands the name of the axis beyond it: its sign is a plus when that axis is positive.
TEST_F(Axes, SignpostsNameTheSideBeyondTheEdge) {
  constexpr double kHeight = 0.095, kMiddle = 0.71, kOffset[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  for (int face = 0; face < 6; ++face) {
    for (const auto& [right, down] : kOffset) {
      // Left of the middle by the sign's position in the text; letters differ in width by 0.06 of their
      // height.
      const double x = kMiddle * right - 0.47 * kHeight, y = kMiddle * down;
      const auto paper = map_(kViews[face].at(x, y - 0.45 * kHeight));
      const double upright = distance(map_(kViews[face].at(x, y - 0.2 * kHeight)), paper);
      const double bar = distance(map_(kViews[face].at(x, y)), paper);
      const Vec3d beyond = kViews[face].at(1e3 * right, 1e3 * down);
      EXPECT_GT(bar, 0.1) << face << ' ' << right << ' ' << down;
      EXPECT_EQ(upright > 0.1, beyond.x + beyond.y + beyond.z > 0) << face << ' ' << right << ' ' << down;
    }
  }
}

// The middle of a native lat-long picture shows +Z, and +X a quarter to its left.
TEST_F(Axes, LatLongShowsItReadable) {
  const sphere::LatLong picture;
  const auto shown = [&](double u, double v) { return map_(picture.to_sphere<double>(0, u, v)); };
  // 22° below the middle, where the disc is plain.
  const double v = 0.5 + 22.0 / 180;
  EXPECT_LT(distance(shown(0.5, v), ground(4)), 1e-6);
  EXPECT_LT(distance(shown(0.25, v), ground(0)), 1e-6);
  EXPECT_LT(distance(shown(0.75, v), ground(1)), 1e-6);
  // The sign is left of the middle and the letter right: 11° above the horizon, only the letter has ink.
  int left = 0, right = 0;
  for (int i = 1; i < 60; ++i) {
    const double angle = 0.3 * i;
    left += distance(shown(0.5 - angle / 360, 0.5 - 10.6 / 180), ground(4)) > 0.05;
    right += distance(shown(0.5 + angle / 360, 0.5 - 10.6 / 180), ground(4)) > 0.05;
  }
  EXPECT_EQ(left, 0);
  EXPECT_GT(right, 10);
}

}  // namespace
}  // namespace welkin::synth
