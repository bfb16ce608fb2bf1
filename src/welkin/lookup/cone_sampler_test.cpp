#include "welkin/lookup/cone_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/lookup/cone_reference.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/map/map_cases.h"
#include "welkin/math/angles.h"

namespace welkin::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool takes(const std::string& filter, const Map& map) {
  return is_usable(cone_filter_from_name(filter), map.parameterization);
}

ConeSamplerOptions options_of(const std::string& filter) {
  return {.filter = cone_filter_from_name(filter)};
}

/// Where things go wrong: poles, axes, edges and corners of cubes and octahedra, folds, the date line; and
/// anywhere.
std::vector<Vec3d> hard_directions() {
  std::vector<Vec3d> all;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        all.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        all.push_back({x + 1e-7, y - 2e-7, z + 3e-7});
        all.push_back({x + 0.01, y - 0.02, z + 0.03});
      }
    }
  }
  std::mt19937 random(7);
  std::normal_distribution<double> along;
  for (int i = 0; i < 40; ++i) all.push_back({along(random), along(random), along(random)});
  return all;
}

/// Cones of all widths about them, down to nothing and wider than the sphere.
std::vector<EllipticalCone> hard_cones() {
  std::mt19937 random(8);
  std::normal_distribution<float> along;
  std::vector<EllipticalCone> cones;
  const float widths[] = {0, 1e-5f, 0.01f, 0.05f, 0.2f, 0.7f, 2, 10, 1e30f};
  std::size_t k = 0;
  for (const Vec3d& d : hard_directions()) {
    for (int i = 0; i < 3; ++i) {
      const float narrow = widths[k++ % std::size(widths)];
      const float aspect = i == 0 ? 1.0f : i == 1 ? 5.0f : 40.0f;
      cones.push_back({{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)},
                       {along(random), along(random), along(random)},
                       std::min(narrow * aspect, 1e35f),
                       narrow});
    }
  }
  return cones;
}

class EveryFilter : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter, ::testing::ValuesIn(cone_filter_names()), cases::test_name);

TEST_P(EveryFilter, KeepsAConstantEverywhere) {
  const std::vector<EllipticalCone> cones = hard_cones();
  for (const std::string& spec : cases::names_and_windows()) {
    Map map = cases::rendered(
        spec, 24, [](const Vec3d&) { return 3.25; }, 2);
    map.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
    if (!takes(GetParam(), map)) {
      EXPECT_THROW(ConeSampler::borrow(map, options_of(GetParam())), Error) << spec;
      continue;
    }
    const ConeSampler sampler = ConeSampler::borrow(map, options_of(GetParam()));
    std::vector<float> radiance(2 * cones.size() + 1, -7);
    sampler.look_up(cones, radiance);
    EXPECT_EQ(radiance.back(), -7) << "past the results";
    const Sampler point = Sampler::borrow(map);
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const double want = point.covers(cones[i].direction) ? 3.25 : 0;
      ASSERT_NEAR(static_cast<double>(radiance[2 * i]), want, 1e-6 * 3.25)
          << spec << " cone " << i << " " << cones[i].wide << " " << cones[i].narrow;
      ASSERT_NEAR(static_cast<double>(radiance[2 * i + 1]), 2 * want, 2e-6 * 3.25) << spec << " cone " << i;
    }
  }
}

TEST_P(EveryFilter, KeepsWhatIsPositiveBetweenTheLeastAndTheMost) {
  const std::vector<EllipticalCone> cones = hard_cones();
  for (const char* spec : {"latlong", "cube", "octahedral", "healpix", "mirror-ball"}) {
    const Map map = cases::rendered(spec, 24, [](const Vec3d& d) { return d.y > 0.98 ? 1e4 : 1e-3; });
    if (!takes(GetParam(), map)) continue;
    const ConeSampler sampler = ConeSampler::borrow(map, options_of(GetParam()));
    std::vector<float> radiance(cones.size());
    sampler.look_up(cones, radiance);
    // The levels of `gaussian` are halves in units of the map's mean, a hundred thousand times the least
    // here.
    const float least = GetParam() == "gaussian" ? 0 : 1e-3f * (1 - 1e-5f);
    for (std::size_t i = 0; i < cones.size(); ++i) {
      ASSERT_GE(radiance[i], least) << spec << " " << i;
      ASSERT_LE(radiance[i], 1e4f * (1 + 1e-5f)) << spec << " " << i;
    }
  }
}

