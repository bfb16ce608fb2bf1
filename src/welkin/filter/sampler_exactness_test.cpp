/// Float look-ups against float64 ones, and those of one direction against those of many.

#include <gtest/gtest.h>

#include "welkin/filter/sampler_aim.h"
#include "welkin/filter/sampler_cases.h"

namespace welkin {
namespace {

using namespace cases;

/// Parameterizations at all kinds of parameters.
std::vector<std::string> all_specs() {
  std::vector<std::string> specs = sphere::parameterization_names();
  for (const char* more :
       {"fisheye-equidistant,fov=220", "fisheye-equisolid,fov=360", "fisheye-orthographic,fov=120",
        "fisheye-stereographic,fov=350", "cylinder,fov=150", "mercator,fov=120", "vr180,fov=220",
        "latlong,left=-90,right=90,top=45,bottom=-45", "latlong,left=90,right=270,top=60,bottom=-20",
        "latlong,top=30,bottom=-60", "latlong,left=0,right=360",
        "latlong,left=-70,right=230,top=90,bottom=20"}) {
    specs.push_back(more);
  }
  return specs;
}

/// Axes, edges, corners, folds, and directions near them; directions at chart edges; others all over the
/// sphere.
std::vector<Vec3<float>> telling_directions(const Map& map) {
  std::vector<Vec3<float>> directions = random_directions(2000);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3<float> d{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        for (const float nudge : {0.0f, 1e-3f, -1e-3f, 1e-6f, -1e-6f, 1e-9f}) {
          if (x == 0 && y == 0 && z == 0) continue;
          directions.push_back({d.x + nudge, d.y, d.z});
          directions.push_back({d.x, d.y + nudge, d.z});
          directions.push_back({d.x, d.y, d.z + nudge});
        }
      }
    }
  }
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int i = 0; i <= 16; ++i) {
      for (const double edge : {0.0, 1e-7, 1.0 - 1e-7, 1.0}) {
        for (const auto& [u, v] : {std::pair{edge, i / 16.0}, {i / 16.0, edge}}) {
          const Vec3d d = transpose(map.orientation) * map.parameterization.to_sphere(chart, u, v);
          directions.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
        }
      }
    }
  }
  return directions;
}

/// The minimum and the maximum value, and whether some are shown and some not, of the float64 look-ups at a
/// direction and at those around it, `angle` radians away.
struct Neighbourhood {
  float minimum = HUGE_VALF, maximum = -HUGE_VALF;
  bool shown = true, hidden = true;  ///< all of them
};

Neighbourhood around(const Sampler& sampler, const Vec3d& direction, double angle) {
  const Vec3d d = normalize(direction);
  const Vec3d side = normalize(cross(d, std::fabs(d.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
  const Vec3d other = cross(d, side);
  std::vector<Vec3d> directions{d};
  for (const double part : {0.1, 0.4, 1.0}) {
    for (int i = 0; i < 16; ++i) {
      const double at = kPi / 8 * i;
      directions.push_back(d + (angle * part * std::cos(at)) * side + (angle * part * std::sin(at)) * other);
    }
  }
  std::vector<float> values(directions.size());
  sampler.look_up(directions, values);
  Neighbourhood found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    (sampler.covers(directions[i]) ? found.hidden : found.shown) = false;
    found.minimum = std::min(found.minimum, values[i]);
    found.maximum = std::max(found.maximum, values[i]);
  }
  return found;
}

/// A float look-up finds what float64 finds within the stated angle. 3e-7 of a chart's side is at most 2π
/// times as many radians, around a lat-long. Where radiance is smooth within that angle, the values between
/// those that the neighbourhood tries differ by less than half of their range. Rounding of values: 1e-6.
TEST(SamplerExactness, FloatDirectionsAgreeWithFloat64) {
  constexpr double kAngle = 5e-7 + 2 * kPi * 3e-7;
  for (const std::string& spec : all_specs()) {
    for (const bool turned : {false, true}) {
      Map map = make_map(spec, 48);
      if (turned) map.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
      fill_with_noise(map);
      const std::vector<Vec3<float>> directions = telling_directions(map);
      for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
        const Sampler sampler = Sampler::borrow(map, {.filter = filter});
        std::vector<float> values(directions.size());
        sampler.look_up(directions, values);
        for (std::size_t i = 0; i < values.size(); ++i) {
          const Vec3<float>& f = directions[i];
          const Neighbourhood found = around(sampler, {f.x, f.y, f.z}, kAngle);
          if (found.shown) {
            ASSERT_TRUE(sampler.covers(f)) << spec;
          }
          if (found.hidden) {
            ASSERT_FALSE(sampler.covers(f)) << spec;
          }
          const float margin = 0.5f * (found.maximum - found.minimum) + 2e-6f;
          ASSERT_GE(values[i], found.minimum - margin)
              << spec << " " << name_of(filter) << " " << f.x << " " << f.y << " " << f.z;
          ASSERT_LE(values[i], found.maximum + margin)
              << spec << " " << name_of(filter) << " " << f.x << " " << f.y << " " << f.z;
        }
      }
    }
  }
}

/// One, many, arrays, a level for each: the same bits; with Lanczos, nearly.
TEST(SamplerExactness, OneAndManyAgree) {
  for (const std::string& spec : all_specs()) {
    for (const int channels : {1, 3, 4, 6}) {
      Map map = make_map(spec, 24, channels);
      if (channels > 1) map.orientation = rotation_from_yaw_pitch_roll(30, 20, 10);
      fill_with_noise(map);
      const std::vector<Vec3<float>> directions = telling_directions(map);
      std::vector<float> x, y, z;
      std::vector<Vec3d> wide;
      for (const auto& d : directions) {
        x.push_back(d.x);
        y.push_back(d.y);
        z.push_back(d.z);
        wide.push_back({d.x, d.y, d.z});
      }
      for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
        const Sampler sampler = Sampler::borrow(map, {.filter = filter, .levels = 4});
        const double tolerance = filter == Filter::lanczos ? 2e-6 : 0;
        const auto n = static_cast<std::size_t>(channels);
        const std::vector<float> levels = random_levels(sampler, directions.size());
        std::vector<float> many(n * directions.size()), arrays(many), own(many), own_arrays(many), one(n),
            wide_many(many), wide_own(many);
        for (const double level : {0.0, 1.75}) {
          sampler.look_up(directions, many, level);
          sampler.look_up(DirectionArrays{x, y, z}, arrays, level);
          sampler.look_up(wide, wide_many, level);
          ASSERT_EQ(many, arrays) << spec;
          for (std::size_t i = 0; i < directions.size(); ++i) {
            sampler.look_up(directions[i], one, level);
            for (std::size_t c = 0; c < n; ++c) ASSERT_NEAR(one[c], many[i * n + c], tolerance) << spec;
            sampler.look_up(wide[i], one, level);
            for (std::size_t c = 0; c < n; ++c) ASSERT_NEAR(one[c], wide_many[i * n + c], tolerance) << spec;
          }
        }
        sampler.look_up(directions, own, levels);
        sampler.look_up(DirectionArrays{x, y, z}, own_arrays, levels);
        sampler.look_up(wide, wide_own, levels);
        ASSERT_EQ(own, own_arrays) << spec;
        for (std::size_t i = 0; i < directions.size(); ++i) {
          sampler.look_up(directions[i], one, static_cast<double>(levels[i]));
          for (std::size_t c = 0; c < n; ++c) ASSERT_NEAR(one[c], own[i * n + c], tolerance) << spec;
          sampler.look_up(wide[i], one, static_cast<double>(levels[i]));
          for (std::size_t c = 0; c < n; ++c) ASSERT_NEAR(one[c], wide_own[i * n + c], tolerance) << spec;
        }
      }
    }
  }
}

