#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "welkin/filter/fetch.h"

/// Radiance within a source's texels, for Filter::automatic. Internal to resample.
///
/// A texel is a mean over its area (docs/decisions/0009), so what is reconstructed within it has that mean: a
/// quadratic in x and y, −½…½ from the texel's centre,
///
///     m + a_x·x + a_y·y + a_xx·(x² − 1/12) + a_xy·x·y + a_yy·(y² − 1/12).
///
/// Its coefficients are the moments of the spline of degree 4 whose mean over every texel is that texel
/// (histopolation), from four texels to each side. All but m is scaled down (Zhang and Shu 2010) where
/// it would go beyond the range of the 3×3 texels around by more than half of that range, or below 0 by more
/// than half of m; where it would by more than twice m, until it is at least half the smallest of the 3×3. So
/// every texel keeps its mean, and a light has no ripples. Among negative texels, the smallest stands for 0.
namespace welkin {

/// Coefficients in the order of their planes: m − (a_xx + a_yy)/12, a_x, a_y, a_xx, a_xy, a_yy.
inline constexpr int kCoefficients = 6;

/// Texels to each side that a reconstruction reads.
inline constexpr int kReconstructionReach = 4;

/// Weights of the differences between neighbours at 1 … 4 texels, for the odd moments; of the second
/// differences for the even ones. Least squares to the spline's, for pictures whose power falls as the cube
/// of the frequency, exact for what is linear (odd) or quadratic (even).
inline constexpr float kOddTaps[kReconstructionReach] = {0.944101f, -0.3679654f, 0.141927f, -0.0334878f};
inline constexpr float kEvenTaps[kReconstructionReach] = {1.3557766f, -0.4343374f, 0.1570215f, -0.0332263f};

/// How far a reconstruction may fall below 0 and the 3×3 texels around, as a share of its texel.
inline constexpr float kUndershoot = 0.5f;
/// How far it may go beyond the range of the 3×3 texels around, as a share of that range: a far light's
/// ripples are more.
inline constexpr float kBeyond = 0.5f;
/// Where it would fall lower than this below 0, it is beside a light: then it may not fall below half the
/// smallest of the 3×3 texels.
inline constexpr float kDeep = 2.0f;

/// Texels that differ from those around by more than this share of the map's mean are uneven: where they
/// meet, radiance may jump, and few points miss where.
inline constexpr float kUneven = 0.25f;
/// ReconstructedTexels::hard.
inline constexpr std::uint8_t kIsUneven = 1, kIsLight = 2;
/// What a light adds to ReconstructedTexels::counts; rectangles have fewer texels.
inline constexpr std::int32_t kLights = 1 << 16;

/// How a source is reconstructed.
struct Reconstruction {
  bool limited = true;  ///< see above
  /// For each channel, what a light is brighter than: several times the source's mean.
  const float* bright = nullptr;
};

/// Reconstructions of a rectangle of texels.
struct ReconstructedTexels {
  int chart = 0;
  int x = 0, y = 0, width = 0, height = 0;
  int channels = 0;
  /// Plane after plane; each holds the texels row by row, their channels interleaved. Readable for 8 values
  /// past the end.
  std::vector<float> coefficients;
  /// Of each texel, kIsLight where it is part of a light or beside one: sums over points are not exact enough
  /// there. kIsUneven where they need more points. Else 0.
  std::vector<std::uint8_t> hard;
  /// How many there are of each above and to the left of each texel, one more column and row: of lights times
  /// kLights, and uneven ones.
  std::vector<std::int32_t> counts;
  std::vector<float> scratch;

  /// Another rectangle, of unspecified reconstructions.
  void reset(int new_chart, int new_x, int new_y, int new_width, int new_height, int new_channels);

  /// Adds up `counts`.
  void count_hard();
  /// The counts of the texels from (left, top) to (right, bottom).
  std::int32_t hard_in(int left, int top, int right, int bottom) const {
    const std::int32_t* row = counts.data() - x;
    const std::ptrdiff_t above = static_cast<std::ptrdiff_t>(top - y) * (width + 1),
                         below = static_cast<std::ptrdiff_t>(bottom + 1 - y) * (width + 1);
    return row[below + right + 1] - row[below + left] - row[above + right + 1] + row[above + left];
  }

  std::ptrdiff_t plane() const { return static_cast<std::ptrdiff_t>(width) * height * channels; }
  /// Of a texel among the rectangle's.
  std::size_t index(int texel_x, int texel_y) const {
    return static_cast<std::size_t>(texel_y - y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(texel_x - x);
  }
};

/// The most points of a texel.
inline constexpr int kMaxQuadrature = 64;

/// A rule along one side of a target's texel.
struct QuadraturePoints {
  int count;
  const float* offset;  ///< 0…1
  const float* weight;
};

/// How many rules there are, for longer and longer sides.
inline constexpr int kQuadratureRules = 5;
/// The number of the rule for a side that crosses so many texels of the source, −1 for more than five.
int rule_for(float texels);
QuadraturePoints quadrature_rule(int number);

/// A target's texel as a quadrilateral of the source: its corners, top left, top right, bottom left and
/// bottom right, and the target's density at each.
struct Quadrilateral {
  float x[4], y[4], weight[4];
};

/// Rows of values, one for each part of texels, `stride` apart.
struct DividedRow {
  const float* shares;  ///< of each part in its texel's solid angle
  float* parts;         ///< out: means over the parts
  std::size_t stride;
};

struct ReconstructionKernels {
  /// Fills `out`, whose rectangle lies inside the chart.
  void (*reconstruct)(const LevelView& level, const Reconstruction& how, ReconstructedTexels& out);
  /// Weighted means over quadrilaterals that lie inside the rectangle, channels values each; `means` has room
  /// for four more. The rules are for points across and down the target's texel.
  void (*means)(const ReconstructedTexels& texels, const QuadraturePoints& across,
                const QuadraturePoints& down, const Quadrilateral* areas, std::size_t count, float* means);
  /// Divides a row of texels into 2×2 or 4×4 parts each (refinement.h), given their reconstructions without a
  /// limiter.
  void (*divide)(const LevelView& texels, const ReconstructedTexels& whole, int row, int parts,
                 const DividedRow& out);
  /// Fills the coefficients of `out` from a level of parts.
  void (*reconstruct_parts)(const LevelView& parts, ReconstructedTexels& out);
};

ReconstructionKernels reconstruction_kernels_baseline(int channels);
#ifdef WELKIN_HAS_AVX2
ReconstructionKernels reconstruction_kernels_avx2(int channels);
#endif
/// For the best instruction set of this processor.
ReconstructionKernels reconstruction_kernels(int channels);

}  // namespace welkin
