#pragma once

#include <vector>

#include "welkin/map/map.h"

/// Where the outlines of a target's texels lie in a source's charts. Internal to resample.
namespace welkin {

struct OutlinePoint {
  double x, y;  ///< texels of the chart
};

/// A closed polygon in one chart.
struct OutlineLoop {
  int chart;
  std::vector<OutlinePoint> points;
};

/// Traces texels' outlines exactly, across whatever lies in their way: the edges of the source's charts,
/// poles, folds. In float64, one position after another.
class Outline {
 public:
  /// `to_source` takes directions of the target's parameterization to the source's.
  Outline(const sphere::AnyParameterization& source, ChartSize source_size, const MapFrame& target,
          const Matrix3& to_source);

  /// The parts of the source that a target's texel covers, of one on the target's rim those that its valid
  /// part does. False where there is no telling: at the rim of a disc of the source, where either map ends
  /// otherwise than a disc, where an outline runs along edges of the source's charts, and where a texel
  /// covers most of a chart.
  bool trace(int chart, int x, int y, std::vector<OutlineLoop>& loops) const;

 private:
  struct Position {
    double u, v;  ///< in the target
    int chart;
    double x, y;  ///< in the source, texels
    bool shown;   ///< by the source
  };
  /// In the target.
  struct TargetPoint {
    double u, v;
  };
  /// A part of an outline that doesn't leave a chart.
  struct Run {
    int chart;
    std::vector<OutlinePoint> points;
  };

  /// What there is of an outline so far.
  struct Followed {
    std::vector<Run> runs;
    int positions = 0;  ///< asked for
  };

  Position locate(int chart, double u, double v) const;
  /// By the target's straight lines, or along its rim.
  bool follow(int chart, const Position& from, const Position& to, bool on_rim, int depth,
              Followed& followed) const;
  /// Where the rim lies beside the middle of a chord of it, clockwise around what is valid: the middle itself
  /// where the rim is straight.
  TargetPoint rim_between(int chart, const Position& from, const Position& to) const;
  /// Leaves the valid part of a texel's outline; of one that the rim cuts, this leads from its last point to
  /// its first. False where there is more than one such stretch, or nothing valid.
  bool clip_to_rim(int chart, std::vector<TargetPoint>& ring, bool& has_rim) const;
  double along_edge(const OutlinePoint& point) const;
  void add_corners(double from, double length, std::vector<OutlinePoint>& points) const;

  const sphere::AnyParameterization& source_;
  const MapFrame& target_;
  Matrix3 to_source_;
  double width_, height_;               ///< of the source's chart
  double left_, right_, top_, bottom_;  ///< its valid part, texels
  bool rectangle_;                      ///< the valid part is that rectangle
  bool target_full_;
  std::vector<double> turn_;  ///< of each chart: ±1, how directions turn about it
  std::vector<double> target_turn_;
};

}  // namespace welkin
