#include "welkin/filter/resample.h"

#include "welkin/map/borders.h"

#include <tbb/global_control.h>

#include "welkin/base/error.h"
#include "welkin/filter/resample_cases.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

constexpr Filter kFilters[] = {Filter::automatic, Filter::nearest, Filter::bilinear, Filter::bicubic,
                               Filter::lanczos};

TEST(ResampleTest, FilterNamesAreReadBack) {
  for (const Filter filter : kFilters) EXPECT_EQ(filter_from_name(name_of(filter)), filter);
  EXPECT_THROW(filter_from_name("bilinaer"), Error);
}

TEST(ResampleTest, AQuarterTurnOfALatLongIsAnExactShift) {
  const auto latlong = sphere::AnyParameterization::make("latlong");
  Map source(latlong, 64, 32, 1), turned(latlong, 64, 32, 1);
  render(source, waves(30, 40));
  ResampleOptions options = with(Filter::nearest);
  options.rotation = rotation_from_yaw_pitch_roll(90, 0, 0);
  resample(source, turned, options);
  // Positive yaw takes +Z to +X, which a lat-long shows a quarter to the left.
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(*turned.level.chart(0).at(x, y), *source.level.chart(0).at((x + 16) % 64, y))
          << x << "," << y;
    }
  }
}

TEST(ResampleTest, RotationThereAndBackReturns) {
  const Matrix3 rotation = rotation_from_yaw_pitch_roll(50, -30, 70);
  for (const char* name : {"cube", "latlong", "octahedral", "healpix"}) {
    const Map source = rendered(name, 48, smooth);
    Map there = make_map(name, 48), back = make_map(name, 48);
    ResampleOptions options;
    options.rotation = rotation;
    resample(source, there, options);
    fill_borders(there);
    for_each_valid_texel(there, [&](int chart, int x, int y) {
      const double expected = smooth(transpose(rotation) * direction_at(there, chart, x, y));
      ASSERT_NEAR(*there.level.chart(chart).at(x, y), expected, 0.01) << name;
    });
    options.rotation = transpose(rotation);
    resample(there, back, options);
    EXPECT_LT(largest_difference(source, back), 0.02) << name;
  }
}

/// A map may be rotated in the world: source and target each have their own `orientation`.
TEST(ResampleTest, OrientationsAndRotationCompose) {
  const Matrix3 a = rotation_from_yaw_pitch_roll(20, 50, -10), b = rotation_from_yaw_pitch_roll(-70, 15, 33);
  Matrix3 mirrored = rotation_from_yaw_pitch_roll(10, 20, 30);
  for (double& x : mirrored.rows[0]) x = -x;
  const Matrix3 rotation = rotation_from_yaw_pitch_roll(5, 95, 12);
  for (const Matrix3& orientation : {a, b, mirrored}) {
    Map source = make_map("latlong", 64);
    source.orientation = orientation;
    render(source, smooth);
    Map target = make_map("cube", 32);
    target.orientation = mirrored * b;
    ResampleOptions options = with(Filter::bicubic);
    options.rotation = rotation;
    resample(source, target, options);
    for_each_valid_texel(target, [&](int chart, int x, int y) {
      const Vec3d d = direction_at(target, chart, x, y);
      ASSERT_NEAR(*target.level.chart(chart).at(x, y), smooth(transpose(rotation) * d), 1e-3);
    });
  }
}

/// The smallest value around one texel of a million in a dark map, on each face's middle, edge and corner.
double minimum_beside_a_light(Filter filter, bool allow_ringing, double dark) {
  double minimum = HUGE_VAL;
  for (const auto& [x, y] : {std::pair{8, 8}, {0, 7}, {15, 15}}) {
    Map source = rendered("cube", 16, [dark](const Vec3d&) { return dark; });
    *source.level.chart(2).at(x, y) = 1e6f;
    fill_borders(source);
    for (const char* name : {"cube", "latlong"}) {
      Map target = make_map(name, 80);
      ResampleOptions options = with(filter);
      options.allow_ringing = allow_ringing;
      options.rotation = rotation_from_yaw_pitch_roll(3, 4, 5);
      resample(source, target, options);
      for_each_valid_texel(target, [&](int chart, int i, int j) {
        minimum = std::min(minimum, static_cast<double>(*target.level.chart(chart).at(i, j)));
      });
    }
  }
  return minimum;
}

