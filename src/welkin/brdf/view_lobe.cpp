#include "welkin/brdf/view_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/brdf/light_power.h"
#include "welkin/brdf/plane_quadrature.h"
#include "welkin/lobe/zonal.h"

namespace welkin::brdf {
namespace {

void check(const AnyBrdf& brdf, double view_cosine) {
  require(!brdf.is_mirror(), "a mirror's lobe is a direction: it has no points");
  require(view_cosine > 0 && view_cosine <= 1, "the cosine of view and normal is in 0…1, and not 0");
}

Vec3d view_of(double view_cosine) {
  return {std::sqrt(std::max(0.0, 1 - view_cosine * view_cosine)), 0, view_cosine};
}

/// BRDF · cosine of the surface seen at n·v.
class Lobe {
 public:
  Lobe(const AnyBrdf& brdf, double view_cosine) : brdf_(brdf), view_(view_of(view_cosine)) {}

  double at(const Vec3d& light) const {
    if (light.z <= 0) return 0;
    const double value = brdf_.value(view_, light) * light.z;
    if (!(value >= 0 && std::isfinite(value)))
      throw Error(ErrorKind::bad_value, brdf_.spec() + ": the BRDF is " + number_text(value / light.z) +
                                            " at n·v = " + number_text(view_.z) + ", n·l = " +
                                            number_text(light.z) + ": neither 0 nor a positive number");
    return value;
  }

 private:
  const AnyBrdf& brdf_;
  Vec3d view_;
};

/// The narrowest that a lobe seen at n·v is: across the plane of incidence, where half vectors turn light by
/// 2 (n·v) times their own angle.
double finest_step(const AnyBrdf& brdf, double view_cosine) {
  return brdf.width() * std::max(view_cosine, 0.02) / 4;
}

/// The mean of a lobe over circles about an axis in the plane of incidence.
class Circles {
 public:
  Circles(const AnyBrdf& brdf, double view_cosine, double elevation)
      : lobe_(brdf, view_cosine),
        sine_(std::sin(elevation)),
        cosine_(std::cos(elevation)),
        finest_(finest_step(brdf, view_cosine)) {}

  /// Of the circle at this angle from the axis.
  double mean(double angle) const {
    const double along = std::cos(angle), out = std::sin(angle);
    // Height is along · sine + out · cosine · cos φ; above the surface on one stretch of 0…π.
    double from = 0, to = kPi;
    if (const double height = along * sine_, swing = out * std::fabs(cosine_); std::fabs(height) < swing) {
      const double turn = std::acos(std::clamp(-height / (out * cosine_), -1.0, 1.0));
      (cosine_ > 0 ? to : from) = turn;
    } else if (height <= 0) {
      return 0;
    }
    if (out == 0) return lobe_.at({-cosine_ * along, 0, sine_ * along});
    double sum = 0;
    for_each_node(both_ends(from, to, std::min(1.0, finest_ / out)), 5, [&](double turn, double weight) {
      const double e1 = out * std::cos(turn);
      sum += weight *
             lobe_.at({-cosine_ * along + sine_ * e1, out * std::sin(turn), sine_ * along + cosine_ * e1});
    });
    return sum / kPi;
  }

 private:
  Lobe lobe_;
  double sine_, cosine_, finest_;
};

/// The means of circles as a table: angles added where a line between two is too far from the mean between.
class Profile {
 public:
  Profile(const Circles& circles, double whole) : circles_(circles), tolerance_(kTolerance * whole) {}

  void add(double from, double at_from, double to, double at_to, int depth) {
    const double middle = 0.5 * (from + to), value = circles_.mean(middle);
    const double area = 2 * kPi * std::sin(middle) * (to - from);
    if (depth < kMaxDepth && std::fabs(value - 0.5 * (at_from + at_to)) * area > tolerance_) {
      add(from, at_from, middle, value, depth + 1);
      push(middle, value);
      add(middle, value, to, at_to, depth + 1);
    } else {
      push(middle, value);
    }
  }
  void push(double angle, double value) {
    degrees.push_back(angle / kPi * 180);
    values.push_back(value);
  }

  std::vector<double> degrees, values;

