#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/io/byte_sink.h"
#include "welkin/io/capabilities.h"
#include "welkin/io/light_encoding.h"
#include "welkin/texture/texture_quality.h"

/// @file
/// Bytes ↔ images. This room knows files and pixels; what a picture means on the sphere is decided in
/// map_file/.
namespace welkin::io {

/// The transfer function of stored colour values. Linear is radiance; sRGB is IEC 61966-2-1, made linear on
/// reading. Alpha is always linear. Others (PQ, HLG, powers, ICC profiles) are undone where a file declares
/// them.
enum class Colour {
  automatic,  ///< by the format: see ReadOptions and WriteOptions
  linear,     ///< stored values are proportional to radiance
  srgb,       ///< stored values are sRGB-encoded
};

/// One picture of a file: the only one in most formats, one of many in a multi-part EXR, a multi-page TIFF,
/// or a texture with levels. Pictures of a texture come level by level, then layer by layer, then face by
/// face.
struct PartInfo {
  std::string name;  ///< EXR part name; empty where the format has none
  int width = 0;     ///< texels
  int height = 0;    ///< rows
  /// Names, in the order that reading them all gives: R G B A first, then others.
  std::vector<std::string> channels;
  PixelType type = PixelType::float32;  ///< that holds all channels' values
  std::string compression;              ///< `none`, `zip`, `rle`, `deflate`, `jpeg`…
  int level = 0;                        ///< of a mip pyramid; 0 is the finest
  int layer = 0;                        ///< of an array texture
  int face = 0;                         ///< of a cube texture: +X −X +Y −Y +Z −Z
  bool deep = false;                    ///< EXR's deep data, which cannot be read
  /// EXR's views: the one that the part is of, or those whose names are in the channels' names, the first of
  /// them as channels without one.
  std::vector<std::string> views = {};
  std::optional<std::string> envmap = {};  ///< as in FileInfo, where parts can differ in it
  std::vector<std::string> warnings = {};  ///< as in FileInfo, of this picture alone
};

/// How the pictures of two eyes lie in one picture. As Google and YouTube have it, the left eye's is on top,
/// or on the left.
enum class Stereo {
  not_said,    ///< nothing is known
  mono,        ///< one picture, for both eyes
  top_bottom,  ///< the left eye's above the right eye's
  left_right,  ///< the left eye's to the left of the right eye's
};

/// What metadata, such as XMP's GPano, says of a panorama: the part of a full one that the picture shows, and
/// how the camera stood. map_file/ makes a parameterization and an orientation of it (docs/conventions.md).
struct Panorama {
  /// `equirectangular`, `cylindrical`, another program's word; empty: not said.
  std::string projection;
  int full_width = 0;   ///< of the full panorama, 360° around, texels; 0: not said
  int full_height = 0;  ///< of the full panorama, from pole to pole, texels; 0: not said
  int crop_width = 0;   ///< of the part of it that the picture shows, in its texels; 0: not said
  int crop_height = 0;  ///< of the part of it that the picture shows, in its texels; 0: not said
  int crop_left = 0;    ///< that part's left edge in the full panorama, texels
  /// That part's top edge in the full panorama, texels: below the top, or of a cylinder below the horizon and
  /// negative above it.
  int crop_top = 0;
  double heading = 0;  ///< where the full panorama's centre looks: degrees clockwise from north
  double pitch = 0;    ///< and how far above the horizon, degrees
  double roll = 0;     ///< degrees; as it grows, the horizon turns counterclockwise in the picture
  Stereo stereo = Stereo::not_said;  ///< whether the picture holds two
  /// All of it.
  bool operator==(const Panorama&) const = default;
};

/// What a file says of itself, known before any pixel is decoded.
struct FileInfo {
  std::string format;              ///< `exr`, `hdr`… as Capabilities::format
  std::vector<PartInfo> parts;     ///< its pictures, at least one
  int levels = 1;                  ///< of a mip pyramid
  int layers = 0;                  ///< of an array texture; 0 when it is none
  int faces = 1;                   ///< 6 of a cube texture
  Colour colour = Colour::linear;  ///< the transfer function that reading will undo
  /// Text metadata: EXR string attributes, PNG tEXt, .hdr header lines…
  std::map<std::string, std::string> attributes;
  std::optional<std::string> envmap;  ///< EXR's standard `envmap` attribute: `latlong` or `cube`; of the
                                      ///< first part that has one
  std::optional<Panorama> panorama;   ///< what it says of the panorama that it shows
  std::vector<std::string> notes;     ///< what a person would like to know: tiles, interlacing…
  /// What reading changes, guesses or leaves undone, so that the picture may not be the one that is meant.
  /// Commands print these on stderr.
  std::vector<std::string> warnings;
  std::uint64_t bytes = 0;  ///< of the file
};

/// How a file is read.
struct ReadOptions {
  /// The transfer function of stored values. `automatic`: what the file declares, by its format, its code
  /// points or its ICC profile, else sRGB for integers of 8 and 16 bits, linear for all others.
  Colour colour = Colour::automatic;
  /// Colours stay those of the primaries that the file declares; otherwise they are converted to BT.709's.
  bool keep_primaries = false;
  /// Images whose decoded floats would need more bytes are refused: Error (too_large).
  std::uint64_t max_bytes = std::uint64_t{32} << 30;
  /// How radiance lies in the file's R G B A of 8 bits; none: as its text metadata say, in files of ours,
  /// else not at all. Error (mismatch) for other pictures.
  std::optional<LightEncoding> encoding = {};
};

/// An open image file. Headers are parsed and checked (against ReadOptions::max_bytes and against the file's
/// own length where the format allows) when it is opened; pixels are decoded by `read`.
///
/// Failures throw Error about the file, (damaged, unsupported, too_large…), with the byte offset or the row
/// where it helps. One thread at a time for each reader.
class WELKIN_API Reader {
 public:
  virtual ~Reader();

