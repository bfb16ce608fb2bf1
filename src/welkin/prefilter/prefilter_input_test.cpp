#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <limits>
#include <thread>

#include "welkin/base/error.h"
#include "welkin/prefilter/prefilter_cases.h"

/// What plans refuse, how they can be shared, and how they stop.
namespace welkin {
namespace {

using namespace prefilter_cases;

const ChartSize kSize{8, 8};

std::vector<PrefilterLevel> some_levels() {
  return {{{16, 16}, AnyLobe::make("ggx,roughness=0")},
          {{12, 12}, AnyLobe::make("ggx,roughness=0.05")},
          {kSize, AnyLobe::make("ggx,roughness=0.5")},
          {{1, 1}, AnyLobe::make("lambert")}};
}

PrefilterPlan plan_for(const Map& source, const PrefilterOptions& options = {}) {
  return PrefilterPlan(shape_of(source), AnyParameterization::make("cube"), some_levels(), options);
}

std::vector<float> values_of(const std::vector<Map>& levels) {
  std::vector<float> all;
  for (const Map& level : levels)
    for_each_value(level, [&](double value) { all.push_back(static_cast<float>(value)); });
  return all;
}

template <class Body>
std::string message_of(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(PrefilterInput, RefusesValuesThatCannotBeSummed) {
  for (const char* shape : {"latlong", "cube"}) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), 2e38f}) {
      Map source = landscape(shape, 8, 8, 3);
      source.level.chart(source.charts() - 1).at(7, 7)[2] = bad;
      EXPECT_NE(message_of([&] { plan_for(source).run(source); }).find("NaN"), std::string::npos) << bad;
      for (const char* lobe : {"ggx,roughness=0", "lambert"}) {
        EXPECT_NE(message_of([&] { prefiltered(source, "cube", kSize, lobe); }).find("NaN"),
                  std::string::npos)
            << lobe << ' ' << bad;
      }
    }
    Map source = landscape(shape, 8, 8, 3);
    source.level.chart(0).at(3, 3)[1] = 1e30f;
    source.level.chart(0).at(5, 3)[1] = std::numeric_limits<float>::denorm_min();
    fill_borders(source);
    // Within a mirror's texel, as far as its limiter lets it (filter/reconstruction.h).
    for (const float value : values_of(plan_for(source).run(source))) {
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1.5e30f);
    }
  }
}

/// The corners of a disc are not valid; what a file has there is ignored.
TEST(PrefilterInput, TheUnusedCornersOfADiscMayHoldAnything) {
  const Map clean = landscape("fisheye-equidistant", 24, 24);
  Map dirty = landscape("fisheye-equidistant", 24, 24);
  for (const int x : {0, 1, 22, 23}) *dirty.level.chart(0).at(x, x) = std::numeric_limits<float>::quiet_NaN();
  fill_borders(dirty);
  EXPECT_EQ(values_of(plan_for(clean).run(clean)), values_of(plan_for(clean).run(dirty)));
}

