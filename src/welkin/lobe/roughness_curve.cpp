#include "welkin/lobe/roughness_curve.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin::lobe {
namespace {

/// Levels are unclamped here; `last` is the last level's number.
struct Curve {
  const char* name;
  const char* description;
  const char* source;
  double (*roughness)(double level, int last);
  double (*level)(double roughness, int last);
};

double share(double level, int last) {
  return last > 0 ? level / last : 0;
}

double from_share(double roughness, int last) {
  return roughness * last;
}

/// The r of x = r (2 − r), 1 − √(1 − x), without the difference.
double of_square(double x) {
  return x / (1 + std::sqrt(std::max(1 - x, 0.0)));
}

double three_js_size(double roughness);
double three_js_roughness(double size);

constexpr Curve kCurves[] = {
    {"linear", "roughness = x", "glTF-Sample-Viewer, among others", share, from_share},
    {"filament", "x = r (2 − r)",
     "Filament: perceptualRoughnessToLod, and lodToPerceptualRoughness of its filter",
     [](double level, int last) { return of_square(share(level, last)); },
     [](double roughness, int last) { return last * roughness * (2 - roughness); }},
    {"unity", "x = r (1.7 − 0.7 r)",
     "Unity: PerceptualRoughnessToMipmapLevel of ImageBasedLighting.hlsl, which has 7 levels",
     [](double level, int last) {
       const double x = share(level, last);
       return 20 * x / (17 + std::sqrt(289 - 280 * x));
     },
     [](double roughness, int last) { return last * roughness * (1.7 - 0.7 * roughness); }},
    {"unreal", "level = last − 2 + 1.2 log2 r; 1 beyond last − 2, for chains down to 1×1",
     "Unreal Engine: ComputeReflectionCaptureMipFromRoughness of ReflectionEnvironmentShared",
     [](double level, int last) { return std::min(1.0, std::exp2((level - (last - 2)) / 1.2)); },
     [](double roughness, int last) { return last - 2 + 1.2 * std::log2(std::max(roughness, 1e-3)); }},
    {"three.js", "x = r (2 − r), since r187; before: three.js-r186",
     "three.js: PMREMGenerator, lodToRoughness and its inverse in the look-up",
     [](double level, int last) { return of_square(share(level, last)); },
     [](double roughness, int last) { return last * roughness * (2 - roughness); }},
    {"three.js-r186",
     "by level = last − 2 − m: m = −2 log2(1.16 r), below r 0.21; then by a table to 1 at m = −2",
     "three.js up to r186: roughnessToMip of cube_uv_reflection_fragment, PMREMGenerator",
     [](double level, int last) { return three_js_roughness(last - 2 - level); },
     [](double roughness, int last) { return last - 2 - three_js_size(roughness); }},
    {"godot", "x = √r",
     "Godot 4: the look-up of scene_forward_clustered and sky radiance, √roughness · MAX_ROUGHNESS_LOD",
     [](double level, int last) { return share(level, last) * share(level, last); },
     [](double roughness, int last) { return last * std::sqrt(roughness); }},
    {"babylon", "level = 0.8 log2(N r²), N = 2^last; 1 beyond, for chains down to 1×1",
     "Babylon.js: getLodFromAlphaG, and lodGenerationScale 0.8 of its textures",
     [](double level, int last) { return std::min(1.0, std::exp2((level / 0.8 - last) / 2)); },
     [](double roughness, int last) { return 0.8 * (last + 2 * std::log2(std::max(roughness, 1e-9))); }},
    {"playcanvas", "r = level / 5; 1 beyond, for six levels", "PlayCanvas: reflectionEnv, calcReflection",
     [](double level, int) { return std::min(1.0, level / 5); },
     [](double roughness, int) { return 5 * roughness; }},
    {"cesium", "roughness = x", "Cesium: ImageBasedLightingStageFS, sampleSpecularEnvironment", share,
     from_share},
    {"bevy", "roughness = x", "Bevy: environment_map, compute_radiances", share, from_share},
};

// Up to r186 three.js counts m, the binary logarithm of a level's face size, and continues below its smallest
// face of 16 with levels of that size: m = 3 … −2.
struct Knot {
  double roughness, size;
};
constexpr Knot kKnots[] = {{1, -2}, {0.8, -1}, {0.4, 2}, {0.305, 3}, {0.21, 4}};

double three_js_size(double roughness) {
  if (roughness < 0.21) return -2 * std::log2(1.16 * roughness);
  std::size_t i = 1;
  while (i + 1 < std::size(kKnots) && roughness < kKnots[i].roughness) ++i;
  const Knot rough = kKnots[i - 1], smooth = kKnots[i];
  return rough.size +
         (rough.roughness - roughness) / (rough.roughness - smooth.roughness) * (smooth.size - rough.size);
}

/// The two pieces don't quite meet at 0.21: sizes 4 to 4.07 all have it.
double three_js_roughness(double size) {
  if (size >= 4) return std::min(0.21, std::exp2(-0.5 * size) / 1.16);
  if (size <= -2) return 1;
  std::size_t i = 1;
  while (size > kKnots[i].size) ++i;
  const Knot rough = kKnots[i - 1], smooth = kKnots[i];
  return rough.roughness +
         (size - rough.size) / (smooth.size - rough.size) * (smooth.roughness - rough.roughness);
}

const Curve* curve_named(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kCurves), std::end(kCurves), [&](const Curve& c) { return c.name == name; });
  return found == std::end(kCurves) ? nullptr : &*found;
}