 private:
  /// Of the lobe's integral, each: there are a few hundred.
  static constexpr double kTolerance = 1e-6;
  static constexpr int kMaxDepth = 8;
  const Circles& circles_;
  double tolerance_;
};

/// Degrees of light that an axis is fitted for, and how large cells of points may be for that, radians.
constexpr int kAxisDegree = 64;
constexpr double kAxisStep = 0.01;

/// Σ_l of what an average about this axis keeps of the lobe, weighted by the light's power.
double kept(const MergedPoints& points, const Vec3d& axis) {
  std::vector<double> front, front_weights, behind, behind_weights;
  for (std::size_t i = 0; i < points.directions.size(); ++i) {
    const Vec3d ahead = points.directions[i] - axis, back = points.directions[i] + axis;
    const double s = 0.5 * dot(ahead, ahead);
    (s <= 1 ? front : behind).push_back(s <= 1 ? s : 0.5 * dot(back, back));
    (s <= 1 ? front_weights : behind_weights).push_back(points.weights[i]);
  }
  const std::vector<double> f = lobe::legendre_sums(std::move(front), std::move(front_weights), kAxisDegree);
  const std::vector<double> b =
      lobe::legendre_sums(std::move(behind), std::move(behind_weights), kAxisDegree);
  double sum = 0;
  for (int l = 1; l <= kAxisDegree; ++l) {
    const auto k = static_cast<std::size_t>(l);
    const double zonal = l % 2 == 0 ? f[k] + b[k] : f[k] - b[k];
    sum += light_power(l) * (2 * l + 1) * zonal * zonal;
  }
  return sum;
}

}  // namespace

Vec3d tilted_direction(double view_cosine, double tilt) {
  const double elevation = std::asin(std::clamp(view_cosine, -1.0, 1.0)) + tilt;
  return {-std::cos(elevation), 0, std::sin(elevation)};
}

LobePoints lobe_points(const AnyBrdf& brdf, double view_cosine, int nodes) {
  check(brdf, view_cosine);
  require(nodes >= 2 && nodes <= 16, "a panel has 2 to 16 nodes");
  const Lobe lobe(brdf, view_cosine);
  const double finest = finest_step(brdf, view_cosine), reflected = std::asin(view_cosine);
  // In coordinates of the plane of incidence the surface is a straight edge: elevation 0…π along it.
  const std::vector<double> elevations = around({reflected, kPi - reflected, 0, kPi}, 0, kPi, finest, 24);
  const std::vector<double> across = around({0}, 0, kPi / 2, finest, 6);
  LobePoints points;
  for_each_node(elevations, nodes, [&](double elevation, double along_weight) {
    for_each_node(across, nodes, [&](double beta, double across_weight) {
      const double level = std::cos(beta), side = std::sin(beta);
      Vec3d d{-std::cos(elevation) * level, side, std::sin(elevation) * level};
      const double weight = lobe.at(d) * level * along_weight * across_weight;
      if (weight == 0) return;
      points.directions.push_back(d);
      points.weights.push_back(weight);
      d.y = -side;
      points.directions.push_back(d);
      points.weights.push_back(weight);
    });
  });
  return points;
}

double directional_albedo(const AnyBrdf& brdf, double view_cosine) {
  double sum = 0;
  for (const double weight : lobe_points(brdf, view_cosine).weights) sum += weight;
  return sum;
}

double fitted_tilt(const AnyBrdf& brdf, double view_cosine) {
  const MergedPoints points = merged(lobe_points(brdf, view_cosine, 3), kAxisStep);
  const double reflected = std::asin(view_cosine);
  const auto at = [&](double elevation) {
    return kept(points, tilted_direction(view_cosine, elevation - reflected));
  };
  // The best of a few, then the golden section between its neighbours.
  constexpr int kFirst = 24;
  double best = reflected, most = at(reflected), step = kPi / kFirst;
  for (int k = 0; k <= kFirst; ++k) {
    if (const double value = at(k * step); value > most) {
      most = value;
      best = k * step;
    }
  }
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double low = best - step, high = best + step;
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = at(a), at_b = at(b);
  while (high - low > 1e-3) {
    if (at_a > at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = at(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = at(b);
    }
  }
  return 0.5 * (low + high) - reflected;
}

AveragedLobe average_lobe(const AnyBrdf& brdf, double view_cosine, double tilt) {
  check(brdf, view_cosine);
  const double albedo = directional_albedo(brdf, view_cosine);
  if (!(albedo > 0))
    throw Error(ErrorKind::bad_value,
                brdf.spec() + ": reflects nothing at n·v = " + number_text(view_cosine));
  const double reflected = std::asin(view_cosine), elevation = reflected + tilt;
  const Circles circles(brdf, view_cosine, elevation);
  // Circles that touch the horizon, or go through r or the viewer, where the lobe is steep.
  const double last = std::clamp(std::max(elevation, kPi - elevation), 1e-6, kPi);
  std::vector<double> steep{0, std::fabs(tilt), std::fabs(kPi - reflected - elevation),
                            std::min(std::fabs(elevation), std::fabs(kPi - elevation))};
  const std::vector<double> angles = around(steep, 0, last, finest_step(brdf, view_cosine), 16);
  Profile profile(circles, albedo);
  double before = circles.mean(angles.front());
  profile.push(angles.front(), before);
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double value = i + 2 < angles.size() ? circles.mean(angles[i + 1]) : 0;
    profile.add(angles[i], before, angles[i + 1], value, 0);
    profile.push(angles[i + 1], value);
    before = value;
  }
  const std::string name = brdf.spec() + " at n·v=" + number_text(view_cosine);
  return {lobe::AnyLobe::from_table(name, profile.degrees, profile.values), tilt, albedo};
}

AveragedLobe average_lobe(const AnyBrdf& brdf, double view_cosine, LobeAxis axis) {
  return average_lobe(brdf, view_cosine, axis == LobeAxis::fitted ? fitted_tilt(brdf, view_cosine) : 0.0);
}

}  // namespace welkin::brdf
