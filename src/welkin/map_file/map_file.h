#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/io/image_file.h"
#include "welkin/map/chain.h"
#include "welkin/map/map.h"
#include "welkin/map_file/layout.h"

/// @file
/// Image files ↔ maps: which parameterization a picture has, and where its charts lie in it.
namespace welkin {
namespace map_file {
struct FaceNames;
}

/// Of a picture that holds those of two eyes, the one that is read.
enum class Eye {
  left,   ///< the viewer's left one
  right,  ///< the other
};

/// How a map's file is read.
struct ReadMapOptions {
  /// `NAME[:LAYOUT][,PARAMETER=VALUE]…`; without it, what the file declares, else a guess.
  std::optional<std::string> shape = {};
  std::string faces = {};  ///< see with_faces; empty for the layout's own order
  /// Which channels become the map's: names of the file. Empty: R G B (A) by the ends of their names, in
  /// whichever part and layer they are; or Y (A); or X Y Z; or the first three.
  std::vector<std::string> channels = {};
  /// The layer to read: what stands before the last dot in its channels' names, or components of that; or the
  /// name of a part, or of a view. Empty: plain names, or the layer whose name says that it is the finished
  /// picture, or the first.
  std::string layer = {};
  /// How the file's directions relate to the native world (convention.h), orthonormal; without it, what the
  /// file declares, else native.
  std::optional<Matrix3> orientation = {};
  /// Of two eyes' pictures, the one that is read; without it the left one, with a warning.
  std::optional<Eye> eye = {};
  /// How two eyes' pictures lie in the file's; not_said: what the file declares, else what the aspect
  /// suggests where an eye is asked for, else one picture.
  io::Stereo stereo = io::Stereo::not_said;
  /// Whether a cube whose file doesn't say how its faces lie is read another way when they don't join, which
  /// costs a reading of its pixels when it is opened. Told as a warning.
  bool join_faces = true;
  int border = 0;  ///< texels of safety border around every chart in the file, besides what the file declares
  /// Of a file with several pictures; where these are the charts, of several sets. None: the first that has
  /// the channels to read.
  std::optional<std::size_t> part = {};
  int level = 0;               ///< of a file with levels; 0 is the finest
  io::ReadOptions image = {};  ///< transfer function, limit of memory
};

/// Channels of one picture that have the same name before the last dot: `diffuse.R`, `diffuse.G`…
struct MapLayer {
  std::size_t picture = 0;            ///< index into FileInfo::parts
  std::string name;                   ///< `diffuse`; empty for channels without a dot
  std::vector<std::string> channels;  ///< as the file calls them
};

/// What is known of a map's file before its pixels are read.
struct MapFileInfo {
  io::FileInfo image;                 ///< of the first file where there are several
  std::size_t picture = 0;            ///< of image.parts, the one to read at level 0, or the first of several
  std::vector<std::string> channels;  ///< of that picture, those to read, as the file calls them
  std::vector<MapLayer> layers;       ///< of all parts at level 0
  std::optional<MapShape> shape;      ///< none when nothing declares it and the size suggests nothing
  std::string reason;                 ///< why this shape: `declared by the file`, `guessed from 2:1`…
  ChartSize chart;                    ///< of the level that is read; meaningful when there is a shape
  std::vector<ChartSize> levels;      ///< charts of every level; one entry for a file without levels, none
                                      ///< without a shape
  ChainNotes notes;                   ///< what the file says of its levels
  io::Stereo stereo = io::Stereo::mono;  ///< how two eyes' pictures lie in the file's, or that there is one
  Eye eye = Eye::left;                   ///< the one that is read, where there are two
  int border = 0;                        ///< safety border around every chart in the file, texels
  Matrix3 orientation;                   ///< that the map will have
};

/// What a MapReader finds of one picture that says nothing of itself, such as a stream's frames, without its
/// pixels; how the faces of a cube join isn't looked at. `name` stands for the path in messages. Throws Error
/// (bad_request): a side below 1, no channels; else as MapReader does.
WELKIN_API MapFileInfo inspect_picture(ChartSize size, const std::vector<std::string>& channels,
                                       const std::string& name, const ReadMapOptions& options = {});

/// A map's file, opened once: it may be a pipe. `path` contains `%s` when the charts are in files of their
/// own, unless a file is called so; the first of these is opened, the others when they are read. The `%s`
/// stands for `px`, `nx`…, or what other tools call the faces of a cube; or for the charts' numbers. Members
/// throw Error: (not_found, denied, damaged, unsupported, too_large…) files that can't be read, (bad_request)
/// shapes and levels that don't exist, (mismatch) sizes that don't fit the shape. One thread at a time for
/// each reader.
class WELKIN_API MapReader {
 public:
  /// Opens the file and finds its shape; no pixel is decoded.
  explicit MapReader(const std::filesystem::path& path, const ReadMapOptions& options = {});
  /// From memory, which must outlive the reader; `name` stands for the path in messages.
  MapReader(std::span<const std::byte> bytes, const std::string& name, const ReadMapOptions& options = {});

  /// What is known of the file; valid as long as the reader, and follows what is set.
  const MapFileInfo& info() const { return info_; }

  /// The shape. Throws Error (bad_request) where there is none: give it as ReadMapOptions::shape.
  const MapShape& shape() const;

