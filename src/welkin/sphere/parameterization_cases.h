#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "welkin/sphere/all.h"

/// What the tests of parameterizations share: which ones, at which parameters, and where they are looked at.
namespace welkin::sphere::cases {

using Pack = xsimd::batch<float>;

/// A window of the lat-long.
template <int kLeft, int kRight, int kTop, int kBottom>
struct Window : LatLongWindow {
  Window() {
    left = kLeft;
    right = kRight;
    top = kTop;
    bottom = kBottom;
    update();
  }
};

/// A parameterization in each kind of number, behind calls: the laws are compiled once, and not for each of
/// the seventy.
class Case {
 public:
  std::string name;
  std::string_view kind;  ///< kName
  int charts = 1;
  double coverage = 0;
  bool density_by_row = false;

  virtual ~Case() = default;

  virtual Vec3d to_sphere(int chart, double u, double v) const = 0;
  virtual Vec3<float> to_sphere(int chart, float u, float v) const = 0;
  virtual Vec3<Pack> to_sphere(int chart, const Pack& u, const Pack& v) const = 0;

  virtual ChartPoint<double> from_sphere(const Vec3d& d) const = 0;
  virtual ChartPoint<float> from_sphere(const Vec3<float>& d) const = 0;
  virtual ChartPoint<Pack> from_sphere(const Vec3<Pack>& d) const = 0;

  virtual bool covers(const Vec3d& d) const = 0;
  virtual bool covers(const Vec3<float>& d) const = 0;
  virtual Mask<Pack> covers(const Vec3<Pack>& d) const = 0;

  virtual bool valid(int chart, double u, double v) const = 0;
  virtual Mask<Pack> valid(int chart, const Pack& u, const Pack& v) const = 0;

  virtual double solid_angle_density(int chart, double u, double v) const = 0;
  virtual float solid_angle_density(int chart, float u, float v) const = 0;
  virtual Pack solid_angle_density(int chart, const Pack& u, const Pack& v) const = 0;
};

/// Every registered parameterization, and those with parameters at a few other values.
const std::vector<std::unique_ptr<const Case>>& all_cases();

/// Holds a law to each of them; a failure names which.
template <class Law>
void for_all(const Law& law) {
  for (const auto& p : all_cases()) {
    SCOPED_TRACE(p->name);
    law(*p);
  }
}

struct Position {
  int chart;
  double u, v;
};

/// Points spread evenly over the sphere (a Fibonacci spiral).
inline std::vector<Vec3d> spread_directions(int count) {
  std::vector<Vec3d> directions;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, side = std::sqrt(1 - y * y), angle = 2.3999632297286533 * i;
    directions.push_back({side * std::cos(angle), y, side * std::sin(angle)});
  }
  return directions;
}

/// Axes, diagonals of the coordinate planes and octants, and directions an epsilon away from each.
inline std::vector<Vec3d> special_directions() {
  std::vector<Vec3d> directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3d d{1.0 * x, 1.0 * y, 1.0 * z};
        directions.push_back(normalize(d));
        for (const Vec3d& nudge : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
          for (const double size : {1e-3, 1e-6, 1e-9}) {
            directions.push_back(normalize(d + size * nudge));
            directions.push_back(normalize(d - size * nudge));
          }
        }
      }
    }
  }
  return directions;
}

inline std::vector<Vec3d> all_directions() {
  std::vector<Vec3d> directions = special_directions();
  for (const Vec3d& d : spread_directions(20000)) directions.push_back(d);
  return directions;
}

/// Random positions of every chart in [low, high]².
inline std::vector<Position> random_positions(int charts, int count, double low, double high) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(low, high);
  std::vector<Position> positions;
  for (int i = 0; i < count; ++i) {
    const double u = along(random), v = along(random);
    positions.push_back({i % charts, u, v});
  }
  return positions;
}

/// A lattice over every chart that stays off all the lines of symmetry where a chart may have a crease.
inline std::vector<Position> lattice_positions(int charts, int size) {
  std::vector<Position> positions;
  for (int chart = 0; chart < charts; ++chart) {
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) positions.push_back({chart, (i + 0.37) / size, (j + 0.61) / size});
    }
  }
  return positions;
}

/// Whether the position and those `margin` around it are valid.
template <class P>
bool well_inside(const P& p, const Position& at, double margin) {
  for (const double du : {-margin, margin}) {
    for (const double dv : {-margin, margin}) {
      const double u = at.u + du, v = at.v + dv;
      if (u < 0 || u > 1 || v < 0 || v > 1 || !p.valid(at.chart, u, v)) return false;
    }
  }
  return true;
}

inline double distance(const Vec3d& a, const Vec3d& b) {
  return length(a - b);
}

/// How far the direction at a position moves when u and v are off by up to `error`: what a rounding error of
/// that size in (u, v) excuses, at singular points too.
template <class P>
double wobble(const P& p, int chart, double u, double v, double error) {
  const Vec3d d = p.to_sphere(chart, u, v);
  double maximum = 0;
  for (const double du : {-error, 0.0, error}) {
    for (const double dv : {-error, 0.0, error}) {
      maximum = std::max(maximum, distance(d, p.to_sphere(chart, u + du, v + dv)));
    }
  }
  return maximum;
}

/// The partial derivatives of the direction by u and v, by central differences.
struct Tangents {
  Vec3d along_u, along_v;
};

template <class P>
Tangents tangents(const P& p, const Position& at, double step) {
  const double scale = 0.5 / step;
  return {scale * (p.to_sphere(at.chart, at.u + step, at.v) - p.to_sphere(at.chart, at.u - step, at.v)),
          scale * (p.to_sphere(at.chart, at.u, at.v + step) - p.to_sphere(at.chart, at.u, at.v - step))};
}

}  // namespace welkin::sphere::cases
