#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Under a name of its own, so that programs can link the library and a tinygltf of theirs. The JSON library
// is included by gltf_file.cpp alone.
#define tinygltf welkin_tinygltf
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include "welkin/scene/scene_input.h"

/// @file
/// glTF's parts. What the library tinygltf gives is its JSON as structs; bytes and pictures are ours.
namespace welkin::scene {

/// A picture of the file, not decoded.
struct GltfImage {
  std::string name;
  HeldBytes data;
  std::string fault;  ///< why it can't be had; empty
};

/// The file, and the bytes that it refers to.
struct GltfFile {
  tinygltf::Model model;           ///< without buffers and images
  std::vector<HeldBytes> buffers;  ///< each of the length that it declares
  std::vector<GltfImage> images;   ///< as many as the file has
};

/// Parses .gltf and .glb. Throws Error (damaged, unsupported, too_large) without the file's name, and what
/// open_beside throws for buffers.
GltfFile open_gltf(const SceneInput& input);

/// The bytes of a buffer view, and the stride that it sets, or 0.
struct GltfView {
  std::span<const std::byte> bytes;
  std::size_t stride;
};
/// Throws Error (damaged) for one that isn't, or that leaves its buffer.
GltfView view_of(const GltfFile& file, int index);

/// An accessor's values as floats, `components` each, integers divided by their largest where it says so.
/// Throws Error (damaged, too_large).
std::vector<float> read_floats(const GltfFile& file, int accessor, int components, const std::string& what);
/// An accessor of single whole numbers. Throws Error (damaged, too_large).
std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor, const std::string& what);

/// Reads materials into the scene, with the pictures that they wear, and one at the end for what has none.
void read_gltf_materials(const GltfFile& file, const SceneInput& input, Scene& scene);

/// Scene::meshes for each primitive of each mesh of the file.
using GltfMeshes = std::vector<std::vector<int>>;
/// Reads meshes into the scene; those without triangles are left out.
GltfMeshes read_gltf_meshes(const GltfFile& file, Scene& scene);

/// Reads nodes: instances, cameras, lights.
void read_gltf_nodes(const GltfFile& file, const GltfMeshes& meshes, Scene& scene);

/// A number of an extension; `other` where it isn't there or is none.
double number_of(const tinygltf::Value& object, const char* key, double other);

}  // namespace welkin::scene
