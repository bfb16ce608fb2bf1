#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/light_encoding.h"
#include "welkin/io/texels/picture_set.h"

/// Faces of cubes that lie, upside down, as pictures of RGBD in other files: `.env`, and the lights of
/// `.glb`.
namespace welkin::io {

inline constexpr LightEncoding kRgbd{LightEncoding::Kind::rgbd};

/// The largest face.
inline constexpr int kLargestRgbdFace = 1 << 14;

/// What both formats hold: a cube with levels.
Capabilities rgbd_cube(std::string format, std::string title, std::string irradiance);

/// A PNG of R G B A of each of a cube's pictures: level by level, face by face.
std::vector<std::vector<std::byte>> rgbd_pngs(const texels::PictureSet& cube, WriteReport& report);

/// A PNG or WebP as RGBD; with `plain`, a picture without alpha, JPEG as well, as the light that it shows.
/// `name` is the face's, for messages.
void read_face(std::span<const std::byte> bytes, const std::string& name, const Source& file, bool plain,
               std::span<const int> channels, ImageView<float> out);

}  // namespace welkin::io
