#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// What streams of frames are: the uncompressed ones that programs pass each other through pipes.
namespace welkin::video {

/// How frames follow each other.
enum class StreamKind {
  y4m,  ///< YUV4MPEG2: one header, then planes of Y′CbCr
  ppm,  ///< portable pixmaps, one after another: R′G′B′, binary (P6), and grey (P5)
  pfm,  ///< portable float maps, one after another: linear, 32-bit floats
};

/// `y4m`, `ppm`, `pfm`. Throws Error (bad_request) for another, which suggests the nearest.
WELKIN_API StreamKind stream_kind_from_name(std::string_view name);
/// The name that stream_kind_from_name takes.
WELKIN_API std::string_view name_of(StreamKind kind);
/// All of them.
WELKIN_API const std::vector<std::string>& stream_kind_names();

/// Where a y4m's chroma samples lie.
enum class Chroma {
  c420jpeg,   ///< half as many each way, amid four of luma
  c420mpeg2,  ///< half as many each way, above and below amid two of luma in a column
  c420paldv,  ///< half as many each way, on one of luma
  c422,       ///< half as many in a row, on every second of luma
  c444,       ///< as many
  mono,       ///< none
};

/// How R′G′B′ and Y′CbCr are related, which a y4m doesn't say.
enum class YuvMatrix {
  bt601,   ///< ITU-R BT.601: what ffmpeg takes where nothing is said
  bt709,   ///< ITU-R BT.709: of high definition
  bt2020,  ///< ITU-R BT.2020, non-constant luminance
};

/// `bt601`, `bt709`, `bt2020`. Throws Error (bad_request) for another.
WELKIN_API YuvMatrix yuv_matrix_from_name(std::string_view name);
/// All of them.
WELKIN_API const std::vector<std::string>& yuv_matrix_names();

/// What a stream's first header says.
struct StreamInfo {
  StreamKind kind = StreamKind::y4m;  ///< how frames follow each other
  int width = 0;                      ///< of every frame
  int height = 0;                     ///< of every frame
  int channels = 3;                   ///< 1: grey
  int bits = 8;                       ///< of a stored value: 8 … 16, of PFM 32
  int largest = 255;                  ///< of PPM, the value of white
  int rate_numerator = 0;             ///< frames a second; 0: not said
  int rate_denominator = 1;           ///< of the rate
  int aspect_numerator = 0;           ///< of a pixel, width to height; 0: not said
  int aspect_denominator = 0;         ///< of the aspect
  Chroma chroma = Chroma::c420jpeg;   ///< of y4m
  bool full_range = false;            ///< of y4m: 0 … 255 is black to white, not 16 … 235
};

/// Values of a frame that lie together, as they are stored.
struct StoredPlane {
  std::size_t offset = 0;  ///< of the first byte, among a frame's
  int width = 0;           ///< pixels in a row
  int height = 0;          ///< rows
  int channels = 1;        ///< values of a pixel
};

/// Of a frame: Y′, Cb and Cr of a y4m, else all in one. PFM has its rows upside down.
WELKIN_API std::vector<StoredPlane> stored_planes(const StreamInfo& info);

/// How a stream's numbers are colours.
struct StreamColour {
  YuvMatrix matrix = YuvMatrix::bt601;  ///< of y4m
  bool linear = false;                  ///< stored values are linear; else sRGB's encoding, but of PFM
};

}  // namespace welkin::video
