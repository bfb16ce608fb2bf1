#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/io/image_file.h"
#include "welkin/video/stream_info.h"

/// @file
/// Frames into a stream.
namespace welkin::video {

/// Takes bytes on; throws Error when it can't.
using WriteBytes = std::function<void(std::span<const std::byte>)>;

/// Makes a stream of y4m, PPM or PFM.
///
/// `put` moves through the stream, in one thread at a time; `encode` changes nothing, so that frames may be
/// encoded while others are put.
class WELKIN_API FrameWriter {
 public:
  /// Writes nothing yet. Throws Error (bad_request): sizes below 1, bits that the kind doesn't have (y4m 8,
  /// 10, 12, 16; ppm 8, 16; pfm 32), channels other than 1 and 3, chroma of the wrong number of channels.
  FrameWriter(WriteBytes write, const StreamInfo& info, const StreamColour& colour = {});

  /// What is written.
  const StreamInfo& info() const { return info_; }

  /// A frame as it is stored, its header included. `frame` has info()'s size; R G B may be given where Y is
  /// written. Integers hold 0 … 1: what is clipped, and what isn't a number and becomes 0, is counted. Throws
  /// Error (mismatch): another size.
  io::WriteReport encode(ImageView<const float> frame, std::vector<std::byte>& stored) const;

  /// What stands before a frame's pixels, for who has them stored already. Of PPM and y4m.
  std::string frame_header() const;

  /// Writes an encoded frame, after the stream's header where it is the first.
  void put(std::span<const std::byte> stored);

 private:
  WriteBytes write_;
  StreamInfo info_;
  StreamColour colour_;
  bool begun_ = false;
};

}  // namespace welkin::video
