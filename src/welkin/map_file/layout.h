#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Layouts: how the charts of a map lie in a picture, or in several.
namespace welkin {

/// One chart in the grid of a layout: mirrored left to right first, if so, then turned clockwise by quarter
/// turns.
struct LayoutCell {
  int chart = 0;          ///< the chart's number
  int column = 0;         ///< in the grid, from the left
  int row = 0;            ///< in the grid, from the top
  int quarter_turns = 0;  ///< clockwise, 0 … 3
  bool mirrored = false;  ///< left to right
};

/// Where the charts of a layout are.
enum class LayoutKind {
  picture,  ///< one picture with all charts in a grid of equal cells
  files,    ///< a picture per chart, `%s` in the file's name standing for the chart's name
  layers,   ///< a part (EXR) or page (TIFF) per chart, as the parameterization has it: not mirrored, not
            ///< turned
};

/// How the charts of a map lie in a picture, or in several.
struct Layout {
  std::string name;                       ///< `hcross`; empty for the single picture of a single chart
  LayoutKind kind = LayoutKind::picture;  ///< one picture or several
  int columns = 1;                        ///< of the grid
  int rows = 1;                           ///< of the grid
  std::vector<LayoutCell> cells;          ///< one per chart
};

/// The layouts of a parameterization, its default first. Crosses, strips and face files are pictures seen
/// from inside, never mirrored; native cube faces are (docs/conventions.md). Whether there are
/// crosses, and how wide a grid is, the parameterization's traits say.
WELKIN_API std::vector<Layout> layouts_of(const sphere::AnyParameterization& parameterization);

/// Names of the charts in file names and for with_faces: px nx py ny pz nz for cubes, else 0, 1, 2….
WELKIN_API std::vector<std::string> chart_names(const sphere::AnyParameterization& parameterization);

/// A parameterization and a layout, as text: `cube:hcross`,
/// `fisheye-equidistant,fov=200`.
struct WELKIN_API MapShape {
  sphere::AnyParameterization parameterization;  ///< with its parameters
  Layout layout;                                 ///< one of layouts_of, or changed by with_faces

  /// What parse_map_shape takes; faces that with_faces changed are not in it.
  std::string text() const;
};

/// Parses `NAME[:LAYOUT][,PARAMETER=VALUE]…`; without a layout, the parameterization's default. Throws Error
/// (bad_request) for unknown names, with the nearest, and for values out of range.
WELKIN_API MapShape parse_map_shape(std::string_view text);

/// The shape of charts of this size. It differs where the parameterization depends on the size: parameters
/// `width` and `height` follow it.
WELKIN_API MapShape for_chart_size(const MapShape& shape, ChartSize size);

/// The layout for a map whose orientation is a reflection. Its native faces are unmirrored pictures already,
/// so cells aren't mirrored, and where faces adjoin, +X and −X are swapped.
WELKIN_API Layout for_reflected_world(const Layout& layout,
                                      const sphere::AnyParameterization& parameterization);

/// Another order and rotation of the charts: `px,nx,py:90,ny:270:mirror,pz,nz` names the chart of each of the
/// layout's cells in reading order, and how its picture is turned clockwise (after mirroring) beyond what the
/// layout does. Also `+X` for `px`. Throws Error (bad_request) for what isn't of that form.
WELKIN_API Layout with_faces(const Layout& layout, const sphere::AnyParameterization& parameterization,
                             std::string_view faces);

/// Size of a chart in a picture of this size, or nothing when the grid doesn't divide it.
WELKIN_API std::optional<ChartSize> chart_size_in(const Layout& layout, int picture_width,
                                                  int picture_height);

/// Throws Error when the layout turns a cell by 90° or 270° and charts of this size, not being square, would
/// no longer fit the grid.
WELKIN_API void check_turns(const Layout& layout, ChartSize size);

/// Copies a chart out of a cell's pixels, with as many channels. Throws Error (bad_request) unless their
/// sizes match (swapped for odd quarter turns).
WELKIN_API void copy_from_cell(const LayoutCell& cell, ImageView<const float> picture,
                               ImageView<float> chart);
/// Copies a chart into a cell's pixels, with as many channels. Throws Error (bad_request) unless their sizes
/// match (swapped for odd quarter turns).
WELKIN_API void copy_to_cell(const LayoutCell& cell, ImageView<const float> chart, ImageView<float> picture);
/// The same for some of the cell's rows, from `first` on.
WELKIN_API void copy_to_cell_rows(const LayoutCell& cell, ImageView<const float> chart, int first,
                                  ImageView<float> rows);

/// Fills rows of a cell's picture, those from row y of the cell on.
using DrawCell = std::function<void(const LayoutCell& cell, int y, ImageView<float> rows)>;

/// Rows of a layout's picture, from row `first` on: all cells, of charts of that size, and black where there
/// is none. `rows` is as wide as the picture and ends inside it.
WELKIN_API void draw_rows(const Layout& layout, ChartSize size, const DrawCell& draw_cell, int first,
                          ImageView<float> rows);
/// The same with the chart of its number in `charts` for each cell. There is a chart for every cell, all of
/// one size.
WELKIN_API void draw_rows(const Layout& layout, const std::vector<ImageView<const float>>& charts, int first,
                          ImageView<float> rows);

/// The rectangle of a cell in a picture, whose size the grid divides.
template <class T>
ImageView<T> cell_of(const Layout& layout, const LayoutCell& cell, ImageView<T> picture) {
  const int width = picture.width / layout.columns, height = picture.height / layout.rows;
  return picture.part(cell.column * width, cell.row * height, width, height);
}

}  // namespace welkin
