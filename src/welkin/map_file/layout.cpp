#include "welkin/map_file/layout.h"

#include <algorithm>
#include <cassert>

#include "welkin/base/error.h"
#include "welkin/map_file/cell_walk.h"

namespace welkin {
namespace {

enum Face { px, nx, py, ny, pz, nz };

/// A cube's face as a picture seen from inside: the native face, mirrored.
LayoutCell picture_of(int face, int column, int row, int quarter_turns = 0) {
  return {face, column, row, quarter_turns, true};
}

std::vector<Layout> cube_layouts() {
  const auto line = [](int columns, int rows, LayoutKind kind, bool mirrored) {
    Layout layout{"", kind, columns, rows, {}};
    for (int face = 0; face < 6; ++face) {
      layout.cells.push_back({face, columns == 1 ? 0 : face, columns == 1 ? face : 0, 0, mirrored});
    }
    return layout;
  };
  std::vector<Layout> list;
  // Front (+Z) in the middle as in a lat-long; +X is a quarter to its left.
  //   .  +Y  .   .
  //  +X  +Z  −X  −Z
  //   .  −Y  .   .
  list.push_back({"hcross",
                  LayoutKind::picture,
                  4,
                  3,
                  {picture_of(py, 1, 0), picture_of(px, 0, 1), picture_of(pz, 1, 1), picture_of(nx, 2, 1),
                   picture_of(nz, 3, 1), picture_of(ny, 1, 2)}});
  //   .  +Y  .
  //  +X  +Z  −X
  //   .  −Y  .
  //   .  −Z  .     upside down
  list.push_back({"vcross",
                  LayoutKind::picture,
                  3,
                  4,
                  {picture_of(py, 1, 0), picture_of(px, 0, 1), picture_of(pz, 1, 1), picture_of(nx, 2, 1),
                   picture_of(ny, 1, 2), picture_of(nz, 1, 3, 2)}});
  // The horizontal cross turned a quarter clockwise, its back joined to the top.
  //    .    left   .    .
  //  bottom front top  back
  //    .    right  .    .
  list.push_back({"flat",
                  LayoutKind::picture,
                  4,
                  3,
                  {picture_of(px, 1, 0, 1), picture_of(ny, 0, 1, 1), picture_of(pz, 1, 1, 1),
                   picture_of(py, 2, 1, 1), picture_of(nz, 3, 1, 3), picture_of(nx, 1, 2, 1)}});
  list.push_back(line(6, 1, LayoutKind::picture, true));
  list.back().name = "hstrip";
  list.push_back(line(1, 6, LayoutKind::picture, true));
  list.back().name = "vstrip";
  //  +X  −X  +Y
  //  −Y  +Z  −Z
  list.push_back({"3x2",
                  LayoutKind::picture,
                  3,
                  2,
                  {picture_of(px, 0, 0), picture_of(nx, 1, 0), picture_of(py, 2, 0), picture_of(ny, 0, 1),
                   picture_of(pz, 1, 1), picture_of(nz, 2, 1)}});
  // Two bands of three joined faces: left front right; bottom back top, these on their side.
  list.push_back({"bands",
                  LayoutKind::picture,
                  3,
                  2,
                  {picture_of(px, 0, 0), picture_of(pz, 1, 0), picture_of(nx, 2, 0), picture_of(ny, 0, 1, 3),
                   picture_of(nz, 1, 1, 1), picture_of(py, 2, 1, 3)}});
  // The strip of EXR files with `envmap = cube` (ImfEnvmap.h).
  list.push_back({"openexr",
                  LayoutKind::picture,
                  1,
                  6,
                  {picture_of(px, 0, 0), picture_of(nx, 0, 1), picture_of(py, 0, 2, 2),
                   picture_of(ny, 0, 3, 2), picture_of(pz, 0, 4), picture_of(nz, 0, 5)}});
  list.push_back(line(6, 1, LayoutKind::files, true));
  list.back().name = "faces";
  list.push_back(line(6, 1, LayoutKind::layers, false));
  list.back().name = "layers";
  return list;
}

/// Charts that are pictures already: in a grid `columns` wide, in strips, files and layers.
std::vector<Layout> plain_layouts(int charts, int columns) {
  const auto grid = [charts](std::string name, LayoutKind kind, int across) {
    Layout layout{std::move(name), kind, across, (charts + across - 1) / across, {}};
    for (int chart = 0; chart < charts; ++chart)
      layout.cells.push_back({chart, chart % across, chart / across, 0, false});
    return layout;
  };
  if (charts == 1) return {grid("", LayoutKind::picture, 1)};
  std::vector<Layout> list;
  if (columns != charts) list.push_back(grid("grid", LayoutKind::picture, columns));
  list.push_back(grid("hstrip", LayoutKind::picture, charts));
  list.push_back(grid("vstrip", LayoutKind::picture, 1));
  list.push_back(grid("faces", LayoutKind::files, charts));
  list.push_back(grid("layers", LayoutKind::layers, charts));
  return list;
}

int chart_from_name(const sphere::AnyParameterization& p, std::string name) {
  if (name.size() == 2 && (name[0] == '+' || name[0] == '-')) {
    name = {name[0] == '+' ? 'p' : 'n', static_cast<char>(name[1] | 0x20)};
  }
  const std::vector<std::string> names = chart_names(p);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(ErrorKind::bad_request, unknown_name("face", name, names));
  return static_cast<int>(found - names.begin());
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

/// Puts the layout of that name first.
std::vector<Layout> with_default(std::vector<Layout> list, std::string_view name) {
  std::stable_partition(list.begin(), list.end(), [&](const Layout& layout) { return layout.name == name; });
  return list;
}

}  // namespace

std::vector<Layout> layouts_of(const sphere::AnyParameterization& p) {
  const sphere::Traits& traits = p.traits();
  const int columns = traits.grid_columns > 0 ? traits.grid_columns : p.charts();
  return with_default(traits.cube_faces ? cube_layouts() : plain_layouts(p.charts(), columns), traits.layout);
}

std::vector<std::string> chart_names(const sphere::AnyParameterization& p) {
  if (p.traits().cube_faces) return {"px", "nx", "py", "ny", "pz", "nz"};
  std::vector<std::string> names;
  for (int i = 0; i < p.charts(); ++i) names.push_back(std::to_string(i));
  return names;
}

std::string MapShape::text() const {
  std::string text = parameterization.spec();
  if (!layout.name.empty()) text.insert(parameterization.name().size(), ":" + layout.name);
  return text;
}

MapShape parse_map_shape(std::string_view text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const std::string_view head = text.substr(0, comma);
  const std::size_t colon = head.find(':');
  std::string spec(head.substr(0, colon));
  spec += text.substr(comma);
  auto parameterization = sphere::AnyParameterization::make(spec);
  const std::vector<Layout> layouts = layouts_of(parameterization);
  if (colon == std::string_view::npos) return {parameterization, layouts.front()};
  const std::string_view wanted = head.substr(colon + 1);
  std::vector<std::string> names;
  for (const Layout& layout : layouts) {
    if (layout.name == wanted) return {parameterization, layout};
    if (!layout.name.empty()) names.push_back(layout.name);
  }
  if (names.empty()) {
    throw Error(ErrorKind::bad_request,
                parameterization.name() +
                    " is a single picture: it takes no layout, but ':" + std::string(wanted) + "' was given");
  }
  throw Error(ErrorKind::bad_request, unknown_name("layout of " + parameterization.name(), wanted, names));
}

MapShape for_chart_size(const MapShape& shape, ChartSize size) {
  return {shape.parameterization.at_size(size.width, size.height), shape.layout};
}

Layout for_reflected_world(const Layout& layout, const sphere::AnyParameterization& p) {
  if (!p.traits().cube_faces || layout.kind == LayoutKind::layers) return layout;
  Layout changed = layout;
  const bool adjoining =
      layout.name == "hcross" || layout.name == "vcross" || layout.name == "flat" || layout.name == "bands";
  for (LayoutCell& cell : changed.cells) {
    cell.mirrored = false;
    if (adjoining && cell.chart <= nx) cell.chart = px + nx - cell.chart;
  }
  return changed;
}

Layout with_faces(const Layout& layout, const sphere::AnyParameterization& p, std::string_view faces) {
  const std::vector<std::string> parts = split(faces, ',');
  if (parts.size() != layout.cells.size()) {
    throw Error(ErrorKind::bad_request, "names " + std::to_string(parts.size()) + " faces, but " + p.name() +
                                            " has " + std::to_string(layout.cells.size()));
  }
  Layout changed = layout;
  std::sort(changed.cells.begin(), changed.cells.end(), [](const LayoutCell& a, const LayoutCell& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  std::vector<bool> seen(layout.cells.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::vector<std::string> words = split(parts[i], ':');
    LayoutCell& cell = changed.cells[i];
    cell.chart = chart_from_name(p, words[0]);
    if (seen[static_cast<std::size_t>(cell.chart)])
      throw Error(ErrorKind::bad_request, "names '" + words[0] + "' twice");
    seen[static_cast<std::size_t>(cell.chart)] = true;
    for (std::size_t k = 1; k < words.size(); ++k) {
      if (words[k] == "mirror") {
        // Mirroring a picture that is turned by q is turning the mirrored one by −q.
        cell.mirrored = !cell.mirrored;
        cell.quarter_turns = (4 - cell.quarter_turns) & 3;
      } else if (words[k] == "0" || words[k] == "90" || words[k] == "180" || words[k] == "270") {
        cell.quarter_turns = (cell.quarter_turns + std::stoi(words[k]) / 90) & 3;
      } else {
        throw Error(ErrorKind::bad_request,
                    "'" + parts[i] + "': after the face come 90, 180, 270 or mirror, not '" + words[k] + "'");
      }
    }
    if ((cell.quarter_turns & 1) != 0 && p.aspect() != 1)
      throw Error(ErrorKind::bad_request, "only square charts can be turned by 90°");
  }
  return changed;
}

std::optional<ChartSize> chart_size_in(const Layout& layout, int picture_width, int picture_height) {
  require(layout.columns > 0 && layout.rows > 0, "a layout has at least one column and one row");
  if (picture_width % layout.columns != 0 || picture_height % layout.rows != 0) return std::nullopt;
  return ChartSize{picture_width / layout.columns, picture_height / layout.rows};
}

void check_turns(const Layout& layout, ChartSize size) {
  if (size.width == size.height) return;
  for (const LayoutCell& cell : layout.cells) {
    if ((cell.quarter_turns & 1) == 0) continue;
    throw Error(ErrorKind::mismatch,
                "faces of " + std::to_string(size.width) + "×" + std::to_string(size.height) +
                    " cannot be turned by 90° in " +
                    (layout.name.empty() ? std::string("a picture") : "the layout " + layout.name) +
                    ": they must be square");
  }
}

TexelWalk walk_of(const LayoutCell& cell, ChartSize chart) {
  const int right = chart.width - 1, bottom = chart.height - 1;
  // A picture turned clockwise by one quarter shows at (x, y) what was at (y, h − 1 − x).
  TexelWalk walk;
  switch (cell.quarter_turns & 3) {
    case 0:
      break;
    case 1:
      walk = {0, bottom, 0, -1, 1, 0};
      break;
    case 2:
      walk = {right, bottom, -1, 0, 0, -1};
      break;
    default:
      walk = {right, 0, 0, 1, -1, 0};
      break;
  }
  if (cell.mirrored) {
    walk.start_x = right - walk.start_x;
    walk.right_x = -walk.right_x;
    walk.down_x = -walk.down_x;
  }
  return walk;
}

namespace {

void check_cell(const LayoutCell& cell, ChartSize picture, ChartSize chart) {
  if ((cell.quarter_turns & 1) != 0) std::swap(picture.width, picture.height);
  require(picture.width == chart.width && picture.height == chart.height,
          "a chart and the cell of its picture have other sizes");
}

void check_channels(int a, int b) {
  require(a == b, "a chart and its picture have other numbers of channels");
}

}  // namespace

void copy_from_cell(const LayoutCell& cell, ImageView<const float> picture, ImageView<float> chart) {
  check_cell(cell, {picture.width, picture.height}, {chart.width, chart.height});
  check_channels(chart.channels, picture.channels);
  copy_unwalked(picture, walk_of(cell, {chart.width, chart.height}), chart);
}

void copy_to_cell(const LayoutCell& cell, ImageView<const float> chart, ImageView<float> picture) {
  check_cell(cell, {picture.width, picture.height}, {chart.width, chart.height});
  check_channels(chart.channels, picture.channels);
  copy_to_cell_rows(cell, chart, 0, picture);
}

void copy_to_cell_rows(const LayoutCell& cell, ImageView<const float> chart, int first,
                       ImageView<float> rows) {
  const bool on_its_side = (cell.quarter_turns & 1) != 0;
  require(rows.width == (on_its_side ? chart.height : chart.width) && first >= 0 &&
              first + rows.height <= (on_its_side ? chart.width : chart.height),
          "a chart and the rows of its picture have other sizes");
  check_channels(chart.channels, rows.channels);
  copy_walked(chart, walk_of(cell, {chart.width, chart.height}).from(0, first), rows);
}

void draw_rows(const Layout& layout, ChartSize size, const DrawCell& draw_cell, int first,
               ImageView<float> rows) {
  // All cells are of one size, so those on their side are square.
  const auto [width, height] = size;
  require(rows.width == layout.columns * width && first >= 0 && first + rows.height <= layout.rows * height,
          "the rows to draw lie outside the layout's picture");
  for (int y = 0; y < rows.height;) {
    const int row = (first + y) / height, inside = (first + y) % height;
    const int count = std::min(height - inside, rows.height - y);
    std::vector<bool> filled(static_cast<std::size_t>(layout.columns));
    for (const LayoutCell& cell : layout.cells) {
      if (cell.row != row) continue;
      filled[static_cast<std::size_t>(cell.column)] = true;
      draw_cell(cell, inside, rows.part(cell.column * width, y, width, count));
    }
    for (int column = 0; column < layout.columns; ++column) {
      if (filled[static_cast<std::size_t>(column)]) continue;
      const ImageView<float> black = rows.part(column * width, y, width, count);
      for (int i = 0; i < count; ++i) std::fill_n(black.row(i), width * rows.channels, 0.0f);
    }
    y += count;
  }
}

void draw_rows(const Layout& layout, const std::vector<ImageView<const float>>& charts, int first,
               ImageView<float> rows) {
  require(charts.size() == layout.cells.size() && !charts.empty() && charts.front().channels == rows.channels,
          "a layout is drawn of one picture for each chart, of as many channels as the rows");
  draw_rows(
      layout, {charts.front().width, charts.front().height},
      [&](const LayoutCell& cell, int y, ImageView<float> part) {
        copy_to_cell_rows(cell, charts[static_cast<std::size_t>(cell.chart)], y, part);
      },
      first, rows);
}

}  // namespace welkin
