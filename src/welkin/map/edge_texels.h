#pragma once

#include <vector>

#include "welkin/image/image.h"
#include "welkin/map/face_edges.h"

/// The edges of a cube's faces, on small pictures that stand for them. Internal: what face_edges.h measures,
/// and the search for readings in which faces join.
namespace welkin {

/// Texels across a face that stands for it: its outermost texels, those next to them, and others to fill the
/// edge.
inline constexpr int kSmallFaceSide = 64;

/// The map's faces, kSmallFaceSide² of one channel: log₂ of luminance over the map's mean, so that dark and
/// bright edges count alike; the darkest count for little.
std::vector<Image> small_faces(const Map& map);
/// So many pictures of that size.
std::vector<Image> blank_small_faces(int count);

/// A texel at an edge of a face, the one inside of it, and the one across the edge.
struct EdgeTexel {
  int face, x, y, inner_x, inner_y;
  int other_face, other_x, other_y;
};

/// All of the small faces.
std::vector<EdgeTexel> edge_texels(const sphere::AnyParameterization& p);

FaceEdges face_edges_of(const std::vector<Image>& faces, const std::vector<EdgeTexel>& texels);

}  // namespace welkin
