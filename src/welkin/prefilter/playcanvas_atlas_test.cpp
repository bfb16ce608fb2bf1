#include "welkin/prefilter/playcanvas_atlas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/prefilter/reference.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

/// The engine's look-up: mapUv of toSphericalUv, bilinear, texel centres at half.
Vec3d read(const Image& atlas, const Vec3d& d, double x, double y, double width, double height) {
  const double u = std::atan2(-d.x, d.z) / (2 * kPi) + 0.5, v = 1 - (std::asin(d.y) / kPi + 0.5);
  const double across = x + 1 + u * (width - 2) - 0.5, down = y + 1 + v * (height - 2) - 0.5;
  const int left = static_cast<int>(std::floor(across)), top = static_cast<int>(std::floor(down));
  Vec3d sum{0, 0, 0};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double weight =
          (i == 0 ? left + 1 - across : across - left) * (j == 0 ? top + 1 - down : down - top);
      const float* p = atlas.at(left + i, top + j);
      sum = sum +
            weight * Vec3d{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    }
  }
  return sum;
}

const Map& room() {
  static const Map map = render(synth::make("room"), sphere::AnyParameterization::make("latlong"), 256, 128);
  return map;
}

const Image& atlas() {
  static const Image image = playcanvas_atlas(room());
  return image;
}

/// As the engine's shader finds them: mirrors at (1 − t, 1 − t, t, t/2), roughness at (0, 1 − t, t, t/2), t =
/// 2⁻ⁱ.
TEST(PlaycanvasAtlas, LiesAsTheEngineLooksItUp) {
  const auto rectangles = playcanvas_rectangles();
  ASSERT_EQ(rectangles.size(), 13u);
  for (int i = 0; i < 6; ++i) {
    const double t = std::exp2(-i), rough = std::exp2(-i - 1);
    const AtlasRectangle &mirror = rectangles[static_cast<std::size_t>(i)],
                         &ggx = rectangles[static_cast<std::size_t>(6 + i)];
    EXPECT_EQ(mirror.x, 512 * (1 - t));
    EXPECT_EQ(mirror.y, 512 * (1 - t));
    EXPECT_EQ(mirror.width, 512 * t);
    EXPECT_EQ(mirror.height, 256 * t);
    EXPECT_EQ(ggx.x, 0);
    EXPECT_EQ(ggx.y, 512 * (1 - rough));
    EXPECT_EQ(ggx.width, 512 * rough);
    EXPECT_EQ(ggx.height, 256 * rough);
  }
  // None covers another.
  for (std::size_t i = 0; i < 13; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto &a = rectangles[i], &b = rectangles[j];
      EXPECT_TRUE(a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + b.height ||
                  b.y >= a.y + a.height);
    }
  }
}

/// What the engine reads at roughness 0.4 and of diffuse light is the lobe's mean, within what bilinear
/// texels of that size lose; across the seam and at the poles too.
TEST(PlaycanvasAtlas, ReadsTheLobesMeans) {
  const auto rectangles = playcanvas_rectangles();
  for (const std::size_t index : {7u, 8u, 12u}) {
    const AtlasRectangle& r = rectangles[index];
    const Map exact =
        prefilter_map(room(), sphere::AnyParameterization::make("latlong"), {{{256, 128}, r.lobe}})[0]
            .clone();
    const Sampler sampler(exact.clone());
    for (const Vec3d& d :
         {Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{1e-3, 0.1, -1}, Vec3d{-1e-3, 0.1, -1}, Vec3d{1, 0.3, 0.2},
          Vec3d{-1, -0.5, 0.4}, Vec3d{0.01, 1, 0}, Vec3d{0.3, -1, 0.2}}) {
      const Vec3d direction = normalize(d);
      const Vec3d found = read(atlas(), direction, r.x, r.y, r.width, r.height);
      const auto wanted = sampler.rgb(direction);
      EXPECT_NEAR(found.x / static_cast<double>(wanted[0]), 1, 0.06)
          << index << ' ' << d.x << ' ' << d.y << ' ' << d.z;
      EXPECT_NEAR(found.z / static_cast<double>(wanted[2]), 1, 0.06)
          << index << ' ' << d.x << ' ' << d.y << ' ' << d.z;
    }
  }
}

TEST(PlaycanvasAtlas, RefusesOtherChannels) {
  EXPECT_THROW(playcanvas_atlas(Map(sphere::AnyParameterization::make("latlong"), 8, 4, 1)), Error);
}

}  // namespace
}  // namespace welkin
