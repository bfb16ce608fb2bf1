#include "welkin/prefilter/point_grid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>

#include "welkin/base/error.h"
#include "welkin/map/map_cases.h"

namespace welkin::prefilter {
namespace {

using namespace cases;
using sphere::AnyParameterization;

/// Gauss's rule of four points in 0 … 1.
constexpr double kNodes[4] = {0.0694318442029737, 0.330009478207572, 0.669990521792428, 0.930568155797026};
constexpr double kWeights[4] = {0.173927422568727, 0.326072577431273, 0.326072577431273, 0.173927422568727};

/// ∫ f over one texel, by parts² · 4² points.
double texel_integral(const Map& map, int chart, int x, int y, int parts, const Function& f) {
  double sum = 0;
  for (int k = 0; k < 16 * parts * parts; ++k) {
    const int i = k % (4 * parts), j = k / (4 * parts);
    const double u = (x + (i / 4 + kNodes[i % 4]) / parts) / map.width();
    const double v = (y + (j / 4 + kNodes[j % 4]) / parts) / map.height();
    sum += kWeights[i % 4] * kWeights[j % 4] * map.parameterization.solid_angle_density(chart, u, v) *
           f(map.parameterization.to_sphere(chart, u, v));
  }
  return sum / (static_cast<double>(parts * parts) * map.width() * map.height());
}

bool is_whole(const Map& map, int chart, int x, int y) {
  for (int k = 0; k < 81; ++k) {
    const double u = (x + k % 9 / 8.0) / map.width(), v = (y + k / 9 / 8.0) / map.height();
    if (!map.parameterization.valid(chart, u, v)) return false;
  }
  return true;
}

/// Noise of 0 … 1 with a few lamps; black where a texel isn't whole.
Map noise(const AnyParameterization& p, int width, int height, int channels = 2) {
  Map map(p.at_size(width, height), width, height, channels);
  std::mt19937 random(6);
  std::uniform_real_distribution<float> value;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!is_whole(map, chart, x, y)) continue;
        float* texel = map.level.chart(chart).at(x, y);
        for (int c = 0; c < channels; ++c) texel[c] = value(random) < 0.01f ? 50 : value(random);
      }
    }
  }
  return map;
}

/// body(direction of column x + across, lane's weight, of channel c)
template <class Body>
void for_each_point(const PointGrid& points, int channel, const Body& body) {
  for (int y = 0; y < points.height; ++y) {
    const int north = std::min(y, points.height - 1 - y), lane = north % 8 + (y == north ? 0 : 8);
    const double theta = (y + 0.5) * kPi / points.height;
    for (int x = 0; x < points.width; ++x) {
      body(theta, x, static_cast<double>(points.at(north / 8, channel)[x * 16 + lane]));
    }
  }
}

/// Σ weights · f, f averaged over a point's column where points are boxes.
double weighted_sum(const PointGrid& points, int channel, int parts, const Function& f) {
  double sum = 0;
  for_each_point(points, channel, [&](double theta, int x, double weight) {
    if (weight == 0) return;
    double value = 0;
    for (int k = 0; k < (points.boxes ? 4 * parts : 1); ++k) {
      const double across = points.boxes ? (k / 4 + kNodes[k % 4]) / parts : 0.5;
      const double longitude = 2 * kPi * (0.5 - (x + across) / points.width);
      value +=
          (points.boxes ? kWeights[k % 4] / parts : 1) *
          f({std::sin(theta) * std::sin(longitude), std::cos(theta), std::sin(theta) * std::cos(longitude)});
    }
    sum += weight * value;
  });
  return sum;
}

double integral(const Map& map, int channel, int parts, const Function& f) {
  double sum = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const double radiance = static_cast<double>(map.level.chart(chart).at(x, y)[channel]);
        if (radiance != 0) sum += radiance * texel_integral(map, chart, x, y, parts, f);
      }
    }
  }
  return sum;
}

double one(const Vec3d& /*d*/) {
  return 1;
}

struct Shape {
  std::string parameterization;
  int width, height;
};

