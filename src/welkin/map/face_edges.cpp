#include "welkin/map/face_edges.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/map/edge_texels.h"
#include "welkin/map/luminance.h"

namespace welkin {
namespace {

constexpr int kSide = kSmallFaceSide;
constexpr int kFaces = 6;

/// The texel of `size` that stands at place `i` of kSide.
int texel_at(int i, int size) {
  if (i < 2) return std::min(i, size - 1);
  if (i >= kSide - 2) return std::max(0, size - (kSide - i));
  return static_cast<int>((i + 0.5) * size / kSide);
}

}  // namespace

std::vector<Image> small_faces(const Map& map) {
  std::vector<Image> faces = blank_small_faces(kFaces);
  const TexelLuminance luminance(map.channel_names);
  double sum = 0;
  for (int face = 0; face < kFaces; ++face) {
    Image& small = faces[static_cast<std::size_t>(face)];
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double value = static_cast<double>(
            luminance(map.level.chart(face).at(texel_at(x, map.width()), texel_at(y, map.height()))));
        const double kept = std::isfinite(value) ? std::max(value, 0.0) : 0;
        *small.at(x, y) = static_cast<float>(kept);
        sum += std::min(kept, 1e30);
      }
    }
  }
  const double mean = sum / (kFaces * kSide * kSide);
  constexpr double kDark = 1.0 / 16;
  for (Image& face : faces) {
    for (int i = 0; i < kSide * kSide; ++i) {
      float& value = face.at(0, 0)[i];
      value = static_cast<float>(std::log2((mean > 0 ? static_cast<double>(value) / mean : 0) + kDark));
    }
  }
  return faces;
}

std::vector<Image> blank_small_faces(int count) {
  std::vector<Image> faces;
  for (int face = 0; face < count; ++face) faces.emplace_back(kSide, kSide, 1);
  return faces;
}

std::vector<EdgeTexel> edge_texels(const sphere::AnyParameterization& p) {
  std::vector<EdgeTexel> list;
  const auto place = [](double u) { return std::clamp(static_cast<int>(u * kSide), 0, kSide - 1); };
  for (int face = 0; face < kFaces; ++face) {
    for (int edge = 0; edge < 4; ++edge) {
      for (int i = 0; i < kSide; ++i) {
        const int last = kSide - 1;
        const int x = edge == 0 ? 0 : edge == 1 ? last : i, y = edge == 2 ? 0 : edge == 3 ? last : i;
        const int out_x = edge == 0 ? -1 : edge == 1 ? 1 : 0, out_y = edge == 2 ? -1 : edge == 3 ? 1 : 0;
        const double u = (x + 0.5 + out_x) / kSide, v = (y + 0.5 + out_y) / kSide;
        // Past the edge the face's plane goes on, and the direction is another face's.
        const sphere::ChartPoint<double> other = p.from_sphere(p.to_sphere(face, u, v));
        if (static_cast<int>(other.chart) == face) continue;
        list.push_back({face, x, y, x - out_x, y - out_y, static_cast<int>(other.chart), place(other.u),
                        place(other.v)});
      }
    }
  }
  return list;
}

FaceEdges face_edges_of(const std::vector<Image>& faces, const std::vector<EdgeTexel>& texels) {
  FaceEdges edges;
  for (const EdgeTexel& t : texels) {
    const Image& face = faces[static_cast<std::size_t>(t.face)];
    const Image& other = faces[static_cast<std::size_t>(t.other_face)];
    const float value = *face.at(t.x, t.y);
    edges.across += std::fabs(static_cast<double>(value - *other.at(t.other_x, t.other_y)));
    edges.beside += std::fabs(static_cast<double>(value - *face.at(t.inner_x, t.inner_y)));
  }
  edges.across /= static_cast<double>(texels.size());
  edges.beside /= static_cast<double>(texels.size());
  return edges;
}

bool FaceEdges::join() const {
  // Joined edges differ as neighbours do, and a little more where texels are far apart.
  constexpr double kNoticed = 0.05;  // stops
  return across <= 2 * beside + kNoticed;
}

FaceEdges measure_face_edges(const Map& map) {
  if (!map.parameterization.traits().cube_faces)
    throw Error(ErrorKind::bad_request, map.parameterization.name() + " has no cube's faces");
  return face_edges_of(small_faces(map), edge_texels(map.parameterization));
}

}  // namespace welkin
