#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/map_file/map_file.h"
#include "welkin/prefilter/bake.h"
#include "welkin/sequence/frame_names.h"

/// @file
/// The frames of an animation baked, every one, or every N with those between interpolated
/// (docs/sequences.md).
namespace welkin {

/// How a sequence is baked.
struct BakeFramesOptions {
  /// What each frame becomes. The plan is made once, for the shape of the first frame.
  BakeOptions bake = {};
  /// Which frames. None: from the first to the last of which there is a file.
  std::optional<FrameRange> frames = {};
  /// Key frames are the first, each so many further, and the last; only they need a source. Those between are
  /// interpolated.
  int every = 1;
  /// Whether frames between key frames are written.
  bool between = true;
  /// How many frames between key frames are baked too, at most, to measure the error of interpolating: the
  /// middle ones of stretches spread evenly over the sequence, where they have sources.
  int held_out = 4;
  /// Frames are left alone whose files are complete, were made from the same frames in the same way, and are
  /// newer than these: each file notes what it was made from. Throws Error (unsupported) for formats without
  /// text metadata.
  bool resume = false;
  /// How frames are read, where `open` isn't set.
  ReadMapOptions read = {};
  /// Opens a frame's file. `pixels` is false where only its shape is asked for, and no pixel should be
  /// read: ReadMapOptions::join_faces. From several threads at once.
  std::function<MapReader(const std::filesystem::path& file, bool pixels)> open = nullptr;
  /// Changes a frame that was read: repairs, rotations. Not its shape. From several threads at once.
  std::function<void(Map& map, const std::filesystem::path& file)> prepare = nullptr;
  /// What `open` and `prepare` do, in any words: `resume` makes frames again when this has changed.
  std::string request = {};
  float factor = 1;                   ///< times every value of the results, but for the channel A
  std::optional<Layout> layout = {};  ///< of the outputs; none: default_layout
  WriteMapOptions write = {};         ///< of the outputs
  /// The most bytes that the maps of frames in work together have, about; at least one frame is in work.
  std::uint64_t max_bytes = std::uint64_t{4} << 30;
  /// Told what reading a frame changed, guessed or left undone, and what is remarkable about it; each text
  /// once, of the first frame that has it. From one thread at a time.
  std::function<void(const std::filesystem::path& file, const std::string& text)> told = nullptr;
  /// Progress counts frames. Cancelling keeps those that are finished.
  Monitor monitor = {};
};

/// A frame between two key frames that was baked too.
struct HeldOutFrame {
  int frame = 0;             ///< its number
  double relative_rmse = 0;  ///< of interpolating, as ErrorMeasures has it; of the worst level
  double maximum = 0;        ///< the largest relative error of a texel of any level, as ErrorMeasures has it
};

/// Seconds that the steps took, added up over frames that were in work at the same time.
struct BakeFramesSeconds {
  double plan = 0;         ///< once
  double read = 0;         ///< opening and decoding
  double filter = 0;       ///< of key frames and those held out
  double interpolate = 0;  ///< and comparing with those held out
  double write = 0;        ///< of all frames
  double all = 0;          ///< on the clock, from start to end
};

/// What was done.
struct BakeFramesReport {
  std::vector<int> frames;               ///< all that were asked for, ascending
  std::vector<int> baked;                ///< of these, written after filtering
  std::vector<int> interpolated;         ///< of these, written after interpolating
  std::vector<int> complete;             ///< of these, left alone: see BakeFramesOptions::resume
  std::vector<HeldOutFrame> held_out;    ///< ascending
  std::vector<PrefilterLevel> levels;    ///< of each frame; empty where there was nothing to do
  std::vector<PrefilterMethod> methods;  ///< how they were filtered
  io::WriteReport losses;                ///< of all files together
  BakeFramesSeconds seconds;             ///< how long it took

  /// The one with the largest relative RMSE; null where none was held out.
  const HeldOutFrame* worst() const;
};

/// Reads the sources of key frames, bakes them, interpolates between, and writes one file for each frame, or
/// those of one where the name has a `%s`. Several frames are in work at once, on TBB's threads. A frame's
/// file appears when it is complete; the same bytes whatever the number of threads.
///
/// Before any work it throws Error for what is wrong with the request: (not_found) sources that are missing,
/// all of them named; (mismatch) sources of another size or parameterization than the first frame's, the
/// frame and both named; (bad_request) outputs that are sources too; files that can't be opened or written.
/// Then, about the frame's file: what reading and writing throw, (bad_value) for what can't be filtered,
/// (mismatch) other channels than the first frame's. Finished frames are kept, and the message counts them.
/// Cancelled.
WELKIN_API BakeFramesReport bake_frames(const FrameNames& in, const FrameNames& out,
                                        const BakeFramesOptions& options = {});

}  // namespace welkin
