#include "welkin/lookup/gaussian_stack.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/lookup/gaussian_cases.h"
#include "welkin/map/borders.h"
#include "welkin/math/rotation.h"
#include "welkin/math/vec_precision.h"
#include "welkin/synth/render_synth.h"

namespace welkin::test {
namespace {

Map synthetic(const char* name, const char* parameterization, int width, int height) {
  return render(synth::make(name), sphere::AnyParameterization::make(parameterization), width, height);
}

Map filled(const char* parameterization, int width, int height, int channels, float value) {
  Map map(sphere::AnyParameterization::make(parameterization), width, height, channels);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y)
      std::fill_n(map.level.chart(chart).row(y), map.width() * channels, value);
  }
  fill_borders(map);
  return map;
}

/// Cones of any direction and axis; `narrow` between two numbers of radians, evenly in its logarithm.
std::vector<EllipticalCone> cones(int count, double least, double most, double aspect) {
  std::mt19937 random(5);
  std::normal_distribution<float> along;
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<EllipticalCone> result;
  for (int i = 0; i < count; ++i) {
    EllipticalCone cone{{along(random), along(random), along(random)},
                        {along(random), along(random), along(random)}};
    const double sigma = least * std::pow(most / least, share(random));
    cone.narrow = static_cast<float>(sigma);
    cone.wide = static_cast<float>(sigma * aspect);
    result.push_back(cone);
  }
  return result;
}

/// The RMS error over cones and channels, relative to the value or a tenth of the mean.
double error_of(const Map& map, const GaussianStack& stack, const std::vector<EllipticalCone>& cones) {
  const GaussianReference reference(map);
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  const std::vector<double> mean = reference.mean();
  std::vector<float> got(cones.size() * channels);
  stack.look_up(cones, got);
  double sum = 0;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const std::vector<double> wanted = reference.mean(cones[i]);
    for (std::size_t c = 0; c < channels; ++c) {
      const double error =
          (got[i * channels + c] - wanted[c]) / std::max(std::fabs(wanted[c]), 0.1 * mean[c]);
      sum += error * error;
    }
  }
  return std::sqrt(sum / static_cast<double>(cones.size() * channels));
}

TEST(GaussianStack, KeepsToTheAccuracy) {
  for (const char* name : {"sun", "room", "checker"}) {
    const Map map = synthetic(name, "latlong", 192, 96);
    const GaussianReference reference(map);
    for (const auto& [accuracy, most] :
         {std::pair{GaussianAccuracy::percent, 0.01}, {GaussianAccuracy::permille, 0.002}}) {
      const GaussianStack stack = GaussianStack::borrow(map, {accuracy});
      for (const double aspect : {1.0, 1.3, 4.0, 12.0}) {
        const double widest = std::max(1.01 * stack.narrowest(), 0.35 / aspect);
        EXPECT_LT(error_of(map, stack, cones(24, stack.narrowest(), widest, aspect)), most)
            << name << ", aspect " << aspect;
      }
    }
  }
}

TEST(GaussianStack, LeavesConstantMapsConstant) {
  for (const char* parameterization : {"latlong", "cube", "octahedral"}) {
    const int height = parameterization[0] == 'l' ? 32 : 64;
    const Map map = filled(parameterization, 64, height, 3, 0.7f);
    for (const GaussianAccuracy accuracy : {GaussianAccuracy::percent, GaussianAccuracy::permille}) {
      const GaussianStack stack = GaussianStack::borrow(map, {accuracy});
      for (const double aspect : {1.0, 1.2, 3.0, 30.0, 1000.0}) {
        std::vector<EllipticalCone> list = cones(500, 1e-4, 2.5, aspect);
        // Edges, corners and poles.
        for (const float x : {-1.0f, 0.0f, 1.0f}) {
          for (const float y : {-1.0f, 0.0f, 1.0f}) {
            EllipticalCone cone = list[static_cast<std::size_t>(4 + x + 3 * y)];
            cone.direction = {x, y, 1};
            list.push_back(cone);
            cone.direction = {x, 1, y};
            list.push_back(cone);
          }
        }
        std::vector<float> got(3 * list.size());
        stack.look_up(list, got);
        for (const float value : got) ASSERT_NEAR(value, 0.7f, 0.7e-6) << parameterization << ' ' << aspect;
      }
    }
  }
}