std::vector<Shape> shapes() {
  std::vector<Shape> list{{"latlong", 64, 32}, {"latlong", 30, 90}, {"latlong", 8, 64},
                          {"latlong", 37, 19}, {"latlong", 64, 31}, {"latlong", 14, 7},
                          {"latlong", 4, 2},   {"latlong", 2, 1},   {"latlong", 1, 1},
                          {"latlong", 3, 1},   {"latlong", 512, 2}, {"cube", 1, 1},
                          {"cube", 5, 5},      {"cube", 21, 21},    {"octahedral", 40, 40}};
  for (const std::string& name : sphere::parameterization_names()) {
    const Map map = make_map(name, 16);
    list.push_back({name, map.width(), map.height()});
  }
  return list;
}

/// Float sums: 2e-6. Where the density has a kink, as along the edges of an octahedron, this test's own
/// quadrature misses more.
TEST(PointGrid, WeightsAddUpToTheMapsIntegral) {
  for (const Shape& shape : shapes()) {
    const Map map = noise(AnyParameterization::make(shape.parameterization), shape.width, shape.height);
    const bool kinks = shape.parameterization.find("octahedral") != std::string::npos;
    const double whole[] = {integral(map, 0, 2, one), integral(map, 1, 2, one)};
    for (const int degree : {4, 70}) {
      const PointGridPlan plan(map.parameterization, {map.width(), map.height()}, degree);
      const PointGrid points = make_point_grid(map, plan, {});
      EXPECT_GE(points.height, degree + 2);
      for (int c = 0; c < 2; ++c) {
        EXPECT_NEAR(weighted_sum(points, c, 1, one) / whole[c], 1,
                    shape.width < 4 ? 3e-5
                    : kinks         ? 1e-4
                                    : 2e-6)
            << shape.parameterization << ' ' << shape.width << ' ' << degree;
      }
    }
  }
}

/// The channels of one map are the maps of one channel each.
TEST(PointGrid, ChannelsAreIndependent) {
  for (const Shape& shape : {Shape{"latlong", 24, 12}, Shape{"latlong", 6, 12}, Shape{"cube", 6, 6}}) {
    for (const int channels : {1, 4, 7}) {
      const Map map =
          noise(AnyParameterization::make(shape.parameterization), shape.width, shape.height, channels);
      const PointGridPlan plan(map.parameterization, {map.width(), map.height()}, 10);
      const PointGrid together = make_point_grid(map, plan, {});
      for (int c = 0; c < channels; ++c) {
        Map single(map.parameterization, map.width(), map.height(), 1);
        for_each_valid_texel(map, [&](int chart, int x, int y) {
          *single.level.chart(chart).at(x, y) = map.level.chart(chart).at(x, y)[c];
        });
        const PointGrid alone = make_point_grid(single, plan, {});
        std::vector<double> weights;
        for_each_point(alone, 0, [&](double, int, double weight) { weights.push_back(weight); });
        std::size_t i = 0;
        for_each_point(together, c, [&](double, int, double weight) { EXPECT_EQ(weight, weights[i++]); });
      }
    }
  }
}

TEST(PointGrid, DependOnNothingButTheMap) {
  for (const Shape& shape : {Shape{"latlong", 64, 32}, Shape{"latlong", 16, 32}, Shape{"cube", 16, 16}}) {
    const Map map = noise(AnyParameterization::make(shape.parameterization), shape.width, shape.height);
    // Borders aren't read.
    Map dirty = noise(map.parameterization, shape.width, shape.height);
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = -kBorder; y < map.height() + kBorder; ++y) {
        for (int x = -kBorder; x < map.width() + kBorder; ++x) {
          const bool inside = x >= 0 && x < map.width() && y >= 0 && y < map.height();
          if (!inside) dirty.level.chart(chart).at(x, y)[1] = std::numeric_limits<float>::quiet_NaN();
        }
      }
    }
    const PointGridPlan plan(map.parameterization, {map.width(), map.height()}, 20);
    const PointGrid many = make_point_grid(map, plan, {});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const PointGrid single = make_point_grid(dirty, plan, {});
    EXPECT_EQ(std::vector<float>(many.lanes.data(), many.lanes.data() + many.lanes.size()),
              std::vector<float>(single.lanes.data(), single.lanes.data() + single.lanes.size()));
  }
}

/// A texel at a disc's rim is weighted by the part of it within: a constant picture measures as much as the
/// map covers.
TEST(PointGrid, DiscsMeasureWhatTheyCover) {
  for (const char* name : {"angular", "fisheye-equidistant", "half-cube", "paraboloid", "hemi-octahedral"}) {
    Map map = make_map(name, 32);
    render(map, [](const Vec3d&) { return 1; });
    for (const int degree : {5, 90}) {
      const PointGridPlan plan(map.parameterization, {map.width(), map.height()}, degree);
      EXPECT_NEAR(weighted_sum(make_point_grid(map, plan, {}), 0, 1, one) / map.parameterization.coverage(),
                  1, 3e-5)
          << name;
    }
  }
}

