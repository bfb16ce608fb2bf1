#include "welkin/map/map_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/map/map_file_job.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;
using namespace map_file;

std::optional<Matrix3> matrix_from(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  Matrix3 m;
  for (auto& row : m.rows) {
    for (double& value : row) {
      if (!(in >> value)) return std::nullopt;
    }
  }
  if (!is_orthonormal(m)) return std::nullopt;
  return m;
}

/// Whether a picture of this size can be of this shape: within one texel, or a hundredth, of the aspect.
/// Texels of the equal-area map are never square, so it may have any aspect.
bool size_fits(const MapShape& shape, int width, int height, ChartSize& chart) {
  const auto size = chart_size_in(shape.layout, width, height);
  if (!size) return false;
  chart = *size;
  if (shape.parameterization.name() == "equal-area") return true;
  const double wide = shape.parameterization.aspect() * chart.height;
  const double high = chart.width / shape.parameterization.aspect();
  return std::fabs(wide - chart.width) <= std::max(1.0, 0.01 * wide) || std::fabs(high - chart.height) < 1;
}

/// What a picture's size suggests.
std::optional<std::pair<std::string, std::string>> guess(const io::FileInfo& file, bool pattern) {
  const int width = file.parts[0].width, height = file.parts[0].height;
  if (pattern) return std::pair("cube:faces", "six files");
  if (file.parts.size() == 6 && width == height) return std::pair("cube:layers", "six square parts");
  const auto ratio = [&](int across, int down) {
    return static_cast<long>(width) * down == static_cast<long>(height) * across;
  };
  if (std::abs(width - 2 * height) <= 1) return std::pair("latlong", "guessed from the aspect 2:1");
  if (ratio(4, 3)) return std::pair("cube:hcross", "guessed from the aspect 4:3");
  if (ratio(3, 4)) return std::pair("cube:vcross", "guessed from the aspect 3:4");
  if (ratio(6, 1)) return std::pair("cube:hstrip", "guessed from the aspect 6:1");
  if (ratio(1, 6)) return std::pair("cube:vstrip", "guessed from the aspect 1:6");
  if (ratio(3, 2)) return std::pair("cube:3x2", "guessed from the aspect 3:2");
  return std::nullopt;
}

std::string attribute(const io::FileInfo& file, const char* key) {
  const auto found = file.attributes.find(key);
  return found == file.attributes.end() ? std::string() : found->second;
}

/// The declared safety border, 0 when there is none or it makes no sense.
int border_from(const std::string& text) {
  const long value = std::strtol(text.c_str(), nullptr, 10);
  return value > 0 && value < (1 << 20) ? static_cast<int>(value) : 0;
}

/// Whether another program turned our map into the one that its `envmap` declares, and copied our declaration
/// along.
bool is_copied(const std::string& declared, const io::FileInfo& file) {
  return file.envmap && !declared.starts_with("openexr-" + *file.envmap);
}

/// The channels to read: indices into the part's list.
std::vector<int> choose_channels(const std::string& name, const io::PartInfo& part,
                                 const std::vector<std::string>& wanted) {
  const auto index_of = [&](const std::string& channel) {
    const auto found = std::find(part.channels.begin(), part.channels.end(), channel);
    return found == part.channels.end() ? -1 : static_cast<int>(found - part.channels.begin());
  };
  std::vector<int> chosen;
  for (const std::string& channel : wanted) {
    const int index = index_of(channel);
    if (index < 0) throw Error(name + ": " + unknown_name("channel", channel, part.channels));
    chosen.push_back(index);
  }
  if (!chosen.empty()) return chosen;
  if (index_of("R") >= 0 && index_of("G") >= 0 && index_of("B") >= 0) {
    chosen = {index_of("R"), index_of("G"), index_of("B")};
  } else if (index_of("Y") >= 0) {
    chosen = {index_of("Y")};
  } else {
    for (int i = 0; i < std::min<int>(3, static_cast<int>(part.channels.size())); ++i) chosen.push_back(i);
    return chosen;
  }
  if (index_of("A") >= 0) chosen.push_back(index_of("A"));
  return chosen;
}

/// Opens the file, or the first of the files of a pattern.
std::unique_ptr<io::Reader> open_first(const fs::path& path, const ReadMapOptions& options) {
  if (!is_pattern(path)) return io::open(path, options.image);
  // What the charts are called depends on the shape; without one there may be faces of a cube, or numbered
  // charts.
  if (options.shape) {
    return io::open(chart_path(path, chart_names(parse_map_shape(*options.shape).parameterization).front()),
                    options.image);
  }
  const bool numbered = !fs::exists(chart_path(path, "px")) && fs::exists(chart_path(path, "0"));
  return io::open(chart_path(path, numbered ? "0" : "px"), options.image);
}

