#pragma once

#include <span>
#include <vector>

#include "welkin/map/map.h"
#include "welkin/render/trace/surface.h"

namespace welkin::scene {

/// A place in a picture, in its pixels: centres at +½.
struct PicturePlace {
  float x = 0;    ///< to the right
  float y = 0;    ///< down
  int chart = 0;  ///< of a picture with several: a cube's face
};

/// The rays of a picture, whose parameterization is the lens, taken at a place in the world.
class CameraRays {
 public:
  CameraRays(MapFrame frame, const Vec3d& position);

  /// The ray through each place, and its change over `spacing` pixels; `valid` tells which the lens shows.
  void rays(std::span<const PicturePlace> places, double spacing, std::vector<RaySpread>& rays,
            std::vector<bool>& valid) const;

  const MapFrame& frame() const { return frame_; }

 private:
  MapFrame frame_;
  Matrix3 to_world_;
  Vec3d position_;
};

}  // namespace welkin::scene
