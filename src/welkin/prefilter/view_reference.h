#pragma once

#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/brdf.h"
#include "welkin/map/map.h"

/// @file
/// What a surface reflects, by brute force: what look-ups are measured against.
namespace welkin {

/// The full integral in float64, for any BRDF, normal and viewer: over all of a map's texels radiance, which
/// is constant over each, times the integral of BRDF · cosine over the texel. Four points to a texel, and
/// texels over which the BRDF varies are subdivided. Relative error 1e-4 of the sum, measured against finer
/// subdivisions; milliseconds to tenths of a second a call. Never changes; safe from many threads.
class WELKIN_API ViewReference {
 public:
  /// Keeps a copy of what it needs: about 150 bytes a texel.
  explicit ViewReference(const Map& source);

  /// ∫ L BRDF (n·l) dω / ∫ BRDF (n·l) dω of each channel, to `radiance`; unit vectors of the world, n·v over
  /// 0. `tolerance` is how much of the whole a texel may be off by before it is subdivided. Throws Error
  /// (bad_request): a mirror, n·v not over 0, too little room.
  void evaluate(const brdf::AnyBrdf& brdf, const Vec3d& normal, const Vec3d& view, std::span<double> radiance,
                double tolerance = 1e-7) const;

  /// Values of a texel.
  int channels() const { return channels_; }

 private:
  struct Point {
    Vec3d direction;  ///< of the world
    double solid_angle;
  };
  struct Texel {
    std::size_t first, count;  ///< its points
    int chart, x, y;
  };

  sphere::AnyParameterization parameterization_;
  Matrix3 to_world_;
  ChartSize size_;
  int channels_;
  std::vector<Point> points_;
  std::vector<Texel> texels_;
  std::vector<float> radiance_;
};

}  // namespace welkin
