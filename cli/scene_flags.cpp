#include "scene_flags.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "progress.h"
#include "welkin/scene/built_in.h"
#include "welkin/scene/read_scene.h"

namespace welkin::cli {
namespace {

/// `name=value`, `name=r/g/b`: to all materials.
void set_material(scene::Material& material, const std::string& name, const std::string& value) {
  const auto number = [&] {
    const std::vector<double> numbers = parse_numbers("--material", value);
    if (numbers.size() != 1) throw UsageError("--material: " + name + "=" + value + " is not a number");
    return static_cast<float>(numbers[0]);
  };
  const auto colour = [&] {
    std::string listed = value;
    std::replace(listed.begin(), listed.end(), '/', ',');
    std::vector<double> numbers = parse_numbers("--material", listed);
    if (numbers.size() == 1) numbers.resize(3, numbers[0]);
    if (numbers.size() != 3)
      throw UsageError("--material: " + name + "=" + value + " is not a colour, R/G/B");
    return std::array{static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
                      static_cast<float>(numbers[2])};
  };
  const std::vector<std::string> names{"color",           "metallic",   "roughness",           "ior",
                                       "transmission",    "clearcoat",  "clearcoat-roughness", "sheen",
                                       "sheen-roughness", "anisotropy", "anisotropy-angle",    "emission",
                                       "normal-scale"};
  if (name == "color") {
    material.base_color = colour();
    material.base_map = {};
  } else if (name == "emission") {
    material.emission = colour();
  } else if (name == "metallic" || name == "roughness") {
    (name == "metallic" ? material.metallic : material.roughness) = number();
    material.metallic_roughness_map = {};
  } else if (name == "ior") {
    material.ior = number();
  } else if (name == "transmission") {
    material.transmission = number();
    material.transmission_map = {};
  } else if (name == "clearcoat") {
    material.clearcoat = number();
    material.clearcoat_map = {};
  } else if (name == "clearcoat-roughness") {
    material.clearcoat_roughness = number();
    material.clearcoat_roughness_map = {};
  } else if (name == "sheen") {
    material.sheen_color = colour();
    material.sheen_color_map = {};
  } else if (name == "sheen-roughness") {
    material.sheen_roughness = number();
    material.sheen_roughness_map = {};
  } else if (name == "anisotropy") {
    material.anisotropy = number();
    material.anisotropy_map = {};
  } else if (name == "anisotropy-angle") {
    material.anisotropy_angle = number() * static_cast<float>(kPi / 180);
  } else if (name == "normal-scale") {
    material.normal_scale = number();
  } else {
    throw UsageError("--material: " + unknown_name("property", name, names));
  }
}

void set_materials(scene::Scene& scene, const std::string& text) {
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find(',', first), text.size());
    const std::string item = text.substr(first, end - first);
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos) throw UsageError("--material: '" + item + "' is not NAME=VALUE");
    for (scene::Material& material : scene.materials)
      set_material(material, item.substr(0, equals), item.substr(equals + 1));
    first = end + 1;
  }
  parse_option("--material", [&] {
    scene.check();
    return 0;
  });
}

}  // namespace

Vec3d parse_point(std::string_view option, const std::string& text) {
  const std::vector<double> n = parse_numbers(option, text);
  if (n.size() != 3) throw UsageError(fmt::format("{}: '{}' is not x,y,z", option, text));
  return {n[0], n[1], n[2]};
}

void SceneFlags::add_scene(Command command) {
  command.add_option(
      "--material", material,
      "Properties of all materials: color=R/G/B, metallic, roughness, ior, transmission, "
      "clearcoat, clearcoat-roughness, sheen=R/G/B, sheen-roughness, anisotropy, anisotropy-angle (degrees), "
      "emission=R/G/B, normal-scale; metallic=1,roughness=0.2");
  command
      .add_option(
          "--shadows", shadows,
          "Of the scene's own lights, with --shading material: map (distances on an octahedron), traced, "
          "none; off leaves the lights out")
      .show_default();
  command.add_option("--triangles", triangles, "About how many triangles a built-in body has")
      .within(64, 10'000'000);
}