/// One lit texel at a pole, at the seam, and at both: its weight lies where it is.
TEST(PointGrid, OneTexelLiesWhereItIs) {
  struct Case {
    Shape shape;
    int x, y;
  };
  const Case cases[] = {
      {{"latlong", 32, 16}, 0, 0}, {{"latlong", 32, 16}, 31, 8}, {{"latlong", 32, 16}, 31, 15},
      {{"latlong", 8, 16}, 0, 15}, {{"latlong", 33, 17}, 0, 0},  {{"latlong", 33, 17}, 32, 16},
      {{"cube", 8, 8}, 0, 0},      {{"cube", 9, 9}, 4, 4},       {{"octahedral", 8, 8}, 0, 0}};
  for (const Case& each : cases) {
    const auto p = AnyParameterization::make(each.shape.parameterization);
    for (int chart = 0; chart < p.charts(); ++chart) {
      Map map(p, each.shape.width, each.shape.height, 1);
      *map.level.chart(chart).at(each.x, each.y) = 1e30f;
      const PointGrid points = make_point_grid(map, PointGridPlan(p, {map.width(), map.height()}, 16), {});
      const double whole = 1e30 * texel_integral(map, chart, each.x, each.y, 4, one);
      EXPECT_NEAR(weighted_sum(points, 0, 1, one) / whole, 1, 1e-5);
      // Polynomials of degree one: the centroid.
      for (const Function& f :
           {Function([](const Vec3d& d) { return d.x; }), Function([](const Vec3d& d) { return d.y; }),
            Function([](const Vec3d& d) { return d.z; })}) {
        const double centroid = 1e30 * texel_integral(map, chart, each.x, each.y, 4, f) / whole;
        EXPECT_NEAR(weighted_sum(points, 0, 8, f) / whole, centroid, 1e-4)
            << each.shape.parameterization << ' ' << chart;
      }
    }
  }
}

TEST(PointGrid, AreCancelled) {
  for (const char* name : {"latlong", "cube"}) {
    const Map map = make_map(name, 16);
    Monitor monitor;
    monitor.cancelled = [] { return true; };
    const PointGridPlan plan(map.parameterization, {map.width(), map.height()}, 16);
    EXPECT_THROW(make_point_grid(map, plan, monitor), Cancelled);
  }
}

/// A smooth lobe of the light that the degree resolves: e^(κ(cos θ − 1)), κ = degree²/18, whose coefficient
/// there is about e^−9. Relative to its mean over all directions the polynomials' error is under 1e-4 where
/// the grid is fine, else measured: up to 2e-3 along rows, 5e-3 texel by texel.
TEST(PointGrid, SmoothFunctionsIntegrateAsOverTexels) {
  for (const Shape& shape : shapes()) {
    const Map map = noise(AnyParameterization::make(shape.parameterization), shape.width, shape.height);
    const double whole = integral(map, 1, 1, one);
    for (const int degree : {4, 20, 70}) {
      const PointGridPlan plan(map.parameterization, {map.width(), map.height()}, degree);
      const PointGrid points = make_point_grid(map, plan, {});
      const double kappa = degree * degree / 18.0;
      // Parts of a texel and of a box that are narrow beside the lobe.
      const int parts = 1 + degree / std::min(map.width(), 2 * map.height());
      const bool kinks = shape.parameterization.find("octahedral") != std::string::npos;
      const double fine = kinks ? 5e-4 : 1e-4,
                   coarse = plan.way == PointGridPlan::Way::spread_texels ? 7e-3 : 3e-3;
      const Vec3d axis = degree == 20 ? Vec3d{0, 1, 0} : normalize(Vec3d{-0.3, -0.8, 0.4});
      const Function lobe = [&](const Vec3d& d) { return std::exp(kappa * (dot(d, axis) - 1)); };
      const double mean = whole / (2 * kappa);
      EXPECT_NEAR(weighted_sum(points, 1, 2 * parts, lobe) / mean, integral(map, 1, parts, lobe) / mean,
                  degree == 4 ? fine : coarse)
          << shape.parameterization << ' ' << shape.width << ' ' << degree;
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
