#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "welkin/map/borders.h"
#include "welkin/map/map.h"
#include "welkin/map/texel_points.h"
#include "welkin/math/angles.h"

/// What the tests and the benchmark of lights share: maps of even discs whose texels are exact to a
/// thousandth.
namespace welkin::cases {

/// An even disc.
struct Disc {
  Vec3d direction;
  double diameter;  ///< radians
  double radiance;  ///< above the background

  double solid_angle() const { return 2 * kPi * (1 - std::cos(diameter / 2)); }
  double irradiance() const { return radiance * solid_angle(); }
};

/// Adds a disc to a map, in every channel but A, or times `colour` where there are three: each texel's mean
/// over parts² positions, weighted by density. Borders are filled.
inline void add_disc(Map& map, const Disc& disc, const std::vector<double>& colour = {1, 1, 1},
                     int parts = 32) {
  const auto& p = map.parameterization;
  const Vec3d axis = map.orientation * disc.direction;
  const double radius = disc.diameter / 2, edge = std::cos(radius);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const auto at = [&](double across, double down) {
          return p.to_sphere(chart, (x + across) / map.width(), (y + down) / map.height());
        };
        // Only texels of over a radian are larger than this.
        if (dot(at(0.5, 0.5), axis) < std::cos(std::min(radius + 0.5, kPi))) continue;
        double reach = radius;
        for (int k = 0; k < 4; ++k)
          reach = std::max(reach, radius + angle_between(at(k % 2, k / 2), at(0.5, 0.5)));
        if (angle_between(at(0.5, 0.5), axis) > reach ||
            !p.valid(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height()))
          continue;
        double inside = 0, total = 0;
        // A texel within the disc needs no positions.
        const double middle = angle_between(at(0.5, 0.5), axis);
        const bool whole = middle + (reach - radius) < 0.95 * radius;
        for (int k = 0; k < (whole ? 1 : parts * parts); ++k) {
          const double across = (k % parts + 0.5) / parts, down = (k / parts + 0.5) / parts;
          const double density =
              p.solid_angle_density(chart, (x + across) / map.width(), (y + down) / map.height());
          total += density;
          if (whole || dot(at(across, down), axis) >= edge) inside += density;
        }
        float* texel = map.level.chart(chart).at(x, y);
        for (int c = 0; c < map.channels(); ++c) {
          if (map.channel_names[static_cast<std::size_t>(c)] == "A") continue;
          const double tint = map.channels() >= 3 && c < 3 ? colour[static_cast<std::size_t>(c)] : 1;
          texel[c] += static_cast<float>(tint * disc.radiance * inside / total);
        }
      }
    }
  }
  fill_borders(map);
}

/// Solid angles of all texels of maps like this one, chart by chart, row by row.
inline std::vector<float> solid_angles_of(const Map& map) {
  const std::size_t width = static_cast<std::size_t>(map.width());
  std::vector<float> omega(width * static_cast<std::size_t>(map.charts() * map.height()));
  for (int row = 0; row < map.charts() * map.height(); ++row) {
    centred_solid_angles(map.parameterization, {map.width(), map.height()}, row / map.height(),
                         row % map.height(), omega.data() + static_cast<std::size_t>(row) * width);
  }
  return omega;
}

/// ∫ of each channel, dω.
inline std::vector<double> energy_of(const Map& map, const std::vector<float>& omega) {
  std::vector<double> sums(static_cast<std::size_t>(map.channels()));
  const float* weight = omega.data();
  for (int row = 0; row < map.charts() * map.height(); ++row) {
    const float* texel = map.level.chart(row / map.height()).row(row % map.height());
    for (int x = 0; x < map.width(); ++x, texel += map.channels(), ++weight) {
      for (int c = 0; c < map.channels(); ++c)
        sums[static_cast<std::size_t>(c)] += static_cast<double>(*weight) * static_cast<double>(texel[c]);
    }
  }
  return sums;
}
inline std::vector<double> energy_of(const Map& map) {
  return energy_of(map, solid_angles_of(map));
}

/// Of texels with a solid angle.
inline double largest_value(const Map& map, const std::vector<float>& omega) {
  float largest = 0;
  const float* weight = omega.data();
  for (int row = 0; row < map.charts() * map.height(); ++row) {
    const float* texel = map.level.chart(row / map.height()).row(row % map.height());
    for (int x = 0; x < map.width(); ++x, texel += map.channels(), ++weight) {
      if (*weight > 0) largest = std::max(largest, *std::max_element(texel, texel + map.channels()));
    }
  }
  return static_cast<double>(largest);
}
inline double largest_value(const Map& map) {
  return largest_value(map, solid_angles_of(map));
}

}  // namespace welkin::cases
