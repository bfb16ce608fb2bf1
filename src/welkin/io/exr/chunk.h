#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/io/exr/header.h"

struct libdeflate_decompressor;

/// Chunks of the simple compressions (none, RLE, ZIPS, ZIP) from packed bytes to floats, without OpenEXR's
/// library: its generic path inflates with zlib and walks each value through several passes. Source: "OpenEXR
/// File Layout", scan-line and tile blocks; the byte order within RLE and ZIP is described there.
namespace welkin::io::exr {

/// True for the compressions that ChunkUnpacker undoes.
bool unpacks_here(Compression compression);

/// Working memory for one thread: two chunks.
class ChunkUnpacker {
 public:
  ChunkUnpacker();

  /// The `size` bytes of a chunk's pixels: for each line, for each channel by name, the line's values. The
  /// result lies in `packed` itself or here until the next call. Throws Error, the cause only.
  std::span<const std::byte> unpack(Compression compression, std::span<const std::byte> packed,
                                    std::size_t size);

 private:
  struct Free {
    void operator()(libdeflate_decompressor* p) const;
  };
  std::unique_ptr<libdeflate_decompressor, Free> inflater_;
  std::vector<std::byte> coded_, bytes_;
};

/// Which stored channel goes where in the caller's picture.
struct Destination {
  ImageView<float> out;       ///< texel (0, 0) is the display window's first
  std::vector<int> channels;  ///< for each channel of `out`, the number of a stored channel of the part
};

/// Writes the pixels of `window` that lie in the display window, as floats. `bytes` is what unpack gave for
/// it.
void store_chunk(const Part& part, const Window& window, std::span<const std::byte> bytes,
                 const Destination& destination);

// The steps, for tests.

/// Each byte but the first is a difference to the one before, plus 128: sums them, in place.
void undo_differences(std::span<std::byte> bytes);
/// The first half holds the even bytes of `to`, the second half the odd ones.
void interleave_halves(std::span<const std::byte> from, std::span<std::byte> to);
/// `count` little-endian values at any address. Half to float keeps the payload of NaNs.
void convert_to_float(StoredType type, const std::byte* from, int count, float* to);

}  // namespace welkin::io::exr
