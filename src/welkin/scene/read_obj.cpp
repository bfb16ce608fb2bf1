// Under a name of its own, so that programs can link the library and a tinyobjloader of theirs.
#define tinyobj welkin_tinyobj
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "welkin/base/error.h"
#include "welkin/io/colour/transfer.h"
#include "welkin/scene/scene_input.h"

namespace welkin::scene {
namespace {

std::string as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reads the libraries of materials that the file names, from beside it.
class Libraries final : public tinyobj::MaterialReader {
 public:
  Libraries(const SceneInput& input, Scene& scene) : input_(input), scene_(scene) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* numbers, std::string* warning, std::string* error) override {
    try {
      std::istringstream text(as_text(input_.open_beside(name).bytes));
      tinyobj::LoadMtl(numbers, materials, &text, warning, error);
      return true;
    } catch (const Error& fault) {
      warn(scene_, std::string("its materials count as white: ") + fault.what());
      return false;
    }
  }

 private:
  const SceneInput& input_;
  Scene& scene_;
};

class Materials {
 public:
  Materials(const SceneInput& input, Scene& scene) : input_(input), scene_(scene) {}

  Material made(const tinyobj::material_t& from) {
    Material m;
    m.name = from.name;
    float shine = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      m.base_color[i] = from.diffuse[i];
      m.emission[i] = from.emission[i];
      shine = std::max(shine, from.specular[i]);
    }
    m.alpha = from.dissolve;
    m.blended = from.dissolve < 1;
    m.metallic = from.metallic;
    m.clearcoat = from.clearcoat_thickness;
    m.clearcoat_roughness = from.clearcoat_roughness;
    m.anisotropy = from.anisotropy;
    m.anisotropy_angle = static_cast<float>(2 * kPi) * from.anisotropy_rotation;
    m.sheen_color = {from.sheen, from.sheen, from.sheen};
    // Without numbers of its own for roughness: the GGX lobe about as wide as Phong's of that exponent.
    const float exponent = std::max(from.shininess, 0.0f);
    m.roughness = from.roughness > 0 ? from.roughness : std::pow(2 / (exponent + 2), 0.25f);
    // What has no specular colour reflects nothing like glass does.
    const bool shines = shine > 0 || from.metallic > 0 || from.roughness > 0;
    m.ior = !shines ? 1 : from.ior > 1 ? from.ior : 1.5f;
    m.base_map = use(from.diffuse_texname, from.diffuse_texopt, io::Colour::srgb);
    m.emission_map = use(from.emissive_texname, from.emissive_texopt, io::Colour::srgb);
    m.normal_map = use(from.normal_texname, from.normal_texopt, io::Colour::linear);
    if (m.emission_map && m.emission == std::array<float, 3>{}) m.emission = {1, 1, 1};
    for (const auto& [name, kind] :
         {std::pair{&from.bump_texname, "heights (bump)"},
          std::pair{&from.displacement_texname, "displacement"},
          std::pair{&from.specular_texname, "specular colour"}, std::pair{&from.alpha_texname, "coverage"},
          std::pair{&from.roughness_texname, "roughness"}, std::pair{&from.metallic_texname, "metallic"},
          std::pair{&from.specular_highlight_texname, "exponents"}, std::pair{&from.sheen_texname, "sheen"}})
      if (!name->empty()) warn(scene_, std::string("pictures of ") + kind + " are not read from .mtl files");
    mend_material(scene_, m);
    return m;
  }

 private:
  PictureUse use(const std::string& name, const tinyobj::texture_option_t& options, io::Colour colour) {
    PictureUse made;
    if (name.empty()) return made;
    const Wrap wrap = options.clamp ? Wrap::clamp : Wrap::repeat;
    const auto key = std::tuple{name, colour, wrap};
    if (const auto known = numbers_.find(key); known != numbers_.end()) {
      made.picture = known->second;
    } else {
      made.picture = read(name, colour, wrap);
      numbers_[key] = made.picture;
    }
    // Their v runs up: v' = 1 − (o + s·(1 − v)).
    made.scale = {options.scale[0], options.scale[1]};
    made.offset = {options.origin_offset[0], 1 - options.origin_offset[1] - options.scale[1]};
    return made;
  }