  /// What the file says of itself; valid as long as the reader.
  const FileInfo& info() const { return info_; }

  /// Decodes the part's channels numbered `channels` (indices into PartInfo::channels, one per channel of
  /// `out`) into `out`, which has the part's width and height and any row stride. Pictures stand upright.
  /// Colour is linear afterwards, and multiplied by alpha where that is read too (associated, as EXR's); what
  /// a format stores straight is as it is where alpha isn't read. Non-finite and negative values are kept.
  /// EXR data windows are placed inside the display window; texels outside it are 0. Uses the calling thread
  /// and TBB's workers. Throws also Error (bad_request) for a part or a channel that there isn't, and for
  /// another size.
  void read(std::size_t part, std::span<const int> channels, ImageView<float> out);

 protected:
  /// What read does, its arguments checked. For formats.
  virtual void decode(std::size_t part, std::span<const int> channels, ImageView<float> out) = 0;

  FileInfo info_;  ///< filled by the format when it opens
};

/// Opens a file, its format known by its first bytes, never by its name. It may be a pipe. Throws Error about
/// the file: (not_found, denied, system), (unsupported) for bytes of no known format, and what Reader says.
WELKIN_API std::unique_ptr<Reader> open(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same from memory, which must outlive the reader; `name` stands for the path in messages.
WELKIN_API std::unique_ptr<Reader> open(std::span<const std::byte> bytes, std::string name,
                                        const ReadOptions& options = {});

/// A picture to be written. `image` is a view: its pixels must last until they are written.
struct WritePart {
  std::string name;                   ///< EXR part name; may be empty for a single part
  ImageView<const float> image;       ///< linear values
  std::vector<std::string> channels;  ///< the name of each of the image's: `R G B`, `R G B A`, `Y`…
  int level = 0;                      ///< as in PartInfo, in formats of textures
  int layer = 0;                      ///< as in PartInfo
  int face = 0;                       ///< as in PartInfo
  /// Where this is set, the picture needn't lie in memory: `image` gives its size alone, without data, and
  /// `draw(y, rows)` fills all texels of `rows`, which are those of the picture from row y on. Called for
  /// rows in any order, again for some, and from several threads at once.
  std::function<void(int y, ImageView<float> rows)> draw = nullptr;
  int rows_at_once = 1;  ///< `draw` is fastest for so many rows, from a multiple of them on; a hint
};

/// How a file is written.
struct WriteOptions {
  /// Default: the format's best, float for EXR, PFM and TIFF, uint16 for PNG….
  std::optional<PixelType> type = {};
  Colour colour = Colour::automatic;  ///< automatic: sRGB into integer formats, linear into float ones
  /// Empty: the format's default; else one of Capabilities::compressions: `none`, `zip`, `piz`, `dwaa`….
  std::string compression = {};
  int quality = 95;                                         ///< of lossy formats, 1…100
  TextureQuality texture_quality = TextureQuality::normal;  ///< of compressed textures
  std::map<std::string, std::string> attributes = {};       ///< text metadata, in formats that carry it
  std::optional<std::string> envmap = {};                   ///< EXR's standard `envmap` attribute
  std::optional<Panorama> panorama = {};                    ///< XMP's GPano, in formats that carry XMP
  /// How radiance is laid into R G B A of 8 bits: PNG of R G B alone.
  std::optional<LightEncoding> encoding = {};
  /// Of formats with Capabilities::irradiance: the diffuse light in that basis, of each coefficient R, G and
  /// B, in the coordinates of the cube's look-up; 27 numbers, or none (harmonics/file_irradiance.h).
  std::vector<double> irradiance = {};
};

/// What writing lost, for the caller to report.
struct WELKIN_API WriteReport {
  std::uint64_t above = 0;       ///< values over the format's largest, clipped
  std::uint64_t below = 0;       ///< negative values in a format that has none, clipped to 0
  std::uint64_t not_finite = 0;  ///< NaN or infinity in a format that has neither
  double squares = 0;            ///< of a LightEncoding: the sum of all values' squares
  double error_squares = 0;      ///< and of their errors'

  /// Of a LightEncoding: the root mean square of the errors over that of the values; 0 of other files.
  double relative_rmse() const;
};

/// What both lost.
WELKIN_API WriteReport operator+(const WriteReport& a, const WriteReport& b);

/// Writes pictures to a file: to a temporary one beside `path`, then renamed, so that on any failure nothing
/// is left and an older file of that name stays. The format follows the name's extension. More than one part:
/// EXR, KTX2 and TIFF only. Values that the format can't hold are clipped and counted in the report. Throws
/// Error about the file: (bad_request, unsupported, too_large) for what the format doesn't hold, (not_found,
/// denied, system) for folders and disks.
WELKIN_API WriteReport write(const std::filesystem::path& path, std::span<const WritePart> parts,
                             const WriteOptions& options = {});

/// A file of a set.
struct WriteFile {
  std::filesystem::path path;    ///< its extension chooses the format
  std::vector<WritePart> parts;  ///< as in `write`
};

/// The same for files that belong together, as the faces of a cube: they appear only when all are written.
/// They are then renamed one after the other: should the system refuse one, those before it have appeared.
/// `next(i)` gives each of `count` files when its turn comes; what it refers to may be gone at the next call.
WELKIN_API WriteReport write_set(std::size_t count, const std::function<WriteFile(std::size_t)>& next,
                                 const WriteOptions& options = {});

/// The same into a sink, in the format of that name (Capabilities::format). On failure the sink holds part of
/// a file.
WELKIN_API WriteReport write(ByteSink& sink, std::string_view format, std::span<const WritePart> parts,
                             const WriteOptions& options = {});

/// Throws what `write` would throw for a picture of this size and these channels, before there is one: Error
/// (unsupported, bad_request, too_large) about the file for what its format can't hold, or (denied,
/// not_found…) for a folder that doesn't take it. Nothing is left behind.
WELKIN_API void check_write(const std::filesystem::path& path, int width, int height,
                            const std::vector<std::string>& channels, const WriteOptions& options = {});

}  // namespace welkin::io
