#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "welkin/filter/reconstruction.h"
#include "welkin/sphere/registry.h"

/// Radiance within parts of a source's texels, for Filter::automatic where it magnifies. Internal to
/// resample.
///
/// A quadratic that is limited as a whole (reconstruction.h) is flat in one texel of a slanted edge and steep
/// in the next, which shows once a texel covers several of the target. So a texel is divided into K×K parts:
///
/// - A part is the mean over it of the texel's quadratic, before its limiter, kept within the range of the
/// 2×2
///   texels nearest to it and a little more. What that adds to the texel or takes from it goes to the parts
///   that have room, evenly, in kClippedRounds. So each texel keeps its mean, and what is in it gathers on
///   the side where it comes from.
/// - Within a part radiance is the quadratic through the means of the 3×3 parts around, scaled down where it
///   would go beyond their range.
namespace welkin {

/// Parts along a texel's side, at most.
inline constexpr int kMostParts = 4;

/// How far a part may go beyond the range of the 2×2 texels nearest to it, as a share of that range: a smooth
/// extreme goes 1/12 beyond. Downwards less, and not at all from where the range is kFlatFloor times the
/// lowest: beside lamps nothing is darker than what is around.
inline constexpr float kBeyondTexels = 0.06f, kFlatFloor = 8.0f;
/// The same within a part, beyond the 3×3 parts around.
inline constexpr float kBeyondParts = 0.02f;

inline constexpr int kClippedRounds = 6;

/// How many parts serve a target whose footprints are so wide, source texels.
int parts_for(double footprint);

/// The part of a side of `size` parts whose solid angle is that of any part of the border: its mirror image.
constexpr int part_inside(int part, int size) {
  if (part < 0) return -1 - part;
  return part < size ? part : 2 * size - 1 - part;
}

/// What divides a source.
struct PartsOfTexels {
  const sphere::AnyParameterization& source;
  int parts = 1;
  /// Where solid angle depends on the row alone: of the rows of parts. Else nothing, and asked of the source.
  const std::vector<float>* row_angle = nullptr;
};

/// What Refinement works with.
struct RefinementWork {
  ReconstructedTexels whole;
  std::vector<float> texels, parts, divided, shares, u, v, density;
};

/// A source's texels in parts. Each is divided once, when something beside it is first asked for.
class Refinement {
 public:
  /// Of a level that must outlive this, as everything that the others point to.
  Refinement(const LevelView& level, const PartsOfTexels& parts, const Reconstruction& how,
             const ReconstructionKernels& kernels);

  /// Fills `out`, whose rectangle is one of parts: of a chart that is as many times as wide and high. From
  /// any thread.
  void reconstruct(RefinementWork& work, ReconstructedTexels& out) const;

 private:
  /// Side of a tile, texels.
  static constexpr int kTile = 16;
  struct Texels {
    int width = 0;
    std::vector<float> parts;        ///< their means, row by row
    std::vector<std::uint8_t> hard;  ///< ReconstructedTexels::hard of each texel
  };
  struct Tile {
    std::once_flag made;
    std::unique_ptr<const Texels> texels;
  };
  const Texels& tile(int chart, int column, int row, RefinementWork& work) const;

  const LevelView level_;
  const PartsOfTexels parts_;
  Reconstruction how_;
  const ReconstructionKernels kernels_;
  const int columns_, rows_;  ///< of tiles; the first ones begin with the border's last texels
  mutable std::vector<Tile> tiles_;
};

}  // namespace welkin
