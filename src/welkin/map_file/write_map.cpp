#include <algorithm>
#include <deque>
#include <functional>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/map_file/map_file.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/map_file/panorama.h"
#include "welkin/map_file/safety_border.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace map_file;

namespace {

/// The map's metadata.
io::WriteOptions declared(const io::Capabilities& format, const WrittenLevel& map, const Layout& layout,
                          const WriteMapOptions& options) {
  const auto& p = map.frame.parameterization;
  io::WriteOptions image = options.image;
  image.attributes[kShapeKey] = MapShape{p, layout}.text();
  image.attributes[kChartKey] = text_of(map.frame.size);
  if (format.texture) {
    // Which has four channels in any case, or three.
    const auto& names = map.channel_names;
    const bool alpha = std::find(names.begin(), names.end(), "A") != names.end();
    image.attributes[kChannelsKey] = alpha ? "R,G,B,A" : "R,G,B";
  }
  if (!options.faces.empty()) image.attributes[kFacesKey] = options.faces;
  if (!options.convention.empty() && options.convention != "native")
    image.attributes[kConventionKey] = options.convention;
  if (options.border > 0) image.attributes[kBorderKey] = std::to_string(options.border);
  if (options.border == 0) image.panorama = panorama_of(map.frame);
  // OpenEXR's attribute also says how the world lies: as the native one; and it knows no borders.
  if (!(map.frame.orientation == Matrix3{})) {
    image.attributes[kOrientationKey] = text_of(map.frame.orientation);
  } else if (const sphere::Traits& traits = p.traits();
             !traits.envmap.empty() && options.faces.empty() && options.border == 0 &&
             (traits.layout.empty() || traits.layout == layout.name)) {
    image.envmap = std::string(traits.envmap);
  }
  return image;
}

/// The pictures of maps in a layout. Charts that lie in them as they are need no copy, and others are turned
/// when their rows are written; only safety borders are made before.
class Pictures {
 public:
  Pictures(const Layout& placed, int border) : placed_(placed), border_(border) {}

  /// The picture of one cell, as a part without name or position. Refers to the map, and to what this keeps
  /// until the next `drop`.
  io::WritePart of_cell(const WrittenLevel& level, const LayoutCell& cell) {
    const bool on_its_side = (cell.quarter_turns & 1) != 0;
    if (level.map == nullptr) {
      const auto [width, height] = level.frame.size;
      return drawn(level, on_its_side ? height : width, on_its_side ? width : height,
                   [&cell, &level](int y, ImageView<float> rows) { level.draw(cell, y, rows); });
    }
    const ImageView<const float> chart = chart_of(*level.map, cell.chart);
    if (!cell.mirrored && cell.quarter_turns == 0) return {"", chart, level.channel_names};
    return drawn(level, on_its_side ? chart.height : chart.width, on_its_side ? chart.width : chart.height,
                 [&cell, chart](int y, ImageView<float> rows) { copy_to_cell_rows(cell, chart, y, rows); });
  }

  /// The picture of all cells.
  io::WritePart of_all(const WrittenLevel& level) {
    if (placed_.cells.size() == 1) return of_cell(level, placed_.cells[0]);
    if (level.map == nullptr) {
      const auto [width, height] = level.frame.size;
      return drawn(level, width * placed_.columns, height * placed_.rows,
                   [&layout = placed_, &level](int y, ImageView<float> rows) {
                     draw_rows(layout, level.frame.size, level.draw, y, rows);
                   });
    }
    const Map& map = *level.map;
    std::vector<ImageView<const float>> charts;
    for (int chart = 0; chart < map.charts(); ++chart) charts.push_back(chart_of(map, chart));
    const int width = charts.front().width * placed_.columns, height = charts.front().height * placed_.rows;
    return drawn(level, width, height, [&layout = placed_, charts](int y, ImageView<float> rows) {
      draw_rows(layout, charts, y, rows);
    });
  }

  void drop() { bordered_.clear(); }

 private:
  ImageView<const float> chart_of(const Map& map, int chart) {
    if (border_ == 0) return map.level.chart(chart);
    return bordered_.emplace_back(with_safety_border(map, chart, border_)).view();
  }
  static io::WritePart drawn(const WrittenLevel& level, int width, int height,
                             std::function<void(int, ImageView<float>)> draw) {
    const int channels = static_cast<int>(level.channel_names.size());
    io::WritePart part{"", {nullptr, width, height, channels, 0}, level.channel_names};
    part.draw = std::move(draw);
    part.rows_at_once = level.rows_at_once;
    return part;
  }

  const Layout& placed_;
  int border_;
  std::deque<Image> bordered_;
};

}  // namespace

void check_face_pattern(const fs::path& path, const Layout& layout) {
  if (is_pattern(path) == (layout.kind == LayoutKind::files)) return;
  throw Error(ErrorKind::bad_request, path.string(),
              (is_pattern(path)
                   ? "%s stands for a face's name: write to :faces, as in cube:faces, or to a name without it"
                   : "several files are written: put %s in the name, where the face's name goes"));
}

bool holds_levels(const fs::path& path) {
  return capabilities_or_none(path).levels;
}

Layout default_layout(const sphere::AnyParameterization& parameterization, const io::Capabilities& format,
                      int levels) {
  const std::vector<Layout> layouts = layouts_of(parameterization);
  const auto named = [&](std::string_view name) -> const Layout& {
    const auto found = std::find_if(layouts.begin(), layouts.end(),
                                    [&](const Layout& layout) { return layout.name == name; });
    return found == layouts.end() ? layouts.front() : *found;
  };
  if (format.texture) return named("layers");
  if (levels > 1 && layouts.front().name == "hcross") return named("vstrip");
  return layouts.front();
}

