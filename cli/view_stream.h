#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "welkin/map_file/byte_remap.h"
#include "welkin/video/frame_reader.h"
#include "welkin/video/frame_writer.h"

namespace welkin::cli {

/// Options about streams of frames on standard input and output.
struct StreamFlags {
  std::string kind, rate, matrix = "bt601";

  void add(Command command);
  bool asked() const { return !kind.empty(); }
  /// Throws UsageError for those that are given without `--stream`.
  void check_unused(const Command& command) const;
  video::StreamKind parse_kind() const;
  video::StreamColour colour() const;
  /// `25`, `30000/1001`, `29.97`; none: not given.
  std::optional<std::pair<int, int>> parse_rate() const;
};

/// Worlds out of a stream on standard input, each frame a picture as a file would hold it.
class WorldStream {
 public:
  WorldStream(const ReadFlags& read, const StreamFlags& flags);

  const video::StreamInfo& info() const { return reader_.info(); }
  /// The shape of every frame, where a frame is a map's one chart and nothing else is to be done.
  const std::optional<MapShape>& plain_shape() const { return plain_; }
  const Matrix3& orientation() const { return orientation_; }
  bool take(std::vector<std::byte>& stored) { return reader_.take(stored); }
  /// The world of a frame that was taken; of an eye, where the pictures have two. Several at the same time.
  Map world(std::span<const std::byte> stored) const;

 private:
  /// As a file in memory, of which the shape is found.
  std::vector<std::byte> as_file(ImageView<const float> frame) const;

  const ReadFlags& read_;
  video::FrameReader reader_;
  std::optional<MapShape> plain_;  ///< a shape of one picture, where nothing else is to be done
  Matrix3 orientation_;
};

/// Frames of 8 bits resampled bilinearly as they are stored, plane by plane, by a camera that stands still:
/// the positions are found once.
class StoredFrames {
 public:
  /// None where the streams' values aren't the same: of 8 bits, of one kind and with the same planes.
  static std::optional<StoredFrames> make(const WorldStream& worlds, const MapFrame& seen,
                                          const video::StreamInfo& out);

  /// A frame's header and pixels. Several at the same time.
  void apply(std::span<const std::byte> taken, const std::string& header, std::vector<std::byte>& made) const;

 private:
  std::vector<video::StoredPlane> from_, to_;
  std::vector<ByteRemap> remaps_;  ///< for planes of each size
  std::size_t bytes_ = 0;
};

}  // namespace welkin::cli
