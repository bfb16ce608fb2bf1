#pragma once

#include <array>
#include <vector>

#include "welkin/scene/scene.h"

namespace welkin::scene {

/// A picture with its pyramid, to be looked up over parallelograms.
class Texture {
 public:
  /// Views of `picture` are kept: it must outlive the texture.
  explicit Texture(const Picture& picture);
  /// Of levels, each half as large as the one before; those that are missing are made. Its edges are clamped.
  explicit Texture(std::vector<Image> levels);

  /// The mean over a parallelogram about (u, v) with the sides `right` and `down`, R G B A: trilinear probes
  /// along its longer side. What the picture lacks is 0, its alpha 1; one channel is grey.
  std::array<float, 4> mean(const std::array<double, 2>& uv, const std::array<double, 2>& right,
                            const std::array<double, 2>& down) const;

 private:
  void make_levels();
  std::array<float, 4> bilinear(std::size_t level, double u, double v) const;

  Wrap across_, down_;
  std::vector<Image> smaller_;                  // those that are its own
  std::vector<ImageView<const float>> levels_;  // all of them
};

}  // namespace welkin::scene
