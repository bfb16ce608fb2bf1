#pragma once

#include <span>
#include <vector>

#include "welkin/base/monitor.h"
#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"
#include "welkin/map/texel_points.h"

namespace welkin {

/// Pre-filtering by brute force in float64: for any direction, the sum over all the source's texels of
/// radiance times the integral of the lobe over the texel. The definition itself, as far as quadrature goes:
/// four points to a texel, more where a rim or a kink goes through it (texel_points.h), and texels near the
/// direction subdivided until a piece is a tenth as wide as the lobe's local scale. Relative error 1e-6 of
/// the sum.
class PrefilterReference {
 public:
  /// Keeps a copy of what it needs of the source: 144 + 4 · channels bytes for each texel, and about 10 kB
  /// for each that a rim or a kink goes through.
  explicit PrefilterReference(const Map& source);

  /// out[i·channels…]: the level's values in directions of the world.
  void evaluate(const lobe::AnyLobe& lobe, std::span<const Vec3d> directions, std::span<double> out,
                const Monitor& monitor = {}) const;

  /// ∫ L dω of each channel.
  const std::vector<double>& integral() const { return integral_; }

 private:
  /// How fine a lobe is, for steps.
  struct Scale;
  class Weights;

  /// Texels for which four points suffice: summed in blocks.
  struct Plain {
    std::vector<double> x, y, z, solid_angle;  ///< four points a texel
    std::vector<double> size;                  ///< of the texel, squared, radians²
    std::vector<float> radiance;
    std::vector<std::size_t> texel;  ///< (chart · height + y) · width + x
  };
  /// Others, one by one.
  struct Irregular {
    std::vector<TexelPoint> points;
    double size;
    std::vector<float> radiance;
    std::size_t texel;
  };

  void add_texel(std::size_t texel, const float* radiance, bool plain);
  ChartCell cell_of(std::size_t texel) const;
  /// `points` is scratch.
  double near_texel(const lobe::AnyLobe& lobe, const Vec3d& direction, const Scale& scale,
                    const ChartCell& cell, bool plain, std::vector<TexelPoint>& points) const;
  /// Add to sum[channel] the texels' radiance times the integral of the lobe over them.
  void sum_plain(const Weights& weights, const Scale& scale, const Vec3d& direction, double* sum) const;
  void sum_irregular(const Weights& weights, const Scale& scale, const Vec3d& direction, double* sum) const;

  sphere::AnyParameterization parameterization_;
  Matrix3 orientation_;
  ChartSize size_;
  std::size_t channels_;
  CellLimits limits_;
  double mean_texel_;  ///< a side, radians
  Plain plain_;
  std::vector<Irregular> irregular_;
  std::vector<double> integral_;
};

}  // namespace welkin
