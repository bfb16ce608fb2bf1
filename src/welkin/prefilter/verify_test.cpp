#include "welkin/prefilter/verify.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/lobe/lobe_cases.h"
#include "welkin/map/borders.h"
#include "welkin/prefilter/reference.h"
#include "welkin/prefilter/verify_energy.h"
#include "welkin/prefilter/verify_texels.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using lobe::AnyLobe;
using sphere::AnyParameterization;

Map sun(const std::string& parameterization, int width, int height, const Matrix3& orientation = {}) {
  synth::SynthOptions options;
  options.angle = 10;
  options.intensity = 100;
  return render(synth::make("sun", options), AnyParameterization::make(parameterization), width, height,
                {4, orientation, {}});
}

/// A level by the reference itself.
Map exact_level(const Map& source, const AnyLobe& lobe, const std::string& parameterization, int width,
                const Matrix3& orientation = {}) {
  const AnyParameterization target = AnyParameterization::make(parameterization);
  Map level(target, width, static_cast<int>(width / target.aspect()), source.channels());
  level.orientation = orientation;
  const std::vector<prefilter::Texel> texels = prefilter::random_texels(level, 1 << 20, 1);
  std::vector<Vec3d> directions;
  for (const prefilter::Texel& t : texels) directions.push_back(prefilter::direction_of(level, t));
  const auto channels = static_cast<std::size_t>(source.channels());
  std::vector<double> values(texels.size() * channels);
  PrefilterReference(source).evaluate(lobe, directions, values);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    float* texel = level.level.chart(texels[i].chart).at(texels[i].x, texels[i].y);
    for (std::size_t c = 0; c < channels; ++c) texel[c] = static_cast<float>(values[i * channels + c]);
  }
  return level;
}

void multiply(Map& map, const prefilter::Texel& t, float factor) {
  for (int c = 0; c < map.channels(); ++c) map.level.chart(t.chart).at(t.x, t.y)[c] *= factor;
}

LevelVerification verify(const Map& source, const Map& level, const AnyLobe& lobe,
                         const VerifyOptions& options = {}) {
  const PrefilterLevel made{{level.width(), level.height()}, lobe};
  return verify_prefilter(source, {&level, 1}, {&made, 1}, options).front();
}

ReferenceErrors errors_of(const Map& source, const Map& level, const AnyLobe& lobe,
                          const VerifyOptions& options = {}) {
  return verify(source, level, lobe, options).reference;
}

/// Wide enough to be itself in the coarsest level.
const AnyLobe kLobe = AnyLobe::make("ggx,roughness=0.6");

// ---- against the reference

/// The level holds floats: 6e-8.
TEST(Verify, TheReferenceItselfHasNoError) {
  const Matrix3 turned = rotation_from_yaw_pitch_roll(40, 10, -70);
  const Matrix3 mirrored = Matrix3{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}} * turned;
  for (const Map& source : {sun("latlong", 64, 32, turned), sun("cube", 16, 16, mirrored)}) {
    for (const Matrix3& orientation : {Matrix3{}, turned, mirrored}) {
      VerifyOptions options;
      options.prefilter.orientation = orientation;
      const Map level = exact_level(source, kLobe, "cube", 8, orientation);
      const ReferenceErrors errors = errors_of(source, level, kLobe, options);
      EXPECT_EQ(errors.random_texels, 64);
      EXPECT_GE(errors.hot_texels, 1);
      EXPECT_LT(errors.relative_rmse, 1e-7);
      EXPECT_LT(errors.maximum, 1e-7);
    }
  }
}

TEST(Verify, AFactorIsFoundAsItsExcess) {
  const Map source = sun("latlong", 64, 32);
  Map level = exact_level(source, kLobe, "cube", 8);
  for (const prefilter::Texel& t : prefilter::random_texels(level, 1000, 1)) multiply(level, t, 1.03125f);
  const ReferenceErrors errors = errors_of(source, level, kLobe);
  EXPECT_NEAR(errors.relative_rmse, 0.03125, 1e-6);
  EXPECT_NEAR(errors.maximum, 0.03125, 1e-6);
}

