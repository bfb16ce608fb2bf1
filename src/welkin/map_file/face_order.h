#pragma once

#include <string>
#include <vector>

#include "welkin/map/edge_texels.h"
#include "welkin/map_file/layout.h"

/// In which order, and turned how, six pictures are the faces of a cube.
namespace welkin::map_file {

/// An order of faces, and how well it joins.
struct FaceOrder {
  std::string faces;     ///< as with_faces takes it
  double step = 0;       ///< FaceEdges::across
  double next_step = 0;  ///< the least of the orders that join worse than by rounding: of another world
};

/// The order and quarter turns in which the edges join best, out of all 720·4⁶. That is the same for all 24
/// ways to turn the world, of which the one is taken that turns the fewest pictures, those of the sides
/// first, and then the one that is nearest to the layout's own order. `pictures` are those of the layout's
/// cells, which are in reading order, and small_faces in size.
FaceOrder find_face_order(const std::vector<Image>& pictures, const Layout& layout,
                          const sphere::AnyParameterization& p, const std::vector<EdgeTexel>& texels);

}  // namespace welkin::map_file
