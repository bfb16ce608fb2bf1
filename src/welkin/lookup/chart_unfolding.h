#pragma once

#include <vector>

#include "welkin/lookup/summed_area.h"
#include "welkin/map/map.h"

/// Rectangles that run past a chart's edges, as rectangles within charts. Internal to lookup.
namespace welkin {

class ChartUnfolding {
 public:
  /// Throws Error (unsupported) for what is neither a lat-long, a cube nor a square octahedron.
  ChartUnfolding(const sphere::AnyParameterization& p, ChartSize size);

  /// Whether a rectangle may be as wide as the chart wherever it lies, and is the whole row then.
  bool goes_around() const { return kind_ == Kind::latlong; }

  /// A rectangle's parts: at most nine, two of which the date line may cut.
  struct Parts {
    int count = 0;
    ChartRectangle list[12];
  };
  /// Of a rectangle that is at most as large as a chart and has its middle in one. On a lat-long and an
  /// octahedron the parts are exactly what lies past the edge; on a cube a face is continued over the one
  /// beside it, texel by texel, and what lies past a corner, where there is nothing, is left out.
  Parts parts_of(const ChartRectangle& r) const;

 private:
  enum class Kind { latlong, octahedron, cube };
  enum Side { left, right, top, bottom };

  /// What lies past an edge of a cube's face.
  struct Neighbour {
    int chart;
    Side edge;      ///< of the neighbour
    bool reversed;  ///< positions along the edge run the other way
  };

  Neighbour neighbour(const sphere::AnyParameterization& p, int chart, Side side) const;
  void add_latlong(const ChartRectangle& r, Parts& parts) const;
  void add_octahedron(const ChartRectangle& r, Parts& parts) const;
  void add_cube(const ChartRectangle& r, Parts& parts) const;

  Kind kind_;
  double width_, height_;
  std::vector<Neighbour> neighbours_;  ///< of a cube: of the four sides of each face
};

}  // namespace welkin