/// One wrong texel out of 6·16² near the light, too bright or too dark: random texels would miss it.
TEST(Verify, AWrongTexelInTheLightIsFound) {
  const Map source = sun("latlong", 64, 32);
  Map level = exact_level(source, kLobe, "cube", 16);
  const Vec3d light = prefilter::brightest_lights(source, 1).front();
  VerifyOptions options;
  options.random_texels = 4;
  options.most_hot = 1;
  const std::vector<prefilter::Texel> random = prefilter::random_texels(level, 4, options.seed);
  std::vector<prefilter::Texel> wrong;
  for (const prefilter::Texel& t : prefilter::random_texels(level, 10000, 1)) {
    if (dot(prefilter::direction_of(level, t), light) > std::cos(0.04)) wrong.push_back(t);
  }
  ASSERT_EQ(wrong.size(), 1u);
  ASSERT_EQ(std::count(random.begin(), random.end(), wrong.front()), 0);
  float* const texel = level.level.chart(wrong.front().chart).at(wrong.front().x, wrong.front().y);
  const float right[3] = {texel[0], texel[1], texel[2]};
  for (const float factor : {1.5f, 0.5f, 0.0f}) {
    std::copy_n(right, 3, texel);
    multiply(level, wrong.front(), factor);
    const ReferenceErrors errors = errors_of(source, level, kLobe, options);
    EXPECT_NEAR(errors.maximum, std::fabs(factor - 1), 1e-6);
    EXPECT_LT(errors.relative_rmse, 1e-7);
    EXPECT_NEAR(dot(errors.maximum_direction, prefilter::direction_of(level, wrong.front())), 1, 1e-12);
  }
}

TEST(Verify, NanIsNotASmallError) {
  const Map source = sun("latlong", 32, 16);
  Map level = exact_level(source, kLobe, "cube", 1);
  level.level.chart(3).at(0, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  const ReferenceErrors errors = errors_of(source, level, kLobe);
  EXPECT_FALSE(errors.relative_rmse < 1);
  EXPECT_FALSE(errors.maximum < 1);
}

TEST(Verify, BlackMapsAreExactAndKeepTheirEnergy) {
  Map source(AnyParameterization::make("latlong"), 32, 16, 3);
  fill_borders(source);
  Map level(AnyParameterization::make("cube"), 4, 4, 3);
  LevelVerification v = verify(source, level, kLobe);
  EXPECT_EQ(v.reference.relative_rmse, 0);
  EXPECT_EQ(v.reference.maximum, 0);
  EXPECT_EQ(v.energy, 1.0);
  level.level.chart(0).at(0, 0)[0] = 1e-20f;
  v = verify(source, level, kLobe);
  EXPECT_TRUE(std::isinf(v.reference.maximum));
}

/// Alpha is 1 everywhere, and would hide what is wrong with dim radiance.
TEST(Verify, AlphaIsNotCountedAmongColours) {
  Map source(AnyParameterization::make("latlong"), 32, 16, 4);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      float* texel = source.level.chart(0).at(x, y);
      texel[0] = texel[1] = texel[2] = 1e-3f;
      texel[3] = 1;
    }
  }
  fill_borders(source);
  Map level = exact_level(source, kLobe, "cube", 2);
  for (int chart = 0; chart < 6; ++chart) {
    for (int i = 0; i < 4; ++i) level.level.chart(chart).at(i % 2, i / 2)[0] = 0;
  }
  EXPECT_NEAR(errors_of(source, level, kLobe).relative_rmse, std::sqrt(1.0 / 3), 1e-6);
}

TEST(Verify, IntegralsAreComparedWithIntegrals) {
  const Map source = sun("latlong", 64, 32);
  const AnyLobe lambert = AnyLobe::make("lambert");
  Map level = exact_level(source, lambert, "cube", 4);
  for (const prefilter::Texel& t : prefilter::random_texels(level, 1000, 1))
    multiply(level, t, static_cast<float>(kPi));
  VerifyOptions options;
  options.prefilter.scale = LobeScale::integral;
  EXPECT_LT(errors_of(source, level, lambert, options).maximum, 2e-7);
}

const AnyLobe kMirror = AnyLobe::make("ggx,roughness=0");

TEST(Verify, MirrorsAreComparedWithTheSourceResampled) {
  const Matrix3 turned = rotation_from_yaw_pitch_roll(50, 20, -70);
  for (const Map& source : {sun("latlong", 128, 64), sun("cube", 32, 32, turned)}) {
    for (const char* target : {"cube", "octahedral", "latlong"}) {
      for (const int width : {8, 32, 64}) {
        PrefilterOptions options;
        options.orientation = turned;
        const auto p = AnyParameterization::make(target);
        const PrefilterLevel level{{width, static_cast<int>(width / p.aspect())}, kMirror};
        VerifyOptions how;
        how.prefilter = options;
        std::vector<Map> levels = prefilter_map(source, p, {level}, options);
        const LevelVerification v = verify_prefilter(source, levels, {&level, 1}, how).front();
        EXPECT_GT(v.reference.random_texels, 20);
        EXPECT_GT(v.reference.hot_texels, 0);
        EXPECT_LT(v.reference.relative_rmse, 8e-3) << target << width;
        EXPECT_NEAR(*v.energy, 1, 1e-3) << target << width;
        EXPECT_LT(*v.furnace, 1e-5) << target << width;
        // An error is seen as what it is.
        for (int chart = 0; chart < levels[0].charts(); ++chart) {
          for (int y = 0; y < levels[0].height(); ++y) {
            for (int i = 0; i < levels[0].width() * 3; ++i) levels[0].level.chart(chart).row(y)[i] *= 1.1f;
          }
        }
        const LevelVerification wrong = verify_prefilter(source, levels, {&level, 1}, how).front();
        EXPECT_NEAR(wrong.reference.relative_rmse, 0.1, 7e-3) << target << width;
        EXPECT_NEAR(*wrong.energy, 1.1, 2e-3) << target << width;
      }
    }
  }
}

