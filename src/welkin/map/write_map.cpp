#include <vector>

#include "welkin/base/error.h"
#include "welkin/map/map_file.h"
#include "welkin/map/map_file_job.h"
#include "welkin/map/safety_border.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace map_file;

void check_face_pattern(const fs::path& path, const Layout& layout) {
  if (is_pattern(path) == (layout.kind == LayoutKind::files)) return;
  throw Error(path.string() +
              (is_pattern(path)
                   ? ": %s stands for a face's name: write to :faces, as in cube:faces"
                   : ": several files are written: put %s in the name, where the face's name goes"));
}

std::vector<fs::path> files_of(const fs::path& path, const sphere::AnyParameterization& parameterization) {
  if (!is_pattern(path)) return {path};
  std::vector<fs::path> files;
  for (const std::string& name : chart_names(parameterization)) files.push_back(chart_path(path, name));
  return files;
}

io::WriteReport write_map(const fs::path& path, const Map& map, const Layout& layout,
                          const WriteMapOptions& options) {
  const auto& p = map.parameterization;
  Layout placed = layout_for(layout, p, map.orientation);
  if (!options.faces.empty()) placed = with_faces(placed, p, options.faces);
  check_face_pattern(path, placed);
  io::WriteOptions image = options.image;
  image.attributes[kShapeKey] = MapShape{p, layout}.text();
  image.attributes[kChartKey] = text_of(ChartSize{map.width(), map.height()});
  if (!options.faces.empty()) image.attributes[kFacesKey] = options.faces;
  // OpenEXR's attribute also says how the world lies: as the native one; and it knows no borders.
  if (!(map.orientation == Matrix3{})) {
    image.attributes[kOrientationKey] = text_of(map.orientation);
  } else if (p.name() == "openexr-latlong" && options.border == 0) {
    image.envmap = "latlong";
  } else if (p.name() == "openexr-cube" && layout.name == "openexr" && options.faces.empty() &&
             options.border == 0) {
    image.envmap = "cube";
  }

  if (options.border > 0) image.attributes[kBorderKey] = std::to_string(options.border);

  const int width = map.width() + 2 * options.border, height = map.height() + 2 * options.border;
  const auto draw = [&](const LayoutCell& cell, ImageView<float> picture) {
    if (options.border == 0) return copy_to_cell(cell, map.level.chart(cell.chart), picture);
    const Image chart = with_safety_border(map, cell.chart, options.border);
    copy_to_cell(cell, chart.view(), picture);
  };
  const auto picture_of = [&](const LayoutCell& cell) {
    const bool on_its_side = (cell.quarter_turns & 1) != 0;
    Image picture(on_its_side ? height : width, on_its_side ? width : height, map.channels());
    draw(cell, picture.view());
    return picture;
  };
  const std::vector<std::string> names = chart_names(p);
  switch (placed.kind) {
    case LayoutKind::files: {
      Image picture;
      return io::write_set(
          placed.cells.size(),
          [&](std::size_t i) {
            picture = picture_of(placed.cells[i]);
            return io::WriteFile{chart_path(path, names[i]),
                                 {{"", static_cast<const Image&>(picture).view(), map.channel_names}}};
          },
          image);
    }
    case LayoutKind::layers: {
      std::vector<Image> pictures;
      std::vector<io::WritePart> parts;
      for (const LayoutCell& cell : placed.cells) pictures.push_back(picture_of(cell));
      for (std::size_t i = 0; i < pictures.size(); ++i) {
        parts.push_back({names[i], static_cast<const Image&>(pictures[i]).view(), map.channel_names});
      }
      return io::write(path, parts, image);
    }
    case LayoutKind::picture:
      break;
  }
  if (placed.cells.size() == 1 && !placed.cells[0].mirrored && placed.cells[0].quarter_turns == 0 &&
      options.border == 0) {
    const io::WritePart part{"", map.level.chart(0), map.channel_names};
    return io::write(path, {&part, 1}, image);
  }
  Image picture(placed.columns * width, placed.rows * height, map.channels());
  for (const LayoutCell& cell : placed.cells) {
    draw(cell, cell_of(placed, cell, picture.view()));
  }
  const io::WritePart part{"", static_cast<const Image&>(picture).view(), map.channel_names};
  return io::write(path, {&part, 1}, image);
}

}  // namespace welkin