  /// Changes ReadMapOptions::faces, now that the shape is known.
  void set_faces(std::string faces);
  /// Changes ReadMapOptions::orientation.
  void set_orientation(const Matrix3& orientation);
  /// Changes ReadMapOptions::level.
  void set_level(int level);
  /// Changes ReadMapOptions::part.
  void set_part(std::size_t part);
  /// Reads a cube whose file doesn't say how its faces lie, and adds a warning where they don't join as they
  /// are read now. Changes nothing else.
  void check_faces();

  /// The map, its borders filled. Throws also when the shape is unknown. A picture of one chart is decoded
  /// straight into the map; of several, the picture is in memory besides the map while this lasts.
  Map read();
  /// The map of this level, whatever level the reader is set to. Throws Error (bad_request) where there is
  /// none.
  Map read(int level);

 private:
  /// What the file holds, read in this way.
  MapFileInfo inspected(const ReadMapOptions& options) const;
  /// What `%s` stands for.
  std::vector<std::string> file_names() const;
  void inspect_with(ReadMapOptions options);
  void join_faces();

  std::filesystem::path path_;
  ReadMapOptions options_;
  const map_file::FaceNames* face_names_ = nullptr;  ///< of the files of a cube's faces, where there are six
  std::unique_ptr<io::Reader> reader_;
  MapFileInfo info_;
  std::vector<std::string> joining_;  ///< what there is to tell of how faces join
};

/// A map, and the file that it came from.
struct LoadedMap {
  Map map;           ///< its borders filled
  MapFileInfo info;  ///< what the file said
};

/// Opens and reads. Throws as MapReader does.
WELKIN_API LoadedMap read_map(const std::filesystem::path& path, const ReadMapOptions& options = {});
/// The same from memory; `name` stands for the path in messages.
WELKIN_API LoadedMap read_map(std::span<const std::byte> bytes, const std::string& name,
                              const ReadMapOptions& options = {});

/// Whether a file of this name can hold levels: EXR and KTX2 can.
WELKIN_API bool holds_levels(const std::filesystem::path& path);

/// The layout that a file of this format gets when none is named: charts are faces or layers in a texture;
/// cubes are strips in a picture with levels, whose halves are then pictures of halved faces; else it is the
/// first of layouts_of.
WELKIN_API Layout default_layout(const sphere::AnyParameterization& parameterization,
                                 const io::Capabilities& format, int levels = 1);
/// The same for the format of a file of this name.
WELKIN_API Layout default_layout(const sphere::AnyParameterization& parameterization,
                                 const std::filesystem::path& path, int levels = 1);

/// parse_map_shape for a file to write: without a layout in the text, the default_layout.
WELKIN_API MapShape parse_map_shape_for(const std::filesystem::path& path, std::string_view text,
                                        int levels = 1);

/// For a map that goes from its file to another with its shape, which must be known: the layout stays too,
/// but is the default_layout where one of the files is a texture and the other isn't.
WELKIN_API MapShape shape_for_copy(const MapFileInfo& from, const std::filesystem::path& to, int levels = 1);

/// For a file to write: throws Error, naming the path, when it has a `%s` and the layout is of one file, or
/// the other way round. Any other `%` is a letter like others.
WELKIN_API void check_face_pattern(const std::filesystem::path& path, const Layout& layout);

/// The files that a map is written to: one, or one for each chart where `path` has a `%s`.
WELKIN_API std::vector<std::filesystem::path> files_of(const std::filesystem::path& path,
                                                       const sphere::AnyParameterization& parameterization);

/// How a map is written.
struct WriteMapOptions {
  io::WriteOptions image = {};  ///< type, compression, quality, metadata
  std::string faces = {};       ///< see with_faces
  std::string convention = {};  ///< name of the one that the map's orientation is of, to be noted in the file
  int border = 0;  ///< texels of safety border to write around every chart (safety_border.h); the map's
                   ///< borders must be filled
};

/// Writes the charts in the layout. The parameterization, layout, faces and orientation go into the file's
/// text metadata where the format has any, and reading it restores them. Cells that no chart fills are 0.
/// In a KTX2, `layers` of a cube are the faces of a cube texture, and of others the layers of an array.
WELKIN_API io::WriteReport write_map(const std::filesystem::path& path, const Map& map, const Layout& layout,
                                     const WriteMapOptions& options = {});
/// The same in the default_layout.
WELKIN_API io::WriteReport write_map(const std::filesystem::path& path, const Map& map,
                                     const WriteMapOptions& options = {});
/// The same into a sink, in the format of that name: `exr`, `hdr`, `png`…
WELKIN_API io::WriteReport write_map(io::ByteSink& sink, std::string_view format, const Map& map,
                                     const WriteMapOptions& options = {});

/// Makes the map's channels those that a file of this name takes. Where the format has no alpha, A is
/// dropped; the colours stay as they are in memory, multiplied by it. Where it has no other names, one
/// channel becomes Y, three R G B, four R G B A. Returns what was done, in words. Throws Error (unsupported)
/// about the file for channels that fit in no way.
WELKIN_API std::vector<std::string> fit_channels(Map& map, const std::filesystem::path& path,
                                                 const io::WriteOptions& options = {});

/// Throws whatever writing `levels` levels of this shape and size would throw, before there is any map: of
/// what the format, the layout, the faces, the border and the options allow, and of folders that don't take
/// the files. `channels` are the names that the map will have. Nothing is left behind.
WELKIN_API void check_write_map(const std::filesystem::path& path, const MapShape& shape, ChartSize size,
                                int levels, const std::vector<std::string>& channels,
                                const WriteMapOptions& options = {});

}  // namespace welkin
