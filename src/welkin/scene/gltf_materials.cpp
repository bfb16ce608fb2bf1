#include <algorithm>
#include <map>
#include <tuple>

#include "welkin/base/error.h"
#include "welkin/scene/gltf_file.h"

namespace welkin::scene {
namespace {

using tinygltf::Value;

/// Pictures by image, by how their colours are stored, and by how they go on past their edges.
class Pictures {
 public:
  Pictures(const GltfFile& file, const SceneInput& input, Scene& scene)
      : file_(file), input_(input), scene_(scene) {}

  /// The number of a texture's picture; −1, with a warning, where it can't be had.
  int number_of(int texture_index, io::Colour colour) {
    const auto& textures = file_.model.textures;
    if (texture_index < 0 || static_cast<std::size_t>(texture_index) >= textures.size()) {
      warn(scene_, "texture " + std::to_string(texture_index) + " isn't there, and counts as white");
      return -1;
    }
    const tinygltf::Texture& texture = textures[static_cast<std::size_t>(texture_index)];
    int source = texture.source;
    if (const auto webp = texture.extensions.find("EXT_texture_webp"); webp != texture.extensions.end())
      source = static_cast<int>(std::clamp(scene::number_of(webp->second, "source", source), -1.0, 1e9));
    Wrap across = Wrap::repeat, down = Wrap::repeat;
    if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < file_.model.samplers.size()) {
      const tinygltf::Sampler& sampler = file_.model.samplers[static_cast<std::size_t>(texture.sampler)];
      across = wrap_of(sampler.wrapS);
      down = wrap_of(sampler.wrapT);
    }
    const auto key = std::tuple{source, colour, across, down};
    if (const auto known = numbers_.find(key); known != numbers_.end()) return known->second;
    return numbers_[key] = read(source, colour, across, down);
  }

 private:
  static Wrap wrap_of(int code) {
    return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
           : code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                           : Wrap::repeat;
  }

  int read(int source, io::Colour colour, Wrap across, Wrap down) {
    if (source < 0 || static_cast<std::size_t>(source) >= file_.images.size()) {
      warn(scene_, "a texture without a picture that is read counts as white");
      return -1;
    }
    const GltfImage& image = file_.images[static_cast<std::size_t>(source)];
    try {
      if (!image.fault.empty()) throw Error(ErrorKind::not_found, image.fault);
      scene_.pictures.push_back({image.name,
                                 decode_picture(image.data.bytes, image.name, colour, input_.picture_bytes),
                                 across, down});
    } catch (const Error& error) {
      warn(scene_, "picture '" + image.name + "' counts as white: " + error.what());
      return -1;
    }
    return static_cast<int>(scene_.pictures.size()) - 1;
  }

  const GltfFile& file_;
  const SceneInput& input_;
  Scene& scene_;
  std::map<std::tuple<int, io::Colour, Wrap, Wrap>, int> numbers_;
};

double element_of(const Value& object, const char* key, std::size_t i, double other) {
  if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsArray()) return other;
  const Value& list = object.Get(key);
  if (i >= list.ArrayLen() || !list.Get(static_cast<int>(i)).IsNumber()) return other;
  return list.Get(static_cast<int>(i)).GetNumberAsDouble();
}

/// One material on its way from the file.
class MaterialReader {
 public:
  MaterialReader(Pictures& pictures, Scene& scene) : pictures_(pictures), scene_(scene) {}

  Material read(const tinygltf::Material& from, std::string name) {
    material_ = {};
    material_.name = std::move(name);
    const auto& surface = from.pbrMetallicRoughness;
    if (surface.baseColorFactor.size() == 4) {
      for (std::size_t i = 0; i < 3; ++i)
        material_.base_color[i] = static_cast<float>(surface.baseColorFactor[i]);
      material_.alpha = static_cast<float>(surface.baseColorFactor[3]);
    }
    material_.metallic = static_cast<float>(surface.metallicFactor);
    material_.roughness = static_cast<float>(surface.roughnessFactor);
    material_.normal_scale = static_cast<float>(from.normalTexture.scale);
    material_.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    material_.masked = from.alphaMode == "MASK";
    material_.blended = from.alphaMode == "BLEND";
    material_.two_sided = from.doubleSided;
    if (from.emissiveFactor.size() == 3)
      for (std::size_t i = 0; i < 3; ++i) material_.emission[i] = static_cast<float>(from.emissiveFactor[i]);
    material_.base_map = use(surface.baseColorTexture, io::Colour::srgb);
    material_.metallic_roughness_map = use(surface.metallicRoughnessTexture, io::Colour::linear);
    material_.normal_map = use(from.normalTexture, io::Colour::linear);
    material_.emission_map = use(from.emissiveTexture, io::Colour::srgb);
    for (const auto& [extension, value] : from.extensions) read_extension(extension, value);
    if (from.extensions.contains("KHR_materials_unlit")) {
      // It gives off its base colour, and reflects nothing.
      material_.unlit = true;
      material_.emission = material_.base_color;
      material_.emission_map = material_.base_map;
      material_.base_color = {0, 0, 0};
      material_.metallic = 0;
      material_.ior = 1;
    }
    mend_material(scene_, material_);
    return std::move(material_);
  }

