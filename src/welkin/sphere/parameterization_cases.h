#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "welkin/sphere/all.h"

/// What the tests of parameterizations share: which ones, at which parameters, and where they are looked at.
namespace welkin::sphere::cases {

/// A parameterization with its one parameter set.
template <class P, int kParameter>
struct With : P {
  With() : P(kParameter) {}
};

template <class List, class... More>
struct Joined;
template <class... P, class... More>
struct Joined<TypeList<P...>, More...> {
  using Types = ::testing::Types<P..., More...>;
};

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

/// A frame in which everything is set: an aspect of 1.6, a shift, vertical or diagonal field of view. Of
/// radial lenses the rim crosses it.
template <class P, int kFov, bool kDiagonal, int kRim = 0>
struct Shifted : P {
  Shifted() {
    (kDiagonal ? this->dfov : this->vfov) = kFov;
    this->ratio = 1.6;
    this->right = 0.21;
    this->up = -0.13;
    if (kRim > 0) this->rim = kRim;
    this->shape = {0.7, kDiagonal ? 0.4 : 0.0};
    this->update();
  }
};

/// Every registered parameterization, and those with parameters at a few other values.
using Cases =
    Joined<AllParameterizations, With<MirrorBall, 5>, With<MirrorBall, 2>, With<FisheyeEquidistant, 220>,
           With<FisheyeEquidistant, 360>, With<FisheyeEquisolid, 220>, With<FisheyeEquisolid, 360>,
           With<FisheyeOrthographic, 120>, With<FisheyeStereographic, 220>, With<FisheyeStereographic, 350>,
           With<Cylinder, 150>, With<Mercator, 120>, Window<-90, 90, 45, -45>, Window<0, 180, 90, -90>,
           Window<90, 270, 60, -20>, Window<-180, 180, 30, -60>, Window<0, 360, 90, -90>,
           Window<37, 38, 61, 60>, Window<-70, 230, 90, 20>, Window<130, 200, -30, -90>, With<Vr180, 220>,
           With<Vr180, 60>, Shifted<Perspective, 70, true>, Shifted<Pannini, 60, false>,
           Shifted<Pannini, 120, true>, Shifted<Cylindrical, 120, true>, Shifted<Stereographic, 240, false>,
           Shifted<Equidistant, 190, false, 230>, Shifted<Equisolid, 330, true, 250>,
           Shifted<Orthographic, 100, false, 150>, With<Perspective, 150>, With<Pannini, 300>,
           With<Cylindrical, 360>, With<Equidistant, 360>>::Types;

struct CaseName {
  template <class P>
  static std::string GetName(int index) {
    std::string name = P::kName;
    for (char& c : name) c = c == '-' ? '_' : c;
    return name + "_" + std::to_string(index);
  }
};

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
template <class P>
std::vector<Position> random_positions(int count, double low, double high) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(low, high);
  std::vector<Position> positions;
  for (int i = 0; i < count; ++i) {
    const double u = along(random), v = along(random);
    positions.push_back({i % P::kCharts, u, v});
  }
  return positions;
}

/// A lattice over every chart that stays off all the lines of symmetry where a chart may have a crease.
template <class P>
std::vector<Position> lattice_positions(int size) {
  std::vector<Position> positions;
  for (int chart = 0; chart < P::kCharts; ++chart) {
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
