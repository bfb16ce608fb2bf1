#include <algorithm>
#include <array>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/scene/gltf_file.h"

namespace welkin::scene {
namespace {

constexpr std::array<std::string_view, 11> kRead = {"EXT_texture_webp",
                                                    "KHR_lights_punctual",
                                                    "KHR_materials_anisotropy",
                                                    "KHR_materials_clearcoat",
                                                    "KHR_materials_emissive_strength",
                                                    "KHR_materials_ior",
                                                    "KHR_materials_sheen",
                                                    "KHR_materials_transmission",
                                                    "KHR_materials_unlit",
                                                    "KHR_mesh_quantization",
                                                    "KHR_texture_transform"};

bool is_read(const std::string& extension) {
  return std::find(kRead.begin(), kRead.end(), extension) != kRead.end();
}

}  // namespace

Scene read_gltf(const SceneInput& input) {
  const GltfFile file = open_gltf(input);
  Scene scene;
  for (const std::string& extension : file.model.extensionsRequired)
    if (!is_read(extension))
      throw Error(ErrorKind::unsupported, "requires the extension " + extension + ", which is not read");
  for (const std::string& extension : file.model.extensionsUsed)
    if (!is_read(extension)) warn(scene, "the extension " + extension + " is not read");
  read_gltf_materials(file, input, scene);
  read_gltf_nodes(file, read_gltf_meshes(file, scene), scene);
  if (!file.model.animations.empty())
    warn(scene, "animations are not read: everything stands as it was modelled");
  return scene;
}

}  // namespace welkin::scene
