#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "command.h"
#include "energy_report.h"
#include "hints.h"
#include "json_text.h"
#include "welkin/base/listed.h"
#include "welkin/map/face_edges.h"
#include "welkin/map_file/safety_border.h"
#include "welkin/measure/energy.h"
#include "welkin/measure/statistics.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

struct Info {
  std::vector<std::string> files;
  ReadFlags read;
  bool header = false, json = false;

  void run() const;
  void decode_others(const std::string& path, const MapFileInfo& info) const;
};

ordered_json direction(const Vec3d& d) {
  return {d.x, d.y, d.z};
}

int level_served(const MapFileInfo& info) {
  return std::min(coarsest_level_served(info.border, info.chart.width),
                  coarsest_level_served(info.border, info.chart.height));
}

bool is_texture(const io::FileInfo& file) {
  return file.format == "ktx2";
}

/// The number that --part takes.
std::size_t part_read(const MapFileInfo& info) {
  const auto read = info.image.parts.begin() + static_cast<std::ptrdiff_t>(info.picture);
  return static_cast<std::size_t>(std::count_if(info.image.parts.begin(), read,
                                                [](const io::PartInfo& part) { return part.level == 0; }));
}

/// `top-bottom`, `left-right`; empty where there is one picture.
std::string stereo_of(const MapFileInfo& info) {
  if (info.stereo == io::Stereo::top_bottom) return "top-bottom";
  return info.stereo == io::Stereo::left_right ? "left-right" : "";
}

std::string eye_of(const MapFileInfo& info) {
  return info.eye == Eye::left ? "left" : "right";
}

ordered_json header_of(const std::string& path, const MapFileInfo& info) {
  ordered_json parts = ordered_json::array();
  for (std::size_t i = 0; i < info.image.parts.size(); ++i) {
    const io::PartInfo& part = info.image.parts[i];
    if (part.level > 0) continue;
    parts.push_back({{"name", part.name},
                     {"width", part.width},
                     {"height", part.height},
                     {"channels", part.channels},
                     {"type", name_of(part.type)},
                     {"compression", part.compression}});
    if (!part.views.empty()) parts.back()["views"] = part.views;
    for (const MapLayer& layer : info.layers) {
      if (layer.picture == i && !layer.name.empty())
        parts.back()["layers"].push_back({{"name", layer.name}, {"channels", layer.channels}});
    }
  }
  ordered_json report{{"file", path},
                      {"format", info.image.format},
                      {"bytes", info.image.bytes},
                      {"parts", parts},
                      {"read", {{"part", part_read(info)}, {"channels", info.channels}}},
                      {"colour", info.image.colour == io::Colour::srgb ? "srgb" : "linear"},
                      {"notes", info.image.notes},
                      {"warnings", info.image.warnings},
                      {"attributes", info.image.attributes}};
  if (is_texture(info.image)) {
    report["texture"] = {
        {"levels", info.image.levels}, {"layers", info.image.layers}, {"faces", info.image.faces}};
  }
  report["parameterization"] = info.shape ? ordered_json(info.shape->text()) : ordered_json(nullptr);
  report["reason"] = info.reason;
  if (info.shape) report["chart"] = {{"width", info.chart.width}, {"height", info.chart.height}};
  if (const std::string stereo = stereo_of(info); !stereo.empty()) {
    report["stereo"] = stereo;
    report["eye"] = eye_of(info);
  }
  if (info.border > 0) {
    report["border"] = {{"texels", info.border}, {"coarsest_level_served", level_served(info)}};
  }
  if (!(info.orientation == Matrix3{})) report["orientation"] = info.orientation.rows;
  if (!info.notes.lobe.empty()) report["lobe"] = info.notes.lobe;
  if (!info.notes.curve.empty()) report["roughness_curve"] = info.notes.curve;
  if (!info.notes.normalisation.empty()) report["normalisation"] = info.notes.normalisation;
  if (levels_of(info) == 1) return report;
  for (int level = 0; level < levels_of(info); ++level) {
    const ChartSize size = info.levels[static_cast<std::size_t>(level)];
    ordered_json entry{{"width", size.width}, {"height", size.height}};
    if (const auto roughness = info.notes.roughness_of(level)) entry["roughness"] = *roughness;
    report["levels"].push_back(std::move(entry));
  }
  return report;
}