Layout default_layout(const sphere::AnyParameterization& parameterization, const fs::path& path, int levels) {
  return default_layout(parameterization, capabilities_or_none(path), levels);
}

MapShape parse_map_shape_for(const fs::path& path, std::string_view text, int levels) {
  MapShape shape = parse_map_shape(text);
  if (text.substr(0, text.find(',')).find(':') == std::string_view::npos)
    shape.layout = default_layout(shape.parameterization, path, levels);
  return shape;
}

MapShape shape_for_copy(const MapFileInfo& from, const fs::path& to, int levels) {
  require(from.shape.has_value(), "the shape of the map to copy is unknown");
  // By its name: reading it undoes the turns that the faces were given.
  MapShape shape = parse_map_shape(from.shape->text());
  if (io::capabilities(from.image.format).texture != capabilities_or_none(to).texture)
    shape.layout = default_layout(shape.parameterization, to, levels);
  return shape;
}

std::vector<fs::path> files_of(const fs::path& path, const sphere::AnyParameterization& parameterization) {
  if (!is_pattern(path)) return {path};
  std::vector<fs::path> files;
  for (const std::string& name : chart_names(parameterization)) files.push_back(chart_path(path, name));
  return files;
}

io::WriteReport map_file::write_levels(const Destination& destination, std::span<const WrittenLevel> levels,
                                       const Layout& layout, const WriteMapOptions& options, int sets) {
  const WrittenLevel& finest = levels.front();
  const std::size_t of_set = levels.size() / static_cast<std::size_t>(sets);
  const auto& p = finest.frame.parameterization;
  Layout placed = layout_for(layout, p, finest.frame.orientation);
  if (!options.faces.empty()) placed = with_faces(placed, p, options.faces);
  if (destination.sink == nullptr) check_face_pattern(destination.path, placed);
  const io::WriteOptions image = declared(destination.format, finest, layout, options);
  const std::vector<std::string> names = chart_names(p);
  Pictures pictures(placed, options.border);
  if (placed.kind == LayoutKind::files) {
    require(destination.sink == nullptr, "a layout of several files cannot be written to one sink");
    return io::write_set(
        placed.cells.size(),
        [&](std::size_t i) {
          pictures.drop();
          return io::WriteFile{chart_path(destination.path, names[i]),
                               {pictures.of_cell(finest, placed.cells[i])}};
        },
        image);
  }
  // Only faces that a look-up by direction is meant for make a cube texture.
  const bool texture = destination.format.texture, cube = p.traits().cube_texture;
  std::vector<io::WritePart> parts;
  for (std::size_t each = 0; each < levels.size(); ++each) {
    const WrittenLevel& map = levels[each];
    const int level = static_cast<int>(each % of_set), set = static_cast<int>(each / of_set);
    const std::string prefix = sets > 1 ? "view" + std::to_string(set) : "";
    if (placed.kind == LayoutKind::picture) {
      parts.push_back(pictures.of_all(map));
      parts.back().name = texture ? "" : prefix;
      parts.back().level = level;
      parts.back().layer = texture ? set : 0;
      continue;
    }
    for (std::size_t i = 0; i < placed.cells.size(); ++i) {
      const int index = static_cast<int>(i);
      io::WritePart& part = parts.emplace_back(pictures.of_cell(map, placed.cells[i]));
      part.name = texture ? "" : prefix.empty() ? names[i] : prefix + "." + names[i];
      part.level = level;
      part.layer = !texture ? 0 : cube ? set : set * static_cast<int>(placed.cells.size()) + index;
      part.face = texture && cube ? index : 0;
    }
  }
  if (destination.sink != nullptr)
    return io::write(*destination.sink, destination.format.format, parts, image);
  return io::write(destination.path, parts, image);
}

io::WriteReport write_map(const fs::path& path, const Map& map, const Layout& layout,
                          const WriteMapOptions& options) {
  const WrittenLevel level(map);
  return write_levels(Destination(path), {&level, 1}, layout, options);
}

io::WriteReport write_map(const fs::path& path, const Map& map, const WriteMapOptions& options) {
  return write_map(path, map, default_layout(map.parameterization, path), options);
}

io::WriteReport write_map(io::ByteSink& sink, std::string_view format, const Map& map,
                          const WriteMapOptions& options) {
  const Destination destination(sink, format);
  const WrittenLevel level(map);
  return write_levels(destination, {&level, 1}, default_layout(map.parameterization, destination.format, 1),
                      options);
}

void check_write_map(const fs::path& path, const MapShape& shape, ChartSize size, int levels,
                     const std::vector<std::string>& channels, const WriteMapOptions& options) {
  Layout layout = shape.layout;
  if (!options.faces.empty()) layout = with_faces(layout, shape.parameterization, options.faces);
  check_face_pattern(path, layout);
  check_turns(layout, size);
  check_border(options.border, size);
  check_chain(path, shape, size, levels, options);
  const bool one_picture = layout.kind == LayoutKind::picture;
  const int width = (one_picture ? layout.columns : 1) * (size.width + 2 * options.border);
  const int height = (one_picture ? layout.rows : 1) * (size.height + 2 * options.border);
  for (const fs::path& file : files_of(path, shape.parameterization))
    io::check_write(file, width, height, channels, options.image);
}

}  // namespace welkin
