#pragma once

#include <map>
#include <string>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/rgbd_face.h"

/// The image-based light of a glTF file in its binary form, `.glb`: the extension EXT_lights_image_based.
///
/// Source: Khronos Group, glTF 2.0 specification, 4.4 "Binary glTF layout"; KhronosGroup/glTF,
/// extensions/2.0/Vendor/EXT_lights_image_based.
namespace welkin::io::glb {

inline constexpr char kExtension[] = "EXT_lights_image_based";

/// Whether the bytes begin a binary glTF file.
bool matches(std::span<const std::byte> bytes);

struct Light {
  int width = 0;                                   ///< of the faces of level 0, a power of two
  std::vector<std::span<const std::byte>> images;  ///< level by level, face by face
  double rotation[4] = {0, 0, 0, 1};               ///< quaternion x, y, z, w
  double intensity = 1;                            ///< which multiplies all
  std::map<std::string, std::string> attributes;   ///< of ours; empty in files of other programs
  std::size_t lights = 1;                          ///< how many the file has
};

/// The light of the scene that the file shows, else its first. Checks all against the file's length before
/// anything is allocated by it. Throws Error about the file: (unsupported) without such a light, or whose
/// images lie elsewhere.
Light parse_light(const Source& source);

/// A file of a scene that holds nothing but a light. `irradiance`: 9 × R G B.
std::vector<std::byte> file_of(int width, const std::vector<std::vector<std::byte>>& images,
                               const std::vector<double>& irradiance,
                               const std::map<std::string, std::string>& attributes);

}  // namespace welkin::io::glb
