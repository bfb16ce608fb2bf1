#include "welkin/scene/read_scene.h"

#include <algorithm>
#include <cctype>

#include "welkin/base/error.h"
#include "welkin/io/output_file.h"
#include "welkin/scene/scene_input.h"

namespace welkin::scene {
namespace {

bool is_gltf(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("glTF")) return true;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

bool has_extension(const std::string& name, std::string_view extension) {
  if (name.size() < extension.size()) return false;
  return std::equal(extension.rbegin(), extension.rend(), name.rbegin(), [](char a, char b) {
    return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
  });
}

}  // namespace

Scene read_scene(const SceneInput& input) {
  const bool gltf = is_gltf(input.bytes);
  if (gltf || has_extension(input.name, ".obj")) {
    try {
      Scene scene = gltf ? read_gltf(input) : read_obj(input);
      if (scene.instances.empty())
        throw Error(ErrorKind::unsupported, "has no triangles: nothing of it could be seen");
      return scene;
    } catch (const Error& error) {
      throw about(input.name, error);
    }
  }
  if (has_extension(input.name, ".gltf") || has_extension(input.name, ".glb"))
    throw Error(ErrorKind::damaged, input.name, "doesn't begin as glTF does, with 'glTF' or '{'");
  throw Error(ErrorKind::unsupported, input.name,
              "is no scene that is read: glTF 2.0 (.gltf, .glb) and .obj are");
}

Scene read_scene(const std::filesystem::path& path) {
  const io::InputFile file(path);
  Scene scene = read_scene(SceneInput{path.string(), file.bytes(), files_in(path.parent_path())});
  scene.check();
  return scene;
}

}  // namespace welkin::scene