TEST(PrefilterInput, RefusesPlansThatMakeNoSense) {
  const auto latlong = AnyParameterization::make("latlong");
  const std::vector<PrefilterLevel> levels{{kSize, AnyLobe::make("ggx")}};
  const auto plan = [&](ChartSize source, int channels, ChartSize level, double tolerance) {
    PrefilterOptions options;
    options.tolerance = tolerance;
    return message_of([&] {
      PrefilterPlan({latlong, source, channels}, latlong, {{level, AnyLobe::make("ggx")}}, options);
    });
  };
  EXPECT_EQ(plan({16, 8}, 3, {4, 2}, 1e-3), "nothing thrown");
  for (const ChartSize bad : {ChartSize{0, 8}, {16, 0}, {-4, 8}}) {
    EXPECT_NE(plan(bad, 3, {4, 2}, 1e-3).find("source"), std::string::npos);
    EXPECT_NE(plan({16, 8}, 3, bad, 1e-3).find("level"), std::string::npos);
  }
  EXPECT_NE(plan({16, 8}, 0, {4, 2}, 1e-3).find("source"), std::string::npos);
  for (const double bad : {0.0, -1.0, 1e-7, 0.2, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(plan({16, 8}, 3, {4, 2}, bad).find("tolerance"), std::string::npos) << bad;
}

TEST(PrefilterInput, RefusesMapsOfAnotherShape) {
  const Map source = landscape("latlong", 16, 8);
  const PrefilterPlan plan = plan_for(source);
  for (const Map& other : {landscape("latlong", 16, 9), landscape("latlong", 18, 8),
                           landscape("latlong", 16, 8, 3), landscape("equal-area", 16, 8)}) {
    EXPECT_NE(message_of([&] { plan.run(other); }).find("another shape"), std::string::npos);
  }
}

TEST(PrefilterPlan, KeepsNothingOfItsMaps) {
  for (const char* shape : {"latlong", "cube"}) {
    const Map a = landscape(shape, 16, 16, 2), b = landscape(shape, 16, 16, 2, 77);
    const PrefilterPlan plan = plan_for(a);
    const std::vector<float> first = values_of(plan.run(a)), second = values_of(plan.run(b));
    EXPECT_NE(first, second);
    EXPECT_EQ(second, values_of(plan_for(b).run(b)));
    EXPECT_EQ(first, values_of(plan.run(a)));
  }
}

/// Bit for bit, whoever runs it, and on however many threads.
TEST(PrefilterPlan, GivesTheSameNumbersFromManyThreads) {
  for (const char* shape : {"latlong", "cube"}) {
    const Map source = landscape(shape, 16, 16, 4);
    const PrefilterPlan plan = plan_for(source);
    std::vector<float> expected;
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      expected = values_of(plan.run(source));
    }
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    std::vector<std::vector<float>> results(4);
    std::vector<std::thread> threads;
    for (std::vector<float>& each : results)
      threads.emplace_back([&] { each = values_of(plan.run(source)); });
    for (std::thread& each : threads) each.join();
    for (const std::vector<float>& each : results) EXPECT_EQ(each, expected);
  }
}

/// Cancelling is checked after every piece of work: whenever it is requested, work ends soon.
TEST(PrefilterPlan, StopsWheneverItIsAsked) {
  const Map source = landscape("cube", 12, 12, 1);
  const PrefilterPlan plan = plan_for(source);
  std::atomic<int> asked{0};
  Monitor counting;
  counting.cancelled = [&] {
    ++asked;
    return false;
  };
  plan.run(source, counting);
  const int all = asked;
  EXPECT_GT(all, 100);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (int part = 0; part < 10; ++part) {
    asked = 0;
    const int limit = all * part / 10;
    Monitor monitor;
    monitor.cancelled = [&] { return ++asked > limit; };
    EXPECT_THROW(plan.run(source, monitor), Cancelled) << part;
    EXPECT_LE(asked, limit + 2);
  }
}

/// Tolerances are reached, by the measure that the options name.
TEST(PrefilterPlan, TolerancesAreReached) {
  const Map source = landscape("latlong", 64, 32);
  const PrefilterReference reference(source);
  int before = 0;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    PrefilterOptions options;
    options.tolerance = tolerance;
    const std::vector<PrefilterLevel> levels{{kSize, AnyLobe::make("ggx,roughness=0.5")},
                                             {kSize, AnyLobe::make("phong,exponent=20")},
                                             {kSize, AnyLobe::make("vmf,kappa=10")}};
    const PrefilterPlan plan(shape_of(source), AnyParameterization::make("cube"), levels, options);
    const std::vector<Map> results = plan.run(source);
    for (std::size_t i = 0; i < levels.size(); ++i)
      EXPECT_LT(errors_of(results[i], reference, plan.methods()[i].lobe, 3).relative_rmse, tolerance)
          << levels[i].lobe.spec();
    EXPECT_GT(plan.methods()[0].degree, before);
    before = plan.methods()[0].degree;
  }
}

}  // namespace
}  // namespace welkin