TEST(Verify, MirrorsOfOtherFiltersAreComparedWithTheseFilters) {
  const Map source = sun("latlong", 128, 64);
  const PrefilterLevel level{{24, 24}, kMirror};
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
    PrefilterOptions options;
    options.mirror_filter = filter;
    VerifyOptions how;
    how.prefilter = options;
    const std::vector<Map> levels =
        prefilter_map(source, AnyParameterization::make("cube"), {level}, options);
    // Positions of floats.
    EXPECT_LT(verify_prefilter(source, levels, {&level, 1}, how).front().reference.relative_rmse, 1e-4)
        << name_of(filter);
    how.prefilter.mirror_filter = Filter::automatic;
    EXPECT_GT(verify_prefilter(source, levels, {&level, 1}, how).front().reference.relative_rmse, 1e-3)
        << name_of(filter);
  }
}

TEST(Verify, AMirrorOfTheSourcesOwnShapeIsTheSource) {
  const Map source = sun("latlong", 64, 32);
  const std::vector<Map> levels = prefilter_map(source, source.parameterization, {{{64, 32}, kMirror}});
  const LevelVerification v = verify(source, levels.front(), kMirror);
  // The points' mean of a texel's quadratic: 1/(12·32²) of its curvature.
  EXPECT_LT(v.reference.relative_rmse, 1e-3);
  // Solid angles by four points and exactly: 1e-5.
  EXPECT_NEAR(*v.energy, 1, 1e-5);
  EXPECT_LT(*v.furnace, 1e-6);
}

TEST(Verify, NumbersDependOnTheSeedAloneNotOnThreads) {
  const Map source = sun("cube", 16, 16);
  const std::vector<Map> levels =
      prefilter_map(source, AnyParameterization::make("octahedral"), {{{32, 32}, kLobe}});
  const LevelVerification many = verify(source, levels.front(), kLobe);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LevelVerification single = verify(source, levels.front(), kLobe);
  EXPECT_EQ(many.reference.relative_rmse, single.reference.relative_rmse);
  EXPECT_EQ(many.reference.maximum, single.reference.maximum);
  EXPECT_EQ(many.energy, single.energy);
  EXPECT_EQ(many.furnace, single.furnace);
}

TEST(Verify, HugeSourcesAreRefusedBeforeMemoryIsTaken) {
  EXPECT_THROW(check_verifiable({AnyParameterization::make("latlong"), {16384, 8192}, 3}), Error);
  EXPECT_NO_THROW(check_verifiable({AnyParameterization::make("latlong"), {8192, 4096}, 3}));
}

TEST(Verify, IsCancelled) {
  const Map source = sun("latlong", 64, 32);
  const Map level = exact_level(source, kLobe, "cube", 2);
  VerifyOptions options;
  options.monitor.cancelled = [] { return true; };
  EXPECT_THROW(errors_of(source, level, kLobe, options), Cancelled);
}

TEST(Verify, ProgressRisesToOne) {
  const Map source = sun("fisheye-equidistant", 32, 32);
  const std::vector<PrefilterLevel> levels{{{4, 4}, kLobe}, {{2, 2}, AnyLobe::make("lambert")}};
  const std::vector<Map> maps = prefilter_map(source, AnyParameterization::make("cube"), levels);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  double last = 0;
  VerifyOptions options;
  options.monitor.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  verify_prefilter(source, maps, levels, options);
  EXPECT_NEAR(last, 1, 1e-12);
}

// ---- energy and furnace

