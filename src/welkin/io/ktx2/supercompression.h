#pragma once

#include <cstddef>
#include <span>

#include "welkin/base/large_memory.h"
#include "welkin/io/ktx2/header.h"

/// The compressions of whole levels: Zstandard (RFC 8878) and zlib (RFC 1950).
namespace welkin::io::ktx2 {

/// Memory that is not cleared first.
class Buffer {
 public:
  explicit Buffer(std::size_t bytes = 0) : size_(bytes) {
    if (bytes > 0) memory_ = LargeMemory(bytes, LargeMemory::Contents::unset);
  }
  /// Keeps the first `bytes` of it.
  void shrink(std::size_t bytes) { size_ = bytes; }
  std::span<std::byte> bytes() { return {memory_.data(), size_}; }
  std::span<const std::byte> bytes() const { return {memory_.data(), size_}; }

 private:
  LargeMemory memory_;
  std::size_t size_ = 0;
};

/// One frame, with a checksum.
Buffer pack_zstd(std::span<const std::byte> bytes);

/// Fills `to`. Throws Error, the cause only, when `packed` is damaged or of another length.
void unpack(Scheme scheme, std::span<const std::byte> packed, std::span<std::byte> to);

}  // namespace welkin::io::ktx2
