#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "welkin/io/exr/chunk.h"
#include "welkin/io/exr/header.h"

/// Reading through OpenEXR's C++ library: the compressions that exr_chunk.h leaves out, and luminance/chroma.
namespace welkin::io::exr {

/// What the library said, without the file's name, which the caller adds.
std::string cause_of(const std::exception& error);

/// One part of an open file, for one thread: every worker has its own, so the library needs no threads of its
/// own and no process-wide setting. Takes memory for two chunks.
class LibraryPart {
 public:
  /// `part` is parsed and checked. Throws Error when the library sees another structure in it.
  LibraryPart(std::span<const std::byte> bytes, const std::string& name, const File& file, std::size_t part);
  ~LibraryPart();

  /// Decodes one row of chunks of a level (of Part::levels()): straight into `destination` when all of it is
  /// seen, through a buffer when the display window crops it. Throws std::exception.
  void read(int level, std::uint64_t row, const Destination& destination);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a luminance/chroma file as linear R G B (A): `channels` are numbers in this order. Chroma is
/// interpolated and RGB formed as by Imf::RgbaInputFile, in half precision. Single-part files only. `row` is
/// the row it was at when it throws.
void read_luminance_chroma(std::span<const std::byte> bytes, const std::string& name, const File& file,
                           const Destination& destination, int& row);

}  // namespace welkin::io::exr