TEST(GaussianStack, TendsToTheMeanAndToTheSource) {
  const Map map = synthetic("room", "latlong", 128, 64);
  const GaussianStack stack = GaussianStack::borrow(map, {GaussianAccuracy::permille});
  const std::vector<double> mean = GaussianReference(map).mean();
  const Sampler sampler = Sampler::borrow(map);
  for (EllipticalCone cone : cones(40, 1, 1.01, 1)) {
    cone.wide = cone.narrow = 5;
    const std::array<float, 3> wide = stack.rgb(cone);
    cone.wide = cone.narrow = 0;
    const std::array<float, 3> sharp = stack.rgb(cone), wanted = sampler.rgb(cone.direction);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(wide[c], mean[c], 1e-4 * mean[c]);
      EXPECT_NEAR(sharp[c], wanted[c], 1e-5 * (wanted[c] + mean[c]));
    }
  }
}

TEST(GaussianStack, KeepsLightPositive) {
  for (const char* name : {"sun", "lamps"}) {
    const Map map = synthetic(name, "latlong", 128, 64);
    for (const GaussianAccuracy accuracy : {GaussianAccuracy::percent, GaussianAccuracy::permille}) {
      const GaussianStack stack = GaussianStack::borrow(map, {accuracy});
      for (const double aspect : {1.0, 5.0}) {
        const std::vector<EllipticalCone> list = cones(2000, 0.2 * stack.narrowest(), 2, aspect);
        std::vector<float> got(3 * list.size());
        stack.look_up(list, got);
        for (const float value : got) ASSERT_GT(value, 0) << name;
      }
    }
  }
}

TEST(GaussianStack, LooksAlikeAloneAndAmongOthers) {
  const Map map = synthetic("studio", "cube", 32, 32);
  const GaussianStack stack = GaussianStack::borrow(map);
  for (const double aspect : {1.0, 1.1, 7.0, 60.0}) {
    const std::vector<EllipticalCone> list = cones(300, 0.3 * stack.narrowest(), 1, aspect);
    std::vector<float> together(3 * list.size() + 2, -5);
    stack.look_up(list, together);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::array<float, 3> alone = stack.rgb(list[i]);
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(together[3 * i + c], alone[c]);
    }
    EXPECT_EQ(together[3 * list.size()], -5) << "what is past the results stays";
  }
}

TEST(GaussianStack, TurnsWithTheMap) {
  Map map = synthetic("room", "latlong", 128, 64);
  const Matrix3 turn = rotation_from_yaw_pitch_roll(40, 25, -60);
  const std::vector<EllipticalCone> list = cones(100, 0.06, 0.4, 3);
  const GaussianStack straight = GaussianStack::borrow(map);
  std::vector<EllipticalCone> turned = list;
  const auto rotated = [&](const Vec3<float>& v) { return to_float(transpose(turn) * Vec3d{v.x, v.y, v.z}); };
  for (EllipticalCone& cone : turned)
    cone = {rotated(cone.direction), rotated(cone.axis), cone.wide, cone.narrow};
  std::vector<float> before(300), after(300);
  straight.look_up(list, before);
  map.orientation = turn;
  GaussianStack::borrow(map).look_up(turned, after);
  // The grids of both lie differently in the map: twice the accuracy.
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 0.02 * before[i] + 0.01);
}

TEST(GaussianStack, KeepsTheLightOfAPannedSun) {
  // The sum of look-ups all around, whose cones overlap so that a sum stands for the integral to 1e-4. The
  // sun passes edges, corners and poles of the levels' grids.
  const Map map = synthetic("sun", "latlong", 128, 64);
  for (const GaussianAccuracy accuracy : {GaussianAccuracy::percent, GaussianAccuracy::permille}) {
    const GaussianStack stack = GaussianStack::borrow(map, {accuracy});
    const double mean = GaussianReference(map).mean()[0];
    for (int degrees = 0; degrees < 360; degrees += 15) {
      const Matrix3 turn = rotation_from_yaw_pitch_roll(degrees, 0.5 * degrees, 20);
      std::vector<EllipticalCone> list;
      std::vector<double> areas;
      for (int row = 0; row < 64; ++row) {
        for (int column = 0; column < 128; ++column) {
          const double polar = (row + 0.5) * kPi / 64, round = (column + 0.5) * kPi / 64;
          const Vec3d d{std::sin(polar) * std::sin(round), std::cos(polar),
                        std::sin(polar) * std::cos(round)};
          list.push_back({to_float(turn * d), {}, 0.07f, 0.07f});
          areas.push_back(std::sin(polar));
        }
      }
      std::vector<float> got(3 * list.size());
      stack.look_up(list, got);
      double sum = 0, area = 0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        sum += areas[i] * got[3 * i];
        area += areas[i];
      }
      ASSERT_NEAR(sum / area, mean, 0.005 * mean) << degrees;
    }
  }
}