void SceneFlags::add(Command command) {
  add_scene(command);
  command.add_option("--size", size, "WIDTHxHEIGHT of the picture, pixels").show_default();
  command.add_option("--camera", camera,
                     "Which of the scene's cameras, by name or number. Default: the first");
  command.add_option("--lens", lens, "Lens, as `view --camera` has them").show_default();
  command.add_option("--fov", fov, "Horizontal field of view, degrees. Default: the scene's camera's")
      .finite();
  command.add_option(
      "--position", position,
      "x,y,z of the camera. Default: the scene's camera; where there is none, or --look is given, "
      "from where it sees all of the scene");
  command.add_option("--look", look, "YAW,PITCH,ROLL, degrees, as of `view`");
}

scene::Scene SceneFlags::load(const std::string& name) const {
  const std::vector<std::string> known = scene::built_in_names();
  const bool built_in = std::find(known.begin(), known.end(), name) != known.end();
  if (!built_in && !std::filesystem::exists(name) && name.find_first_of("./") == std::string::npos)
    throw UsageError("SCENE: no such file, and " + unknown_name("built-in scene", name, known));
  scene::Scene scene = built_in ? scene::built_in(name, {.triangles = triangles}) : scene::read_scene(name);
  print_warnings(name, scene.warnings);
  if (!material.empty()) set_materials(scene, material);
  return scene;
}

std::unique_ptr<scene::Shading> SceneFlags::lit(std::unique_ptr<scene::Shading> shading,
                                                const std::string& name,
                                                const scene::TracedScene& traced) const {
  const std::vector<std::string> names{"none", "map", "traced", "off"};
  const auto found = std::find(names.begin(), names.end(), shadows);
  if (found == names.end()) throw UsageError("--shadows: " + unknown_name("kind of shadow", shadows, names));
  if (name != "material" || shadows == "off" || traced.scene().lights.empty()) return shading;
  return scene::with_lights(std::move(shading), traced, static_cast<scene::Shadows>(found - names.begin()));
}

namespace {

const scene::SceneCamera& chosen(const scene::Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const scene::SceneCamera& camera : scene.cameras) {
    if (camera.name == name) return camera;
    names.push_back(camera.name);
  }
  if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos && name.size() < 6 &&
      std::stoul(name) < scene.cameras.size())
    return scene.cameras[std::stoul(name)];
  throw UsageError("--camera: " + unknown_name("camera of the scene", name, names));
}

}  // namespace

scene::PlacedCamera SceneFlags::camera_of(const scene::Scene& scene) const {
  scene::PlacedCamera placed;
  placed.camera.lens = lens;
  if (size.find('x') == std::string::npos) throw UsageError("--size: '" + size + "' is not WIDTHxHEIGHT");
  placed.camera.size = parse_chart_size("--size", size, sphere::AnyParameterization::make("perspective"));
  placed.camera.fov = fov;
  const bool aimed = !look.empty();
  if (aimed) {
    std::vector<double> angles = parse_numbers("--look", look);
    if (angles.size() > 3) throw UsageError("--look: '" + look + "' is not YAW,PITCH,ROLL");
    angles.resize(3);
    placed.camera.rotation = rotation_of({angles[0], angles[1], angles[2]});
  }
  if (!camera.empty() || (!scene.cameras.empty() && !aimed && position.empty())) {
    const scene::SceneCamera& from = camera.empty() ? scene.cameras.front() : chosen(scene, camera);
    placed.position = from.position;
    if (!aimed) placed.camera.rotation = from.rotation;
    if (!fov && lens == "perspective") {
      placed.camera.fov = from.vertical_fov;
      placed.camera.axis = FovAxis::vertical;
    }
    if (!position.empty()) placed.position = parse_point("--position", position);
    parse_option("--lens", [&] { return frame_of(placed.camera); });
    return placed;
  }
  parse_option("--lens", [&] { return frame_of(placed.camera); });
  if (!position.empty()) {
    placed.position = parse_point("--position", position);
    return placed;
  }
  return camera_that_sees(scene, placed.camera);
}

}  // namespace welkin::cli
