#pragma once

#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/image/pixels.h"
#include "welkin/math/rotation.h"
#include "welkin/sphere/registry.h"

namespace welkin {

/// Texels of border around every chart at every level: enough for the widest kernel here (Lanczos with four
/// lobes).
inline constexpr int kBorder = 4;

inline constexpr int kMaxChannels = 64;

/// One resolution of a map: its charts, all of one size, each with kBorder texels of border on every side.
/// A chart's view starts at its first texel; texels from −kBorder to width+kBorder−1 can be read.
///
/// Filled borders are an invariant: whoever makes a level, or changes its texels, leaves its borders filled
/// (borders.h). Those of new, black levels are. Code that writes texels itself calls fill_borders afterwards.
class WELKIN_API Level {
 public:
  Level() = default;
  Level(int charts, int width, int height, int channels, PixelContents contents = PixelContents::zero);

  int charts() const { return charts_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return storage_.channels(); }

  /// Throws Error (bad_request) for a chart that there isn't.
  ImageView<float> chart(int index);
  ImageView<const float> chart(int index) const;
  /// Values from one chart to the next.
  std::ptrdiff_t chart_stride() const;

 private:
  Image storage_;  // the charts one under the other, borders included
  int charts_ = 0;
  int width_ = 0;
  int height_ = 0;
};

/// A map: a parameterization with pixels. Radiance is linear, unclamped, and positions are in the native
/// world (docs/conventions.md) turned by `orientation`: the texel at parameterization direction d shows the
/// world's direction orientationᵀ·d.
struct WELKIN_API Map {
  sphere::AnyParameterization parameterization;
  Level level;
  std::vector<std::string> channel_names;
  Matrix3 orientation;

  /// A map of charts of width × height, black unless told otherwise. Channel names: R G B, R G B A, Y, Y A,
  /// else C0 C1….
  Map(sphere::AnyParameterization parameterization, int width, int height, int channels,
      PixelContents contents = PixelContents::zero);

  /// A map of somebody's pixels, copied once: those of each chart, all of one size and number of channels, in
  /// the parameterization's order of charts. Its borders are filled. Throws Error (mismatch) for another
  /// number of charts or for sizes that differ, and as copy_pixels does.
  static Map from_pixels(const sphere::AnyParameterization& parameterization, std::span<const Pixels> charts);
  /// The same of a single chart.
  static Map from_pixels(const sphere::AnyParameterization& parameterization, const Pixels& chart);

  int charts() const { return level.charts(); }
  int width() const { return level.width(); }
  int height() const { return level.height(); }
  int channels() const { return level.channels(); }
};

struct ChartSize {
  int width = 0;
  int height = 0;
};

/// Names for the channels of an image that has `count` of them.
WELKIN_API std::vector<std::string> default_channel_names(int count);

/// Solid angle of every texel of a chart's row, sr: `out` has the level's width. Texels that are not valid
/// get 0.
WELKIN_API void texel_solid_angles(const sphere::AnyParameterization& parameterization, int width, int height,
                                   int chart, int row, float* out);

}  // namespace welkin
