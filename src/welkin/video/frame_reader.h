#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/video/stream_info.h"

/// @file
/// Frames out of a stream.
namespace welkin::video {

/// Fills what it is given with the next bytes, and returns how many there were: fewer only at the stream's
/// end.
using ReadBytes = std::function<std::size_t(std::span<std::byte>)>;

/// Takes a stream of y4m, PPM or PFM apart; which one it is its first bytes say.
///
/// `take` moves through the stream, in one thread at a time; `decode` changes nothing, so that frames taken
/// may be decoded while others are taken.
class WELKIN_API FrameReader {
 public:
  /// Reads the first header. `name` is the stream's, for messages. Throws Error: (unsupported) no such
  /// stream, interlaced frames, alpha, chroma that isn't in Chroma; (damaged) a header without sizes;
  /// (too_large) frames of more than `max_bytes` as floats.
  FrameReader(ReadBytes read, std::string name, const StreamColour& colour = {},
              std::uint64_t max_bytes = std::uint64_t{32} << 30);
  ~FrameReader();
  /// Moved, not copied: there is one stream.
  /// @{
  FrameReader(FrameReader&&) noexcept;
  FrameReader& operator=(FrameReader&&) noexcept;
  /// @}

  /// What the first header says.
  const StreamInfo& info() const;

  /// The next frame's stored bytes; false at the stream's end. Throws Error (damaged): it ends within a
  /// frame, or a frame has another size or kind than the first; the message has the frame's number, from 0
  /// on.
  bool take(std::vector<std::byte>& stored);

  /// Of info()'s size: linear, R G B or Y.
  void decode(std::span<const std::byte> stored, ImageView<float> frame) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin::video
