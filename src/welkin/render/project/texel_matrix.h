#pragma once

#include <optional>
#include <vector>

#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"

namespace welkin::scene {

/// One level of pre-filtering as a matrix from a small map's texels to the level's, for many maps of one
/// shape: the definition of prefilter.h, by quadrature points of every texel, finer ones near the lobe's
/// axis. Against PrefilterReference the relative RMS error is below 1e-3 (texel_matrix_test.cpp).
class TexelMatrix {
 public:
  /// None where it would have over 2²² numbers, or the lobe is narrower than a quarter of a texel.
  static std::optional<TexelMatrix> make(const sphere::AnyParameterization& parameterization, ChartSize from,
                                         ChartSize to, const lobe::AnyLobe& lobe);

  /// The level, of the source's orientation, its borders filled.
  Map apply(const Map& source) const;

 private:
  TexelMatrix(const sphere::AnyParameterization& parameterization, ChartSize from, ChartSize to,
              const lobe::AnyLobe& lobe, int parts);

  sphere::AnyParameterization parameterization_;
  ChartSize from_, to_;
  std::vector<float> weights_;  // source texel by source texel, of every texel of the level
};

}  // namespace welkin::scene
