#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "command.h"
#include "welkin/camera/camera_path.h"
#include "welkin/camera/view.h"
#include "welkin/sequence/frame_names.h"

namespace welkin::cli {

/// `left-right`, `top-bottom`. Throws Error for another name.
Pair pair_from_name(std::string_view name);

/// The pictures that `view` makes.
struct ViewRequest {
  std::string in, out;
  Camera camera;
  ResampleOptions options;
  float factor = 1;
  std::optional<Pair> pair = {};
  std::optional<FrameRange> frames = {};
  std::optional<CameraPath> path = {};
  const ReadFlags* read = nullptr;
  const WriteFlags* write = nullptr;

  /// One picture, or one for each frame.
  void run();

 private:
  /// What is seen at a frame, from key frames where there are any.
  Camera camera_at(int frame) const;
  void run_frames();
  /// What was asked for, else those that there are inputs for, else those of the key frames.
  std::vector<int> frames_to_make() const;
  /// The world of one eye or of both.
  struct Worlds {
    Map left;
    std::optional<Map> right;
    MapFileInfo info;
  };
  Worlds read_worlds(const std::string& file) const;
  /// The worlds with the channels that the output takes, and brightened.
  Worlds fit(Worlds worlds, const std::string& file, bool told) const;
  void make(const Worlds& worlds, const Camera& at, const std::string& file, io::WriteReport& losses) const;
};

}  // namespace welkin::cli
