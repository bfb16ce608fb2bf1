#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.h"
#include "view_stream.h"
#include "welkin/camera/camera_path.h"
#include "welkin/camera/motion_blur.h"
#include "welkin/camera/view.h"
#include "welkin/sequence/frame_names.h"

namespace welkin::cli {

/// `left-right`, `top-bottom`. Throws Error for another name.
Pair pair_from_name(std::string_view name);

/// Positions that are kept from frame to frame while the worlds have one shape and the camera stands still.
class KeptPositions {
 public:
  std::shared_ptr<const TexelPositions> of(const MapFrame& world, const MapFrame& seen);

 private:
  std::mutex mutex_;
  std::shared_ptr<const TexelPositions> kept_;
};

/// The pictures that `view` makes.
struct ViewRequest {
  std::string in, out;
  Camera camera;
  ResampleOptions options;
  float factor = 1;
  std::optional<Pair> pair = {};
  std::optional<FrameRange> frames = {};
  std::optional<CameraPath> path = {};
  std::optional<Shutter> shutter = {};  ///< from a frame's number on
  std::optional<int> samples = {};      ///< MotionBlurOptions::samples
  std::string over = {};                ///< near pictures, which may be numbered
  bool resume = false;
  std::string request = {};  ///< all that the pictures depend on, in any words
  const ReadFlags* read = nullptr;
  const WriteFlags* write = nullptr;
  const StreamFlags* stream = nullptr;
  std::shared_ptr<KeptPositions> kept = {};  ///< none: the camera moves, or the filter doesn't read them

  /// One picture, or one for each frame.
  void run();

 private:
  /// The world of one eye or of both.
  struct Worlds {
    Map left;
    std::optional<Map> right = {};
    std::optional<BlurredWorld> blurred = {};  ///< of `left`, where many frames are made of it
  };
  /// What is seen, as a map, or for two eyes as a picture.
  struct Picture {
    std::optional<Map> map;
    Image both;
    std::vector<std::string> channels;

    ImageView<float> view() { return map ? map->level.chart(0) : both.view(); }
  };
  class Sequence;
  void run_frames() const;

  /// What is seen at a time in frames, from key frames where there are any.
  Camera camera_at(double frame) const;
  std::shared_ptr<const TexelPositions> positions_for(const Map& world, const MapFrame& seen) const;
  Worlds read_worlds(const std::string& file, bool warn) const;
  /// The worlds with the channels that the output takes, and brightened.
  Worlds fit(Worlds worlds, const std::string& file, bool told) const;
  Picture picture_of(const Worlds& worlds, int frame) const;
  /// Lays the near picture of a frame over it.
  void lay_over(Picture& picture, int frame) const;
  std::string near_file(int frame) const;
  /// To a file, by bands where that is enough.
  io::WriteReport make(const Worlds& worlds, int frame, const std::string& file,
                       const std::string& note) const;
  /// Throws as writing a frame's file would.
  void check_file(int frame, const std::string& file) const;
  /// What was asked for, else those that there are inputs for, else those of the key frames.
  std::vector<int> frames_to_make() const;
  bool reads_stream() const { return stream->asked() && in == "-"; }
  bool writes_stream() const { return stream->asked() && out == "-"; }
};

}  // namespace welkin::cli
