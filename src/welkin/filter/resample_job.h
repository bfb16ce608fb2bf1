#pragma once

#include <memory>
#include <vector>

#include "welkin/filter/fetch.h"
#include "welkin/filter/texel_maker.h"

/// What the ways to fill a map share. Internal to resample.
namespace welkin {

/// Samples that go through the pipeline together: their arrays stay in the first-level cache.
inline constexpr int kBatch = 256;

/// From directions of the target's parameterization to the source's.
inline Matrix3 rotation_to_source(const Matrix3& source, const Matrix3& target, const Matrix3& rotation) {
  return source * transpose(rotation) * transpose(target);
}

struct ResampleJob {
  ResampleJob(const Map& source, const MapFrame& target, const ResampleOptions& options);

  const Map& source;
  MapFrame target;
  ResampleOptions options;
  Matrix3 to_source;  ///< directions of the target's parameterization to the source's
  bool turned;        ///< to_source is not the identity
  bool target_is_full;
  bool source_is_whole;
  FetchKernels kernels;
  std::vector<float> fill;  ///< a value for each channel

  std::size_t channels() const { return fill.size(); }
  Fetch fetch_of(Filter filter) const;
  /// Whether some texels of the target may get the fill.
  bool fills() const {
    return !source_is_whole || (!target_is_full && !target.parameterization.filled_to_edges());
  }
};

/// directions → rotate → positions, for a batch of samples given as (u, v) of a target chart, padded(count) ≤
/// kBatch.
class Batch {
 public:
  explicit Batch(const ResampleJob& job) : job_(job), pixels_(kBatch * job.channels() + 8) {}

  alignas(64) float u[kBatch], v[kBatch];  ///< in: positions in the target's chart
  alignas(64) float chart[kBatch], source_u[kBatch], source_v[kBatch];  ///< positions in the source
  alignas(64) float weight[kBatch];  ///< solid angle per (u, v) area of the target

  /// Takes positions that were kept, of texels of the target from there on.
  void recall(const ChartPart& part, int width, int height);
  /// Finds the source's positions.
  void locate(int target_chart, std::size_t count);
  /// Weights each sample by the solid angle around it, 0 where the target is not valid. Call it after locate.
  void weigh(int target_chart, std::size_t count);
  /// Which samples the source shows: 1 or 0. Call it after locate.
  const float* covered(std::size_t count);
  /// The source's values at the positions, channels() for each sample: the fill where the source shows
  /// nothing.
  const float* fetch(Fetch kernel, const LevelView& level, std::size_t count);
  /// The same of centres of texels, with the fill also in those that are not valid anywhere in the target,
  /// unless it is filled to its edges.
  const float* fetch_texels(Fetch kernel, const LevelView& level, int target_chart, std::size_t count);

 private:
  void fill_where_zero(const float* mask, std::size_t count);

  const ResampleJob& job_;
  alignas(64) float x_[kBatch], y_[kBatch], z_[kBatch], mask_[kBatch];
  std::vector<float> pixels_;
};

/// Looks up the centres of texels; `out` has at most kBatch of them.
void resample_rectangle(const ResampleJob& job, Fetch kernel, const ChartPart& part, ImageView<float> out,
                        Batch& batch);

/// Texels by one look-up for each.
std::unique_ptr<TexelMaker> make_by_points(ResampleJob job, Fetch kernel);

/// Texels by Filter::automatic.
std::unique_ptr<TexelMaker> make_means(ResampleJob job);

}  // namespace welkin
