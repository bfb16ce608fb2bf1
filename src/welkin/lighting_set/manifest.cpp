#include "welkin/lighting_set/manifest.h"

#include <nlohmann/json.hpp>

#include "welkin/base/version.h"

namespace welkin {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const LevelVerification& v) {
  ordered_json report{{"random_texels", v.reference.random_texels},
                      {"hot_texels", v.reference.hot_texels},
                      {"relative_rmse", v.reference.relative_rmse},
                      {"max_relative", v.reference.maximum}};
  report["energy"] = v.energy ? ordered_json(*v.energy) : ordered_json();
  report["furnace"] = v.furnace ? ordered_json(*v.furnace) : ordered_json();
  return report;
}

ordered_json json_of(const SetLevel& level, std::size_t index) {
  ordered_json report{{"level", index}, {"width", level.size.width}, {"height", level.size.height}};
  if (level.roughness) report["roughness"] = *level.roughness;
  if (!level.method.empty()) report["method"] = level.method;
  report["stored"] = {{"relative_rmse", level.stored.relative_rmse()}, {"rmsle", level.stored.rmsle()}};
  if (level.verification) report["verification"] = json_of(*level.verification);
  return report;
}

ordered_json json_of(const io::WriteReport& losses) {
  return {{"above", losses.above}, {"negative", losses.below}, {"not_finite", losses.not_finite}};
}

ordered_json json_of(const MadeFile& file) {
  const SetFile& made = file.made;
  ordered_json report{{"file", made.name},
                      {"content", name_of(made.content)},
                      {"about", made.about},
                      {"bytes", file.bytes.size()}};
  if (made.content == SetContent::harmonics) {
    report["basis"] = made.basis;
    report["convention"] = made.convention;
  } else if (made.content == SetContent::table) {
    report["table"] = made.table;
    report["type"] = made.type;
    report["error"] = file.error;
  } else {
    report["parameterization"] = made.to;
    report["convention"] = made.convention;
    report["type"] = made.type.empty() ? ordered_json() : ordered_json(made.type);
    if (!made.compression.empty()) report["compression"] = made.compression;
    if (!file.notes.lobe.empty()) report["lobe"] = file.notes.lobe;
    if (!file.notes.roughness.empty()) report["roughness_curve"] = made.curve;
    report["clipped"] = json_of(file.losses);
    for (std::size_t i = 0; i < file.levels.size(); ++i)
      report["levels"].push_back(json_of(file.levels[i], i));
  }
  report["seconds"] = {{"all", file.seconds}, {"encoding", file.encoding_seconds}};
  return report;
}

ordered_json json_of(const LightSet& sun) {
  if (sun.lights.empty()) return nullptr;
  const ExtractedLight& light = sun.lights.front();
  const Vec3d& d = light.direction;
  return {{"direction", {d.x, d.y, d.z}},
          {"channels", sun.channels},
          {"irradiance", light.irradiance},
          {"solid_angle", light.solid_angle},
          {"shape", name_of(light.shape)}};
}

ordered_json json_of(const FormatChoice& choice) {
  return {{"type", choice.type},   {"compression", choice.compression},     {"bytes", choice.bytes},
          {"rmsle", choice.rmsle}, {"relative_rmse", choice.relative_rmse}, {"loads", choice.loads}};
}

}  // namespace

std::string manifest_text(const LightingSet& set, const SetRequest& request) {
  const Engine& engine = set.engine;
  ordered_json report{{"welkin", version()},
                      {"for", engine.name},
                      {"engine", {{"title", engine.title}, {"run", engine.run}, {"source", engine.source}}},
                      {"command", request.command},
                      {"source",
                       {{"file", request.source},
                        {"parameterization", request.parameterization},
                        {"width", request.width},
                        {"height", request.height}}},
                      {"tolerance", request.tolerance}};
  if (request.sun) report["sun"] = json_of(*request.sun);
  for (const MadeFile& file : set.files) report["files"].push_back(json_of(file));
  report["irradiance_by_harmonics"] = {{"relative_rmse", set.light_error}};
  if (!set.formats.empty()) {
    for (const FormatChoice& choice : set.formats) report["formats"].push_back(json_of(choice));
  }
  if (!set.warnings.empty()) report["warnings"] = set.warnings;
  report["snippet"] = engine.snippet;
  return report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace welkin