/// Waldvogel 2006: exact below the number of points.
TEST(VerifyEnergy, FejersRuleIsExactForPolynomials) {
  for (const int rows : {1, 2, 7, 192}) {
    const std::vector<double> weights = prefilter::fejer_weights(rows);
    for (int degree = 0; degree < std::min(rows, 40); ++degree) {
      double sum = 0;
      for (int j = 0; j < rows; ++j) {
        sum += weights[static_cast<std::size_t>(j)] * std::pow(std::cos((j + 0.5) * kPi / rows), degree);
      }
      EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0, 1e-14) << rows << ' ' << degree;
    }
  }
}

/// The grid integrates the lobe about any axis of the world, and so any sum of them. verify_energy.h states
/// 2e-5.
TEST(VerifyEnergy, TheGridResolvesEveryLobeItTakes) {
  const std::vector<Vec3d> axes{{0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0.3, 0.8, -0.5}, {0.001, -1, 0}};
  const Matrix3 orientation = prefilter::energy_grid_orientation();
  int taken = 0;
  for (const AnyLobe& lobe : lobe::cases::all_lobes()) {
    const std::optional<int> rows = prefilter::energy_rows(lobe);
    if (!rows) continue;
    ++taken;
    const std::vector<double> weights = prefilter::fejer_weights(*rows);
    for (const Vec3d& each : axes) {
      const Vec3d axis = orientation * normalize(each);
      double sum = 0;
      for (int j = 0; j < *rows; ++j) {
        const double theta = (j + 0.5) * kPi / *rows;
        for (int i = 0; i < 2 * *rows; ++i) {
          const double phi = (i + 0.5) * kPi / *rows;
          const Vec3d d =
              Vec3d{std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)} - axis;
          sum += weights[static_cast<std::size_t>(j)] * kPi / *rows * lobe.weight(dot(d, d) / 2);
        }
      }
      EXPECT_NEAR(sum / lobe.integral(), 1, 2e-5) << lobe.spec() << ' ' << each.x;
    }
  }
  EXPECT_GT(taken, 10);
}

/// Narrow lobes at the source's own texels, by the reference: texels of 7°, for which verify_energy.h states
/// 5e-4.
TEST(VerifyEnergy, TheSourcesTexelsAddUpForNarrowLobes) {
  for (const char* spec : {"ggx,roughness=0.125"}) {
    const AnyLobe lobe = AnyLobe::make(spec);
    for (const Map& source : {sun("latlong", 36, 18), sun("cube", 9, 9)}) {
      const Map level = exact_level(source, lobe, source.parameterization.name(), source.width());
      EXPECT_NEAR(prefilter::integral_of_texels(level)[0] / PrefilterReference(source).integral()[0], 1, 2e-3)
          << spec << ' ' << source.parameterization.name();
    }
  }
}

/// A light at the very pole, and a lobe that a lat-long's rows resolve, but the grid for wider ones doesn't.
TEST(VerifyEnergy, LightAtAPoleIsAddedUp) {
  const AnyLobe lobe = AnyLobe::make("ggx,roughness=0.125");
  ASSERT_FALSE(prefilter::energy_rows(lobe));
  Map source(AnyParameterization::make("latlong"), 1024, 512, 1);
  for (int x = 0; x < source.width(); ++x) *source.level.chart(0).at(x, 0) = 1e5f;
  fill_borders(source);
  const auto integrals = prefilter::integrals_of_levels(source, {{lobe}}, {});
  EXPECT_NEAR(integrals.at(0).value()[0] / prefilter::integral_of_texels(source)[0], 1, 2e-5);
}

/// The plan's own bounds for tiny maps: energy 1e-4, furnace 2e-5, 2e-4 where a rim ends the map.
TEST(VerifyEnergy, PlansKeepEnergyAndConstants) {
  for (const Map& source : {sun("latlong", 64, 32), sun("latlong", 37, 19), sun("cube", 33, 33),
                            sun("fisheye-equidistant", 48, 48)}) {
    const std::vector<PrefilterLevel> levels{{{9, 9}, AnyLobe::make("ggx,roughness=0.25")},
                                             {{1, 1}, AnyLobe::make("lambert")},
                                             {{4, 4}, AnyLobe::make("phong,exponent=20")},
                                             {{8, 8}, AnyLobe::make("ggx,roughness=0.02")}};
    const std::vector<Map> maps = prefilter_map(source, AnyParameterization::make("cube"), levels);
    const auto results = verify_prefilter(source, maps, levels);
    for (const LevelVerification& v : results) {
      EXPECT_NEAR(*v.energy, 1, 1e-4) << source.parameterization.name();
      EXPECT_LT(*v.furnace, source.parameterization.full_charts() ? 2e-5 : 2e-4)
          << source.parameterization.name();
      EXPECT_LT(v.reference.relative_rmse, 1e-3) << source.parameterization.name();
    }
  }
}

}  // namespace
}  // namespace welkin
