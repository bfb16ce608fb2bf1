// Any bytes as a stream of frames: y4m, PPM, PFM. Only Error may come out; frames that were taken can be
// decoded, and encoded again.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/image/image.h"
#include "welkin/video/frame_reader.h"
#include "welkin/video/frame_writer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 24;
  constexpr int kMostFrames = 4;
  std::span<const std::byte> rest = std::as_bytes(std::span(data, size));
  try {
    video::FrameReader reader(
        [&](std::span<std::byte> to) {
          const std::size_t count = std::min(to.size(), rest.size());
          std::copy_n(rest.begin(), count, to.begin());
          rest = rest.subspan(count);
          return count;
        },
        "fuzz", {}, kMostBytes);
    const video::StreamInfo& info = reader.info();
    Image frame(info.width, info.height, info.channels);
    std::vector<std::byte> stored, again;
    for (int i = 0; i < kMostFrames && reader.take(stored); ++i) {
      for (const video::StoredPlane& plane : video::stored_planes(info)) {
        if (plane.offset > stored.size() || plane.width < 1 || plane.height < 1) __builtin_trap();
      }
      reader.decode(stored, frame.view());
      // Not all that is read can be written.
      try {
        video::FrameWriter([](std::span<const std::byte>) {}, info).encode(frame.view(), again);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::bad_request) __builtin_trap();
      }
    }
  } catch (const Error&) {
  }
  return 0;
}