TEST(ResampleTest, LightNeverBecomesNegativeUnlessRingingIsAllowed) {
  for (const Filter filter : kFilters) {
    EXPECT_GE(minimum_beside_a_light(filter, false, 0), 0) << name_of(filter);
    // A look-up is at least half the smallest texel; a mean of texels that keep theirs is not negative.
    const double smallest = filter == Filter::automatic ? 0 : 0.125 - 1e-6;
    EXPECT_GE(minimum_beside_a_light(filter, false, 0.25), smallest) << name_of(filter);
  }
  for (const Filter filter : {Filter::automatic, Filter::bicubic, Filter::lanczos}) {
    EXPECT_LT(minimum_beside_a_light(filter, true, 0), -1e4) << name_of(filter);
  }
}

/// Kernels reach 1, 2, 3 or 4 texels, and a border texel interpolates two texels on each side more.
TEST(ResampleTest, ANaNStaysWithinTheKernelsReach) {
  for (const char* source_name : {"cube", "latlong"}) {
    for (const auto& [px, py] : {std::pair{16, 16}, {0, 15}}) {
      Map source = rendered(source_name, 32, smooth);
      *source.level.chart(0).at(px, py) = NAN;
      fill_borders(source);
      const Vec3d centre = direction_at(source, 0, px, py);
      const double texel = source.charts() == 6 ? 2.0 / 32 : kPi / source.height();
      for (const Filter filter : kFilters) {
        Map target = make_map("octahedral", 120);
        resample(source, target, with(filter));
        int poisoned = 0;
        for_each_valid_texel(target, [&](int chart, int x, int y) {
          if (!std::isnan(*target.level.chart(chart).at(x, y))) return;
          ++poisoned;
          EXPECT_LT(length(direction_at(target, chart, x, y) - centre), (4 + 2 + 1) * std::sqrt(2) * texel)
              << source_name << " " << name_of(filter);
        });
        if (filter == Filter::nearest || filter == Filter::bilinear) {
          EXPECT_GT(poisoned, 0) << name_of(filter);
        }
      }
    }
  }
}

/// Lamps a thousand times brighter than what is around them, some smaller than a texel of any target.
double high_contrast(const Vec3d& d) {
  const auto lamp = [&](const Vec3d& at, double radius) {
    return length(d - normalize(at)) < radius ? 1000.0 : 0.0;
  };
  return 0.5 + 0.4 * d.y + lamp({0.2, 1, 0.1}, 0.06) + lamp({1, 1, 1}, 0.1) + lamp({-0.3, -1, 0}, 0.08) +
         lamp({0.05, 0.1, -1}, 0.15);
}

struct Size {
  const char* name;
  int width, height;
};

TEST(ResampleTest, EnergyIsKeptDownToTheSmallestTargets) {
  // Relative error of the mean over the sphere, nearly all of which comes from four lamps. A texel over a
  // fold (the middle of an odd octahedron) or over several charts (below faces of 4) is no parallelogram:
  // hence two tolerances.
  constexpr double kRegular = 5e-3, kFolded = 3e-2;
  const std::pair<Size, double> targets[] = {
      {{"latlong", 37, 19}, kRegular},
      {{"latlong", 16, 8}, kRegular},
      {{"cube", 7, 7}, kRegular},
      {{"cube", 4, 4}, kRegular},
      {{"octahedral", 9, 9}, kRegular},
      {{"octahedral", 8, 8}, kRegular},
      {{"eac", 5, 5}, kRegular},
      {{"healpix", 4, 4}, kRegular},
      {{"octahedral-equal-area", 8, 8}, kRegular},
      {{"equal-area", 12, 5}, kRegular},
      {{"cube", 2, 2}, kRegular},
      {{"octahedral-equal-area", 7, 7}, kFolded},
      {{"cube", 1, 1}, kFolded},
      {{"latlong", 2, 1}, kFolded},
      {{"latlong", 1, 1}, kFolded},
      {{"octahedral", 1, 1}, kFolded},
      {{"paraboloid", 16, 16}, kRegular},
      {{"angular", 17, 17}, kRegular},
  };
  for (const char* source_name : {"latlong", "cube", "octahedral"}) {
    const Map source = rendered(source_name, 200, high_contrast);
    const double expected = mean_over_sphere(source);
    for (const auto& [size, tolerance] : targets) {
      Map target(sphere::AnyParameterization::make(size.name), size.width, size.height, 1);
      resample(source, target, with(Filter::automatic));
      EXPECT_LT(std::fabs(mean_over_sphere(target) / expected - 1), tolerance)
          << source_name << " to " << size.name << " " << size.width << "×" << size.height;
    }
  }
}

