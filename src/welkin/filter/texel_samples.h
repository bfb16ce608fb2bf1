#pragma once

#include <vector>

#include "welkin/filter/resample_job.h"

/// Means of target texels whose outlines are of no use: at rims, and where maps end. Internal to resample.
namespace welkin {

/// Means over grids of points.
class TexelSamples {
 public:
  /// Of a level of the job's source. Both must outlive this.
  TexelSamples(const ResampleJob& job, const LevelView& level);

  /// Whether the target's texels are as large as charts: they have no simple outline.
  bool huge() const { return huge_; }
  /// Whether none of nine points of a texel is valid in the target.
  bool is_outside(int chart, int x, int y) const;
  /// Whether the source shows none of 8×8 points of a texel: for those all around which it shows nothing.
  bool misses(int chart, int x, int y, Batch& batch) const;
  /// What a texel has that lies outside the valid part of a chart, or sees nothing of the source.
  void leave(int chart, int x, int y, Batch& batch, float* out) const;
  /// The mean over a grid of points of the texel.
  void sample(int chart, int x, int y, Batch& batch, std::vector<double>& sum, float* out) const;

 private:
  /// Whether a texel shows the direction of a whole rim of the source, and so very many texels.
  bool sees_many(int chart, int x, int y) const;

  const ResampleJob& job_;
  const LevelView view_;
  const bool huge_;
  const bool source_is_full_;
  const bool source_is_broad_;  ///< no texel's neighbours lie on both sides of what it shows
};

}  // namespace welkin
