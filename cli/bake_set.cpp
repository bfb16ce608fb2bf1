#include "bake_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <span>

#include "lights_report.h"
#include "welkin/lighting_set/manifest.h"
#include "welkin/lighting_set/page.h"
#include "welkin/lighting_set/set_folder.h"

namespace welkin::cli {
namespace {

/// Of `bake`, those that a set has no use for.
constexpr const char* kUnused[] = {"--lobe",        "--to",        "--level0",       "--method",   "--brdf",
                                   "--views",       "--axis",      "--lobes",        "--frames",   "--every",
                                   "--keys-only",   "--held-out",  "--resume",       "--to-faces", "--border",
                                   "--compression", "--to-colour", "--normalisation"};

/// Of a set alone.
constexpr const char* kOnlySets[] = {"--for", "--max-bytes"};

std::string texels_of(const MadeFile& file) {
  const SetFile& made = file.made;
  if (file.levels.empty()) return made.content == SetContent::harmonics ? made.basis : made.table;
  const ChartSize size = file.levels.front().size;
  std::string text = fmt::format("{} {}×{}", made.to, size.width, size.height);
  if (file.levels.size() > 1) text += fmt::format(", {} levels", file.levels.size());
  if (!made.type.empty()) text += ", " + made.type;
  return made.compression.empty() ? text : text + " + " + made.compression;
}

void print(const LightingSet& set, const std::string& out) {
  fmt::print("{}: for {}\n", printable(out), set.engine.title);
  for (const MadeFile& file : set.files) {
    fmt::print("{:<32} {:>9} bytes  {}\n", file.made.name, file.bytes.size(), texels_of(file));
    double rmsle = 0, relative = 0;
    for (const SetLevel& level : file.levels) {
      rmsle = std::max(rmsle, level.stored.rmsle());
      relative = std::max(relative, level.stored.relative_rmse());
    }
    if (!file.levels.empty())
      fmt::print(
          "{:<32} stored: rel. RMSE ≤ {:.3g} %, RMSLE ≤ {:.2g}; {:.3f} s, of which {:.3f} s encoding\n", "",
          100 * relative, rmsle, file.seconds, file.encoding_seconds);
    for (std::size_t i = 0; i < file.levels.size(); ++i) {
      if (!file.levels[i].verification) continue;
      const ReferenceErrors& reference = file.levels[i].verification->reference;
      fmt::print("{:<32} level {} against brute force: rel. RMSE {:.3g} %, max {:.3g} %\n", "", i,
                 100 * reference.relative_rmse, 100 * reference.maximum);
    }
  }
  fmt::print("irradiance by nine harmonics: rel. RMSE {:.3g} %\n", 100 * set.light_error);
  for (const FormatChoice& choice : set.formats) {
    fmt::print("as ktx2 {:<20} {:>9} bytes, rel. RMSE {:.3g} %, RMSLE {:.2g}{}\n",
               choice.compression == "none" ? choice.type : choice.type + " + " + choice.compression,
               choice.bytes, 100 * choice.relative_rmse, choice.rmsle,
               choice.loads ? "" : "; this engine can't load it");
  }
}

/// As a shell takes it for one word.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("_-+=./,:%@", c) != nullptr;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string command_line(const Command& command) {
  std::string text = "welkin " + command.name();
  for (const Option& option : command.options()) {
    if (!option.given()) continue;
    for (const std::string& value : option.values()) {
      if (option.positional()) {
        text += " " + quoted(value);
      } else if (option.flag()) {
        text += " " + option.name() + (value == "true" ? "" : "=" + value);
      } else {
        text += " " + option.name() + " " + quoted(value);
      }
    }
  }
  return text;
}

void BakeSet::add(Command command) {
  command.add_option("--for", engine,
                     "All files that an engine lights a scene with, into the folder OUT: three.js, filament… "
                     "(`welkin list engines`). A folder alone, OUT/: the general set");
  command
      .add_option("--max-bytes", most_bytes,
                  "Of a set: halve the faces of the specular chain until its file has at most so many bytes")
      .positive();
}

Engine BakeSet::chosen() const {
  return parse_option("--for", [&] { return engine_from_name(engine.empty() ? "general" : engine); });
}

bool BakeSet::asked(const std::string& out, const Command& command) const {
  std::error_code ignored;
  const bool folder = !out.empty() && (out.back() == '/' || std::filesystem::is_directory(out, ignored));
  if (engine.empty() && !folder) {
    for (const char* option : kOnlySets) {
      if (command.option(option).given())
        throw UsageError(fmt::format("{}: is for a set; name a folder, as {}/", option, printable(out)));
    }
    return false;
  }
  for (const char* option : kUnused) {
    if (command.option(option).given())
      throw UsageError(
          fmt::format("{}: a set is made as its engine loads it; name one file for other maps", option));
  }
  return true;
}

SetOptions BakeSet::parse(const std::string& out, const BakeLevels& made, const std::string& type,
                          const std::string& convention, const WriteMapOptions& write) const {
  const Engine wanted = chosen();
  SetOptions options;
  if (!made.size.empty())
    options.width = parse_chart_size("--size", made.size, sphere::AnyParameterization::make("cube")).width;
  options.levels = made.count;
  if (!made.roughness.empty())
    options.curve =
        parse_option("--roughness", [&] { return lobe::RoughnessCurve::from_name(made.roughness); });
  if (!convention.empty()) options.convention = convention;
  if (!type.empty()) options.type = type;
  options.quality = write.image.texture_quality;
  options.most_bytes = most_bytes.value_or(0);
  const std::vector<SetFile> files = parse_option("--for", [&] { return set_files(wanted, options); });
  std::vector<std::string> names{kManifestName, kPageName};
  for (const SetFile& file : files) names.push_back(file.name);
  check_set_folder(out, names);
  return options;
}

void BakeSet::run(const Map& source, const std::string& out, const SetOptions& options,
                  const SetRequest& request, bool json) const {
  const LightingSet set = make_lighting_set(source, chosen(), options);
  end_progress();
  const std::string manifest = manifest_text(set, request), page = page_text(set, request);
  std::vector<FolderFile> files;
  for (const MadeFile& file : set.files) files.push_back({file.made.name, file.bytes});
  files.push_back({kPageName, std::as_bytes(std::span(page))});
  files.push_back({kManifestName, std::as_bytes(std::span(manifest))});
  for (const std::string& name : write_set_folder(out, files))
    print_message(
        fmt::format("welkin: {}: is left of an earlier set\n", (std::filesystem::path(out) / name).string()));
  for (const MadeFile& file : set.files)
    report_losses((std::filesystem::path(out) / file.made.name).string(), file.losses);
  for (const std::string& warning : set.warnings) print_warning(out, warning);
  if (json) {
    fmt::print("{}", manifest);
  } else {
    if (request.sun) print_sun(*request.sun);
    print(set, out);
  }
}

}  // namespace welkin::cli
