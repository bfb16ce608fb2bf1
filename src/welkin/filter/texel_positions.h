#pragma once

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/map/map.h"

/// @file
/// Where the texels of a map lie in another, for many maps of the same shapes.
namespace welkin {

/// Positions of a target's texel centres in a source, found once for the frames of a sequence
/// (ResampleOptions::positions), which come out as without them, bit for bit. 8 bytes for each texel of the
/// target, 12 where the source has several charts. Immutable; safe from many threads.
class WELKIN_API TexelPositions {
 public:
  /// Of maps that need not exist; `rotation` is ResampleOptions::rotation. Throws Error (bad_request): sizes
  /// below 1, a rotation that isn't orthonormal; std::bad_alloc.
  TexelPositions(const MapFrame& source, const MapFrame& target, const Matrix3& rotation = {});

  /// Whether they are those of maps like these.
  bool fit(const MapFrame& source, const MapFrame& target, const Matrix3& rotation = {}) const;

  /// @cond INTERNAL
  /// Row y of a chart of the target, a value for each texel. Up to 64 bytes past the last can be read.
  /// @{
  const float* u(int chart, int y) const { return row(u_, chart, y); }  ///< NaN: it gets the fill
  const float* v(int chart, int y) const { return row(v_, chart, y); }
  /// Null where the source has one chart.
  const float* chart(int chart, int y) const { return chart_.empty() ? nullptr : row(chart_, chart, y); }
  /// @}
  /// @endcond

 private:
  const float* row(const Image& image, int chart, int y) const {
    return image.at(0, chart * target_.size.height + y);
  }
  void locate_row(const Matrix3& to_source, int chart, int y);

  MapFrame source_, target_;
  Matrix3 rotation_;
  Image u_, v_, chart_;  ///< rows of one chart after those of another
};

}  // namespace welkin
