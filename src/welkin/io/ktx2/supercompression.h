#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "welkin/io/ktx2/header.h"

/// The compressions of whole levels: Zstandard (RFC 8878) and zlib (RFC 1950).
namespace welkin::io::ktx2 {

/// Memory that is not cleared first.
struct Buffer {
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;

  static Buffer of_size(std::size_t size) {
    return {std::make_unique_for_overwrite<std::byte[]>(size), size};
  }
  std::span<std::byte> bytes() { return {data.get(), size}; }
  std::span<const std::byte> bytes() const { return {data.get(), size}; }
};

/// One frame, with a checksum.
Buffer pack_zstd(std::span<const std::byte> bytes);

/// Fills `to`. Throws Error, the cause only, when `packed` is damaged or of another length.
void unpack(Scheme scheme, std::span<const std::byte> packed, std::span<std::byte> to);

}  // namespace welkin::io::ktx2
