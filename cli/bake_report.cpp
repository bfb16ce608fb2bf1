#include "bake_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "json_text.h"
#include "lights_report.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

std::string size_text(ChartSize size) {
  return fmt::format("{}×{}", size.width, size.height);
}

/// What a text lacks of a width in characters, of which × is one and two bytes.
std::string padding(const std::string& text, std::size_t width) {
  std::size_t characters = 0;
  for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80 ? 1 : 0;
  return std::string(width - std::min(width, characters), ' ');
}
std::string right(const std::string& text, std::size_t width) {
  return padding(text, width) + text;
}
std::string left(const std::string& text, std::size_t width) {
  return text + padding(text, width);
}

template <class T>
std::string or_dash(const char* format, const std::optional<T>& value) {
  return value ? fmt::format(fmt::runtime(format), *value) : "–";
}

std::string method_text(const PrefilterMethod& method) {
  std::string text =
      method.degree > 0 ? fmt::format("{}, degree {}", method.name, method.degree) : method.name;
  if (method.widened > 0) text += fmt::format(", σ {:.2g}°", method.widened * 180 / kPi);
  return text;
}

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json json_of(const LevelVerification& v) {
  const Vec3d& d = v.reference.maximum_direction;
  ordered_json report{{"random_texels", v.reference.random_texels},
                      {"hot_texels", v.reference.hot_texels},
                      {"relative_rmse", v.reference.relative_rmse},
                      {"max_relative", v.reference.maximum},
                      {"max_relative_direction", {d.x, d.y, d.z}}};
  report["energy"] = or_null(v.energy);
  report["furnace"] = or_null(v.furnace);
  return report;
}

}  // namespace

ordered_json describe_bake(const std::string& in, const std::string& out, const BakeLevels& made,
                           const ChainNotes& notes) {
  return {{"in", in},
          {"out", out},
          {"lobe", notes.lobe},
          {"roughness_curve", notes.curve.empty() ? ordered_json() : ordered_json(notes.curve)},
          {"normalisation", notes.normalisation},
          {"parameterization", made.shape->text()},
          {"tolerance", made.options.prefilter.tolerance}};
}

ordered_json describe_levels(const BakeLevels& made, const ChainNotes& notes,
                             const std::vector<PrefilterMethod>& methods) {
  ordered_json levels = ordered_json::array();
  for (std::size_t i = 0; i < made.levels.size(); ++i) {
    ordered_json level{{"level", i},
                       {"width", made.levels[i].size.width},
                       {"height", made.levels[i].size.height},
                       {"lobe", made.levels[i].lobe.spec()}};
    if (i < notes.roughness.size()) level["roughness"] = notes.roughness[i];
    if (i < methods.size()) {
      level["method"] = methods[i].name;
      if (methods[i].degree > 0) level["degree"] = methods[i].degree;
      if (methods[i].widened > 0) level["widened_radians"] = methods[i].widened;
    }
    levels.push_back(std::move(level));
  }
  return levels;
}

void BakeReport::print() const {
  const BakeLevels& m = *made;
  const std::size_t count = m.levels.size();
  if (sun) print_sun(*sun);
  fmt::print("{}: {}, {} of {}, {} {}\n", printable(out), printable(notes.lobe), m.shape->text(),
             size_text(m.levels.front().size), count, count == 1 ? "level" : "levels");
  fmt::print(
      "level  {}  roughness  {}", right("size", 11),
      verification.empty() ? "method" : left("method", 33) + "  rel. RMSE %    max %    energy   furnace");
  fmt::print("\n");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string roughness =
        i < notes.roughness.size() ? fmt::format("{:.6g}", notes.roughness[i]) : "–";
    const std::string method = method_text(methods[i]);
    fmt::print("{:>5}  {}  {}  {}", i, right(size_text(m.levels[i].size), 11), right(roughness, 9),
               verification.empty() ? method : left(method, 33));
    if (!verification.empty()) {
      const LevelVerification& v = verification[i];
      fmt::print("  {}  {}  {}  {}", right(fmt::format("{:.3g}", 100 * v.reference.relative_rmse), 11),
                 right(fmt::format("{:.3g}", 100 * v.reference.maximum), 7),
                 right(or_dash("{:.6f}", v.energy), 8), right(or_dash("{:.1e}", v.furnace), 8));
    }
    fmt::print("\n");
  }
  for (std::size_t i = 0; i < stored.size(); ++i) {
    fmt::print("level {} as it is stored: rel. RMSE {:.3g} %, RMSLE {:.2g}\n", i,
               100 * stored[i].relative_rmse(), stored[i].rmsle());
  }
  fmt::print("read {:.3f} s, planned {:.3f} s, filtered {:.3f} s, ", read_seconds, plan_seconds,
             compute_seconds);
  if (!verification.empty()) fmt::print("verified {:.3f} s, ", verify_seconds);
  fmt::print("wrote {:.3f} s\n", write_seconds);
}

void BakeReport::print_json() const {
  ordered_json report = describe_bake(in, out, *made, notes);
  if (sun) report["sun"] = sun->lights.empty() ? ordered_json(nullptr) : cli::json_of(*sun, 0);
  ordered_json levels = describe_levels(*made, notes, methods);
  for (std::size_t i = 0; i < verification.size(); ++i) levels[i]["verification"] = json_of(verification[i]);
  for (std::size_t i = 0; i < stored.size(); ++i)
    levels[i]["stored"] = {{"relative_rmse", stored[i].relative_rmse()}, {"rmsle", stored[i].rmsle()}};
  report["levels"] = std::move(levels);
  report["seconds"] = {{"read", read_seconds}, {"plan", plan_seconds}, {"compute", compute_seconds}};
  if (!verification.empty()) report["seconds"]["verify"] = verify_seconds;
  report["seconds"]["write"] = write_seconds;
  print_json_text(report);
}

void BakeReport::report_misses() const {
  if (sun) warn_of_lights(in, *sun);
  if (made->options.method != BakeMethod::exact) return;
  for (std::size_t i = 0; i < verification.size(); ++i) {
    const ReferenceErrors& reference = verification[i].reference;
    if (reference.relative_rmse <= made->options.prefilter.tolerance) continue;
    print_message(
        fmt::format("welkin: {}: level {}: the relative RMSE, {:.3g} %, is above the tolerance, {:g} %\n",
                    out, i, 100 * reference.relative_rmse, 100 * made->options.prefilter.tolerance));
  }
}

}  // namespace welkin::cli
