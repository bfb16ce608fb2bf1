#pragma once

#include "welkin/io/heif/library.h"

namespace welkin::io::heif {

/// Decoded planes → linear values of Y or R G B, with A where there is alpha: of k/(2^n − 1) for those of n
/// bits, each the correctly rounded one.
class Planes {
 public:
  /// `code_points` may be null. Throws Error (unsupported) for matrices that libheif doesn't undo. `picture`
  /// must outlive this.
  Planes(const Picture& picture, const heif_color_profile_nclx* code_points, const Source& source);

  int width() const { return channels_.front().width; }
  int height() const { return channels_.front().height; }
  int depth() const { return depth_; }  ///< bits of a stored value of colour
  bool grey() const { return grey_; }
  bool alpha() const { return channels_.size() % 2 == 0; }

  /// Whether sRGB is undone; linear at first. Alpha stays as it is.
  void set_colour(Colour colour);

  /// Row y: the stored channel channels[k] of pixel x goes to out[x·step + k].
  void read_row(int y, std::span<const int> channels, float* out, std::ptrdiff_t step) const;

 private:
  struct Plane {
    const std::uint8_t* data;
    std::ptrdiff_t stride;
    int width, height;
    bool wide;                  ///< 16 bits for each value
    double zero, one;           ///< codes of 0 and 1
    std::vector<float> values;  ///< of each code
  };

  /// `black` and `white` are codes of 8 bits.
  Plane plane(const Picture& picture, heif_channel channel, int black, int white, const Source& source) const;

  bool grey_;
  int depth_;
  std::vector<Plane> channels_;
};

}  // namespace welkin::io::heif
