#include "welkin/synth/render_synth.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

int height_of(const AnyParameterization& p, int width) {
  return std::max(1, static_cast<int>(std::lround(width / p.aspect())));
}

TEST(RenderSynth, AConstantIsConstantInEveryParameterization) {
  const auto constant = [](const Vec3d&) { return std::array<float, 3>{0.25f, 1.5f, 3}; };
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    const Map map = render(constant, p, 24, height_of(p, 24), {.samples = 3});
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
          if (!p.valid(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height())) continue;
          const float* texel = map.level.chart(chart).at(x, y);
          EXPECT_FLOAT_EQ(texel[0], 0.25f) << name;
          EXPECT_FLOAT_EQ(texel[1], 1.5f) << name;
          EXPECT_FLOAT_EQ(texel[2], 3) << name;
        }
      }
    }
    EXPECT_FLOAT_EQ(map.level.chart(0).at(-1, map.height() / 2)[1], 1.5f) << name;  // the border
  }
}

/// A linear function of direction is its own mean but for the texel's curvature and the density's slope,
/// which are of the order of the texel's angle squared (but at the poles of a lat-long map): 0.03² at most.
TEST(RenderSynth, TexelsShowTheWorldInTheirDirection) {
  const Matrix3 orientation = rotation_from_yaw_pitch_roll(50, -20, 130);
  const auto linear = [](const Vec3d& d) {
    return std::array<float, 3>{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  };
  for (const char* name : {"eac", "cube", "healpix", "half-cube"}) {
    const Map map = render(linear, AnyParameterization::make(name), 64, 64, {.orientation = orientation});
    EXPECT_EQ(map.orientation, orientation);
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < 64; y += 7) {
        for (int x = 0; x < 64; x += 5) {
          const double u = (x + 0.5) / 64, v = (y + 0.5) / 64;
          if (!map.parameterization.valid(chart, u, v)) continue;
          const Vec3d d = transpose(orientation) * map.parameterization.to_sphere(chart, u, v);
          const float* texel = map.level.chart(chart).at(x, y);
          EXPECT_NEAR(static_cast<double>(texel[0]), d.x, 2e-3) << name;
          EXPECT_NEAR(static_cast<double>(texel[1]), d.y, 2e-3) << name;
          EXPECT_NEAR(static_cast<double>(texel[2]), d.z, 2e-3) << name;
        }
      }
    }
  }
}

TEST(RenderSynth, TexelsOutsideTheMapAreBlackAndNotEvaluated) {
  std::atomic<int> behind{0};
  const auto front = [&](const Vec3d& d) {
    if (d.z < -1e-5) ++behind;
    return std::array<float, 3>{1, 1, 1};
  };
  const Map map = render(front, AnyParameterization::make("fisheye-equidistant"), 64, 64);
  EXPECT_EQ(behind, 0);
  EXPECT_EQ(map.level.chart(0).at(0, 0)[0], 0);
  EXPECT_EQ(map.level.chart(0).at(32, 32)[0], 1);
  EXPECT_EQ(map.level.chart(0).at(32, 0)[0], 1);
}

TEST(RenderSynth, SamplesAreAsManyAsAskedAndUnit) {
  std::atomic<int> calls{0}, bent{0};
  const auto count = [&](const Vec3d& d) {
    ++calls;
    if (std::fabs(length(d) - 1) > 1e-14) ++bent;
    return std::array<float, 3>{0, 0, 0};
  };
  render(count, AnyParameterization::make("cube"), 5, 7, {.samples = 3});
  EXPECT_EQ(calls, 6 * 5 * 7 * 9);
  EXPECT_EQ(bent, 0);
}

/// An edge that is aligned with rows or columns is seen in samples² steps, not in `samples`.
TEST(RenderSynth, AStraightEdgeIsCutFinely) {
  const auto p = AnyParameterization::make("cube");
  for (int i = 1; i < 16; ++i) {
    const double edge = -1 + 2 * (3 + (i + 0.02) / 16) / 8;  // within texel 3 of 8, on the faces ±Z
    const auto half = [edge](const Vec3d& d) {
      return std::array<float, 3>{d.x < edge * d.z ? 1.0f : 0.0f, d.y > -edge * d.z ? 1.0f : 0.0f, 0};
    };
    const Map map = render(half, p, 8, 8);
    // The density varies over a texel by a few percent.
    EXPECT_NEAR(static_cast<double>(map.level.chart(4).at(3, 4)[0]), i / 16.0, 0.02);
    EXPECT_NEAR(static_cast<double>(map.level.chart(4).at(4, 3)[1]), i / 16.0, 0.02);
  }
}

TEST(RenderSynth, RejectsSizesThatMakeNoSense) {
  const auto p = AnyParameterization::make("cube");
  const auto sky = synth::make("constant");
  EXPECT_THROW(render(sky, p, 0, 8), Error);
  EXPECT_THROW(render(sky, p, 8, -1), Error);
  EXPECT_THROW(render(sky, p, 1 << 30, 1 << 30), Error);
  EXPECT_THROW(render(sky, p, 8, 8, {.samples = 0}), Error);
  EXPECT_THROW(render(sky, p, 8, 8, {.samples = 65}), Error);
  Matrix3 bent;
  bent.rows[0][0] = 2;
  EXPECT_THROW(render(sky, p, 8, 8, {.orientation = bent}), Error);
  EXPECT_THROW(render(sky, p, 8, 8, {.monitor = {nullptr, [] { return true; }}}), Cancelled);
}

}  // namespace
}  // namespace welkin
