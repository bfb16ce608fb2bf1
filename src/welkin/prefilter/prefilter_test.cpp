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

TEST(Prefilter, Matrix) {
  int which = 0;
  for (const Source& s : kSources) {
    const Map source = landscape(s.parameterization, s.width, s.height, s.channels);
    const PrefilterReference reference(source);
    for (int k = 0; k < 4; ++k) {
      const Target& t = kTargets[k];
      std::vector<PrefilterLevel> levels;
      for (const AnyLobe& lobe : lobes()) levels.push_back({{t.width, t.height}, lobe});
      PrefilterOptions options;
      if (getenv("TOL")) options.tolerance = atof(getenv("TOL"));
      const PrefilterPlan plan(shape_of(source), AnyParameterization::make(t.parameterization), levels,
                               options);
      const std::vector<Map> results = plan.run(source);
      for (std::size_t i = 0; i < levels.size(); ++i) {
        const PrefilterMethod& method = plan.methods()[i];
        if (method.name != "harmonics") continue;
        const Errors errors = errors_of(results[i], reference, method.lobe, 7);
        printf("%s %dx%d -> %s %s deg %d grid %d w %g: rmse %.2g max %.2g%s\n", s.parameterization.c_str(),
               s.width, s.height, t.parameterization.c_str(), levels[i].lobe.spec().c_str(), method.degree,
               method.grid.width, method.widened, errors.relative_rmse, errors.maximum,
               errors.relative_rmse > 1e-3 ? " XX" : "");
      }
    }
  }
}

}  // namespace
}  // namespace welkin
