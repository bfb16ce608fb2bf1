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

const Source kSources[] = {{"latlong", 64, 32, 3},     {"latlong", 63, 31, 1},
                           {"latlong", 30, 40, 2},     {"latlong", 10, 128, 1},
                           {"latlong", 4, 2, 1},       {"latlong", 2, 1, 1},
                           {"latlong", 1, 1, 1},       {"latlong", 3, 1, 1},
                           {"cube", 16, 16, 3},        {"cube", 33, 33, 1},
                           {"cube", 1, 1, 4},          {"octahedral", 32, 32, 7},
                           {"octahedral", 31, 31, 1},  {"fisheye-equidistant", 32, 32, 3},
                           {"mirror-ball", 48, 48, 1}, {"paraboloid", 24, 24, 2},
                           {"healpix", 16, 16, 1},     {"openexr-latlong", 32, 16, 1},
                           {"equal-area", 40, 20, 1},  {"half-cube", 16, 16, 1}};

struct Target {
  std::string parameterization;
  int width, height;
};

const Target kTargets[] = {{"cube", 8, 8}, {"latlong", 16, 8}, {"octahedral", 15, 15}, {"paraboloid", 9, 9}};

/// Half the tolerance in the mean square is what the plan aims at; few texels are compared here, so all of it
/// is allowed. The largest error, where a level is dark beside a lamp, is relative to a hundredth of the
/// level's mean at least.
TEST(Prefilter, LevelsAreBruteForcesWithinTheTolerance) {
  int which = 0;
  for (const Source& s : kSources) {
    const Map source = landscape(s.parameterization, s.width, s.height, s.channels);
    const PrefilterReference reference(source);
    const Target& target = kTargets[which++ % 4];
    std::vector<PrefilterLevel> levels;
    for (const AnyLobe& lobe : lobes()) levels.push_back({{target.width, target.height}, lobe});
    const PrefilterPlan plan(shape_of(source), AnyParameterization::make(target.parameterization), levels);
    const std::vector<Map> results = plan.run(source);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const PrefilterMethod& method = plan.methods()[i];
      const Errors errors = errors_of(results[i], reference, method.lobe, 19);
      EXPECT_LT(errors.relative_rmse, 1.5e-3)
          << s.parameterization << ' ' << s.width << ' ' << levels[i].lobe.spec() << " by " << method.name
          << ' ' << method.degree;
      EXPECT_LT(errors.maximum, 2e-2) << s.parameterization << ' ' << s.width << ' ' << levels[i].lobe.spec();
    }
  }
}

}  // namespace
}  // namespace welkin
