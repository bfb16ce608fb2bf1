#pragma once

#include <memory>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/filter/filter.h"
#include "welkin/filter/texel_positions.h"
#include "welkin/map/map.h"

/// @file
/// A map from another.
namespace welkin {

/// How a map is made from another.
struct ResampleOptions {
  Filter filter = Filter::automatic;  ///< how the source is read
  /// Rotates the world: what was seen along d is seen along rotation·d afterwards. Orthonormal; not checked
  /// (is_orthonormal).
  Matrix3 rotation = {};
  /// Bicubic and Lanczos kernels have negative lobes, and so has what `automatic` reconstructs. Unless this
  /// is set, their overshoot is clamped, or limited, so radiance never becomes negative beside a bright spot
  /// (docs/filtering.md).
  bool allow_ringing = false;
  /// For directions that the source doesn't show and texels that aren't a position of the target: one value
  /// per channel; 0 where there are fewer.
  std::vector<float> fill = {};
  /// false: leave the target's borders (fill_borders) to the caller. Of a disc these are also its texels at
  /// the rim whose centres lie outside: filled, they serve look-ups there; left, they hold the mean over
  /// their part inside, which files of discs should have, or the fill.
  bool borders = true;
  /// Positions of texels that were found before, for maps of these shapes; none: they are found on the way.
  /// Results are the same. `automatic`, which looks at corners of texels, doesn't read them.
  std::shared_ptr<const TexelPositions> positions = {};
  Monitor monitor = {};  ///< progress and cancelling
};

/// Fills the target's charts from the source, whose borders must be filled, and then the target's borders.
/// Each is read by its own orientation; channels go by position, and both have as many. The two are different
/// maps. Reads the source only; besides it needs at most a pyramid of a third of the source, and only to
/// minify more than sixteenfold. Positions are exact to 1e-6 of a chart's side. `automatic` keeps light: the
/// integral over the sphere, and that of every texel, within the bounds that docs/filtering.md gives; values
/// beyond ±1e37 may become infinite. Throws Error (bad_request) for maps of other numbers of channels;
/// (mismatch) for positions of other maps; Cancelled.
///
/// A target of the source's own parameterization, size and orientation gets the texels as they are.
WELKIN_API void resample(const Map& source, Map& target, const ResampleOptions& options = {});

/// Size of a chart of `parameterization` that has as many texels per steradian as the map has on average,
/// rounded to an even width.
WELKIN_API ChartSize default_chart_size(const Map& map, const sphere::AnyParameterization& parameterization);

}  // namespace welkin
