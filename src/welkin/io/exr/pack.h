#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "welkin/io/exr/header.h"

struct libdeflate_compressor;

/// Writing scan-line chunks of the simplest compressions (none, ZIPS, ZIP) without OpenEXR's library:
/// libdeflate packs twice as fast as zlib and a little tighter.
namespace welkin::io::exr {

/// True for the compressions that ChunkPacker does.
bool packs_here(Compression compression);

/// Working memory for one thread.
class ChunkPacker {
 public:
  ChunkPacker();

  /// What the file stores for a chunk's bytes, which is `raw` itself where packing would not make it shorter.
  /// The result lies in `raw` or here until the next call.
  std::span<const std::byte> pack(Compression compression, std::span<const std::byte> raw);

 private:
  struct Free {
    void operator()(libdeflate_compressor* p) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> deflater_;
  std::vector<std::byte> split_, packed_;
};

/// Writes a whole file: `headers` are complete, one per part, and agree with `parts`. Chunks are packed by
/// TBB's workers and written in order, half a megabyte at a time and two of these per worker in memory.
WriteReport write_packed(Imf::OStream& stream, std::span<const Imf::Header> headers,
                         std::span<const WritePart> parts, StoredType type, Compression compression);

}  // namespace welkin::io::exr