ordered_json statistics_of(const MapStatistics& s) {
  ordered_json channels = ordered_json::array();
  for (const ChannelStatistics& c : s.channels) {
    channels.push_back({{"name", c.name},
                        {"min", c.minimum},
                        {"max", c.maximum},
                        {"mean", c.mean},
                        {"integral", c.integral},
                        {"nan", c.nan_texels},
                        {"infinite", c.infinite_texels},
                        {"negative", c.negative_texels}});
  }
  const LuminanceStatistics& l = s.luminance;
  ordered_json report{{"texels", s.texels},
                      {"solid_angle", s.solid_angle},
                      {"channels", channels},
                      {"luminance",
                       {{"min", l.minimum},
                        {"max", l.maximum},
                        {"mean", l.mean},
                        {"integral", l.integral},
                        {"percentile_1", l.percentile_1},
                        {"percentile_50", l.percentile_50},
                        {"percentile_99", l.percentile_99},
                        {"percentile_99_9", l.percentile_99_9},
                        {"stops", l.dynamic_range}}}};
  if (s.light) {
    report["brightest_light"] = {{"direction", direction(s.light->direction)},
                                 {"peak_direction", direction(s.light->peak_direction)},
                                 {"peak", s.light->peak},
                                 {"solid_angle", s.light->solid_angle},
                                 {"radiance", s.light->radiance},
                                 {"share", s.light->share}};
  }
  return report;
}

/// Of a layer's channels, what stands behind its name.
std::vector<std::string> short_names(const MapLayer& layer) {
  std::vector<std::string> names;
  for (const std::string& channel : layer.channels) names.push_back(channel.substr(layer.name.size() + 1));
  return names;
}

void print_texture(const io::FileInfo& file) {
  if (!is_texture(file)) return;
  std::string kind = file.faces == 6 ? "cube" : "2-D";
  if (file.layers > 0) kind += fmt::format(", {} layers", file.layers);
  fmt::print("  texture           {}, {} {}\n", kind, file.levels, file.levels == 1 ? "level" : "levels");
}

/// A line for each level, with its mean luminance where it's known.
void print_levels(const MapFileInfo& info, const std::vector<double>& means) {
  if (levels_of(info) == 1) return;
  for (std::size_t level = 0; level < info.levels.size(); ++level) {
    const ChartSize size = info.levels[level];
    const auto roughness = info.notes.roughness_of(static_cast<int>(level));
    fmt::print("  {:<17} charts {}×{}{}{}\n", fmt::format("level {}", level), size.width, size.height,
               roughness ? fmt::format(", roughness {:.6g}", *roughness) : "",
               level < means.size() ? fmt::format(", mean luminance {:.6g}", means[level]) : "");
  }
}

