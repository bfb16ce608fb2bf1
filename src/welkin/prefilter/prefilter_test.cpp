#include "welkin/prefilter/prefilter.h"

#include <gtest/gtest.h>

#include "welkin/prefilter/prefilter_cases.h"

/// Levels against brute force.
namespace welkin {
namespace {

using namespace prefilter_cases;

struct Source {
  std::string parameterization;
  int width, height, channels;
};

const std::vector<Source> kSources = {{"latlong", 64, 32, 3},    {"latlong", 63, 31, 1},
                                      {"latlong", 30, 40, 2},    {"latlong", 4, 2, 1},
                                      {"latlong", 2, 1, 1},      {"latlong", 1, 1, 1},
                                      {"latlong", 3, 1, 1},      {"cube", 16, 16, 3},
                                      {"cube", 33, 33, 1},       {"cube", 1, 1, 4},
                                      {"octahedral", 32, 32, 7}, {"octahedral", 31, 31, 1},

                                      {"healpix", 16, 16, 1},    {"openexr-latlong", 32, 16, 1},
                                      {"equal-area", 40, 20, 1}, {"half-cube", 16, 16, 1}};

struct Target {
  std::string parameterization;
  int width, height;
};

const Target kTargets[] = {{"cube", 8, 8}, {"latlong", 16, 8}, {"octahedral", 15, 15}, {"paraboloid", 9, 9}};

/// Lobes first, first + step… of lobes().
void compare(const Source& s, const Target& target, std::size_t first, std::size_t step) {
  const Map source = landscape(s.parameterization, s.width, s.height, s.channels);
  const PrefilterReference reference(source);
  std::vector<PrefilterLevel> levels;
  const std::vector<AnyLobe> all = lobes();
  for (std::size_t i = first; i < all.size(); i += step)
    levels.push_back({{target.width, target.height}, all[i]});
  const PrefilterPlan plan(shape_of(source), AnyParameterization::make(target.parameterization), levels);
  const std::vector<Map> results = plan.run(source);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const PrefilterMethod& method = plan.methods()[i];
    const Errors errors = errors_of(results[i], reference, method.lobe, 29);
    EXPECT_LT(errors.relative_rmse, 1.5e-3)
        << s.parameterization << ' ' << s.width << ' ' << levels[i].lobe.spec() << " by " << method.name
        << ' ' << method.degree;
    EXPECT_LT(errors.maximum, 2e-2) << s.parameterization << ' ' << s.width << ' ' << levels[i].lobe.spec();
  }
}

/// The default tolerance is 1e-3 in the mean square over the sphere. Few texels are compared here, so half
/// more is allowed. Every third lobe of each source.
TEST(Prefilter, LevelsAreBruteForcesWithinTheTolerance) {
  for (std::size_t which = 0; which < kSources.size(); which += kThin) {
    compare(kSources[which], kTargets[which % 4], which / 5 % 3, 3);
  }
}

/// Columns wider than the lobe, with lamps in them.
TEST(Prefilter, WideColumnsAreNoPoints) {
  compare({"latlong", 10, 128, 1}, kTargets[0], 1, 5);
  compare({"latlong", 10, 128, 1}, kTargets[3], 3, 5);
}

/// Texels at a rim are weighted by the part within it.
TEST(Prefilter, DiscsAreSummedUpToTheirRims) {
  std::size_t which = 0;
  for (const Source& s :
       {Source{"paraboloid", 24, 24, 2}, {"fisheye-equidistant", 32, 32, 3}, {"mirror-ball", 48, 48, 1}})
    compare(s, kTargets[which++], 0, 7);
}

/// A sun ten million times as bright as the rest, for directions that have it on their horizon: there its
/// contribution is small, and the rest is dark.
TEST(Prefilter, SunsMayStandOnTheHorizon) {
  Map source = filled("latlong", 1024, 512, 0.01f);
  for (const int y : {227, 228}) {
    for (const int x : {400, 401}) *source.level.chart(0).at(x, y) = 1e5f;
  }
  fill_borders(source);
  const Vec3d sun = source.parameterization.to_sphere(0, 401.0 / 1024, 228.0 / 512);
  const Map level = prefiltered(source, "latlong", {64, 32}, "lambert");
  std::vector<Vec3d> directions;
  std::vector<double> values;
  cases::for_each_valid_texel(level, [&](int chart, int x, int y) {
    const Vec3d d = cases::direction_at(level, chart, x, y);
    if (std::fabs(dot(d, sun)) > 0.02) return;
    directions.push_back(d);
    values.push_back(static_cast<double>(*level.level.chart(chart).at(x, y)));
  });
  ASSERT_GE(directions.size(), 10u);
  std::vector<double> expected(directions.size());
  PrefilterReference(source).evaluate(AnyLobe::make("lambert"), directions, expected);
  for (std::size_t i = 0; i < directions.size(); ++i) EXPECT_NEAR(values[i] / expected[i], 1, 0.03);
}

}  // namespace
}  // namespace welkin
