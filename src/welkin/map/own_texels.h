#pragma once

#include <vector>

#include "welkin/map/map.h"

/// What texels on a rim held before borders were filled. Internal to fill_borders.
namespace welkin {

/// A texel that fill_borders makes.
struct BorderTexel {
  int chart, x, y;
};

/// Texels that are valid somewhere, though not at their centre.
class OwnTexels {
 public:
  /// Those of `texels` in a level, with what they hold.
  OwnTexels(const sphere::AnyParameterization& p, const Level& level, const std::vector<BorderTexel>& texels);

  /// Whether that was light, by what the level has in its place: most are within a quarter of it.
  bool are_light(const Level& level) const;
  /// All of it, or only what is finite.
  void put_back(Level& level, bool finite_only) const;

 private:
  struct Held {
    BorderTexel at;
    std::vector<float> values;
    bool finite;
  };
  std::vector<Held> held_;
};

}  // namespace welkin