TEST(GaussianStack, DoesNotDependOnThreads) {
  const Map map = synthetic("room", "latlong", 128, 64);
  const std::vector<EllipticalCone> list = cones(300, 0.02, 1, 3);
  std::vector<float> one(900), many(900);
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    GaussianStack::borrow(map).look_up(list, one);
  }
  GaussianStack::borrow(map).look_up(list, many);
  EXPECT_EQ(one, many);
}

TEST(GaussianStack, CountsWhatIsNotShownAsBlack) {
  const Map map = filled("hemi-octahedral", 64, 64, 1, 2);
  const GaussianStack stack = GaussianStack::borrow(map, {GaussianAccuracy::permille});
  const auto at = [&](const Vec3d& direction, float sigma) {
    float value = 0;
    stack.look_up(EllipticalCone{to_float(direction), {}, sigma, sigma}, {&value, 1});
    return value;
  };
  const GaussianReference reference(map);
  for (const float sigma : {0.05f, 0.3f, 1.0f}) {
    for (const Vec3d& d : {Vec3d{0, 1, 0}, {1, 0, 0}, {0.6, 0.2, -1}, {0, -1, 0.1}}) {
      EXPECT_NEAR(at(d, sigma), reference.mean({to_float(d), {}, sigma, sigma})[0], 0.004) << sigma;
    }
  }
}

TEST(GaussianStack, TakesAnyNumberOfChannels) {
  const Map rgb = synthetic("studio", "latlong", 64, 32);
  const std::vector<EllipticalCone> list = cones(50, 0.02, 1, 4);
  std::vector<float> wanted(150);
  GaussianStack::borrow(rgb).look_up(list, wanted);
  for (const int channels : {1, 2, 4, 5, 9, 40}) {
    Map map(rgb.parameterization, 64, 32, channels);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) {
        for (int c = 0; c < channels; ++c)
          map.level.chart(0).at(x, y)[c] = rgb.level.chart(0).at(x, y)[c % 3];
      }
    }
    fill_borders(map);
    std::vector<float> got(50 * static_cast<std::size_t>(channels));
    GaussianStack::borrow(map).look_up(list, got);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const float want =
          wanted[i / static_cast<std::size_t>(channels) * 3 + i % static_cast<std::size_t>(channels) % 3];
      ASSERT_NEAR(got[i], want, 2e-3 * want + 1e-4) << channels;
    }
  }
}

TEST(GaussianStack, RefusesBadConesBeforeItWrites) {
  const Map map = synthetic("studio", "latlong", 32, 16);
  const GaussianStack stack = GaussianStack::borrow(map);
  std::vector<EllipticalCone> list = cones(200, 0.1, 1, 2);
  std::vector<float> out(600, -1);
  const EllipticalCone good = list[150];
  const auto refused = [&](const EllipticalCone& bad) {
    list[150] = bad;
    EXPECT_THROW(stack.look_up(list, out), Error);
    list[150] = good;
    for (const float value : out) ASSERT_EQ(value, -1);
  };
  refused({{0, 0, 0}, good.axis, good.wide, good.narrow});
  refused({good.direction, good.direction, good.wide, good.narrow});
  refused({good.direction, good.axis, good.narrow, good.wide});
  refused({good.direction, good.axis, good.wide, -0.1f});
  refused({{NAN, 0, 0}, good.axis, good.wide, good.narrow});
  refused({good.direction, good.axis, INFINITY, good.narrow});
  out.resize(599);
  EXPECT_THROW(stack.look_up(list, out), Error);
  EXPECT_THROW(GaussianStack(std::shared_ptr<const Map>()), Error);

  Map broken = synthetic("studio", "latlong", 32, 16);
  broken.level.chart(0).at(3, 3)[0] = NAN;
  EXPECT_THROW(GaussianStack::borrow(broken), Error);
}

}  // namespace
}  // namespace welkin::test
