#pragma once

#include <filesystem>

#include "welkin/base/export.h"
#include "welkin/scene/scene.h"

/// @file
/// Scenes from files.
namespace welkin::scene {

/// Reads glTF 2.0 (`.gltf` with the files that it names beside it, `.glb`) or Wavefront OBJ with its `.mtl`,
/// known by its first bytes and its name. What is left out or mended (unknown extensions, missing pictures,
/// triangles without area, normals that are not finite) is told by Scene::warnings, each once; textures that
/// are missing count as white. Files that it names lie in its folder or below. Throws Error about the file:
/// (not_found, denied, system), (damaged), (unsupported) for what isn't a scene, or for an extension that it
/// requires and that isn't read, (too_large), (bad_value) for vertices that are not finite.
WELKIN_API Scene read_scene(const std::filesystem::path& path);

}  // namespace welkin::scene
