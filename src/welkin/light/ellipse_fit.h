#pragma once

#include <array>
#include <optional>
#include <vector>

#include "welkin/math/vec.h"

/// An even ellipse fitted to texels. Internal to light.
namespace welkin {

struct FitPoint {
  double x, y;
};

/// Half axes a and b, a at `angle` from x toward y.
struct FittedEllipse {
  double x = 0, y = 0, a = 0, b = 0, angle = 0;
};

/// The sphere on a plane about a direction, areas kept (Lambert's azimuthal projection): the distance from
/// the centre is 2 sin(angle/2).
class LightPlane {
 public:
  explicit LightPlane(const Vec3d& middle);

  FitPoint point(const Vec3d& d) const;
  Vec3d direction(const FitPoint& p) const;
  const Vec3d& right() const { return right_; }
  const Vec3d& up() const { return up_; }

 private:
  Vec3d middle_, right_, up_;
};

/// Least squares: each texel is the mean of an ellipse of one radiance over the texel.
class EllipseFit {
 public:
  /// `side`: of a texel, the unit of lengths. Each texel has parts² points.
  EllipseFit(double side, int parts) : side_(side), parts_(parts) {}
  /// `width`: its longer side.
  void begin_texel(double value, double width);
  /// `weight`: the solid angle that it stands for, in any unit that is the same for the texel's points.
  void add_point(const FitPoint& point, double weight);

  struct Result {
    FittedEllipse ellipse;
    double misfit = 1;  ///< Σ (texel − fit)² / Σ texel²
  };
  Result disc(const FittedEllipse& start) const;
  Result ellipse(const FittedEllipse& start) const;

  /// Where texels don't tell how large the disc is, since a much smaller one fits them as well: the largest
  /// that does.
  std::optional<FittedEllipse> largest_alike(const Result& disc) const;

 private:
  /// In texels: x, y, and logarithms of half axes, one or two, and the angle.
  using Parameters = std::vector<double>;
  /// `fixed`: the radius of a disc, whose parameters are then x and y alone.
  std::vector<double> residuals(const Parameters& p, double fixed) const;
  double fit(Parameters& p, double fixed) const;
  /// The misfit of the best disc of that radius.
  Result disc_of(const Result& near, double radius) const;

  double side_;
  int parts_;
  std::vector<double> values_, widths_, weights_;  ///< of texels; weights are the sums of their points
  double squares_ = 0;
  struct Point {
    double x, y, weight;
  };
  std::vector<Point> points_;
};

}  // namespace welkin
