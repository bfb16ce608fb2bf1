#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/rgbd_face.h"

/// The text at the beginning of a Babylon.js environment, `.env`: JSON, ended by a zero byte.
namespace welkin::io::env {

inline constexpr unsigned char kMagic[8] = {0x86, 0x16, 0x87, 0x96, 0xf6, 0xd6, 0x96, 0x36};

/// Longer manifests are none: of the largest faces it is some 10 KB.
inline constexpr std::size_t kLongestManifest = 1 << 20;

/// Where an image lies, from the first byte of the file.
struct Extent {
  std::uint64_t begin = 0, size = 0;
};

struct Manifest {
  int width = 0;                                  ///< of a face, a power of two
  int levels = 0;                                 ///< down to one texel
  double lod_scale = 0.8;                         ///< lodGenerationScale
  std::vector<Extent> images;                     ///< level by level, face by face
  std::map<std::string, std::string> attributes;  ///< of ours; empty in files of other programs
  bool irradiance = false;                        ///< whether there is a polynomial
};

/// Checks everything against the file's length before anything is allocated by it. Throws Error about the
/// file.
Manifest parse_manifest(const Source& source);

/// What stands before the images of so many bytes each. `irradiance` as in WriteOptions.
std::string manifest_text(int width, const std::vector<std::uint64_t>& image_bytes,
                          const std::vector<double>& irradiance,
                          const std::map<std::string, std::string>& attributes);

}  // namespace welkin::io::env
