#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/light_encoding.h"

/// Faces of cubes that lie, upside down, as pictures of RGBD in other files: `.env`, and the lights of
/// `.glb`.
namespace welkin::io {

inline constexpr LightEncoding kRgbd{LightEncoding::Kind::rgbd};

/// As a PNG of R G B A.
std::vector<std::byte> rgbd_png(const WritePart& part, WriteReport& report);

/// A PNG or WebP as RGBD; with `plain`, a picture without alpha, JPEG as well, as the light that it shows.
/// `name` is the face's, for messages.
void read_face(std::span<const std::byte> bytes, const std::string& name, const Source& file, bool plain,
               std::span<const int> channels, ImageView<float> out);

}  // namespace welkin::io
