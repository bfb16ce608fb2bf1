#pragma once

#include <cstddef>
#include <cstdint>

#include "welkin/lookup/face_grid.h"

/// The inner loops of Gaussian look-ups, compiled once per instruction set. Internal to lookup.
namespace welkin {

/// Positions to read, and with which weights: structure of arrays.
struct GaussianTaps {
  static constexpr std::size_t kMost = 128, kLanes = 16, kRoom = kMost + kLanes;

  alignas(64) float x[kRoom], y[kRoom], z[kRoom];  ///< directions
  alignas(64) float weight[kRoom];
  alignas(64) float size[kRoom];  ///< GaussianInterval::size

  /// What `locate` finds: which texel of the interval is the first of 3×3, weights of its columns, and of its
  /// rows times the tap's.
  alignas(64) std::int32_t texel[kRoom];
  alignas(64) float across[3][kRoom];
  alignas(64) float down[3][kRoom];
};

/// The taps of a cone along its long axis: directions d cos φ + a sin φ at φ = node · σ.
struct GaussianSpread {
  float direction[3], axis[3];  ///< unit, perpendicular
  float sigma;
  const float* nodes;  ///< `count` of them, readable up to the next multiple of kLanes
  std::size_t count;
};

/// What lies past an edge of a face of the equi-angular cube: a point at the angle a of the face's own
/// towards the edge, and t along it, has there the angles out · (π/2 − |a|) + along · atan(t / |s|).
struct FaceNeighbor {
  int face;
  float out_u, along_u, out_v, along_v;
};

/// Points with four values each.
struct MassPoints {
  const float *x, *y, *z;  ///< readable up to the next multiple of kLanes
  const float* values;
  std::size_t count;
};

/// A row of the texels that a blurred one is made of.
struct BlurRow {
  int x, y, count;
  std::size_t weight;  ///< of its first texel in the arrays of weights
};

/// How texels of a grid weigh in two Gaussians about a direction (gaussian_blur.h).
struct BlurWeights {
  float s, t;  ///< the direction: a point of the face's plane
  float x, y;  ///< where that is in the grid, texels
  struct Gaussian {
    float kappa, xx, xy, yy;  ///< exp(−κ (1 − cos θ) + xx Δx² + xy Δx Δy + yy Δy²)
  } gaussians[2];
};

/// Lines of texels, `step` values from one to the next; the lines `line_step` from each other.
struct SplineLines {
  int count;
  std::ptrdiff_t step;
  int lines;
  std::ptrdiff_t line_step;
};

struct GaussianKernels {
  /// Adds points to the grid, where a face or its margin has them.
  void (*splat)(const MassPoints& points, const FaceNeighbor* neighbors, FaceGrid& grid);
  /// Weights of rows of texels, whose columns' and rows' tangents are given; a row's are written up to the
  /// next multiple of kLanes.
  void (*weigh)(const BlurWeights& blur, const float* tangents, const BlurRow* rows, std::size_t count,
                float* first, float* second);
  /// Four times the means of kPair values with both weights: means[i][2][kPair], texel (x, y) lying at
  /// from[i] + x · across[i] + y · down[i]. The fourth of kValues is what the others are divided by; they are
  /// 0 where that is.
  void (*apply)(const BlurRow* rows, std::size_t count, const float* first, const float* second,
                const float* const* from, const std::ptrdiff_t* across, const std::ptrdiff_t* down,
                float* means);

  /// From samples to coefficients of the quadratic B-spline whose values at the texels are
  /// (c₋₁ + 6c₀ + c₁)/8, in place, along `lines` lines of `count` texels of a pair of faces. Past the ends
  /// samples are taken to stay as they are there.
  void (*to_spline)(float* values, const SplineLines& lines);

  /// Directions of a cone's taps, to x, y, z from `at` on; kLanes − 1 more values may be written.
  void (*spread)(const GaussianSpread& cone, GaussianTaps& taps, std::size_t at);
  /// Where the taps 0 … count − 1 lie.
  void (*locate)(GaussianTaps& taps, std::size_t count);
  /// sums[0 … width − 1] += the weighted texels, of `width` values, of the taps from … to − 1. `values` is
  /// the interval's first texel, `pitch` the values of a row. Sums are written up to the next multiple of 8.
  void (*gather)(const GaussianTaps& taps, std::size_t from, std::size_t to, const std::uint16_t* values,
                 std::size_t width, std::size_t pitch, float* sums);
  /// to[texel][8]: of each texel three values of one grid and three of another, times `factors`, the fourth
  /// of which is 0, as halves; and two of anything. Texels lie kPair apart in the grids. Returns the largest
  /// absolute value, which must be below 65504.
  float (*to_halves)(const float* a, const float* b, const float* factors, std::size_t texels,
                     std::uint16_t* to);
};

const GaussianKernels& gaussian_kernels_baseline();
#ifdef WELKIN_HAS_AVX2
const GaussianKernels& gaussian_kernels_avx2();
#endif

/// For the best instruction set of this processor.
const GaussianKernels& gaussian_kernels();

}  // namespace welkin
