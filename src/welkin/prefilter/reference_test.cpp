#include "welkin/prefilter/reference.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/lobe/lobe_cases.h"
#include "welkin/lobe/zonal.h"
#include "welkin/prefilter/prefilter_cases.h"

namespace welkin {
namespace {

using namespace prefilter_cases;

const Vec3d kAxes[] = {
    {0, 1, 0}, {0, 0, 1}, normalize(Vec3d{0.3, 0.7, -0.2}), normalize(Vec3d{-0.8, -0.01, 0.4})};

std::vector<double> values(const PrefilterReference& reference, const AnyLobe& lobe,
                           std::span<const Vec3d> directions, int channels = 1) {
  std::vector<double> out(directions.size() * static_cast<std::size_t>(channels));
  reference.evaluate(lobe, directions, out);
  return out;
}

/// ∫ w · 1 = ∫ w, for lobes from wide to far narrower than a texel, rings too. Quadrature over texels
/// of 4.5°: 2e-4 where the lobe has a kink at the horizon; 1e-3 of a step, and of a table's kinks, which it
/// doesn't see.
TEST(PrefilterReference, AConstantMapStaysConstant) {
  for (const char* shape : {"latlong", "cube", "eac", "octahedral-equal-area", "healpix"}) {
    const Map side = cases::make_map(shape, 20);
    const Map source = filled(shape, side.width(), side.height(), 2.5f);
    const PrefilterReference reference(source);
    EXPECT_NEAR(reference.integral()[0] / (10 * kPi), 1, 3e-6) << shape;
    for (const AnyLobe& lobe : lobe::cases::all_lobes()) {
      if (lobe.is_mirror() || lobe.width() < 1e-3) continue;
      const double bound = lobe.name() == "table" || lobe.spec() == "phong,exponent=0" ? 3e-3 : 2e-4;
      for (const double value : values(reference, lobe, kAxes))
        EXPECT_NEAR(value / 2.5, 1, bound) << shape << ' ' << lobe.spec();
    }
  }
}

/// One lit texel, much smaller than the lobe: the lobe's value there, as far as it is flat over the texel.
TEST(PrefilterReference, OneTexelIsTheLobesValue) {
  for (const char* shape : {"latlong", "cube"}) {
    Map source = cases::make_map(shape, 128);
    const int x = source.width() / 3, y = source.height() / 4;
    *source.level.chart(0).at(x, y) = 1000;
    const PrefilterReference reference(source);
    const Vec3d light = cases::direction_at(source, 0, x, y);
    for (const char* spec : {"lambert", "ggx,roughness=0.7", "phong,exponent=3", "vmf,kappa=5"}) {
      const AnyLobe lobe = AnyLobe::make(spec);
      for (const Vec3d& axis : kAxes) {
        const Vec3d away = light - axis;
        if (dot(light, axis) < 0.1) continue;
        const double expected = lobe.weight(dot(away, away) / 2) * reference.integral()[0] / lobe.integral();
        EXPECT_NEAR(values(reference, lobe, {&axis, 1})[0] / expected, 1, 2e-3) << shape << ' ' << spec;
      }
    }
  }
}

/// Of a needle in the middle of a texel the texel's radiance is left, of one in the middle between two their
/// mean.
TEST(PrefilterReference, NeedlesReadTexels) {
  const Map source = landscape("latlong", 32, 16, 3);
  const PrefilterReference reference(source);
  const AnyLobe needle = AnyLobe::make("vmf,kappa=1e5");
  for (const int x : {0, 9, 31}) {
    for (const int y : {1, 8, 14}) {
      const auto direction = [&](double u) {
        return source.parameterization.to_sphere(0, u / 32, (y + 0.5) / 16);
      };
      const Vec3d two[] = {direction(x + 0.5), direction(x + 1)};
      const std::vector<double> out = values(reference, needle, two, 3);
      for (std::size_t c = 0; c < 3; ++c) {
        const double here = static_cast<double>(source.level.chart(0).at(x, y)[c]);
        const double next = static_cast<double>(source.level.chart(0).at((x + 1) % 32, y)[c]);
        EXPECT_NEAR(out[c] / here, 1, 1e-5);
        EXPECT_NEAR(out[3 + c] / (0.5 * (here + next)), 1, 1e-5);
      }
    }
  }
}

/// Funk and Hecke: of L = 1 + a·d + quadratic, λ_1 and λ_2 are left. Texels hold L at their centres, so
/// the error is that of a fine map: 1/64² of its change.
TEST(PrefilterReference, HarmonicsKeepTheirShape) {
  const Vec3d a{0.3, -0.5, 0.4};
  for (const char* shape : {"latlong", "octahedral-equal-area"}) {
    const auto quadratic = [](const Vec3d& d) { return 0.3 * (d.x * d.x - d.y * d.y) + 0.4 * d.x * d.z; };
    const Map source =
        cases::rendered(shape, 128, [&](const Vec3d& d) { return 1 + dot(a, d) + quadratic(d); });
    const PrefilterReference reference(source);
    for (const char* spec : {"lambert", "ggx,roughness=0.5", "charlie", "phong,exponent=10", "blinn"}) {
      const AnyLobe lobe = AnyLobe::make(spec);
      const std::vector<double> zonal = lobe::zonal_coefficients(lobe, 2);
      const std::vector<double> got = values(reference, lobe, kAxes);
      for (std::size_t i = 0; i < got.size(); ++i) {
        const Vec3d& d = kAxes[i];
        EXPECT_NEAR(got[i], 1 + zonal[1] * dot(a, d) + zonal[2] * quadratic(d), 4e-4) << shape << ' ' << spec;
      }
    }
  }
}

/// The irradiance over π of a sky of radiance max(d.y, 0): ⅔ straight up; on a wall ∫ cos θ sin²θ dθ = ⅓
/// times ∫ cos φ dφ = 2.
TEST(PrefilterReference, IrradianceOfACosineSky) {
  const Map source = cases::rendered("latlong", 256, [](const Vec3d& d) { return std::max(d.y, 0.0); });
  const PrefilterReference reference(source);
  const AnyLobe lambert = AnyLobe::make("lambert");
  const Vec3d ways[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
  const std::vector<double> got = values(reference, lambert, ways);
  EXPECT_NEAR(got[0], 2.0 / 3, 1e-4);
  EXPECT_NEAR(got[1], 2.0 / (3 * kPi), 1e-4);
  EXPECT_NEAR(got[2], 2.0 / (3 * kPi), 1e-4);
  EXPECT_NEAR(got[3], 0, 1e-4);
}

TEST(PrefilterReference, DirectionsAreTheWorldsAndOfAnyLength) {
  const Matrix3 turn = rotation_from_yaw_pitch_roll(40, 25, 10);
  Map source = landscape("cube", 8, 8);
  const AnyLobe lobe = AnyLobe::make("ggx,roughness=0.6");
  const std::vector<double> expected = values(PrefilterReference(source), lobe, kAxes);
  source.orientation = turn;
  const PrefilterReference turned(source);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d d = 7.0 * (transpose(turn) * kAxes[i]);
    EXPECT_NEAR(values(turned, lobe, {&d, 1})[0] / expected[i], 1, 1e-12);
  }
}

TEST(PrefilterReference, IsCancelled) {
  const Map source = landscape("cube", 8, 8);
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  std::vector<double> out(4);
  EXPECT_THROW(PrefilterReference(source).evaluate(AnyLobe::make("lambert"), kAxes, out, monitor), Cancelled);
}

}  // namespace
}  // namespace welkin
