#include "welkin/map_file/joining.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "welkin/map/luminance.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/sphere/convention.h"

namespace welkin::map_file {
namespace {

/// Texels across a face that stands for it: its outermost texels, those next to them, and others to fill the
/// edge.
constexpr int kSide = 64;
constexpr int kFaces = 6;

/// The texel of `size` that stands at place `i` of kSide.
int texel_at(int i, int size) {
  if (i < 2) return std::min(i, size - 1);
  if (i >= kSide - 2) return std::max(0, size - (kSide - i));
  return static_cast<int>((i + 0.5) * size / kSide);
}

using Face = Image;

std::vector<Face> blank_faces() {
  std::vector<Face> faces;
  for (int face = 0; face < kFaces; ++face) faces.emplace_back(kSide, kSide, 1);
  return faces;
}

/// log₂ of luminance over the map's mean, so that dark and bright edges count alike; the darkest count for
/// little.
std::vector<Face> faces_of(const Map& map) {
  std::vector<Face> faces = blank_faces();
  const TexelLuminance luminance(map.channel_names);
  double sum = 0;
  for (int face = 0; face < kFaces; ++face) {
    Face& small = faces[static_cast<std::size_t>(face)];
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
  for (Face& face : faces) {
    for (int i = 0; i < kSide * kSide; ++i) {
      float& value = face.at(0, 0)[i];
      value = static_cast<float>(std::log2((mean > 0 ? static_cast<double>(value) / mean : 0) + kDark));
    }
  }
  return faces;
}

/// A texel at an edge of a face, the one inside of it, and the one across the edge.
struct EdgeTexel {
  int face, x, y, inner_x, inner_y;
  int other_face, other_x, other_y;
};

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

double step_of(const std::vector<Face>& faces, const std::vector<EdgeTexel>& texels) {
  double sum = 0;
  for (const EdgeTexel& t : texels) {
    const auto face = static_cast<std::size_t>(t.face), other = static_cast<std::size_t>(t.other_face);
    sum += std::fabs(static_cast<double>(*faces[face].at(t.x, t.y) - *faces[other].at(t.other_x, t.other_y)));
  }
  return sum / static_cast<double>(texels.size());
}

double inner_step_of(const std::vector<Face>& faces, const std::vector<EdgeTexel>& texels) {
  double sum = 0;
  for (const EdgeTexel& t : texels) {
    const Face& face = faces[static_cast<std::size_t>(t.face)];
    sum += std::fabs(static_cast<double>(*face.at(t.x, t.y) - *face.at(t.inner_x, t.inner_y)));
  }
  return sum / static_cast<double>(texels.size());
}

/// Joined edges differ as neighbours do, and a little more where texels are far apart.
bool is_joined(double step, double inner_step) {
  constexpr double kNoticed = 0.05;  // stops
  return step <= 2 * inner_step + kNoticed;
}

/// The readings to try, the likelier first; a mirror image of the world joins as well as the world.
std::vector<FaceReading> readings(const sphere::AnyParameterization& p) {
  std::vector<FaceReading> list;
  const std::array<const char*, 4> kAll{"", ":180:mirror", ":mirror", ":180"};
  const std::array<const char*, 4> kTurns{"", ":90", ":180", ":270"};
  for (const char* all : kAll) {
    for (const char* convention : {"native", "three.js"}) {
      for (const char* top : kTurns) {
        for (const char* bottom : kTurns) {
          FaceReading reading;
          reading.convention = convention;
          reading.orientation = orientation_for(convention_from_name(convention), p);
          const std::string rest = all;
          if (!rest.empty() || *top != '\0' || *bottom != '\0')
            reading.faces = "px" + rest + ",nx" + rest + ",py" + rest + top + ",ny" + rest + bottom + ",pz" +
                            rest + ",nz" + rest;
          list.push_back(std::move(reading));
        }
      }
    }
  }
  return list;
}

}  // namespace

bool Joining::joins() const {
  return is_joined(step, inner_step);
}

Joining measure_joining(const Map& map, const Layout& layout) {
  const sphere::AnyParameterization& p = map.parameterization;
  const std::vector<EdgeTexel> texels = edge_texels(p);
  const std::vector<Face> charts = faces_of(map);
  Joining joining;
  joining.step = step_of(charts, texels);
  joining.inner_step = inner_step_of(charts, texels);
  if (joining.joins()) return joining;

  // The pictures as they lie in the file, by the names of their faces.
  std::vector<Face> pictures = blank_faces();
  for (const LayoutCell& cell : layout.cells)
    copy_to_cell(cell, charts[static_cast<std::size_t>(cell.chart)].view(),
                 pictures[static_cast<std::size_t>(cell.chart)].view());
  const std::vector<Layout> layouts = layouts_of(p);
  const auto files =
      std::find_if(layouts.begin(), layouts.end(), [](const Layout& each) { return each.name == "hstrip"; });
  std::vector<FaceReading> tried = readings(p);
  for (FaceReading& reading : tried) {
    Layout read = layout_for(*files, p, reading.orientation);
    if (!reading.faces.empty()) read = with_faces(read, p, reading.faces);
    std::vector<Face> faces = blank_faces();
    for (std::size_t slot = 0; slot < read.cells.size(); ++slot) {
      const LayoutCell& cell = read.cells[slot];
      copy_from_cell(cell, pictures[slot].view(), faces[static_cast<std::size_t>(cell.chart)].view());
    }
    reading.step = step_of(faces, texels);
  }
  const auto least = std::min_element(tried.begin(), tried.end(),
                                      [](const auto& a, const auto& b) { return a.step < b.step; });
  // The first that joins as well as the best does.
  constexpr double kAsWell = 1.05, kMuchBetter = 0.5;
  const auto best = std::find_if(tried.begin(), tried.end(),
                                 [&](const auto& each) { return each.step <= kAsWell * least->step; });
  if (best->step < kMuchBetter * joining.step && is_joined(best->step, joining.inner_step))
    joining.better = *best;
  return joining;
}

}  // namespace welkin::map_file
