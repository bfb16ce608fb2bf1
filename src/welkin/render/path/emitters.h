#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "welkin/render/trace/traced_scene.h"
#include "welkin/scene/scene.h"

namespace welkin::scene {

/// The triangles of a scene that glow, drawn in proportion to area × emission (without its picture).
class Emitters {
 public:
  explicit Emitters(const Scene& scene);

  bool empty() const { return ends_.empty(); }
  /// A place on one of them, as a hit whose distance isn't known, where it lies in the world.
  struct Drawn {
    Hit hit;
    Vec3d position;
  };
  /// From three numbers in [0, 1).
  Drawn draw(double which, double u1, double u2) const;
  /// Probability per area of drawing a place of this instance; 0 of what doesn't glow.
  double density(std::uint32_t instance) const;

 private:
  struct Corners {
    Vec3d p0, e1, e2;
  };
  Corners corners(std::uint32_t instance, std::uint32_t triangle) const;

  const Scene& scene_;
  struct Part {
    std::uint32_t instance;
    double density;     // per area
    std::size_t first;  // of its triangles in `ends_`
  };
  std::vector<Part> parts_;
  std::vector<std::int64_t> part_of_;  // of each instance; −1: doesn't glow
  std::vector<double> ends_;           // sums of triangles' shares, to 1
};

}  // namespace welkin::scene
