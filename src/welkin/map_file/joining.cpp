#include "welkin/map_file/joining.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "welkin/map/edge_texels.h"
#include "welkin/map_file/face_order.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/sphere/convention.h"

namespace welkin::map_file {
namespace {

/// Steps that differ by less are of worlds that are alike, or mirror images.
constexpr double kAsWell = 1.05;

Layout in_reading_order(Layout layout) {
  std::sort(layout.cells.begin(), layout.cells.end(), [](const LayoutCell& a, const LayoutCell& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  return layout;
}

/// The layout of that name, as the native world has it.
Layout plain_layout(const sphere::AnyParameterization& p, const std::string& name) {
  for (const Layout& layout : layouts_of(p)) {
    if (layout.name == name) return in_reading_order(layout);
  }
  return in_reading_order(layouts_of(p).front());
}

/// The pictures of the cells in reading order, as they lie in the file.
std::vector<Image> pictures_of(const std::vector<Image>& charts, const Layout& layout) {
  const Layout ordered = in_reading_order(layout);
  std::vector<Image> pictures = blank_small_faces(static_cast<int>(ordered.cells.size()));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const LayoutCell& cell = ordered.cells[i];
    copy_to_cell(cell, charts[static_cast<std::size_t>(cell.chart)].view(), pictures[i].view());
  }
  return pictures;
}

/// The layout as a reading has it.
Layout layout_of(const FaceReading& reading, const Layout& plain, const sphere::AnyParameterization& p) {
  const Layout read = layout_for(plain, p, reading.orientation);
  return reading.faces.empty() ? read : with_faces(read, p, reading.faces);
}

/// The layout's own faces, in reading order, all of them turned by `all`, and the top and the bottom by more.
std::string faces_of(const Layout& layout, const sphere::AnyParameterization& p, const std::string& all,
                     const std::string& top, const std::string& bottom) {
  const std::vector<std::string> names = chart_names(p);
  std::string faces;
  for (const LayoutCell& cell : layout.cells) {
    const std::string& name = names[static_cast<std::size_t>(cell.chart)];
    faces += (faces.empty() ? "" : ",") + name + all;
    if (name == "py") faces += top;
    if (name == "ny") faces += bottom;
  }
  return faces;
}

/// The usual readings, the likelier first; a mirror image of the world joins as well as the world.
std::vector<FaceReading> usual_readings(const Layout& plain, const sphere::AnyParameterization& p) {
  std::vector<FaceReading> list;
  const std::array<std::string, 4> kAll{"", ":180:mirror", ":mirror", ":180"};
  const std::array<std::string, 4> kTurns{"", ":90", ":180", ":270"};
  for (const std::string& all : kAll) {
    for (const char* convention : {"native", "three.js"}) {
      for (const std::string& top : kTurns) {
        for (const std::string& bottom : kTurns) {
          FaceReading reading;
          reading.convention = convention;
          reading.orientation = orientation_for(convention_from_name(convention), p);
          if (!all.empty() || !top.empty() || !bottom.empty())
            reading.faces = faces_of(layout_for(plain, p, reading.orientation), p, all, top, bottom);
          list.push_back(std::move(reading));
        }
      }
    }
  }
  return list;
}

/// The likeliest of the usual readings that join best.
FaceReading best_usual_reading(const std::vector<Image>& pictures, const Layout& plain,
                               const sphere::AnyParameterization& p, const std::vector<EdgeTexel>& texels) {
  std::vector<FaceReading> tried = usual_readings(plain, p);
  double least = std::numeric_limits<double>::max(), next = least;
  for (FaceReading& reading : tried) {
    const Layout read = layout_of(reading, plain, p);
    std::vector<Image> faces = blank_small_faces(static_cast<int>(pictures.size()));
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const LayoutCell& cell = read.cells[i];
      copy_from_cell(cell, pictures[i].view(), faces[static_cast<std::size_t>(cell.chart)].view());
    }
    reading.step = face_edges_of(faces, texels).across;
    least = std::min(least, reading.step);
  }
  const auto as_well = [&](const FaceReading& each) { return each.step <= kAsWell * least; };
  for (const FaceReading& reading : tried) {
    if (!as_well(reading)) next = std::min(next, reading.step);
  }
  FaceReading best = *std::find_if(tried.begin(), tried.end(), as_well);
  best.next_step = next;
  return best;
}

/// Whether a reading's faces join where those as they were read don't.
bool is_better(const FaceReading& reading, const FaceEdges& edges) {
  constexpr double kMuchBetter = 0.5;
  return reading.step < kMuchBetter * edges.across && FaceEdges{reading.step, edges.beside}.join();
}

}  // namespace

std::string FaceReading::text() const {
  const std::string world = convention == "native" ? "the native world" : "the world of " + convention;
  return faces.empty() ? world : world + ", the faces being " + faces;
}

bool FaceReading::is_unsure() const {
  constexpr double kNear = 1.2;
  return next_step < kNear * step;
}

Joining measure_joining(const Map& map, const Layout& layout) {
  const sphere::AnyParameterization& p = map.parameterization;
  const std::vector<EdgeTexel> texels = edge_texels(p);
  const std::vector<Image> charts = small_faces(map);
  Joining joining;
  joining.edges = face_edges_of(charts, texels);
  if (joining.edges.join()) return joining;

  const std::vector<Image> pictures = pictures_of(charts, layout);
  const Layout plain = plain_layout(p, layout.name);
  FaceReading reading = best_usual_reading(pictures, plain, p, texels);
  if (!is_better(reading, joining.edges)) {
    const FaceOrder order = find_face_order(pictures, plain, p, texels);
    reading = {"native", Matrix3{}, order.faces, order.step, order.next_step, true};
  }
  if (is_better(reading, joining.edges)) joining.better = reading;
  return joining;
}

}  // namespace welkin::map_file