std::vector<double> parse_list(std::string_view text) {
  std::vector<double> list;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string item(text.substr(0, comma));
    const auto value = parse_number(item);
    if (!value || !(*value >= 0 && *value <= 1)) {
      throw Error(ErrorKind::bad_request, "the roughness '" + item + "' is not a number in 0…1");
    }
    if (!list.empty() && *value < list.back()) {
      throw Error(ErrorKind::bad_request,
                  "the roughness " + item + " is below the one before, " + number_text(list.back()));
    }
    list.push_back(*value);
    if (comma == std::string_view::npos) return list;
    text = text.substr(comma + 1);
  }
}

bool looks_like_a_list(std::string_view text) {
  return text.find(',') != std::string_view::npos || parse_number(text).has_value();
}

}  // namespace

const std::vector<std::string>& roughness_curve_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Curve& curve : kCurves) list.emplace_back(curve.name);
    return list;
  }();
  return names;
}

RoughnessCurve RoughnessCurve::from_name(std::string_view text) {
  RoughnessCurve made{std::string(text)};
  if (looks_like_a_list(text)) {
    made.list_ = parse_list(text);
  } else if (curve_named(text) == nullptr) {
    throw Error(ErrorKind::bad_request, unknown_name("roughness curve", text, roughness_curve_names()));
  }
  return made;
}

std::string RoughnessCurve::description() const {
  return list_.empty() ? curve_named(text_)->description : "a list";
}

std::string RoughnessCurve::source() const {
  return list_.empty() ? curve_named(text_)->source : "the list";
}

void RoughnessCurve::check_levels(int levels) const {
  require(levels >= 1, "a chain has at least one level");
  if (!list_.empty() && levels != listed_levels()) {
    throw Error(ErrorKind::bad_request, "the list " + text_ + " has " + std::to_string(listed_levels()) +
                                            " roughnesses for " + std::to_string(levels) + " levels");
  }
}

double RoughnessCurve::roughness(double level, int levels) const {
  require(level == level, "a level is a number");
  check_levels(levels);
  const double position = std::clamp(level, 0.0, levels - 1.0);
  if (list_.empty()) return curve_named(text_)->roughness(position, levels - 1);
  const auto below = static_cast<std::size_t>(position);
  if (below + 1 == list_.size()) return list_.back();
  return list_[below] + (position - static_cast<double>(below)) * (list_[below + 1] - list_[below]);
}

double RoughnessCurve::level_of(double roughness, int levels) const {
  check_levels(levels);
  if (!(roughness >= 0 && roughness <= 1)) {
    throw Error(ErrorKind::bad_request, "the roughness " + number_text(roughness) + " is not in 0…1");
  }
  if (list_.empty()) {
    return std::clamp(curve_named(text_)->level(roughness, levels - 1), 0.0, levels - 1.0);
  }
  if (roughness <= list_.front()) return 0;
  for (std::size_t i = 1; i < list_.size(); ++i) {
    if (roughness > list_[i]) continue;
    return static_cast<double>(i) - (list_[i] - roughness) / (list_[i] - list_[i - 1]);
  }
  return levels - 1;
}

std::vector<double> RoughnessCurve::roughness_of_levels(int levels) const {
  std::vector<double> list;
  for (int level = 0; level < levels; ++level) list.push_back(roughness(level, levels));
  return list;
}

}  // namespace welkin::lobe
