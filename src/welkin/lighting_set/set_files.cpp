#include <algorithm>
#include <cmath>
#include <filesystem>

#include "welkin/base/error.h"
#include "welkin/base/listed.h"
#include "welkin/base/number_text.h"
#include "welkin/lighting_set/lighting_set.h"
#include "welkin/map/chain.h"
#include "welkin/map_file/layout.h"
#include "welkin/sphere/convention.h"

namespace welkin {
namespace {

[[noreturn]] void refuse(const Engine& engine, const std::string& what, const std::string& reason) {
  throw Error(ErrorKind::bad_request, engine.title + " can't load " + what + ": " + reason);
}

/// What graphics cards take.
constexpr int kWidestFace = 1 << 14;

std::string levels_text(int levels, int width) {
  return std::to_string(levels) + " levels of faces of " + std::to_string(width) + " texels";
}

bool is_power_of_two(int value) {
  return value > 0 && (value & (value - 1)) == 0;
}

int levels_of(const SetFile& file) {
  const int most = max_levels({file.width, file.width});
  return file.levels == 0 ? most : file.levels;
}

void check_limits(const Engine& engine, const SetFile& file) {
  const SetLimits& limits = engine.limits;
  if (!limits.types.empty() && !file.type.empty() &&
      std::count(limits.types.begin(), limits.types.end(), file.type) == 0)
    refuse(engine, "texels of " + file.type,
           limits.types_reason + " (it can load " + listed(limits.types) + ")");
  if ((limits.power_of_two && !is_power_of_two(file.width)) || file.width < limits.narrowest)
    refuse(engine, "faces of " + std::to_string(file.width) + " texels", limits.width_reason);
  const int levels = levels_of(file);
  const bool enough = levels >= limits.fewest_levels && levels <= limits.most_levels;
  if (!enough || (limits.all_levels && levels != max_levels({file.width, file.width})))
    refuse(engine, levels_text(levels, file.width), limits.levels_reason);
}

/// Fewer levels of a smaller cube, where the engine takes them: a last level of as many texels.
int fitting_levels(const Engine& engine, const SetFile& usual, int width) {
  if (usual.levels == 0 ||
      (usual.curve != kGltfCurve && lobe::RoughnessCurve::from_name(usual.curve).listed_levels() > 0))
    return usual.levels;
  int levels = usual.levels;
  for (int w = usual.width; w > width && levels > engine.limits.fewest_levels; w /= 2) --levels;
  return levels;
}

/// The roughness of each level, as Babylon.js reads the light of a .glb.
std::string gltf_roughness(int levels, int width) {
  std::string text;
  for (int level = 0; level < levels; ++level) {
    const double share = levels == 1 ? 1 : static_cast<double>(level) / (levels - 1);
    text += (level == 0 ? "" : ",") + number_text(std::pow(width, (share - 1) / 2));
  }
  return text;
}

void apply(const SetOptions& options, const Engine& engine, SetFile& file) {
  const bool is_chain = file.content == SetContent::specular || file.content == SetContent::sheen;
  if (options.convention && file.content != SetContent::table) file.convention = *options.convention;
  if (!is_chain) return;
  if (options.width) {
    file.levels = fitting_levels(engine, file, *options.width);
    file.width = *options.width;
  }
  if (options.levels) file.levels = *options.levels;
  if (options.curve) {
    file.curve = options.curve->text();
    if (!options.levels && options.curve->listed_levels() > 0) file.levels = options.curve->listed_levels();
  }
  if (options.type && file.content == SetContent::specular) file.type = *options.type;
  if (file.curve == kGltfCurve && file.width > 0 && file.width <= kWidestFace)
    file.curve = gltf_roughness(levels_of(file), file.width);
}

}  // namespace

std::vector<SetFile> set_files(const Engine& engine, const SetOptions& options) {
  std::vector<SetFile> files = engine.files;
  bool has_chain = false;
  for (SetFile& file : files) {
    apply(options, engine, file);
    convention_from_name(file.convention);
    if (file.content != SetContent::specular && file.content != SetContent::sheen) continue;
    has_chain = true;
    if (file.width < 1 || file.width > kWidestFace)
      throw Error(ErrorKind::bad_request, "faces have 1 to " + std::to_string(kWidestFace) + " texels, not " +
                                              std::to_string(file.width));
    const lobe::RoughnessCurve curve = lobe::RoughnessCurve::from_name(file.curve);
    check_limits(engine, file);
    if (levels_of(file) > max_levels({file.width, file.width}))
      throw Error(ErrorKind::bad_request, "there are no " + levels_text(levels_of(file), file.width));
    curve.roughness(0, levels_of(file));
    if (file.type.empty()) continue;
    const std::string extension = std::filesystem::path(file.name).extension().string().substr(1);
    const io::Capabilities& format = io::capabilities_for("x." + extension);
    if (!format.holds(io::pixel_type_from_name(file.type)))
      throw Error(ErrorKind::bad_request, format.title + " holds no " + file.type + " texels");
  }
  const bool changes_chain =
      options.width || options.levels || options.curve || options.type || options.most_bytes > 0;
  if (changes_chain && !has_chain)
    refuse(
        engine, "another chain",
        engine.limits.levels_reason.empty() ? "it filters a panorama itself" : engine.limits.levels_reason);
  return files;
}

}  // namespace welkin
