#pragma once

#include <string>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/math/rotation.h"
#include "welkin/sphere/registry.h"

namespace welkin {

/// Texels of border around every chart at every level: enough for the widest kernel here (Lanczos with four
/// lobes).
inline constexpr int kBorder = 4;

inline constexpr int kMostChannels = 64;

/// One resolution of a map: its charts, all of one size, each with kBorder texels of border on every side.
/// A chart's view starts at its first texel; texels from −kBorder to width+kBorder−1 can be read.
class Level {
 public:
  Level() = default;
  Level(int charts, int width, int height, int channels, PixelContents contents = PixelContents::zero);

  int charts() const { return charts_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return storage_.channels(); }

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
struct Map {
  sphere::AnyParameterization parameterization;
  Level level;
  std::vector<std::string> channel_names;
  Matrix3 orientation;

  /// A map of charts of width × height, black unless told otherwise. Channel names: R G B, R G B A, Y, Y A,
  /// else C0 C1….
  Map(sphere::AnyParameterization parameterization, int width, int height, int channels,
      PixelContents contents = PixelContents::zero);

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
std::vector<std::string> default_channel_names(int count);

/// Solid angle of every texel of a chart's row, sr: `out` has the level's width. Texels that are not valid
/// get 0.
void texel_solid_angles(const sphere::AnyParameterization& parameterization, int width, int height, int chart,
                        int row, float* out);

}  // namespace welkin
