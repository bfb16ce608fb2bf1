#pragma once

#include <span>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"

namespace welkin {

/// Pre-filtering by brute force in float64: for any direction, the sum over all the source's texels of
/// radiance times the integral of the lobe over the texel. The definition itself, as far as quadrature goes:
/// four points to a texel, and texels near the direction cut up until a piece is a tenth as wide as what the
/// lobe does over its place. Relative error 1e-6 of the sum.
class PrefilterReference {
 public:
  /// Keeps a copy of what it needs of the source: 36 + 4 · channels bytes, four times, for each texel.
  explicit PrefilterReference(const Map& source);

  /// out[i·channels…]: the level's values in directions of the world.
  void evaluate(const lobe::AnyLobe& lobe, std::span<const Vec3d> directions, std::span<double> out,
                const Monitor& monitor = {}) const;

  /// ∫ L dω of each channel.
  const std::vector<double>& integral() const { return integral_; }

 private:
  /// How fine a lobe is, for steps.
  struct Scale;

  double near_texel(const lobe::AnyLobe& lobe, const Vec3d& direction, const Scale& scale, int chart,
                    double u, double v, double du, double dv) const;

  sphere::AnyParameterization parameterization_;
  Matrix3 orientation_;
  int width_, height_, channels_;
  std::vector<double> x_, y_, z_, solid_angle_;  ///< four points a texel
  std::vector<double> size_;                     ///< of the texel, squared, radians²
  std::vector<float> radiance_;
  std::vector<std::size_t> texel_;  ///< (chart · height + y) · width + x
  std::vector<double> integral_;
};

}  // namespace welkin