void print_header(const std::string& path, const MapFileInfo& info) {
  fmt::print("{}\n", path);
  fmt::print("  format            {}, {} bytes, {} values\n", info.image.format, info.image.bytes,
             info.image.colour == io::Colour::srgb ? "sRGB" : "linear");
  print_texture(info.image);
  bool layers = false;
  for (std::size_t i = 0; i < info.image.parts.size(); ++i) {
    const io::PartInfo& part = info.image.parts[i];
    // Faces, layers and levels of a texture are alike, except in size.
    const bool alike = is_texture(info.image) || info.image.levels > 1;
    if (alike && (part.level > 0 || part.layer > 0 || part.face > 0)) continue;
    fmt::print("  picture{:<10} {}×{}, {} of {}, compression {}\n",
               part.name.empty() || alike ? "" : " " + printable(part.name), part.width, part.height,
               printable(listed(part.channels)), name_of(part.type), part.compression);
    if (!part.views.empty()) fmt::print("  views             {}\n", printable(listed(part.views)));
    for (const MapLayer& layer : info.layers) {
      if (layer.picture != i || layer.name.empty()) continue;
      fmt::print("  layer             {}: {}\n", printable(layer.name),
                 printable(listed(short_names(layer))));
      layers = true;
    }
  }
  const bool faces = info.shape && info.shape->layout.kind == LayoutKind::layers;
  if (layers || (info.image.parts.size() > 1 && info.image.levels == 1 && !faces)) {
    fmt::print("  read              part {}, channels {}\n", part_read(info),
               printable(listed(info.channels)));
  }
  for (const std::string& note : info.image.notes) fmt::print("  note              {}\n", note);
  for (const std::string& warning : info.image.warnings)
    fmt::print("  warning           {}\n", printable(with_option(warning), kLongestWarning));
  for (const auto& [key, value] : info.image.attributes) {
    fmt::print("  {:<17} {}\n", printable(key), printable(value.substr(0, value.find('\n'))));
  }
  if (info.shape) {
    fmt::print("  parameterization  {} ({}), charts {}×{}×{}\n", info.shape->text(), info.reason,
               info.shape->parameterization.charts(), info.chart.width, info.chart.height);
    if (const std::string stereo = stereo_of(info); !stereo.empty())
      fmt::print("  eye               {}, of two ({})\n", eye_of(info), stereo);
    if (info.border > 0) {
      fmt::print("  safety border     {} texels: serves mip levels 0 to {}\n", info.border,
                 level_served(info));
    }
  } else {
    fmt::print("  parameterization  unknown: {}; name it with --from\n", info.reason);
  }
}

void print_edges(const FaceEdges& edges) {
  fmt::print("  edges of faces    steps of {:.3g} stops across them, {:.3g} beside them: {}\n", edges.across,
             edges.beside, edges.join() ? "they join" : "they do not join");
}

void print_statistics(const MapStatistics& s) {
  fmt::print("  texels            {} over {:.4f} sr ({:.1f} % of the sphere)\n", s.texels, s.solid_angle,
             100 * s.solid_angle / (4 * kPi));
  for (const ChannelStatistics& c : s.channels) {
    fmt::print("  channel {:<9} {:.6g} … {:.6g}, mean {:.6g}\n", c.name, c.minimum, c.maximum, c.mean);
    const auto count = [&](std::uint64_t number, const char* what) {
      if (number > 0) fmt::print("  channel {:<9} {} {} texels\n", c.name, number, what);
    };
    count(c.nan_texels, "NaN");
    count(c.infinite_texels, "infinite");
    count(c.negative_texels, "negative");
  }
  const LuminanceStatistics& l = s.luminance;
  fmt::print("  luminance         {:.6g} … {:.6g}, mean {:.6g}, {:.1f} stops\n", l.minimum, l.maximum, l.mean,
             l.dynamic_range);
  fmt::print("  percentiles       1 %: {:.4g}   50 %: {:.4g}   99 %: {:.4g}   99.9 %: {:.4g}\n",
             l.percentile_1, l.percentile_50, l.percentile_99, l.percentile_99_9);
  if (!s.light) return;
  const BrightestLight& light = *s.light;
  fmt::print(
      "  brightest light   along {:.4f},{:.4f},{:.4f}: peak {:.6g}, {:.3g} sr, {:.1f} % of all light\n",
      light.direction.x, light.direction.y, light.direction.z, light.peak, light.solid_angle,
      100 * light.share);
}

struct Measures {
  MapStatistics statistics;        ///< of the level asked for
  MapEnergy energy;                ///< the same level's
  std::optional<FaceEdges> edges;  ///< the same level's, of a cube
  std::vector<double> means;       ///< luminance of every level, where none is asked for
};

void add_measures(const Map& map, const Monitor& monitor, Measures& measures) {
  measures.energy = measure_energy(map, {.monitor = without_progress(monitor)});
  if (map.parameterization.traits().cube_faces) measures.edges = measure_face_edges(map);
}