  int read(const std::string& name, io::Colour colour, Wrap wrap) {
    try {
      const HeldBytes file = input_.open_beside(name);
      scene_.pictures.push_back(
          {name, decode_picture(file.bytes, name, colour, input_.picture_bytes), wrap, wrap});
      return static_cast<int>(scene_.pictures.size()) - 1;
    } catch (const Error& error) {
      warn(scene_, "picture '" + name + "' counts as white: " + error.what());
      return -1;
    }
  }

  const SceneInput& input_;
  Scene& scene_;
  std::map<std::tuple<std::string, io::Colour, Wrap>, int> numbers_;
};

/// Indices of a position, a normal, texture coordinates.
using Corner = std::array<int, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t h = 0;
    for (const int index : corner) {
      h = (h ^ static_cast<std::uint32_t>(index)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

/// The triangles of one shape and one material, their corners joined where all indices are the same.
class MeshBuilder {
 public:
  explicit MeshBuilder(const tinyobj::attrib_t& attributes) : attributes_(attributes) {}

  void add(const tinyobj::index_t (&corners)[3]) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex(corners[i]);
    mesh_.triangles.push_back(triangle);
  }

  /// Normals and coordinates that only some corners have are given up, and told.
  Mesh finish(Scene& scene) {
    if (has_normals_ && lacks_normals_)
      warn(scene, "mesh '" + mesh_.name + "' has normals in part; they are left out");
    if (!has_normals_ || lacks_normals_) mesh_.normals.clear();
    if (!has_uv_) mesh_.uv[0].clear();
    if (!has_colors_) mesh_.colors.clear();
    return std::move(mesh_);
  }

  Mesh& mesh() { return mesh_; }

 private:
  std::uint32_t vertex(const tinyobj::index_t& corner) {
    const Corner key{corner.vertex_index, corner.normal_index, corner.texcoord_index};
    const auto [at, is_new] = numbers_.emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!is_new) return at->second;
    const auto values = [](const std::vector<float>& all, int index, std::size_t each, const char* of) {
      if (index < 0 || (static_cast<std::size_t>(index) + 1) * each > all.size())
        throw Error(ErrorKind::damaged, "a face names " + std::string(of) + " " + std::to_string(index + 1) +
                                            ", which there isn't");
      return &all[static_cast<std::size_t>(index) * each];
    };
    const float* p = values(attributes_.vertices, corner.vertex_index, 3, "vertex");
    mesh_.positions.push_back({p[0], p[1], p[2]});
    Vec3<float> normal{0, 0, 0};
    if (corner.normal_index >= 0) {
      const float* n = values(attributes_.normals, corner.normal_index, 3, "normal");
      normal = {n[0], n[1], n[2]};
      has_normals_ = true;
    } else {
      lacks_normals_ = true;
    }
    mesh_.normals.push_back(normal);
    std::array<float, 2> uv{};
    if (corner.texcoord_index >= 0) {
      const float* t = values(attributes_.texcoords, corner.texcoord_index, 2, "texture coordinate");
      uv = {t[0], 1 - t[1]};
      has_uv_ = true;
    }
    mesh_.uv[0].push_back(uv);
    mesh_.colors.push_back(color_of(static_cast<std::size_t>(corner.vertex_index)));
    return at->second;
  }

  /// Programs that write them write sRGB; a vertex without one is white.
  std::array<float, 4> color_of(std::size_t vertex) {
    std::array<float, 4> color{1, 1, 1, 1};
    for (std::size_t c = 0; c < 3; ++c) {
      const float encoded = attributes_.colors.at(3 * vertex + c);
      color[c] = static_cast<float>(io::srgb_to_linear(std::clamp(encoded, 0.0f, 1.0f)));
      has_colors_ = has_colors_ || encoded != 1;
    }
    return color;
  }

  const tinyobj::attrib_t& attributes_;
  Mesh mesh_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> numbers_;
  bool has_normals_ = false, lacks_normals_ = false, has_uv_ = false, has_colors_ = false;
};

