#include <algorithm>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/map_file/map_file.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/map_file/safety_border.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace map_file;

namespace {

/// The map's metadata.
io::WriteOptions declared(const fs::path& path, const Map& map, const Layout& layout,
                          const WriteMapOptions& options) {
  const auto& p = map.parameterization;
  io::WriteOptions image = options.image;
  image.attributes[kShapeKey] = MapShape{p, layout}.text();
  image.attributes[kChartKey] = text_of(ChartSize{map.width(), map.height()});
  if (is_texture(path)) {
    // Which has four channels in any case, or three.
    const auto& names = map.channel_names;
    const bool alpha = std::find(names.begin(), names.end(), "A") != names.end();
    image.attributes[kChannelsKey] = alpha ? "R,G,B,A" : "R,G,B";
  }
  if (!options.faces.empty()) image.attributes[kFacesKey] = options.faces;
  if (options.border > 0) image.attributes[kBorderKey] = std::to_string(options.border);
  // OpenEXR's attribute also says how the world lies: as the native one; and it knows no borders.
  if (!(map.orientation == Matrix3{})) {
    image.attributes[kOrientationKey] = text_of(map.orientation);
  } else if (p.name() == "openexr-latlong" && options.border == 0) {
    image.envmap = "latlong";
  } else if (p.name() == "openexr-cube" && layout.name == "openexr" && options.faces.empty() &&
             options.border == 0) {
    image.envmap = "cube";
  }
  return image;
}

/// The pictures of a map in a layout, one after the other. Charts that lie in them as they are need no copy.
class Pictures {
 public:
  Pictures(const Layout& placed, int border) : placed_(placed), border_(border) {}

  /// The picture of one cell, which this keeps until the next `drop`.
  ImageView<const float> of_cell(const Map& map, const LayoutCell& cell) {
    if (is_plain(cell)) return map.level.chart(cell.chart);
    const int width = map.width() + 2 * border_, height = map.height() + 2 * border_;
    const bool on_its_side = (cell.quarter_turns & 1) != 0;
    Image& picture =
        kept_.emplace_back(on_its_side ? height : width, on_its_side ? width : height, map.channels());
    draw(map, cell, picture.view());
    return picture.view();
  }

  /// The picture of all cells.
  ImageView<const float> of_all(const Map& map) {
    if (placed_.cells.size() == 1 && is_plain(placed_.cells[0])) return map.level.chart(0);
    const int width = map.width() + 2 * border_, height = map.height() + 2 * border_;
    Image& picture = kept_.emplace_back(placed_.columns * width, placed_.rows * height, map.channels());
    for (const LayoutCell& cell : placed_.cells) {
      draw(map, cell, cell_of(placed_, cell, picture.view()));
    }
    return picture.view();
  }

  void drop() { kept_.clear(); }

 private:
  bool is_plain(const LayoutCell& cell) const {
    return !cell.mirrored && cell.quarter_turns == 0 && border_ == 0;
  }
  void draw(const Map& map, const LayoutCell& cell, ImageView<float> picture) const {
    if (border_ == 0) return copy_to_cell(cell, map.level.chart(cell.chart), picture);
    const Image chart = with_safety_border(map, cell.chart, border_);
    copy_to_cell(cell, chart.view(), picture);
  }

  const Layout& placed_;
  int border_;
  std::vector<Image> kept_;
};

}  // namespace

void check_face_pattern(const fs::path& path, const Layout& layout) {
  if (is_pattern(path) == (layout.kind == LayoutKind::files)) return;
  throw Error(path.string() +
              (is_pattern(path)
                   ? ": %s stands for a face's name: write to :faces, as in cube:faces"
                   : ": several files are written: put %s in the name, where the face's name goes"));
}

bool holds_levels(const fs::path& path) {
  return is_texture(path) || extension_of(path) == "exr";
}

const Layout& default_layout(const sphere::AnyParameterization& parameterization, const fs::path& path,
                             int levels) {
  const std::vector<Layout>& layouts = layouts_of(parameterization);
  const auto named = [&](const char* name) -> const Layout& {
    const auto found = std::find_if(layouts.begin(), layouts.end(),
                                    [&](const Layout& layout) { return layout.name == name; });
    return found == layouts.end() ? layouts.front() : *found;
  };
  if (is_texture(path)) return named("layers");
  if (levels > 1 && layouts.front().name == "hcross") return named("vstrip");
  return layouts.front();
}

MapShape parse_map_shape_for(const fs::path& path, std::string_view text, int levels) {
  MapShape shape = parse_map_shape(text);
  if (text.substr(0, text.find(',')).find(':') == std::string_view::npos)
    shape.layout = default_layout(shape.parameterization, path, levels);
  return shape;
}

MapShape shape_for_copy(const MapFileInfo& from, const fs::path& to, int levels) {
  // By its name: the turns that the faces were given are undone by reading it.
  MapShape shape = parse_map_shape(from.shape->text());
  if ((from.image.format == "ktx2") != is_texture(to))
    shape.layout = default_layout(shape.parameterization, to, levels);
  return shape;
}

std::vector<fs::path> files_of(const fs::path& path, const sphere::AnyParameterization& parameterization) {
  if (!is_pattern(path)) return {path};
  std::vector<fs::path> files;
  for (const std::string& name : chart_names(parameterization)) files.push_back(chart_path(path, name));
  return files;
}

io::WriteReport map_file::write_levels(const fs::path& path, std::span<const Map* const> levels,
                                       const Layout& layout, const WriteMapOptions& options) {
  const Map& finest = *levels.front();
  const auto& p = finest.parameterization;
  Layout placed = layout_for(layout, p, finest.orientation);
  if (!options.faces.empty()) placed = with_faces(placed, p, options.faces);
  check_face_pattern(path, placed);
  const io::WriteOptions image = declared(path, finest, layout, options);
  const std::vector<std::string> names = chart_names(p);
  Pictures pictures(placed, options.border);
  if (placed.kind == LayoutKind::files) {
    return io::write_set(
        placed.cells.size(),
        [&](std::size_t i) {
          pictures.drop();
          return io::WriteFile{chart_path(path, names[i]),
                               {{"", pictures.of_cell(finest, placed.cells[i]), finest.channel_names}}};
        },
        image);
  }
  // Only faces that a look-up by direction is meant for make a cube texture.
  const bool texture = is_texture(path), cube = p.name() == "cube";
  std::vector<io::WritePart> parts;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const Map& map = *levels[level];
    if (placed.kind == LayoutKind::picture) {
      parts.push_back({"", pictures.of_all(map), map.channel_names, static_cast<int>(level)});
      continue;
    }
    for (std::size_t i = 0; i < placed.cells.size(); ++i) {
      const int index = static_cast<int>(i);
      parts.push_back({texture ? "" : names[i], pictures.of_cell(map, placed.cells[i]), map.channel_names,
                       static_cast<int>(level), texture && !cube ? index : 0, texture && cube ? index : 0});
    }
  }
  return io::write(path, parts, image);
}

io::WriteReport write_map(const fs::path& path, const Map& map, const Layout& layout,
                          const WriteMapOptions& options) {
  const Map* const level = &map;
  return write_levels(path, {&level, 1}, layout, options);
}

}  // namespace welkin
