#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "welkin/base/number_text.h"
#include "welkin/io/channel_names.h"
#include "welkin/map_file/choose_channels.h"
#include "welkin/map_file/layout.h"
#include "welkin/map_file/map_file.h"

/// What reading and writing map files share. Internal to these.
namespace welkin::map_file {

// Text metadata of a map's file.
inline constexpr const char* kShapeKey = "welkin.parameterization";
inline constexpr const char* kFacesKey = "welkin.faces";
inline constexpr const char* kChartKey = "welkin.chart";
inline constexpr const char* kOrientationKey = "welkin.orientation";
inline constexpr const char* kConventionKey = "welkin.convention";
inline constexpr const char* kBorderKey = "welkin.border";
using io::kChannelsKey;

/// MapFileInfo::reason of a shape that PartInfo::envmap declares.
inline constexpr const char* kByEnvmap = "declared by the envmap attribute";

/// MapFileInfo::reason of a shape that FileInfo::panorama declares.
inline constexpr const char* kByPanorama = "declared by the file's panorama metadata";

/// The file of one chart: the first `%s` replaced by the chart's name.
inline std::filesystem::path chart_path(const std::filesystem::path& pattern, const std::string& chart) {
  std::string text = pattern.string();
  text.replace(text.find("%s"), 2, chart);
  return text;
}

inline bool is_pattern(const std::filesystem::path& path) {
  return path.string().find("%s") != std::string::npos;
}

/// Whether several files are read: a file that is called so is one.
inline bool is_pattern_to_read(const std::filesystem::path& path) {
  std::error_code unknown;
  return is_pattern(path) && !std::filesystem::exists(path, unknown);
}

inline std::string text_of(const Matrix3& m) {
  std::string text;
  for (const auto& row : m.rows) {
    for (double value : row) {
      text += (text.empty() ? "" : " ") + number_text(value);
    }
  }
  return text;
}

inline std::string text_of(ChartSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

inline Layout layout_for(const Layout& layout, const sphere::AnyParameterization& p,
                         const Matrix3& orientation) {
  return determinant(orientation) < 0 ? for_reflected_world(layout, p) : layout;
}

/// The file's text metadata of that key, or nothing.
inline std::string attribute(const io::FileInfo& file, const char* key) {
  const auto found = file.attributes.find(key);
  return found == file.attributes.end() ? std::string() : found->second;
}

/// The orientation that the file declares, if it is one.
std::optional<Matrix3> declared_orientation(const io::FileInfo& file);

/// Where a map is written to: a file, or several where its path has a `%s`, or a sink.
struct Destination {
  std::filesystem::path path;  ///< of a sink, what messages call it
  const io::Capabilities& format;
  io::ByteSink* sink = nullptr;

  explicit Destination(const std::filesystem::path& file) : path(file), format(io::capabilities_for(file)) {}
  Destination(io::ByteSink& to, std::string_view format_name)
      : path(format_name), format(io::capabilities(format_name)), sink(&to) {}
};

/// What the format of a file of this name holds; of a name without a known format, those of
/// no format.
const io::Capabilities& capabilities_or_none(const std::filesystem::path& path);

/// The pictures of a level: indices into the file's parts.
std::vector<std::size_t> pictures_of(const io::FileInfo& file, int level);

/// Whether the file's pictures are the charts of a map: faces or layers of a texture.
bool is_array(const io::FileInfo& file);

/// What is read of a file.
struct Selection {
  std::size_t first = 0;    ///< where among the pictures of a level those of the map begin
  ChosenChannels channels;  ///< of the first picture at level 0
};

/// Selects as `options` say, else what has colour. `layout` is null as long as it is unknown.
Selection select(const std::string& file_name, const io::FileInfo& file, const ReadMapOptions& options,
                 const Layout* layout);

/// The layers of every picture at level 0.
std::vector<MapLayer> all_layers(const io::FileInfo& file);

/// What the file of `path`, of which `file` is known, holds.
MapFileInfo inspect(const std::filesystem::path& path, const io::FileInfo& file,
                    const ReadMapOptions& options);

/// A level to be written: a map in memory, or one whose texels are made when they are written.
struct WrittenLevel {
  MapFrame frame;
  std::vector<std::string> channel_names;
  const Map* map = nullptr;  ///< null: `draw` makes the texels; there is no safety border then
  DrawCell draw = nullptr;   ///< from several threads at once
  int rows_at_once = 1;      ///< WritePart

  WrittenLevel(const Map& whole) : frame(whole), channel_names(whole.channel_names), map(&whole) {
    whole.check();
  }
  WrittenLevel(MapFrame drawn, std::vector<std::string> names, DrawCell draw_cell, int at_once)
      : frame(std::move(drawn)),
        channel_names(std::move(names)),
        draw(std::move(draw_cell)),
        rows_at_once(at_once) {}
};

/// Writes maps as the levels of one file, as check_chain lets them be; of `sets` chains one after the other,
/// in one file, as layers or parts.
io::WriteReport write_levels(const Destination& destination, std::span<const WrittenLevel> levels,
                             const Layout& layout, const WriteMapOptions& options, int sets = 1);

/// Throws as check_chain does, for a destination of any kind.
void check_levels(const Destination& destination, const MapShape& shape, ChartSize finest, int levels,
                  const WriteMapOptions& options);

/// Throws as write_chain does where a chain's members don't belong together.
void check_chain_members(const Chain& chain);

}  // namespace welkin::map_file