/// render() puts c+1 times the function into channel c.
TEST(ResampleTest, AnyNumberOfChannelsGivesTheSameResults) {
  for (const Filter filter : kFilters) {
    Map one = make_map("cube", 12);
    const Map source = rendered("latlong", 40, waves(20, 15));
    resample(source, one, with(filter));
    for (const int channels : {2, 3, 4, 5, 7}) {
      Map many = make_map("cube", 12, channels);
      resample(rendered("latlong", 40, waves(20, 15), channels), many, with(filter));
      for_each_valid_texel(one, [&](int chart, int x, int y) {
        for (int c = 0; c < channels; ++c) {
          const float expected = static_cast<float>(c + 1) * *one.level.chart(chart).at(x, y);
          ASSERT_NEAR(many.level.chart(chart).at(x, y)[c], expected, 3e-6 * (c + 1))
              << name_of(filter) << " " << channels;
        }
      });
    }
  }
}

TEST(ResampleTest, ProgressRisesToOneAndCancellingThrows) {
  // One thread: reports of several may overtake each other.
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  const Map source = rendered("latlong", 64, smooth);
  Map target = make_map("cube", 40);
  for (const Filter filter : kFilters) {
    ResampleOptions options = with(filter);
    double last = 0;
    options.monitor.progress = [&](double fraction) {
      EXPECT_GT(fraction, last);
      last = fraction;
    };
    resample(source, target, options);
    EXPECT_EQ(last, 1) << name_of(filter);
    int asked = 0;
    options.monitor = {};
    options.monitor.cancelled = [&] { return ++asked == 3; };
    EXPECT_THROW(resample(source, target, options), Cancelled) << name_of(filter);
    EXPECT_EQ(asked, 3) << name_of(filter);
  }
}

/// Outside the discs of a paraboloid and the triangles of an octahedron's perspective pictures, the pictures
/// continue: what their direction shows, so that a renderer may read across the rim.
TEST(ResampleTest, PicturesThatGoOnShowTheirDirectionsToTheEdge) {
  const auto smooth_world = [](const Vec3d& d) { return 2 + d.x - 0.5 * d.y + 0.25 * d.x * d.z; };
  Map source(sphere::AnyParameterization::make("latlong"), 256, 128, 1);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) {
      const Vec3d d = source.parameterization.to_sphere(0, (x + 0.5) / 256, (y + 0.5) / 128);
      *source.level.chart(0).at(x, y) = static_cast<float>(smooth_world(d));
    }
  }
  fill_borders(source);
  for (const char* name : {"paraboloid", "octahedral-perspective"}) {
    for (const Filter filter : {Filter::bilinear, Filter::automatic}) {
      for (const int size : {24, 100}) {
        Map target(sphere::AnyParameterization::make(name), size, size, 1);
        ResampleOptions options;
        options.filter = filter;
        options.fill = {-100};
        resample(source, target, options);
        for (int chart = 0; chart < target.charts(); ++chart) {
          for (int i = 0; i < size; ++i) {
            for (const auto& [x, y] : {std::pair{i, 0}, {i, size - 1}, {0, i}, {size - 1, i}}) {
              const Vec3d d = target.parameterization.to_sphere(chart, (x + 0.5) / size, (y + 0.5) / size);
              // Of texels on a rim `automatic` has the mean of the part inside.
              EXPECT_NEAR(*target.level.chart(chart).at(x, y), smooth_world(d), 2.0 / size)
                  << name << " " << x << "," << y;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin
