#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// What file formats hold.
namespace welkin::io {

/// How one value of a pixel is stored in the file. In memory every value is a 32-bit float.
/// `rgb9e5` and `r11g11b10` pack three values that are never negative into 32 bits: nine bits each with an
/// exponent in common, and small floats of 6, 6 and 5 bits of mantissa.
enum class PixelType {
  uint8,      ///< 0…255 for 0…1
  uint16,     ///< 0…65535 for 0…1
  uint32,     ///< in EXR whole numbers as they are, else 0…4294967295 for 0…1
  half,       ///< IEEE 754 binary16
  float32,    ///< IEEE 754 binary32
  rgb9e5,     ///< three of nine bits with a common exponent
  r11g11b10,  ///< three small floats without sign
  bc6h,       ///< compressed blocks of 4×4 texels of three halves, never negative
  uastc_hdr,  ///< the same of UASTC HDR 4×4, which is ASTC HDR and becomes BC6H quickly
  astc_hdr,   ///< the same of any ASTC HDR 4×4, with alpha; only read
};

/// Whether it holds three values that are never negative, and no alpha: `rgb9e5`, `r11g11b10`, `bc6h`,
/// `uastc-hdr`.
WELKIN_API bool is_packed(PixelType type);

/// The name in options: `uint8`, `uint16`, `uint32`, `half`, `float`, `rgb9e5`, `r11g11b10`, `bc6h`,
/// `uastc-hdr`, `astc-hdr`.
WELKIN_API std::string_view name_of(PixelType type);

/// The type of that name. Throws Error (bad_request) for another, which suggests the nearest.
WELKIN_API PixelType pixel_type_from_name(std::string_view name);

/// Which channels a picture of a format can have.
enum class Channels {
  rgb,         ///< Y or R G B
  rgba,        ///< either with A
  rg_or_rgba,  ///< the same, or R G alone
  any,         ///< any names, up to as many as a map can have
};

/// What a format holds, as Welkin writes it; of one that is only read, as Welkin reads it.
struct WELKIN_API Capabilities {
  std::string format;                     ///< `exr`
  std::string title;                      ///< as people write it: `EXR`, `WebP`
  std::vector<std::string> extensions;    ///< without dots, in small letters: `jpg`, `jpeg`
  std::vector<PixelType> types;           ///< the default first
  std::vector<std::string> compressions;  ///< names for WriteOptions::compression, the default first
  Channels channels = Channels::rgb;      ///< which channels a picture can have
  bool pictures = false;                  ///< several pictures in one file: parts, pages
  bool levels = false;                    ///< levels, each half as large as the one before
  bool texture = false;                   ///< faces and layers of a texture that GPUs sample
  bool lossless = true;                   ///< what is stored is what was given, rounded to the type
  bool hdr = false;                       ///< values over 1
  bool negative = false;                  ///< values below 0
  bool attributes = false;  ///< text metadata, with which a map's shape comes back when it is read
  /// The basis of the harmonics of diffuse light that stand beside the pictures (harmonics/bases.h); else
  /// empty.
  std::string irradiance = {};
  int longest_side = 1 << 20;  ///< of a picture, texels
  bool writable = true;        ///< false: the format is only read

  /// Whether `types` has this one.
  bool holds(PixelType type) const;
};

/// All formats that are read, in the order in which a file is tried; Capabilities::writable says which can be
/// written too.
WELKIN_API const std::vector<Capabilities>& all_capabilities();

/// Those of the format of that name. Throws Error (bad_request), which suggests the nearest.
WELKIN_API const Capabilities& capabilities(std::string_view format);

/// Those of the format that a file of this name is written in. Throws Error about the file: (bad_request)
/// when the extension is none that is known, (unsupported) when it is of a format that is only read.
WELKIN_API const Capabilities& capabilities_for(const std::filesystem::path& path);

/// Extensions that can be written, without dots: `exr hdr ktx2 pfm png jpg jpeg tif tiff webp`.
WELKIN_API std::vector<std::string> writable_extensions();

}  // namespace welkin::io
