#include <gtest/gtest.h>

#include <cmath>

#include "welkin/lookup/cone_sampler.h"
#include "welkin/map/map_cases.h"
#include "welkin/math/angles.h"

namespace welkin::test {
namespace {

/// Spread evenly over the sphere (Swinbank & Purser 2006).
std::vector<Vec3d> even_directions(int count) {
  std::vector<Vec3d> all;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - y * y), a = 2.399963229728653 * i;
    all.push_back({r * std::cos(a), y, r * std::sin(a)});
  }
  return all;
}

/// Largest change over the turn, and largest error of the whole.
struct Bound {
  const char* filter;
  double change, error;
};

/// Gaussians keep what they should. The others' kernels change with where they are on the map, and so does
/// the sum of what they give of one texel: twice what was found.
constexpr Bound kBounds[] = {{"ewa", 0.002, 0.001}, {"hybrid", 0.002, 0.001}, {"trilinear", 0.04, 0.3},
                             {"probes", 0.04, 0.3}, {"box", 0.02, 0.16},      {"sat", 0.02, 0.18}};

class SunEnergy : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Maps, SunEnergy, ::testing::Values("latlong", "cube", "octahedral"),
                         cases::test_name);

/// All that 4000 cones of σ = 6° see of a sun of some texels, as they are turned about a leaning axis.
TEST_P(SunEnergy, StaysAsTheCameraTurns) {
  const Vec3d sun = normalize(Vec3d{0.3, 0.8, 0.5});
  const Map map = cases::rendered(GetParam(), GetParam() == "cube" ? 40 : 100,
                                  [&](const Vec3d& d) { return angle_between(d, sun) < 0.05 ? 1000 : 0.01; });
  const double energy = cases::mean_over_sphere(map);
  const std::vector<Vec3d> directions = even_directions(4000);
  for (const Bound& each : kBounds) {
    const ConeSampler sampler = ConeSampler::borrow(map, {.filter = cone_filter_from_name(each.filter)});
    double least = 1e30, most = 0;
    for (int step = 0; step < 5; ++step) {
      const Matrix3 turn =
          rotation_from_yaw_pitch_roll(0, 40, 0) * rotation_from_yaw_pitch_roll(72.0 * step, 0, 0);
      std::vector<EllipticalCone> cones;
      for (const Vec3d& d : directions) {
        const Vec3d at = turn * d;
        cones.push_back({{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)},
                         {},
                         0.105f,
                         0.105f});
      }
      std::vector<float> radiance(cones.size());
      sampler.look_up(cones, radiance);
      double sum = 0;
      for (const float value : radiance) sum += static_cast<double>(value);
      least = std::min(least, sum / 4000);
      most = std::max(most, sum / 4000);
    }
    EXPECT_LT(most / least - 1, each.change) << each.filter;
    EXPECT_LT(std::fabs(most / energy - 1), each.error) << each.filter;
  }
}

}  // namespace
}  // namespace welkin::test