void add_shape(const tinyobj::shape_t& shape, const tinyobj::attrib_t& attributes, Mended& mended,
               Scene& scene) {
  const tinyobj::mesh_t& from = shape.mesh;
  const auto last = static_cast<int>(scene.materials.size()) - 1;
  std::map<int, MeshBuilder> builders;
  for (std::size_t face = 0; face < from.num_face_vertices.size() && 3 * face + 2 < from.indices.size();
       ++face) {
    if (from.num_face_vertices[face] != 3)
      throw Error(ErrorKind::damaged, "a face can't be made of triangles");
    int material = face < from.material_ids.size() ? from.material_ids[face] : -1;
    if (material < 0 || material >= last) material = last;
    const tinyobj::index_t corners[3] = {from.indices[3 * face], from.indices[3 * face + 1],
                                         from.indices[3 * face + 2]};
    builders.try_emplace(material, attributes).first->second.add(corners);
  }
  for (auto& [material, builder] : builders) {
    builder.mesh().name = shape.name.empty() ? "mesh" : shape.name;
    Mesh mesh = builder.finish(scene);
    mesh.material = material;
    const Material& stuff = scene.materials[static_cast<std::size_t>(material)];
    mend_mesh(mesh, stuff.normal_map || stuff.anisotropy > 0 ? 0 : -1, mended);
    if (mesh.triangles.empty()) continue;
    scene.instances.push_back({mesh.name, static_cast<int>(scene.meshes.size()), {}, -1});
    scene.meshes.push_back(std::move(mesh));
  }
}

/// Whether a word can begin a number as tinyobjloader reads it; it takes others for 0, in silence.
bool begins_number(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
}

/// Throws Error (bad_value) where a vertex, normal or coordinate has a word that is no finite number.
void check_numbers(std::string_view text) {
  std::size_t number = 0;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    ++number;
    std::size_t at = std::min(line.find_first_not_of(" \t"), line.size());
    if (at == line.size() || line[at] != 'v') continue;
    at = line.find_first_of(" \t", at);
    while (at != std::string_view::npos) {
      at = line.find_first_not_of(" \t\r", at);
      if (at == std::string_view::npos || line[at] == '#') break;
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      std::size_t digits = at;
      while (digits < end && (line[digits] == '+' || line[digits] == '-')) ++digits;
      if (!begins_number(line[at]) || (digits < end && !begins_number(line[digits])))
        throw Error(ErrorKind::bad_value,
                    "line " + std::to_string(number) + ": '" +
                        std::string(line.substr(at, std::min<std::size_t>(end - at, 40))) +
                        "' is not a finite number");
      at = line.find_first_of(" \t", at);
    }
  }
}

}  // namespace

Scene read_obj(const SceneInput& input) {
  Scene scene;
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  Libraries libraries(input, scene);
  const std::string content = as_text(input.bytes);
  check_numbers(content);
  std::istringstream text(content);
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &text, &libraries, true, true))
    throw Error(ErrorKind::damaged, "is no valid OBJ: " + error.substr(0, error.find('\n')));
  Materials reader(input, scene);
  for (const tinyobj::material_t& material : materials) scene.materials.push_back(reader.made(material));
  scene.materials.emplace_back().name = "default";
  Mended mended;
  for (const tinyobj::shape_t& shape : shapes) add_shape(shape, attributes, mended, scene);
  warn_of(scene, mended);
  return scene;
}

}  // namespace welkin::scene