TEST_P(EveryFilter, GivesTheSameAloneAndAmongOthersAndFromManyThreads) {
  const std::vector<EllipticalCone> cones = hard_cones();
  Map map = cases::rendered("octahedral", 32, cases::waves(9, 12), 3);
  const ConeSampler sampler(std::move(map), options_of(GetParam()));
  std::vector<float> all(3 * cones.size()), again(all);
  sampler.look_up(cones, all);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < cones.size(); i += 3) sampler.look_up(cones[i], {&again[3 * i], 3});
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(all, again);
}

TEST_P(EveryFilter, ObeysTheMapsOrientation) {
  const Matrix3 turn = rotation_from_yaw_pitch_roll(70, -35, 20);
  Map plain = cases::rendered("cube", 32, cases::waves(9, 6)), turned = plain.clone();
  turned.orientation = turn;
  if (!takes(GetParam(), plain)) return;
  const ConeSampler a = ConeSampler::borrow(plain, options_of(GetParam())),
                    b = ConeSampler::borrow(turned, options_of(GetParam()));
  const auto to_map = [&](const Vec3<float>& v) { return turn * v; };
  for (const Vec3d& d : hard_directions()) {
    const EllipticalCone cone{
        {static_cast<float>(d.x) + 0.013f, static_cast<float>(d.y) - 0.017f, static_cast<float>(d.z)},
        {0.3f, 0.9f, -0.4f},
        0.2f,
        0.05f};
    EllipticalCone same = cone;
    same.direction = to_map(cone.direction);
    same.axis = to_map(cone.axis);
    float p, q;
    a.look_up(same, {&p, 1});
    b.look_up(cone, {&q, 1});
    EXPECT_NEAR(static_cast<double>(p), static_cast<double>(q), 2e-4);
  }
}

TEST_P(EveryFilter, OfAveragesTendsToTheMeanOfTheSphere) {
  if (GetParam() == "nearest" || GetParam() == "bilinear") return;
  for (const char* spec : {"latlong", "cube", "octahedral", "healpix", "angular"}) {
    const Map map = cases::rendered(spec, 32, [](const Vec3d& d) {
      return dot(d, {0.6, 0, 0.8}) > 0.95 ? 50 : 1;
    });
    if (!takes(GetParam(), map)) continue;
    // These end at the coarsest level: six texels of a cube, and of a disc what a square has of it.
    const bool coarsest = GetParam() == "differential" || GetParam() == "mirrored";
    if (coarsest && (map.charts() > 1 || !map.parameterization.full_charts())) continue;
    const double mean = cases::mean_over_sphere(map);
    const ConeSampler sampler = ConeSampler::borrow(map, options_of(GetParam()));
    for (const Vec3d& d : hard_directions()) {
      float radiance;
      sampler.look_up(isotropic_cone(d, 300), {&radiance, 1});
      EXPECT_NEAR(static_cast<double>(radiance) / mean, 1, 2e-3) << spec;
    }
  }
}

TEST_P(EveryFilter, RefusesWhatMeansNothing) {
  const Map map = cases::rendered("octahedral", 16, cases::smooth, 3);
  const ConeSampler sampler = ConeSampler::borrow(map, options_of(GetParam()));
  const EllipticalCone good = isotropic_cone({0, 0, 1}, 0.1);
  std::vector<float> out(6, -1);
  EXPECT_THROW(sampler.look_up(std::vector{good, good}, std::span(out).first(5)), Error);
  EllipticalCone bad = good;
  bad.narrow = kNaN;
  const std::string said = cases::refusal([&] { sampler.look_up(std::vector{good, bad}, out); });
  EXPECT_NE(said.find("cone 1"), std::string::npos) << said;
  EXPECT_EQ(out[0], -1) << "before anything is written";
  EXPECT_THROW(
      sampler.look_up(QuadCone{{Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{0, 0, 1}, Vec3d{0, 0, -1}}}, out),
      Error);
  Map broken = map.clone();
  broken.level.chart(0).at(3, 5)[1] = kNaN;
  const std::string why = cases::refusal([&] { ConeSampler::borrow(broken, options_of(GetParam())); });
  EXPECT_NE(why.find("column 3, row 5"), std::string::npos) << why;
}

