#pragma once

#include <optional>
#include <vector>

#include "welkin/filter/outline.h"
#include "welkin/filter/overlap.h"
#include "welkin/filter/refinement.h"

/// Exact means over areas of a source. Internal to resample.
namespace welkin {

/// Means over polygons, by the solid angle of the source's texels under them.
class OverlapMeans {
 public:
  /// What a thread works with.
  struct Work {
    explicit Work(const OverlapMeans& means) : overlap(means.by_row_ ? &means.bend_ : nullptr) {}
    PolygonOverlap overlap;
    ReconstructedTexels few;
    RefinementWork refinement;
    std::vector<double> sum;
  };

  /// Of a level of the source, which must outlive this. `reconstructed`: by what is within texels, and not by
  /// their own values; `limited`: with the limiter; `parts`: of a side of each texel (refinement.h), 1 unless
  /// both. All positions and rectangles below are counted in parts.
  OverlapMeans(const sphere::AnyParameterization& source, const Level& level, bool reconstructed,
               bool limited, int parts);
  // Reconstruction points into it.
  OverlapMeans(const OverlapMeans&) = delete;
  OverlapMeans& operator=(const OverlapMeans&) = delete;

  bool reconstructed() const { return reconstructed_; }
  /// Parts of a chart.
  ChartSize size() const { return size_; }
  /// Fills `texels`.
  void reconstruct(ReconstructedTexels& texels, Work& work) const;
  const ReconstructionKernels& kernels() const { return kernels_; }

  /// The mean over loops, `channels` values. False where they enclose nothing. `known` may hold
  /// reconstructions that serve.
  bool mean(const std::vector<OutlineLoop>& loops, const ReconstructedTexels& known, Work& work,
            float* out) const;
  /// The limiter leaves a little of an undershoot: raises what is below 0 and below all texels in and around
  /// that rectangle of a chart.
  void lift(int chart, float left, float top, float right, float bottom, float* out) const;

 private:
  /// Sums over texels: of radiance · solid angle in Work, and of solid angle.
  void add_part(const ReconstructedTexels& texels, int x, int y, const OverlapMoments& m, Work& work,
                double& total) const;
  void add_mean(int chart, int x, int y, const OverlapMoments& m, Work& work, double& total) const;
  void add_whole(int chart, int x, int y, int count, double area, Work& work, double& total) const;

  double density(int chart, double x, double y) const;
  double solid_angle(int chart, int x, int y) const;
  double solid_angle_of_part(int chart, int x, int y, double of_texel, const OverlapMoments& m) const;
  bool is_cut(int chart, int x, int y) const;
  /// That a part is of.
  const float* texel_at(int chart, int x, int y) const;

  const sphere::AnyParameterization& source_;
  const LevelView view_;
  const ReconstructionKernels kernels_;
  const int parts_;
  const ChartSize size_;
  const bool reconstructed_;
  const bool full_;               ///< all positions of the source are valid
  const bool by_row_;             ///< texels of a row have one solid angle
  std::vector<float> bend_;       ///< PolygonOverlap's
  std::vector<float> row_angle_;  ///< solid angles of rows, sr
  std::vector<float> bright_;
  Reconstruction how_;
  std::optional<Refinement> refinement_;  ///< where there is more than one part
};

}  // namespace welkin
