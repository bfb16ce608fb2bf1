/// Every registered parameterization to every other: what no pair may do, whatever it looks like.

#include <iomanip>

#include "welkin/filter/resample_cases.h"
#include "welkin/map/map_cases.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

using namespace cases;

class ResampleCrossTest : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ResampleCrossTest, ::testing::ValuesIn(names_and_windows()), test_name);

constexpr Filter kFilters[] = {Filter::automatic, Filter::nearest, Filter::bilinear, Filter::bicubic,
                               Filter::lanczos};

enum class Coverage { none, mixed, full };

/// How much of the cone of half-angle `angle` around a direction is covered, found on a polar grid.
Coverage coverage_around(const sphere::AnyParameterization& p, const Vec3d& d, double angle) {
  if (p.whole_world()) return Coverage::full;
  constexpr int kRings = 10, kSpokes = 24;
  const Vec3d right = normalize(cross(d, std::fabs(d.y) < 0.5 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  const Vec3d up = cross(right, d);
  int covered = 0;
  for (int i = 0; i < kRings * kSpokes; ++i) {
    const double radius = angle * (i / kSpokes) / (kRings - 1.0), turn = 2 * kPi * (i % kSpokes) / kSpokes;
    const Vec3d aside = std::cos(turn) * right + std::sin(turn) * up;
    covered += p.covers(std::cos(radius) * d + std::sin(radius) * aside) ? 1 : 0;
  }
  // What is shown may be smaller than the grid.
  const bool holds_middle = dot(d, p.to_sphere(0, 0.5, 0.5)) > std::cos(angle);
  if (covered == 0) return holds_middle ? Coverage::mixed : Coverage::none;
  return covered == kRings * kSpokes ? Coverage::full : Coverage::mixed;
}

/// The angle from a texel's centre to the farthest of its valid positions, found on a 5×5 grid.
double half_width(const Map& map, int chart, int x, int y) {
  double widest = 0;
  const Vec3d centre =
      map.parameterization.to_sphere(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height());
  for (int k = 0; k < 25; ++k) {
    const double u = (x + (k % 5) / 4.0) / map.width(), v = (y + (k / 5) / 4.0) / map.height();
    if (!map.parameterization.valid(chart, u, v)) continue;
    const double cosine = dot(centre, map.parameterization.to_sphere(chart, u, v));
    widest = std::max(widest, std::acos(clamp(cosine, -1.0, 1.0)));
  }
  return widest;
}

TEST_P(ResampleCrossTest, AConstantStaysConstantAndTheRestIsFilled) {
  for (const int source_size : {5, 24}) {
    const Map source = rendered(GetParam(), source_size, [](const Vec3d&) { return 2.5; });
    for (const std::string& name : sphere::parameterization_names()) {
      Map target = make_map(name, 9);
      for (const Filter filter : kFilters) {
        ResampleOptions options = with(filter);
        options.fill = {-4};
        options.allow_ringing = source_size == 24;
        // Lanczos: 64 float weights, and no range to clamp them to.
        const double rounding = options.allow_ringing ? 1e-5 : 2.5e-6;
        if (source_size > 5) options.rotation = rotation_from_yaw_pitch_roll(20, 35, 10);
        resample(source, target, options);
        for (int chart = 0; chart < target.charts(); ++chart) {
          for (int y = 0; y < target.height(); ++y) {
            for (int x = 0; x < target.width(); ++x) {
              const float value = *target.level.chart(chart).at(x, y);
              const std::string where = name + " " + std::string(name_of(filter)) + " " +
                                        std::to_string(chart) + ": " + std::to_string(x) + "," +
                                        std::to_string(y);
              if (!is_valid_texel(target, chart, x, y)) {
                const ChartSize size{target.width(), target.height()};
                if (!target.parameterization.filled_to_edges() &&
                    is_outside_texel(target.parameterization, size, chart, x, y)) {
                  ASSERT_EQ(value, -4) << std::setprecision(9) << value << " " << where;
                }
                continue;
              }
              const Vec3d d = transpose(options.rotation) * direction_at(target, chart, x, y);
              // Texels of `automatic` that straddle the rim are a mixture.
              const double reach = filter == Filter::automatic
                                       ? std::min(kPi, 0.05 + 1.2 * half_width(target, chart, x, y))
                                       : 1e-5;
              const Coverage covered = coverage_around(source.parameterization, d, reach);
              ASSERT_GE(value, covered == Coverage::full ? 2.5 - rounding : -4.00001)
                  << std::setprecision(9) << value << " " << where;
              ASSERT_LE(value, covered == Coverage::none ? -3.99999 : 2.5 + rounding)
                  << std::setprecision(9) << value << " " << where;
            }
          }
        }
      }
    }
  }
}

/// How a map was read at a direction: in what texel, and how well.
struct Reading {
  double texel = 0;      // the texel's diameter there, radians
  bool at_edge = false;  // the 4×4 texels around it reach over the chart's edge
  double error = 0;
};

Reading reading_at(const Map& source, const Vec3d& d, double value) {
  const auto& p = source.parameterization;
  const auto position = p.from_sphere(d);
  const int chart = static_cast<int>(position.chart);
  Reading reading;
  reading.error = std::fabs(value - smooth(d));
  for (const double i : {-1.0, 0.0, 1.0}) {
    for (const double j : {-1.0, 0.0, 1.0}) {
      const auto at = [&](double texels) {
        return std::pair{position.u + texels * i / source.width(), position.v + texels * j / source.height()};
      };
      const auto [u, v] = at(2);
      if (u < 0 || u > 1 || v < 0 || v > 1 || !p.valid(chart, u, v)) reading.at_edge = true;
      const auto [near_u, near_v] = at(0.5);
      reading.texel = std::max(reading.texel, 2 * length(p.to_sphere(chart, near_u, near_v) - d));
    }
  }
  return reading;
}

template <class Body>
void for_each_reading(const Map& source, const Map& target, const Body& body) {
  for_each_valid_texel(target, [&](int chart, int x, int y) {
    const Vec3d d = direction_at(target, chart, x, y);
    if (coverage_around(source.parameterization, d, 1e-5) != Coverage::full) return;
    body(reading_at(source, d, static_cast<double>(*target.level.chart(chart).at(x, y))));
  });
}

/// The function's slope is at most 0.55. At kinks (the octahedron's creases), at poles and at rims the
/// interpolation may be displaced, but by less than half a texel.
TEST_P(ResampleCrossTest, ASmoothFunctionIsNowhereDisplacedByHalfATexel) {
  const Map source = rendered(GetParam(), 32, smooth);
  for (const std::string& name : sphere::parameterization_names()) {
    Map target = make_map(name, 41);
    resample(source, target, with(Filter::bicubic));
    double worst = 0;
    for_each_reading(source, target,
                     [&](const Reading& r) { worst = std::max(worst, (r.error - 1e-5) / (0.55 * r.texel)); });
    EXPECT_LT(worst, 0.5) << name;
  }
}

/// Parameterizations that continue past their edges and whose texels there are not degenerate: not those with
/// rims, nor equal-area, whose texels at the poles are thin.
std::vector<std::string> names_without_rims() {
  std::vector<std::string> names;
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = sphere::AnyParameterization::make(name);
    if (p.whole_world() && p.valid(0, 1e-6, 1e-6) && name != "equal-area") names.push_back(name);
  }
  return names;
}

class ResampleEdgeTest : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ResampleEdgeTest, ::testing::ValuesIn(names_without_rims()), test_name);

/// Where charts meet without a rim, an edge must not be seen: errors beside it are at most twice those inside
/// and two hundredths of a texel's slope more (creases meet at the corners of octahedra and of HEALPix).
TEST_P(ResampleEdgeTest, ErrorsAtAnEdgeAreLikeThoseInside) {
  const Map source = rendered(GetParam(), 32, smooth);
  for (const Filter filter : kFilters) {
    double inside = 0, edge = 0;
    for (const char* name : {"cube", "latlong"}) {
      Map target = make_map(name, name[0] == 'c' ? 47 : 119);
      resample(source, target, with(filter));
      for_each_reading(source, target, [&](const Reading& r) {
        double& worst = r.at_edge ? edge : inside;
        worst = std::max(worst, r.error / r.texel);
      });
    }
    // A mean is not the value in the middle, and at a pole its texels are the longest.
    EXPECT_LT(edge, 2 * inside + (filter == Filter::automatic ? 0.05 : 0.02)) << name_of(filter);
  }
}

}  // namespace
}  // namespace welkin