TEST(ConeSampler, RefusesOptionsOutOfRange) {
  const Map map = cases::rendered("cube", 8, cases::smooth);
  const auto refused = [&](ConeSamplerOptions options) {
    return cases::refusal([&] { ConeSampler::borrow(map, options); });
  };
  EXPECT_NE(refused({.filter = ConeFilter::nearest, .level = -1}), "done");
  EXPECT_NE(refused({.filter = ConeFilter::bilinear, .level = 4}), "done");
  EXPECT_EQ(refused({.filter = ConeFilter::bilinear, .level = 3}), "done");
  EXPECT_NE(refused({.filter = ConeFilter::bilinear, .level = static_cast<double>(kNaN)}), "done");
  EXPECT_NE(refused({.filter = ConeFilter::probes, .probes = 0}), "done");
  EXPECT_NE(refused({.filter = ConeFilter::probes, .probes = 65}), "done");
  EXPECT_NE(refused({.filter = ConeFilter::sat, .boxes = 5}), "done");
  EXPECT_THROW(cone_filter_from_name("gaus"), Error);
  EXPECT_THROW(ConeSampler(std::shared_ptr<const Map>()), Error);
  for (const std::string& name : cone_filter_names()) EXPECT_EQ(name_of(cone_filter_from_name(name)), name);
}

/// Cones about hard directions, of these widths.
std::vector<EllipticalCone> cones_of(double wide, double narrow) {
  std::vector<EllipticalCone> cones;
  std::mt19937 random(9);
  std::normal_distribution<float> along;
  const auto directions = hard_directions();
  for (std::size_t i = 0; i < directions.size(); i += 13) {
    const Vec3d& d = directions[i];
    cones.push_back({{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)},
                     {along(random), along(random), along(random)},
                     static_cast<float>(wide),
                     static_cast<float>(narrow)});
  }
  return cones;
}

double bumps(const Vec3d& d) {
  static const cases::Function f = cases::waves(11, 14);
  return 0.5 + 0.5 * f(d);
}

/// The largest difference from what the reference says.
double largest_error(const ConeSampler& sampler, const std::vector<EllipticalCone>& cones,
                     const std::vector<double>& truth) {
  std::vector<float> radiance(cones.size());
  sampler.look_up(cones, radiance);
  double largest = 0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    largest = std::max(largest, std::fabs(static_cast<double>(radiance[i]) - truth[i]));
  }
  return largest;
}

struct Bound {
  const char* filter;
  double isotropic, elongated;
};

/// Of maps of 0 … 1 whose texels are about 2.8° wide, cones of σ = 5.7°, and of 17° × 5.7°. EWA's differ by
/// what the logarithm map's Gaussian does; those of the others are what they are, twice what was found.
constexpr Bound kBounds[] = {{"ewa", 0.002, 0.002},  {"hybrid", 0.002, 0.002}, {"trilinear", 0.06, 0.12},
                             {"probes", 0.06, 0.04}, {"box", 0.07, 0.1},       {"sat", 0.06, 0.07}};

TEST(ConeSampler, IsNearTheReferenceAtEdgesCornersPolesAndFolds) {
  for (const std::string spec : {"latlong", "cube", "octahedral", "healpix", "angular"}) {
    const Map map = cases::rendered(spec, spec == "cube" ? 32 : 80, bumps);
    for (const bool elongated : {false, true}) {
      const std::vector<EllipticalCone> cones = cones_of(elongated ? 0.3 : 0.1, 0.1);
      std::vector<double> truth;
      for (const EllipticalCone& cone : cones) truth.push_back(look_up_reference(map, cone, 2)[0]);
      for (const Bound& each : kBounds) {
        if (!takes(each.filter, map)) continue;
        EXPECT_LT(largest_error(ConeSampler::borrow(map, options_of(each.filter)), cones, truth),
                  elongated ? each.elongated : each.isotropic)
            << spec << " " << each.filter;
      }
    }
  }
}

}  // namespace
}  // namespace welkin::test