/// A direction's length makes no difference: not a bit for powers of two.
TEST(SamplerExactness, LengthsDoNotMatter) {
  for (const std::string& spec : all_specs()) {
    Map map = make_map(spec, 24, 3);
    fill_with_noise(map);
    const Sampler sampler = Sampler::borrow(map);
    for (const Vec3<float>& d : random_directions(200)) {
      const auto expected = sampler.rgb(d);
      const auto expected_wide = sampler.rgb(Vec3d{d.x, d.y, d.z});
      for (const float length : {0x1p-120f, 0x1p-40f, 0x1p40f, 0x1p124f}) {
        ASSERT_EQ(sampler.rgb(length * d), expected) << spec << " " << length;
      }
      for (const double length : {0x1p-1000, 0x1p-90, 0x1p90, 0x1p1000}) {
        ASSERT_EQ(sampler.rgb(length * Vec3d{d.x, d.y, d.z}), expected_wide) << spec << " " << length;
      }
    }
    EXPECT_EQ(sampler.covers(Vec3<float>{0, 1e-45f, 0}), sampler.covers(Vec3<float>{0, 1, 0})) << spec;
    EXPECT_EQ(sampler.covers(Vec3<float>{0, 0, 3.4e38f}), sampler.covers(Vec3<float>{0, 0, 1})) << spec;
    EXPECT_EQ(sampler.covers(Vec3d{5e-324, 0, 0}), sampler.covers(Vec3d{1, 0, 0})) << spec;
  }
}

#ifdef WELKIN_HAS_AVX2
/// One formula, two instruction sets: they differ by rounding only.
TEST(SamplerAim, InstructionSetsAgree) {
  const FloatOrientation orientation(rotation_from_yaw_pitch_roll(30, 20, 10));
  const std::vector<Vec3<float>> directions = random_directions(101);
  const StridedDirections from{&directions[0].x, &directions[0].y, &directions[0].z, 3};
  alignas(64) float x[2][112], y[2][112], z[2][112], usable[2][112];
  for (int k = 0; k < 2; ++k) {
    const Aim aim = (k == 0 ? aim_kernels_baseline() : aim_kernels_avx2()).many;
    EXPECT_TRUE(aim(orientation, from, {x[k], y[k], z[k], usable[k]}, directions.size()));
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(x[0][i], x[1][i], 5e-7);
    EXPECT_NEAR(y[0][i], y[1][i], 5e-7);
    EXPECT_NEAR(z[0][i], z[1][i], 5e-7);
  }
}
#endif

}  // namespace
}  // namespace welkin