 private:
  template <class Info>
  PictureUse use(const Info& info, io::Colour colour) {
    const auto transform = info.extensions.find("KHR_texture_transform");
    return use(info.index, info.texCoord, transform == info.extensions.end() ? Value() : transform->second,
               colour);
  }

  /// A texture that an extension names.
  PictureUse use(const Value& extension, const char* key, io::Colour colour) {
    if (!extension.IsObject() || !extension.Has(key) || !extension.Get(key).IsObject()) return {};
    const Value& info = extension.Get(key);
    const Value extensions = info.Has("extensions") ? info.Get("extensions") : Value();
    const Value transform = extensions.IsObject() ? extensions.Get("KHR_texture_transform") : Value();
    return use(static_cast<int>(std::clamp(number_of(info, "index", -1), -1.0, 1e9)),
               static_cast<int>(std::clamp(number_of(info, "texCoord", 0), 0.0, 1e9)), transform, colour);
  }

  PictureUse use(int texture, int uv_set, const Value& transform, io::Colour colour) {
    PictureUse made;
    if (texture < 0) return made;
    made.uv_set = static_cast<int>(std::clamp(number_of(transform, "texCoord", uv_set), 0.0, 1e9));
    for (std::size_t i = 0; i < 2; ++i) {
      made.offset[i] = static_cast<float>(element_of(transform, "offset", i, 0));
      made.scale[i] = static_cast<float>(element_of(transform, "scale", i, 1));
    }
    made.angle = static_cast<float>(number_of(transform, "rotation", 0));
    if (made.uv_set > 1) {
      warn(scene_, "material '" + material_.name +
                       "' uses a third set of texture coordinates; its picture counts as white");
      return {};
    }
    made.picture = pictures_.number_of(texture, colour);
    return made;
  }

  void read_extension(const std::string& extension, const Value& value) {
    Material& m = material_;
    const auto number = [&](const char* key, double other) {
      return static_cast<float>(number_of(value, key, other));
    };
    if (extension == "KHR_materials_ior") {
      m.ior = number("ior", 1.5);
      if (m.ior == 0) {  // the extension's word for: reflects all
        m.ior = 1000;
        warn(scene_, "material '" + m.name + "' has the index of refraction 0, read as 1000");
      }
    } else if (extension == "KHR_materials_transmission") {
      m.transmission = number("transmissionFactor", 0);
      m.transmission_map = use(value, "transmissionTexture", io::Colour::linear);
    } else if (extension == "KHR_materials_clearcoat") {
      m.clearcoat = number("clearcoatFactor", 0);
      m.clearcoat_roughness = number("clearcoatRoughnessFactor", 0);
      m.clearcoat_map = use(value, "clearcoatTexture", io::Colour::linear);
      m.clearcoat_roughness_map = use(value, "clearcoatRoughnessTexture", io::Colour::linear);
      leave_out(value, "clearcoatNormalTexture");
    } else if (extension == "KHR_materials_sheen") {
      for (std::size_t i = 0; i < 3; ++i)
        m.sheen_color[i] = static_cast<float>(element_of(value, "sheenColorFactor", i, 0));
      m.sheen_roughness = number("sheenRoughnessFactor", 0);
      m.sheen_color_map = use(value, "sheenColorTexture", io::Colour::srgb);
      m.sheen_roughness_map = use(value, "sheenRoughnessTexture", io::Colour::linear);
    } else if (extension == "KHR_materials_anisotropy") {
      m.anisotropy = number("anisotropyStrength", 0);
      m.anisotropy_angle = number("anisotropyRotation", 0);
      m.anisotropy_map = use(value, "anisotropyTexture", io::Colour::linear);
    } else if (extension == "KHR_materials_emissive_strength") {
      const float strength = number("emissiveStrength", 1);
      for (float& emission : m.emission) emission *= strength;
    }
  }

  void leave_out(const Value& extension, const char* texture) {
    if (extension.IsObject() && extension.Has(texture))
      warn(scene_, std::string("textures of kind '") + texture + "' are not read");
  }

  Pictures& pictures_;
  Scene& scene_;
  Material material_;
};

}  // namespace

void read_gltf_materials(const GltfFile& file, const SceneInput& input, Scene& scene) {
  Pictures pictures(file, input, scene);
  MaterialReader reader(pictures, scene);
  for (std::size_t i = 0; i < file.model.materials.size(); ++i) {
    const tinygltf::Material& from = file.model.materials[i];
    scene.materials.push_back(
        reader.read(from, from.name.empty() ? "material " + std::to_string(i) : from.name));
  }
  scene.materials.push_back(reader.read(tinygltf::Material(), "default"));
}

}  // namespace welkin::scene
