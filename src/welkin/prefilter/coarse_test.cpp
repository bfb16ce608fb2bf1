#include "welkin/prefilter/coarse.h"

#include <gtest/gtest.h>

#include "welkin/prefilter/plan.h"
#include "welkin/prefilter/prefilter_cases.h"

namespace welkin::prefilter {
namespace {

using namespace prefilter_cases;

struct Planned {
  explicit Planned(const Map& source, const std::vector<std::string>& lobes,
                   const std::string& target = "latlong", ChartSize size = {24, 12})
      : tables{shape_of(source), AnyParameterization::make(target), {}, {}} {
    std::vector<WidenedLobe> widened;
    int degree = 0;
    for (const std::string& lobe : lobes) {
      tables.levels.push_back({size, AnyLobe::make(lobe)});
      widened.push_back(widen(tables.levels.back().lobe, 0.01, tables.options.tolerance / 5));
      degree = std::max(degree, widened.back().degree());
    }
    tables.analysis.emplace(shape_of(source), degree);
    std::vector<const WidenedLobe*> pointers;
    for (std::size_t i = 0; i < widened.size(); ++i) {
      tables.harmonic.emplace_back(widened[i], widened[i].zonal, static_cast<int>(i),
                                   tables.analysis->points.width);
      pointers.push_back(&widened[i]);
    }
    tables.coarse = CoarsePlan::make(tables.source, tables.harmonic, pointers, tables.options.tolerance);
  }
  PrefilterPlan::Tables tables;
};

std::optional<HarmonicResults> run(const Planned& planned, const Map& source) {
  bool negative = true;
  auto results = run_coarse(planned.tables, source, negative, {});
  EXPECT_FALSE(results && negative);
  return results;
}

/// Lamps of one to four texels, so many times as bright as the landscape's mean.
Map with_lamps(int width, float times, int channels = 3) {
  Map map = landscape("latlong", width, width / 2, channels);
  for (int i = 0; i < 9; ++i) {
    const int x = (97 * i + 5) * width / 1024 % width, y = (50 * i + 20) * width / 1024;
    for (int c = 0; c < channels; ++c) {
      for (int k = 0; k <= i % 4; ++k)
        map.level.chart(0).at((x + k) % width, y)[c] = times * static_cast<float>(c + 1);
    }
  }
  fill_borders(map);
  return map;
}

/// The tolerance, as for every level, and 0.5 % in the worst texel.
TEST(CoarsePlan, AgreesWithBruteForce) {
  for (const float times : {1.0f, 1e3f, 3e4f}) {
    const Map source = with_lamps(512, times);
    const Planned planned(source, {"lambert", "phong,exponent=2", "ggx,roughness=0.9"});
    ASSERT_TRUE(planned.tables.coarse);
    const std::optional<HarmonicResults> results = run(planned, source);
    ASSERT_TRUE(results) << times;
    const PrefilterReference reference(source);
    for (std::size_t i = 0; i < results->levels.size(); ++i) {
      const Errors errors = errors_of(results->levels[i], reference, planned.tables.levels[i].lobe, 7);
      EXPECT_LT(errors.relative_rmse, 2e-4) << i << " × " << times;
      EXPECT_LT(errors.maximum, 2e-3) << i << " × " << times;
    }
  }
}

/// Taking a bright texel from the points leaves what a map without it has.
TEST(CoarsePlan, BrightTexelsAreTakenOutOfThePoints) {
  Map source = filled("latlong", 512, 256, 1.0f, 2);
  for (const auto& [x, y] : {std::pair(0, 0), {511, 1}, {64, 255}, {30, 32}, {1, 2}}) {
    source.level.chart(0).at(x, y)[0] = 3e3f;
  }
  fill_borders(source);
  const Planned planned(source, {"lambert"});
  ASSERT_TRUE(planned.tables.coarse);
  const std::optional<HarmonicResults> results = run(planned, source);
  ASSERT_TRUE(results);
  const PrefilterReference reference(source);
  EXPECT_LT(errors_of(results->levels[0], reference, planned.tables.levels[0].lobe, 3).maximum, 1e-3);
}

/// A contrast that few degrees can't hold is left to many; what can't be filtered too.
TEST(CoarsePlan, RefusesWhatItCannotBound) {
  Map source = filled("latlong", 512, 256, 0.0f);
  for (int y = 40; y < 120; ++y) {
    for (int x = 20; x < 120; ++x) source.level.chart(0).at(x, y)[0] = 1;
  }
  fill_borders(source);
  const Planned planned(source, {"lambert"});
  ASSERT_TRUE(planned.tables.coarse);
  EXPECT_FALSE(run(planned, source));
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e31f}) {
    Map faulty = landscape("latlong", 512, 256);
    faulty.level.chart(0).at(3, 40)[0] = bad;
    EXPECT_FALSE(run(planned, faulty)) << bad;
  }
  Map black = filled("latlong", 512, 256, 0.0f);
  EXPECT_TRUE(run(planned, black));
}

/// Only where it is faster.
TEST(CoarsePlan, IsForWideLobesOfFineLatLongs) {
  EXPECT_FALSE(Planned(landscape("latlong", 512, 256), {"ggx,roughness=0.25"}).tables.coarse);
  EXPECT_FALSE(Planned(landscape("latlong", 512, 256), {"lambert", "ggx,roughness=0.25"}).tables.coarse);
  EXPECT_FALSE(Planned(landscape("cube", 64, 64), {"lambert"}).tables.coarse);
  EXPECT_FALSE(Planned(landscape("latlong", 64, 32), {"lambert"}).tables.coarse);
  EXPECT_FALSE(Planned(landscape("latlong", 512, 256, 5), {"lambert"}).tables.coarse);
  EXPECT_TRUE(Planned(landscape("latlong", 512, 256, 4), {"lambert"}).tables.coarse);
}

}  // namespace
}  // namespace welkin::prefilter
