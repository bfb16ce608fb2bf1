#pragma once

#include <memory>
#include <optional>
#include <string>

#include "command.h"
#include "welkin/render/project/shadow_map.h"
#include "welkin/render/render.h"
#include "welkin/scene/scene.h"

/// What commands on scenes share.
namespace welkin::cli {

/// Options of a scene and of the camera that looks at it.
struct SceneFlags {
  std::string size = "960x540", lens = "perspective", look, position, camera, material;
  std::string shadows = "map";
  std::optional<double> fov;
  int triangles = 0;

  /// All of them.
  void add(Command command);
  /// Of the scene alone.
  void add_scene(Command command);
  /// A file's scene, or a built-in one; `--material` applied, warnings told. Throws UsageError.
  scene::Scene load(const std::string& name) const;
  /// The shading, with the scene's lights, where it is one that they light. Throws UsageError.
  std::unique_ptr<scene::Shading> lit(std::unique_ptr<scene::Shading> shading, const std::string& name,
                                      const scene::TracedScene& traced) const;
  /// The scene's camera, unless options say otherwise. Throws UsageError.
  scene::PlacedCamera camera_of(const scene::Scene& scene) const;
};

/// `x,y,z`. Throws UsageError, naming the option.
Vec3d parse_point(std::string_view option, const std::string& text);

}  // namespace welkin::cli