Measures measure_levels(MapReader& reader, std::optional<int> level) {
  Measures measures;
  const Monitor monitor = progress_monitor("info");
  if (level) {
    const Map map = reader.read();
    measures.statistics = measure(map, monitor);
    add_measures(map, monitor, measures);
  } else {
    for (int each = 0; each < levels_of(reader.info()); ++each) {
      reader.set_level(each);
      const Map map = reader.read();
      const MapStatistics statistics = measure(map, monitor);
      measures.means.push_back(statistics.luminance.mean);
      if (each > 0) continue;
      measures.statistics = statistics;
      add_measures(map, monitor, measures);
    }
    reader.set_level(0);
  }
  end_progress();
  return measures;
}

/// Decodes the pictures that no map is made of, so that the status says whether all of the file can be read.
void Info::decode_others(const std::string& path, const MapFileInfo& info) const {
  const bool alone =
      info.shape && (info.image.parts.size() == 1 || is_texture(info.image) || info.image.levels > 1);
  if (alone || path.find("%s") != std::string::npos) return;
  const std::unique_ptr<io::Reader> reader = io::open(path, read.parse().image);
  for (std::size_t part = 0; part < reader->info().parts.size(); ++part) {
    const io::PartInfo& picture = reader->info().parts[part];
    if (picture.deep || (info.shape && part == info.picture)) continue;
    std::vector<int> channels;
    for (std::size_t k = 0; k < picture.channels.size(); ++k) channels.push_back(static_cast<int>(k));
    Image image(picture.width, picture.height, static_cast<int>(channels.size()));
    reader->read(part, channels, image.view());
  }
}

void Info::run() const {
  read.parse();
  ordered_json all = ordered_json::array();
  bool first = true;
  for (const std::string& path : files) {
    ReadFlags flags = read;
    flags.pixels = !header;
    MapReader reader = flags.open_unknown(path);
    const MapFileInfo& info = reader.info();
    if (!json) {
      if (!first) fmt::print("\n");
      print_header(path, info);
    }
    first = false;
    ordered_json report = header_of(path, info);
    const bool measured = info.shape && !header;
    if (!header) decode_others(path, info);
    const Measures measures = measured ? measure_levels(reader, read.level) : Measures{};
    if (!json) print_levels(info, measures.means);
    for (std::size_t level = 0; levels_of(info) > 1 && level < measures.means.size(); ++level) {
      report["levels"][level]["mean_luminance"] = measures.means[level];
    }
    if (measured) {
      if (!json) {
        if (measures.edges) print_edges(*measures.edges);
        print_statistics(measures.statistics);
        print_energy(measures.energy);
      }
      report["statistics"] = statistics_of(measures.statistics);
      report["statistics"]["energy"] = json_of(measures.energy);
      if (measures.edges) {
        report["face_edges"] = {{"across", measures.edges->across},
                                {"beside", measures.edges->beside},
                                {"join", measures.edges->join()}};
      }
    }
    all.push_back(std::move(report));
  }
  if (json) print_json_text(files.size() == 1 ? all[0] : all);
}

}  // namespace

void add_info(Command app) {
  auto info = std::make_shared<Info>();
  Command command =
      app.add_command("info", "Describe a file: format, parameterization, luminance, brightest light");
  command.add_option("FILE", info->files, "Maps to read; - is standard input").required();
  command.add_flag("--header", info->header, "Only what the header says; read no pixels");
  command.add_flag("--json", info->json, "Machine-readable, on standard output");
  info->read.warn = false;  // they are in the report
  info->read.add(command);
  info->read.add_level(command, "Level to measure. Default: the finest, and every level's mean");
  command.callback([info] {
    if (std::count(info->files.begin(), info->files.end(), "-") > 1)
      throw UsageError("-: standard input holds one file, and is named twice");
    for (std::string& file : info->files) file = input_path(file);
    info->run();
  });
}

}  // namespace welkin::cli
