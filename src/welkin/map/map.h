#pragma once

#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/image/pixels.h"
#include "welkin/math/rotation.h"
#include "welkin/sphere/registry.h"

/// @file
/// Maps: a parameterization with pixels and borders.
namespace welkin {

/// Texels of border around every chart at every level: enough for the widest kernel here (Lanczos with four
/// lobes).
inline constexpr int kBorder = 4;

/// The most channels that a map can have.
inline constexpr int kMaxChannels = 64;

/// One resolution of a map: its charts, all of one size, each with kBorder texels of border on every side.
/// Moved, not copied. A chart's view starts at its first texel; texels from −kBorder to width+kBorder−1 can
/// be read.
///
/// Filled borders are an invariant: whoever makes a level, or changes its texels, leaves its borders filled
/// (borders.h). Those of new, black levels are. Code that writes texels itself calls fill_borders afterwards.
class WELKIN_API Level {
 public:
  /// No charts.
  Level() = default;
  /// Charts of one size. Throws Error (bad_request): a side below 1, a width or charts one below the other of
  /// over 2²⁰ texels, channels outside 1 … kMaxChannels; std::bad_alloc.
  Level(int charts, int width, int height, int channels, PixelContents contents = PixelContents::zero);

  int charts() const { return charts_; }                ///< how many charts
  int width() const { return width_; }                  ///< of a chart, texels, without borders
  int height() const { return height_; }                ///< of a chart, texels, without borders
  int channels() const { return storage_.channels(); }  ///< values of a texel

  /// The texels of a chart, valid as long as the level. Throws Error (bad_request) for a chart that there
  /// isn't.
  /// @{
  ImageView<float> chart(int index);
  ImageView<const float> chart(int index) const;
  /// @}

  /// Values from one chart to the next.
  std::ptrdiff_t chart_stride() const;

 private:
  Image storage_;  // the charts one under the other, borders included
  int charts_ = 0;
  int width_ = 0;
  int height_ = 0;
};

/// A map: a parameterization with pixels. Radiance is linear and unclamped. Moved, not copied.
struct WELKIN_API Map {
  /// Where a direction lies in the charts.
  sphere::AnyParameterization parameterization;
  /// The pixels, with as many charts as the parameterization has. Functions rely on it.
  Level level;
  /// One name for each channel, as many as the level has: R G B, Y…. `A` is coverage, not radiance.
  std::vector<std::string> channel_names;
  /// From the world (docs/conventions.md) to the parameterization. Orthonormal, which functions rely on: the
  /// texel at the parameterization's direction d shows the world's direction orientationᵀ·d.
  Matrix3 orientation;

  /// A map of charts of width × height, black unless told otherwise, its orientation the identity. The
  /// parameterization becomes the one at_size. Channel names: R G B, R G B A, Y, Y A, else C0 C1…. Throws as
  /// Level does.
  Map(sphere::AnyParameterization parameterization, int width, int height, int channels,
      PixelContents contents = PixelContents::zero);

  /// A map of pixels of any spacing, float or half, copied once: those of each chart, all of one size and
  /// number of channels, in the parameterization's order of charts. Its borders are filled. Throws Error
  /// (mismatch) for another number of charts or for sizes that differ, and as copy_pixels does.
  static Map from_pixels(const sphere::AnyParameterization& parameterization, std::span<const Pixels> charts);
  /// The same of a single chart.
  static Map from_pixels(const sphere::AnyParameterization& parameterization, const Pixels& chart);

  /// A copy of all of it. Maps are large, so nothing copies one unasked.
  Map clone() const;

  /// Throws Error (bad_request) when the members don't belong together, as code may set them: another number
  /// of charts than the parameterization has, of names than there are channels, an orientation that isn't
  /// orthonormal. Functions that take a map call it.
  void check() const;

  int charts() const { return level.charts(); }      ///< how many charts
  int width() const { return level.width(); }        ///< of a chart, texels
  int height() const { return level.height(); }      ///< of a chart, texels
  int channels() const { return level.channels(); }  ///< values of a texel
};

/// Size of a chart, texels, without borders.
struct ChartSize {
  int width = 0;   ///< columns
  int height = 0;  ///< rows
};

/// What a map is besides its pixels.
struct WELKIN_API MapFrame {
  sphere::AnyParameterization parameterization;  ///< that of charts of this size
  ChartSize size;                                ///< of every chart, texels
  Matrix3 orientation;                           ///< world to map, as Map::orientation

  /// Of a map that need not exist. `world` is its orientation.
  MapFrame(const sphere::AnyParameterization& which, ChartSize charts, const Matrix3& world = {})
      : parameterization(which.at_size(charts.width, charts.height)), size(charts), orientation(world) {}
  /// That of a map.
  MapFrame(const Map& map)
      : parameterization(map.parameterization),
        size{map.width(), map.height()},
        orientation(map.orientation) {}
};

/// Names for the channels of an image that has `count` of them: R G B, R G B A, Y, Y A, else C0 C1….
WELKIN_API std::vector<std::string> default_channel_names(int count);

/// Solid angle of the valid part of every texel of row `row` of a chart of width × height, sr, to `width`
/// values at `out`: 0 for texels that are not valid anywhere. Their relative error is below 1e-5 but where a
/// chart's density has a kink, as along the diagonals of octahedra: there 1e-4, and 1e-3 in charts of fewer
/// than 32 texels; and where it is infinite, on the rim of an orthographic fish-eye: 3e-3. Throws Error
/// (bad_request) for a row that the chart does not have.
WELKIN_API void texel_solid_angles(const sphere::AnyParameterization& parameterization, int width, int height,
                                   int chart, int row, float* out);

}  // namespace welkin
