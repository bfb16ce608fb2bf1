#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"

/// What the tests of maps share: maps of every parameterization, functions to fill them with, and ways to
/// compare.
namespace welkin::cases {

using Function = std::function<double(const Vec3d& d)>;

inline std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

/// Windows of a lat-long: a crop, a half, across the seam, all around, turned, tiny, to a pole.
inline std::vector<std::string> windows() {
  return {"latlong,left=-90,right=90,top=45,bottom=-45",
          "latlong,left=0",
          "latlong,left=90,right=270,top=60,bottom=-20",
          "latlong,top=30,bottom=-60",
          "latlong,left=0,right=360",
          "latlong,left=37,right=38,top=61,bottom=60",
          "latlong,left=-70,right=230,top=90,bottom=20"};
}

/// Every parameterization, and windows.
inline std::vector<std::string> names_and_windows() {
  std::vector<std::string> specs = sphere::parameterization_names();
  for (const std::string& window : windows()) specs.push_back(window);
  return specs;
}

/// What the Error says that the work throws; `done` when it throws none.
inline std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "done";
}

/// A black map whose charts are about size × size texels, square ones.
inline Map make_map(const std::string& spec, int size, int channels = 1) {
  const auto p = sphere::AnyParameterization::make(spec);
  const double side = std::sqrt(p.aspect());
  const auto texels = [](double extent) { return std::max(1, static_cast<int>(std::lround(extent))); };
  return Map(p, texels(size * side), texels(size / side), channels);
}

inline bool is_valid_texel(const Map& map, int chart, int x, int y) {
  return map.parameterization.valid(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height());
}

/// The world's direction at a texel's centre.
inline Vec3d direction_at(const Map& map, int chart, int x, int y) {
  return transpose(map.orientation) *
         map.parameterization.to_sphere(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height());
}

/// body(chart, x, y) for all valid texels.
template <class Body>
void for_each_valid_texel(const Map& map, const Body& body) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        if (is_valid_texel(map, chart, x, y)) body(chart, x, y);
      }
    }
  }
}

/// Channel c of every valid texel takes (c+1)·f; the borders are filled.
inline void render(Map& map, const Function& f) {
  for_each_valid_texel(map, [&](int chart, int x, int y) {
    const double value = f(direction_at(map, chart, x, y));
    float* texel = map.level.chart(chart).at(x, y);
    for (int c = 0; c < map.channels(); ++c) texel[c] = static_cast<float>((c + 1) * value);
  });
  fill_borders(map);
}

inline Map rendered(const std::string& spec, int size, const Function& f, int channels = 1) {
  Map map = make_map(spec, size, channels);
  render(map, f);
  return map;
}

/// Positive, of degree 3: every face, edge and pole has its own slope.
inline double smooth(const Vec3d& d) {
  return 1 + 0.25 * d.x - 0.2 * d.y + 0.15 * d.z + 0.1 * d.y * d.z + 0.15 * d.x * d.z + 0.1 * d.x * d.y * d.z;
}

/// A sum of `count` plane waves of up to `frequency` radians per unit, within −1…1.
inline Function waves(int count, double frequency) {
  std::mt19937 random(5);
  std::normal_distribution<double> along;
  std::vector<Vec3d> ways;
  for (int i = 0; i < count; ++i) {
    const Vec3d way{along(random), along(random), along(random)};
    ways.push_back((frequency * (i + 1) / count / length(way)) * way);
  }
  return [ways](const Vec3d& d) {
    double sum = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) sum += std::sin(dot(ways[i], d) + static_cast<double>(i));
    return sum / static_cast<double>(ways.size());
  };
}

/// Rings about an oblique axis whose frequency grows to `cycles` per radian at the far end.
inline Function zone_plate(double cycles) {
  return [cycles](const Vec3d& d) {
    const double angle = std::acos(clamp(dot(d, normalize(Vec3d{0.3, 0.5, 1.0})), -1.0, 1.0));
    return 0.5 + 0.5 * std::cos(cycles * angle * angle);
  };
}

/// Black and white cells of a grid of `cells` to the radian in space: no line of it follows a
/// parameterization.
inline Function checker(double cells) {
  return [cells](const Vec3d& d) {
    const Vec3d t{0.8 * d.x + 0.6 * d.y, -0.6 * d.x + 0.8 * d.y, d.z};
    const double sum = std::floor(cells * t.x) + std::floor(cells * t.y) + std::floor(cells * t.z);
    return sum - 2 * std::floor(sum / 2);
  };
}

/// Thin bright lines of latitude and longitude, which meet at the poles.
inline Function lines(int meridians) {
  return [meridians](const Vec3d& d) {
    const double turns = std::atan2(d.x, d.z) / (2 * kPi) * meridians;
    const double height = std::asin(clamp(d.y, -1.0, 1.0)) / (2 * kPi) * meridians;
    const auto line = [](double t) { return std::fabs(t - std::round(t)) < 0.06; };
    return line(turns) || line(height) ? 1.0 : 0.0;
  };
}

/// The largest difference of a channel over all texels.
inline double largest_difference(const Map& a, const Map& b) {
  double largest = 0;
  for (int chart = 0; chart < a.charts(); ++chart) {
    for (int y = 0; y < a.height(); ++y) {
      const float *p = a.level.chart(chart).row(y), *q = b.level.chart(chart).row(y);
      for (int i = 0; i < a.width() * a.channels(); ++i) {
        const double difference = std::fabs(static_cast<double>(p[i]) - static_cast<double>(q[i]));
        largest = difference <= largest ? largest : difference;  // NaN is larger
      }
    }
  }
  return largest;
}

/// Peak signal-to-noise ratio of maps of range 0…1, dB, every texel alike.
inline double psnr(const Map& a, const Map& b) {
  double sum = 0;
  for (int chart = 0; chart < a.charts(); ++chart) {
    for (int y = 0; y < a.height(); ++y) {
      const float *p = a.level.chart(chart).row(y), *q = b.level.chart(chart).row(y);
      for (int i = 0; i < a.width() * a.channels(); ++i) {
        sum += std::pow(static_cast<double>(p[i]) - static_cast<double>(q[i]), 2);
      }
    }
  }
  const double values = static_cast<double>(a.charts()) * a.height() * a.width() * a.channels();
  return -10 * std::log10(sum / values + 1e-30);
}

/// The mean over the covered sphere of channel 0. Solid angles of texels are integrated from 8×8 points of
/// density.
inline double mean_over_sphere(const Map& map) {
  constexpr int kPoints = 8;
  double sum = 0, total = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        double solid_angle = 0;
        for (int k = 0; k < kPoints * kPoints; ++k) {
          const double u = (x + (k % kPoints + 0.5) / kPoints) / map.width();
          const double v = (y + (k / kPoints + 0.5) / kPoints) / map.height();
          const auto& p = map.parameterization;
          if (p.valid(chart, u, v)) solid_angle += p.solid_angle_density(chart, u, v);
        }
        total += solid_angle;
        sum += solid_angle * static_cast<double>(*map.level.chart(chart).at(x, y));
      }
    }
  }
  return sum / total;
}

}  // namespace welkin::cases
