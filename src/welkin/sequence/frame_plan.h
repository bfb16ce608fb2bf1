#pragma once

#include <functional>
#include <set>
#include <vector>

#include "welkin/sequence/frame_names.h"

/// Which frames of a sequence are baked and which interpolated. Knows no maps.
namespace welkin::sequence {

/// A frame whose source is read and baked.
struct BakedFrame {
  int frame = 0;
  bool key = true;     ///< of the key frames; otherwise it is baked to measure the error of interpolating
  bool write = true;   ///< false: only those between or the error need it
  bool joins = false;  ///< the key before it is baked too, and what lies between them is wanted
};

/// A sequence's work.
struct FramePlan {
  std::vector<int> frames;        ///< that are asked for, ascending
  std::vector<BakedFrame> baked;  ///< ascending
  std::vector<int> interpolated;  ///< ascending
  std::vector<int> complete;      ///< already there, ascending
};

/// What is asked for.
struct FramePlanOptions {
  int every = 1;        ///< key frames: the first, each so many further, and the last
  bool between = true;  ///< those between are wanted too
  int held_out = 0;     ///< how many of them are baked too, at most, spread evenly over the sequence
};

/// The key frames of a range. Throws Error (too_large) for over kMostFrames.
std::vector<int> key_frames(FrameRange range, int every);
inline constexpr int kMostFrames = 1000000;

/// Plans. `exists` says whether a frame has a source, of those between key frames; `complete` whether a
/// frame's output is there already, which is then not made again. Of two key frames between which something
/// is to be made, both are baked. Frames held out are the middle ones between two key frames.
FramePlan plan_frames(FrameRange range, const FramePlanOptions& options,
                      const std::function<bool(int)>& exists, const std::function<bool(int)>& complete);

}  // namespace welkin::sequence