MapFileInfo inspect(const fs::path& path, const io::FileInfo& file, const ReadMapOptions& options) {
  MapFileInfo info;
  info.image = file;
  const bool pattern = is_pattern(path);
  std::string shape, faces = options.faces;
  if (options.shape) {
    shape = *options.shape;
    if (pattern && shape.find(':') == std::string::npos) {
      shape.insert(std::min(shape.find(','), shape.size()), ":faces");
    }
    info.reason = "as asked";
  } else if (!attribute(file, kShapeKey).empty() && !is_copied(attribute(file, kShapeKey), file)) {
    shape = attribute(file, kShapeKey);
    info.reason = "declared by the file";
    if (faces.empty()) faces = attribute(file, kFacesKey);
  } else if (file.envmap) {
    const bool cube = *file.envmap == "cube";
    shape = cube ? "openexr-cube:openexr" : "openexr-latlong";
    info.reason = "declared by the envmap attribute";
  } else if (const auto guessed = guess(file, pattern)) {
    shape = guessed->first;
    info.reason = guessed->second;
  }
  if (options.orientation) {
    info.orientation = *options.orientation;
  } else if (const auto declared = matrix_from(attribute(file, kOrientationKey))) {
    info.orientation = *declared;
  }
  if (shape.empty()) {
    info.reason = "the file declares no parameterization, and its size suggests none";
    return info;
  }
  try {
    info.shape = parse_map_shape(shape);
    info.shape->layout = layout_for(info.shape->layout, info.shape->parameterization, info.orientation);
    if (!faces.empty())
      info.shape->layout = with_faces(info.shape->layout, info.shape->parameterization, faces);
  } catch (const Error& error) {
    // A damaged declaration names its file; a bad request names itself.
    if (!options.shape && options.faces.empty()) throw Error(path.string() + ": " + error.what());
    throw;
  }
  const LayoutKind kind = info.shape->layout.kind;
  if (kind == LayoutKind::files && !pattern) {
    throw Error(path.string() + ": " + info.shape->text() + " is in several files: put %s in the name, for " +
                chart_names(info.shape->parameterization).front() + ", " +
                chart_names(info.shape->parameterization)[1] + "…");
  }
  if (kind != LayoutKind::files && pattern) {
    throw Error(path.string() + ": %s stands for a face's name, but " + info.shape->text() +
                " is in one file");
  }
  if (kind == LayoutKind::layers && file.parts.size() < info.shape->layout.cells.size()) {
    throw Error(path.string() + ": " + info.shape->text() + " needs " +
                std::to_string(info.shape->layout.cells.size()) + " parts, the file has " +
                std::to_string(file.parts.size()));
  }
  if (kind != LayoutKind::layers && options.part >= file.parts.size()) {
    throw Error(path.string() + ": has no part " + std::to_string(options.part) + " (parts are 0 to " +
                std::to_string(file.parts.size() - 1) + ")");
  }
  const io::PartInfo& part = file.parts[kind == LayoutKind::layers ? 0 : options.part];
  Layout single;  // one chart per picture
  const MapShape per_picture{info.shape->parameterization,
                             kind == LayoutKind::picture ? info.shape->layout : single};
  info.border = options.border;
  if (!options.shape && options.border == 0) info.border = border_from(attribute(file, kBorderKey));
  // Texels that aren't square were asked for, where the file gives the very size of its charts.
  const int columns = per_picture.layout.columns, rows = per_picture.layout.rows;
  const int inner_width = part.width - 2 * info.border * columns,
            inner_height = part.height - 2 * info.border * rows;
  if (inner_width < 1 || inner_height < 1) {
    throw Error(path.string() + ": " + std::to_string(part.width) + "×" + std::to_string(part.height) +
                " leaves nothing inside a border of " + std::to_string(info.border));
  }
  const std::optional<ChartSize> divided = chart_size_in(per_picture.layout, inner_width, inner_height);
  const bool as_written = !options.shape && divided && text_of(*divided) == attribute(file, kChartKey);
  if (as_written) info.chart = *divided;
  if (!as_written && !size_fits(per_picture, inner_width, inner_height, info.chart)) {
    char aspect[32];
    std::snprintf(
        aspect, sizeof aspect, "%.4g",
        info.shape->parameterization.aspect() * per_picture.layout.columns / per_picture.layout.rows);
    throw Error(path.string() + ": " + std::to_string(part.width) + "×" + std::to_string(part.height) +
                " does not fit " + info.shape->text() + " (" + info.reason + "), whose width is " + aspect +
                " times its height" +
                (per_picture.layout.columns * per_picture.layout.rows > 1
                     ? " in " + std::to_string(per_picture.layout.columns) + "×" +
                           std::to_string(per_picture.layout.rows) + " equal cells"
                     : ""));
  }
  try {
    check_turns(info.shape->layout, info.chart);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
  info.shape = for_chart_size(*info.shape, info.chart);
  return info;
}

}  // namespace

