#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "welkin/base/error.h"
#include "welkin/map_file/chain_attributes.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/map_file/eyes.h"
#include "welkin/map_file/face_names.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/map_file/panorama.h"

/// What a file holds: as it declares, as the caller says, or a guess.
namespace welkin::map_file {
namespace {

namespace fs = std::filesystem;

/// Whether a picture of this size can be of this shape: within one texel, or a hundredth, of the aspect.
bool size_fits(const MapShape& shape, int width, int height, ChartSize& chart) {
  const auto size = chart_size_in(shape.layout, width, height);
  if (!size) return false;
  chart = *size;
  if (shape.parameterization.traits().free_aspect) return true;
  const double aspect = shape.parameterization.at_size(chart.width, chart.height).aspect();
  const double wide = aspect * chart.height, high = chart.width / aspect;
  return std::fabs(wide - chart.width) <= std::max(1.0, 0.01 * wide) || std::fabs(high - chart.height) < 1;
}

/// Whether the parts can be the faces of a cube: six squares that are alike, not six passes of a picture.
bool are_six_faces(const io::FileInfo& file) {
  const std::vector<std::size_t> pictures = pictures_of(file, 0);
  const io::PartInfo& first = file.parts[pictures[0]];
  return pictures.size() == 6 && first.width == first.height &&
         std::all_of(pictures.begin(), pictures.end(), [&](std::size_t i) {
           const io::PartInfo& part = file.parts[i];
           return part.width == first.width && part.height == first.height && !part.deep &&
                  part.channels.size() == first.channels.size();
         });
}

/// What a picture's size, or the kind of texture, suggests.
std::optional<std::pair<std::string, std::string>> guess(const io::FileInfo& file, ChartSize picture,
                                                         bool pattern) {
  const auto [width, height] = picture;
  if (pattern) return std::pair("cube:faces", "six files");
  if (file.faces == 6) return std::pair("cube:layers", "a cube texture");
  if (are_six_faces(file)) return std::pair("cube:layers", "six square parts");
  const auto ratio = [width = width, height = height](int across, int down) {
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

/// A declared count, 0 when there is none or it is invalid.
int positive_number(const std::string& text) {
  const long value = std::strtol(text.c_str(), nullptr, 10);
  return value > 0 && value < (1 << 20) ? static_cast<int>(value) : 0;
}

/// The grid of charts in one picture: a single cell where each has its own.
Layout grid_of_picture(const Layout& layout) {
  return layout.kind == LayoutKind::picture ? layout : Layout{};
}

/// The parameterization that a value of OpenEXR's attribute `envmap` declares.
std::string declared_by_envmap(const std::string& envmap) {
  const std::vector<std::string> names = sphere::parameterization_names();
  const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return sphere::AnyParameterization::make(name).traits().envmap == envmap;
  });
  return found == names.end() ? "" : *found;
}

/// Whether another program turned our map into the one that its `envmap` declares, and copied our declaration
/// along.
bool is_copied(const std::string& declared, const io::PartInfo& part) {
  return part.envmap && !declared.starts_with(declared_by_envmap(*part.envmap));
}

/// The shape as text, and the faces, with the reason for them; the text is empty when nothing suggests one.
struct Declaration {
  std::string shape, faces, reason;
};

/// Of the part that is read; the picture is one eye's where there are two.
Declaration declaration_for(const fs::path& path, const MapFileInfo& info, const ReadMapOptions& options,
                            ChartSize picture, std::vector<std::string>& warnings) {
  const io::FileInfo& file = info.image;
  const io::PartInfo& part = file.parts[info.picture];
  const bool pattern = is_pattern_to_read(path);
  if (options.shape) {
    std::string shape = *options.shape;
    const auto several_charts = [&] { return parse_map_shape(shape).parameterization.charts() > 1; };
    if (shape.find(':') == std::string::npos && (pattern || (is_array(file) && several_charts())))
      shape.insert(std::min(shape.find(','), shape.size()), pattern ? ":faces" : ":layers");
    return {shape, options.faces, "as asked"};
  }
  const std::string declared = attribute(file, kShapeKey);
  if (!declared.empty() && !is_copied(declared, part)) {
    return {declared, options.faces.empty() ? attribute(file, kFacesKey) : options.faces,
            "declared by the file"};
  }
  if (file.panorama) {
    const std::string shape = shape_of(*file.panorama, picture, warnings);
    if (!shape.empty()) return {shape, options.faces, kByPanorama};
  }
  if (part.envmap) {
    const std::string name = declared_by_envmap(*part.envmap);
    const std::string_view layout = sphere::AnyParameterization::make(name).traits().layout;
    return {name + (layout.empty() ? "" : ":" + std::string(layout)), options.faces, kByEnvmap};
  }
  if (const auto guessed = guess(file, picture, pattern))
    return {guessed->first, options.faces, guessed->second};
  const fs::path six = picture.width == picture.height ? pattern_of_face(path) : fs::path();
  return {"", options.faces,
          "the file declares no parameterization, and its size suggests none" +
              (six.empty() ? "" : "; it may be a face of " + six.string())};
}

/// Width over height of one eye's picture, were it of the shape that is asked for, or declared, or a
/// lat-long.
double aspect_of_eye(const fs::path& path, const MapFileInfo& info, const ReadMapOptions& options) {
  std::vector<std::string> unused;
  const io::PartInfo& part = info.image.parts[info.picture];
  const std::string text = declaration_for(path, info, options, {part.width, part.height}, unused).shape;
  if (text.empty()) return 2;
  const MapShape shape = parse_map_shape(text);
  const Layout grid = grid_of_picture(shape.layout);
  return shape.parameterization.aspect() * grid.columns / grid.rows;
}

/// The shape that is declared, its layout as it lies in the file.
MapShape shape_from(const Declaration& declaration, const Matrix3& orientation) {
  MapShape shape = parse_map_shape(declaration.shape);
  shape.layout = layout_for(shape.layout, shape.parameterization, orientation);
  if (!declaration.faces.empty())
    shape.layout = with_faces(shape.layout, shape.parameterization, declaration.faces);
  return shape;
}

/// Throws when there is no part of that number among so many.
void check_part(const fs::path& path, std::size_t parts, std::optional<std::size_t> asked) {
  if (asked.value_or(0) < parts) return;
  throw Error(
      ErrorKind::bad_request, path.string(),
      "has no part " + std::to_string(*asked) + " (parts are 0 to " + std::to_string(parts - 1) + ")");
}

/// Throws when the layout asks for other files or for more pictures than there are.
void check_pictures(const fs::path& path, const io::FileInfo& file, const MapShape& shape,
                    std::optional<std::size_t> part) {
  const LayoutKind kind = shape.layout.kind;
  const std::string name = path.string();
  if (kind == LayoutKind::files && !is_pattern_to_read(path)) {
    const std::vector<std::string> charts = chart_names(shape.parameterization);
    const fs::path six = pattern_of_face(path);
    throw Error(ErrorKind::bad_request, name,
                shape.text() + " is in several files: put %s in the name, for " + charts[0] + ", " +
                    charts[1] + "…" + (six.empty() ? "" : ": " + six.string()));
  }
  if (kind != LayoutKind::files && is_pattern_to_read(path)) {
    throw Error(ErrorKind::bad_request, name,
                "%s stands for a face's name, but " + shape.text() + " is in one file");
  }
  const std::size_t pictures = pictures_of(file, 0).size();
  const std::size_t needed = kind == LayoutKind::layers ? shape.layout.cells.size() : 1;
  if (pictures < needed) {
    throw Error(ErrorKind::mismatch, name,
                shape.text() + " needs " + std::to_string(needed) + " parts, the file has " +
                    std::to_string(pictures));
  }
  check_part(path, pictures / needed, part);
}

/// Charts of level 0. Throws when the pictures' size is none of the shape.
ChartSize finest_chart(const fs::path& path, const ReadMapOptions& options, MapFileInfo& info) {
  const MapShape per_picture{info.shape->parameterization, grid_of_picture(info.shape->layout)};
  const int columns = per_picture.layout.columns, rows = per_picture.layout.rows;
  const io::PartInfo& part = info.image.parts[info.picture];
  const ChartSize picture = eye_size(info.stereo, part.width, part.height);
  const std::string size = std::to_string(picture.width) + "×" + std::to_string(picture.height);
  const int width = picture.width - 2 * info.border * columns;
  const int height = picture.height - 2 * info.border * rows;
  if (width < 1 || height < 1) {
    throw Error(ErrorKind::mismatch, path.string(),
                size + " leaves nothing inside a border of " + std::to_string(info.border));
  }
  // Texels that aren't square were asked for, where the file gives the very size of its charts.
  const std::optional<ChartSize> divided = chart_size_in(per_picture.layout, width, height);
  if (divided && text_of(*divided) == attribute(info.image, kChartKey)) return *divided;
  ChartSize chart;
  if (size_fits(per_picture, width, height, chart)) return chart;
  char aspect[32];
  std::snprintf(aspect, sizeof aspect, "%.4g", info.shape->parameterization.aspect() * columns / rows);
  const std::string expected = std::string("whose width is ") + aspect + " times its height";
  if (info.reason == kByPanorama) return {width, height};  // shape_of has warned
  if (info.reason == kByEnvmap && info.shape->parameterization.charts() == 1) return {width, height};
  if (options.shape && info.shape->parameterization.charts() == 1) {
    // What was asked is believed.
    const io::Stereo stereo =
        stereo_from_aspect(picture.width, picture.height, info.shape->parameterization.aspect());
    info.image.warnings.push_back(
        size + " is read as " + info.shape->text() + ", " + expected +
        ", as asked: its texels are not square" +
        (two_eyes(stereo) && !two_eyes(info.stereo)
             ? "; should it hold two eyes' pictures " + where_of(stereo) + ", ask for an eye"
             : ""));
    return {width, height};
  }
  throw Error(
      ErrorKind::mismatch, path.string(),
      size + " does not fit " + info.shape->text() + " (" + info.reason + "), " + expected +
          (columns * rows > 1 ? " in " + std::to_string(columns) + "×" + std::to_string(rows) + " equal cells"
                              : ""));
}

/// Charts of the levels that hold the map: as many as the file declares, and as are pictures of charts half
/// as large as the level before, by either way of rounding. A picture of several charts can have further
/// levels, down to one texel, which are none of the map.
std::vector<ChartSize> level_charts(const MapFileInfo& info, std::size_t first, ChartSize finest) {
  const io::FileInfo& file = info.image;
  const Layout grid = grid_of_picture(info.shape->layout);
  const std::size_t needed =
      info.shape->layout.kind == LayoutKind::layers ? info.shape->layout.cells.size() : 1;
  const auto halved = [](int side, int finest_side, int level) {
    const int down = std::max(1, finest_side >> level);
    return side == down || (side == down + 1 && (side - 1) << level < finest_side);
  };
  std::vector<ChartSize> charts{finest};
  if (info.border > 0) return charts;
  constexpr int kMaxLevels = 21;  // of a side of 2^20 texels
  for (int level = 1; level < std::min(file.levels, kMaxLevels); ++level) {
    const std::vector<std::size_t> pictures = pictures_of(file, level);
    if (pictures.size() < first + needed) break;
    const io::PartInfo& part = file.parts[pictures[first]];
    if ((info.stereo == io::Stereo::left_right && part.width % 2 != 0) ||
        (info.stereo == io::Stereo::top_bottom && part.height % 2 != 0))
      break;
    const ChartSize picture = eye_size(info.stereo, part.width, part.height);
    const std::optional<ChartSize> chart = chart_size_in(grid, picture.width, picture.height);
    if (!chart || !halved(chart->width, finest.width, level) || !halved(chart->height, finest.height, level))
      break;
    charts.push_back(*chart);
  }
  return charts;
}

/// From what was asked, or the file declares of its map, or of the camera.
void find_orientation(const Declaration& declaration, const io::FileInfo& file, const ReadMapOptions& options,
                      MapFileInfo& info) {
  std::optional<Matrix3> pose;
  if (file.panorama && !declaration.shape.empty()) {
    const bool panorama = parse_map_shape(declaration.shape).parameterization.traits().projection ==
                          sphere::Projection::panorama;
    if (panorama) pose = orientation_of(*file.panorama);
  }
  if (options.orientation) {
    require(is_orthonormal(*options.orientation), "the orientation of a map is a rotation or a reflection");
    info.orientation = *options.orientation;
    if (pose)
      info.image.warnings.push_back(pose_text(*file.panorama) +
                                    ": not used, since an orientation was asked for");
  } else if (const auto declared = declared_orientation(file)) {
    info.orientation = *declared;
  } else if (pose) {
    info.orientation = *pose;
    info.image.notes.push_back(pose_text(*file.panorama));
  }
}

/// Notes which picture and channels are selected; what there is to tell of them goes to `warnings`.
void note_selection(const Selection& selection, MapFileInfo& info, std::vector<std::string>& warnings) {
  const ChosenChannels& chosen = selection.channels;
  const io::PartInfo& part = info.image.parts[chosen.picture];
  info.picture = chosen.picture;
  info.channels.clear();
  for (const int channel : chosen.channels)
    info.channels.push_back(part.channels[static_cast<std::size_t>(channel)]);
  warnings = part.warnings;
  warnings.insert(warnings.end(), chosen.warnings.begin(), chosen.warnings.end());
}

}  // namespace

const io::Capabilities& capabilities_or_none(const fs::path& path) {
  static const io::Capabilities none;
  try {
    return io::capabilities_for(path);
  } catch (const Error&) {
    return none;
  }
}

namespace {

/// inspect, but for `warnings` of what is selected.
MapFileInfo inspect_selected(const fs::path& path, const io::FileInfo& file, const ReadMapOptions& options,
                             std::vector<std::string>& warnings) {
  MapFileInfo info;
  info.image = file;
  info.notes = chain_notes_from(file.attributes);
  info.layers = all_layers(file);
  Selection selection = select(path.string(), file, options, nullptr);
  note_selection(selection, info, warnings);
  const io::PartInfo& part = file.parts[info.picture];
  ChartSize picture;
  try {
    choose_eye(
        {part.width, part.height}, options, [&] { return aspect_of_eye(path, info, options); }, info);
    picture = eye_size(info.stereo, part.width, part.height);
  } catch (const Error& error) {
    throw in_file(path.string(), error);
  }
  const Declaration declaration = declaration_for(path, info, options, picture, info.image.warnings);
  info.reason = declaration.reason;
  try {
    find_orientation(declaration, file, options, info);
    if (declaration.shape.empty()) {
      check_part(path, pictures_of(file, 0).size(), options.part);
      return info;
    }
    info.shape = shape_from(declaration, info.orientation);
  } catch (const Error& error) {
    // A damaged declaration names its file; a bad request names itself.
    if (!options.shape && options.faces.empty()) throw in_file(path.string(), error);
    throw;
  }
  check_pictures(path, file, *info.shape, options.part);
  if (info.shape->layout.kind == LayoutKind::layers) {
    selection = select(path.string(), file, options, &info.shape->layout);
    note_selection(selection, info, warnings);
  }
  if (two_eyes(info.stereo) && info.shape->layout.kind != LayoutKind::picture) {
    throw Error(ErrorKind::bad_request, path.string(),
                info.shape->text() + " is in several pictures, but two eyes' lie in one");
  }
  tell_unused_panorama(picture, info);
  info.border = options.border;
  if (!options.shape && options.border == 0) info.border = positive_number(attribute(file, kBorderKey));
  const ChartSize finest = finest_chart(path, options, info);
  try {
    check_turns(info.shape->layout, finest);
  } catch (const Error& error) {
    throw in_file(path.string(), error);
  }
  info.levels = level_charts(info, selection.first, finest);
  const auto levels = static_cast<int>(info.levels.size());
  if (options.level < 0 || options.level >= levels) {
    throw Error(ErrorKind::bad_request, path.string(),
                "has " + (levels == 1 ? "one level" : "levels 0…" + std::to_string(levels - 1)) + ", not " +
                    (levels == 1 ? "level " : "") + std::to_string(options.level));
  }
  info.chart = info.levels[static_cast<std::size_t>(options.level)];
  info.shape = for_chart_size(*info.shape, info.chart);
  return info;
}

}  // namespace

MapFileInfo inspect(const fs::path& path, const io::FileInfo& file, const ReadMapOptions& options) {
  std::vector<std::string> warnings;
  MapFileInfo info = inspect_selected(path, file, options, warnings);
  info.image.warnings.insert(info.image.warnings.end(), warnings.begin(), warnings.end());
  return info;
}

}  // namespace welkin::map_file
