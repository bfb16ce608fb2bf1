#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map_file/layout.h"

/// @file
/// Pictures of 8 bits resampled as they are, for the frames of a video.
namespace welkin {

/// A window onto 8-bit pixels, channels interleaved: rows of `width` pixels, origin top-left.
template <class T>
struct ByteView {
  T* data = nullptr;              ///< the first value of the top left pixel
  int width = 0;                  ///< pixels in a row
  int height = 0;                 ///< rows
  int channels = 0;               ///< values of a pixel, 1 to 4; 1 also for each plane of planar pictures
  std::ptrdiff_t row_stride = 0;  ///< bytes from one row to the next
};

/// Resamples 8-bit pictures of one shape into another, bilinearly, in whatever transfer function they have,
/// as tools for video do: the positions are found once, in 8 bytes for each pixel of the target, and each
/// frame is read and written once. Positions are rounded to 1/64 texel, values to nearest. Immutable: apply()
/// from many threads at once.
class WELKIN_API ByteRemap {
 public:
  /// From pictures of one chart to pictures of this shape in its layout, by the charts' orientations; what
  /// the source doesn't show, and where no chart lies, gets `fill`. Positions are exact to 1e-6 of a chart's
  /// side before they are rounded. Throws Error (bad_request): a source of several charts, a target whose
  /// layout isn't one picture; (too_large) a source of 2³¹ pixels and more.
  ByteRemap(const MapFrame& source, const MapFrame& target, const Layout& layout, std::uint8_t fill = 0);

  ChartSize source_size() const { return source_; }  ///< of pictures to read, pixels
  ChartSize target_size() const { return target_; }  ///< of pictures to write, pixels

  /// One frame, on TBB's threads. The pictures don't overlap. Throws Error (mismatch) for other sizes, and
  /// numbers of channels that differ or aren't 1 to 4.
  void apply(const ByteView<const std::uint8_t>& source, const ByteView<std::uint8_t>& target) const;

 private:
  /// The top left of 2×2 texels: its index in the source, or one in edges_, and the shares of the right and
  /// the lower ones in 64ths.
  struct Tap {
    std::uint32_t texel;
    std::uint16_t right, down;
  };
  /// Four texels that don't lie together: across a seam or a pole, or at the edge of what is shown.
  struct Edge {
    std::uint32_t texels[4];
  };
  static constexpr std::uint32_t kIsEdge = 0x80000000U, kIsFill = 0xffffffffU;

  template <int kChannels>
  void apply_rows(const std::uint8_t* source, std::ptrdiff_t stride, std::uint8_t* out, const Tap* taps,
                  int count) const;
  Tap tap_at(const MapFrame& source, float u, float v, std::vector<Edge>& edges) const;

  ChartSize source_, target_;
  std::uint8_t fill_;
  std::vector<Tap> taps_;  ///< row by row of the target
  std::vector<Edge> edges_;
};

}  // namespace welkin
