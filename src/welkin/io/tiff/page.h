#pragma once

#include <tiffio.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/tiff/samples.h"

namespace welkin::io {

/// How the samples of a TIFF directory become values.
enum class TiffDecoding {
  samples,  ///< as PartInfo::type says
  unpack,   ///< to floats, by unpack_tiff_samples
  xyz,      ///< LogLuv, which libtiff decodes to CIE XYZ floats
  rgba      ///< libtiff's own conversion to 8-bit RGBA
};

/// One directory of a TIFF, parsed.
struct TiffPage {
  PartInfo part;
  TiffDecoding decoding = TiffDecoding::samples;
  std::uint64_t directory = 0;  ///< byte offset
  TiffSamples samples;          ///< as they are stored
  int stored_samples = 0;       ///< per pixel, before any conversion
  bool planar = false;
  bool inverted = false;  ///< 0 is white, of the first sample
  bool tiled = false;
  int block_width = 0;  ///< of a strip or a tile
  int block_height = 0;
  std::map<std::string, std::string> attributes;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  Declared declared;  ///< but for its alpha
  std::optional<Panorama> panorama;
  /// Of the channel A: whether colours are multiplied by it; nothing where there is none.
  std::optional<bool> associated;
};

/// Parses libtiff's current directory and sets what libtiff must convert while decoding (LogLuv, JPEG).
/// Throws Error naming the file when the directory is of a kind that cannot be read, or implausible for the
/// file's length.
TiffPage understand_tiff_page(TIFF* tiff, const Source& source);

/// Makes libtiff convert LogLuv and JPEG to floats and RGB. Needed again whenever the directory is entered.
void choose_tiff_conversions(TIFF* tiff);

}  // namespace welkin::io
