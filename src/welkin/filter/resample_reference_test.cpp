/// resample() against resample_reference(), which is float64 and knows no pyramid, no tiles and no packs.

#include "welkin/filter/resample_reference.h"
#include "welkin/filter/resample_cases.h"

#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

constexpr Filter kPointFilters[] = {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos};

class ResampleReferenceTest : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ResampleReferenceTest, ::testing::ValuesIn(names_and_windows()), test_name);

/// Texels that differ by more than `tolerance`; NaN does.
int count_different(const Map& a, const Map& b, double tolerance) {
  int count = 0;
  for (int chart = 0; chart < a.charts(); ++chart) {
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        const double p = static_cast<double>(*a.level.chart(chart).at(x, y));
        const double q = static_cast<double>(*b.level.chart(chart).at(x, y));
        count += std::fabs(p - q) <= tolerance ? 0 : 1;
      }
    }
  }
  return count;
}

/// Positions are float: within 1e-6 of a chart, so where texels are a hundredth of the waves the values agree
/// to 2e-4. Two positions may fall on different sides of a texel's edge (nearest) or of a rim.
TEST_P(ResampleReferenceTest, PointFiltersAgreeFromEverywhereAndToEverywhere) {
  const Map source = rendered(GetParam(), 48, waves(12, 6));
  for (const std::string& name : sphere::parameterization_names()) {
    Map fast = make_map(name, 21), exact = make_map(name, 21);
    for (const Filter filter : kPointFilters) {
      for (const bool ringing : {false, true}) {
        ResampleOptions options = with(filter);
        options.rotation = rotation_from_yaw_pitch_roll(31, 17, -8);
        options.allow_ringing = ringing;
        options.fill = {3};
        resample(source, fast, options);
        resample_reference(source, exact, options, 1);
        EXPECT_LE(count_different(fast, exact, 2e-4), filter == Filter::nearest ? 3 : 1)
            << name << " " << name_of(filter);
      }
    }
  }
}

TEST(ResampleReferenceTest, PointFiltersAgreeUpTo4096Texels) {
  Map source(sphere::AnyParameterization::make("latlong"), 4096, 2048, 1);
  // Waves of 50 texels, cheap to make: products of a function of the row and of the column.
  for (int y = 0; y < source.height(); ++y) {
    const double side = std::sin(kPi * (y + 0.5) / source.height());
    float* row = source.level.chart(0).row(y);
    for (int x = 0; x < source.width(); ++x) {
      row[x] = static_cast<float>(0.5 + 0.5 * side * std::sin(2 * kPi * 80 * (x + 0.5) / source.width()));
    }
  }
  fill_borders(source);
  Map fast = make_map("cube", 101), exact = make_map("cube", 101);
  for (const Filter filter : {Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
    resample(source, fast, with(filter));
    resample_reference(source, exact, with(filter), 1);
    // A texel's position may be off by 4096e-6; the slope is π/50 of half the range per texel.
    EXPECT_EQ(count_different(fast, exact, 3e-4), 0) << name_of(filter);
  }
}

struct AreaCase {
  const char* source;
  int source_size;
  const char* target;
  int target_size;
};

/// Minified eightfold, against 40×40 points per texel, unrotated, and rotated so that poles, edges and folds
/// lie at no symmetric position. Range 0…1.
TEST(ResampleReferenceTest, AreaMeansAreExactToFortyFiveDecibels) {
  const AreaCase each_case[] = {{"latlong", 362, "cube", 16},
                                {"cube", 160, "latlong", 56},
                                {"octahedral", 320, "cube", 16},
                                {"cube", 160, "octahedral", 34}};
  const std::pair<const char*, Function> functions[] = {
      {"zone plate", zone_plate(12)}, {"checker", checker(7)}, {"lines", lines(24)}};
  for (const AreaCase& each : each_case) {
    for (const auto& [name, function] : functions) {
      const Map source = rendered(each.source, each.source_size, function);
      Map fast = make_map(each.target, each.target_size), exact = make_map(each.target, each.target_size);
      ResampleOptions options;
      for (const bool turned : {false, true}) {
        if (turned) options.rotation = rotation_from_yaw_pitch_roll(40, 25, 15);
        resample(source, fast, options);
        resample_reference(source, exact, options, 40);
        const std::string what =
            std::string(name) + ", " + each.source + " to " + each.target + (turned ? ", turned" : "");
        EXPECT_GT(psnr(fast, exact), 45) << what;
      }
    }
  }
}

/// The same where it is not minified: what is within texels is reconstructed, and points of it are few.
TEST(ResampleReferenceTest, ReconstructionsAreExactToFortyDecibels) {
  const AreaCase each_case[] = {{"latlong", 60, "cube", 31},
                                {"cube", 24, "latlong", 56},
                                {"octahedral", 50, "cube", 14},
                                {"cube", 30, "octahedral", 90}};
  for (const AreaCase& each : each_case) {
    const Map source = rendered(each.source, each.source_size, zone_plate(6));
    Map fast = make_map(each.target, each.target_size), exact = make_map(each.target, each.target_size);
    for (const bool ringing : {false, true}) {
      ResampleOptions options = with(Filter::automatic);
      options.allow_ringing = ringing;
      options.rotation = rotation_from_yaw_pitch_roll(40, 25, 15);
      resample(source, fast, options);
      resample_reference(source, exact, options, 16);
      EXPECT_GT(psnr(fast, exact), 40) << each.source << " to " << each.target;
    }
  }
}

/// The same where it is magnified, and each texel of the source is divided into parts.
TEST(ResampleReferenceTest, PartsOfTexelsAreExactToFortyDecibels) {
  const AreaCase each_case[] = {{"latlong", 16, "cube", 26},
                                {"latlong", 12, "cube", 40},
                                {"cube", 5, "latlong", 96},
                                {"octahedral", 10, "cube", 44}};
  for (const AreaCase& each : each_case) {
    const Map source = rendered(each.source, each.source_size, checker(3));
    Map fast = make_map(each.target, each.target_size), exact = make_map(each.target, each.target_size);
    ResampleOptions options = with(Filter::automatic);
    options.rotation = rotation_from_yaw_pitch_roll(40, 25, 15);
    resample(source, fast, options);
    resample_reference(source, exact, options, 6);
    EXPECT_GT(psnr(fast, exact), 40) << each.source << " to " << each.target;
  }
}

/// The reference itself: more points change it little, and its mean over one texel that is the world is the
/// world's.
TEST(ResampleReferenceTest, ConvergesToTheMeanOverTheSphere) {
  const Map source = rendered("latlong", 24, smooth);
  Map target = make_map("latlong", 1);
  ASSERT_EQ(target.width() * target.height(), 1);
  resample_reference(source, target, {}, 200);
  EXPECT_NEAR(*target.level.chart(0).at(0, 0), mean_over_sphere(source), 1e-4);
}

}  // namespace
}  // namespace welkin
