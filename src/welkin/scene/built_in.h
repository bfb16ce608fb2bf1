#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/scene/scene.h"

/// @file
/// Scenes that need no file.
namespace welkin::scene {

/// Names of the built-in scenes, in the order they are best shown.
WELKIN_API std::vector<std::string> built_in_names();

/// One line about a scene. Throws Error (bad_request) for a name that built_in_names() lacks.
WELKIN_API std::string built_in_description(std::string_view name);

/// What a built-in scene can be asked for.
struct BuiltInOptions {
  /// Triangles of all that is seen: about so many, 64 … 10⁷, where the shapes can be made of so few (the
  /// landscape has 75,000, the others some hundreds, the creature some thousands); 0: enough for smooth
  /// outlines.
  int triangles = 0;
};

/// The scene of that name, with a camera that sees all of it. Throws Error (bad_request): an unknown name, a
/// number out of range.
WELKIN_API Scene built_in(std::string_view name, const BuiltInOptions& options = {});

}  // namespace welkin::scene
