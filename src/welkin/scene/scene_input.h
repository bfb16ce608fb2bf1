#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"
#include "welkin/scene/scene.h"

/// @file
/// What the readers of scenes share: the files beside a scene, pictures, limits, what is told.
namespace welkin::scene {

/// Bytes, and what keeps them.
struct HeldBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> holder;
};

/// Reads a file that a scene names, relative to the scene. Throws Error.
using OpenBeside = std::function<HeldBytes(const std::string& name)>;

/// Opens files in that folder and below; names with `..`, absolute ones and URLs are refused: Error
/// (unsupported).
OpenBeside files_in(const std::filesystem::path& folder);

/// A scene's bytes, and how to go on from there.
struct SceneInput {
  std::string name;                                      ///< for messages
  std::span<const std::byte> bytes;                      ///< the file
  OpenBeside open_beside;                                ///< what it names
  std::uint64_t picture_bytes = std::uint64_t{4} << 30;  ///< most that one decoded picture may need
};

/// The readers. They throw Error about `input.name`.
/// @{
Scene read_gltf(const SceneInput& input);
Scene read_obj(const SceneInput& input);
/// By the first bytes and the name.
Scene read_scene(const SceneInput& input);
/// @}

/// The error, now about the scene; one about a file beside it keeps that file's name.
Error about(const std::string& scene, const Error& error);

/// Adds a warning once.
void warn(Scene& scene, const std::string& text);

/// Decodes a picture: R G B, or R G B A with straight alpha; grey becomes R = G = B. Throws Error.
Image decode_picture(std::span<const std::byte> bytes, const std::string& name, io::Colour colour,
                     std::uint64_t max_bytes);

/// Vertices, triangles, instances that a scene may have in all.
constexpr std::uint64_t kMostElements = 200'000'000;
constexpr std::uint64_t kMostInstances = 10'000'000;

/// What mend_mesh mended, of all meshes.
struct Mended {
  std::uint64_t flat_triangles = 0;  ///< without area, dropped
  std::uint64_t normals = 0;         ///< rebuilt
  std::uint64_t tangents = 0;        ///< meshes whose own were unfit, and made again
  std::uint64_t coordinates = 0;     ///< texture coordinates that were not finite, now 0
  std::uint64_t colors = 0;          ///< colours that were negative or not finite, now 0
};

/// Drops triangles without area; makes normals unit, and those that can't be from the triangles around;
/// gives it tangents by a set of texture coordinates (−1: none), if it has none. Throws Error (bad_value) for
/// a vertex that is not finite.
void mend_mesh(Mesh& mesh, int tangent_set, Mended& mended);

/// Tells it.
void warn_of(Scene& scene, const Mended& mended);

/// Clamps a material's numbers to what Scene::check allows, and tells it.
void mend_material(Scene& scene, Material& material);

}  // namespace welkin::scene