MapReader::MapReader(const fs::path& path, const ReadMapOptions& options)
    : path_(path),
      options_(options),
      reader_(open_first(path, options)),
      info_(inspect(path, reader_->info(), options)) {}

void MapReader::set_faces(std::string faces) {
  options_.faces = std::move(faces);
  info_ = inspect(path_, reader_->info(), options_);
}

void MapReader::set_orientation(const Matrix3& orientation) {
  options_.orientation = orientation;
  info_ = inspect(path_, reader_->info(), options_);
}

LoadedMap read_map(const fs::path& path, const ReadMapOptions& options) {
  MapReader reader(path, options);
  return {reader.read(), reader.info()};
}

Map MapReader::read() {
  const std::string name = path_.string();
  const MapFileInfo& info = info_;
  const ReadMapOptions& options = options_;
  if (!info.shape) {
    const io::PartInfo& part = info.image.parts.at(std::min(options.part, info.image.parts.size() - 1));
    throw Error(name + ": cannot tell which parameterization " + std::to_string(part.width) + "×" +
                std::to_string(part.height) +
                " is; name it with --from (octahedral, angular, sphere, fisheye-equidistant…)");
  }
  const Layout& layout = info.shape->layout;
  const auto& p = info.shape->parameterization;
  const std::size_t first_part = layout.kind == LayoutKind::layers ? 0 : options.part;
  const std::vector<int> channels = choose_channels(name, info.image.parts[first_part], options.channels);
  const int count = static_cast<int>(channels.size());
  Map map(p, info.chart.width, info.chart.height, count);
  map.orientation = info.orientation;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    map.channel_names[i] = info.image.parts[first_part].channels[static_cast<std::size_t>(channels[i])];
  }
  const int border = info.border;
  const auto plain = [border](const LayoutCell& cell) {
    return !cell.mirrored && cell.quarter_turns == 0 && border == 0;
  };
  const auto inner = [border](ImageView<const float> picture) {
    return picture.part(border, border, picture.width - 2 * border, picture.height - 2 * border);
  };
  /// One picture holds one chart: straight into the map where it is neither turned nor mirrored.
  const auto read_chart = [&](io::Reader& from, std::size_t part, const LayoutCell& cell,
                              const std::string& file) {
    const io::PartInfo& other = from.info().parts.at(part);
    if (other.width - 2 * border != info.chart.width || other.height - 2 * border != info.chart.height) {
      throw Error(file + ": is " + std::to_string(other.width) + "×" + std::to_string(other.height) +
                  ", but the first face is " + std::to_string(info.chart.width) + "×" +
                  std::to_string(info.chart.height));
    }
    const std::vector<int> own = choose_channels(file, other, map.channel_names);
    if (plain(cell)) return from.read(part, own, map.level.chart(cell.chart));
    Image picture(other.width, other.height, count);
    from.read(part, own, picture.view());
    copy_from_cell(cell, inner(picture.view()), map.level.chart(cell.chart));
  };
  switch (layout.kind) {
    case LayoutKind::files: {
      const std::vector<std::string> names = chart_names(p);
      for (std::size_t i = 0; i < layout.cells.size(); ++i) {
        const fs::path file = chart_path(path_, names[i]);
        read_chart(*io::open(file, options.image), options.part, layout.cells[i], file.string());
      }
      break;
    }
    case LayoutKind::layers:
      for (std::size_t i = 0; i < layout.cells.size(); ++i) read_chart(*reader_, i, layout.cells[i], name);
      break;
    case LayoutKind::picture:
      if (layout.cells.size() == 1 && plain(layout.cells[0])) {
        reader_->read(options.part, channels, map.level.chart(0));
        break;
      }
      {
        const io::PartInfo& part = info.image.parts[options.part];
        Image picture(part.width, part.height, count);
        reader_->read(options.part, channels, picture.view());
        for (const LayoutCell& cell : layout.cells) {
          copy_from_cell(cell, inner(cell_of<const float>(layout, cell, picture.view())),
                         map.level.chart(cell.chart));
        }
      }
  }
  fill_borders(map);
  return map;
}

}  // namespace welkin
