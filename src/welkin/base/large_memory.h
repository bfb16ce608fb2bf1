#pragma once

#include <cstddef>
#include <utility>

#include "welkin/base/export.h"

/// @file
/// Memory for pixels and tables.
namespace welkin {

/// Memory for pixels and tables, on a 64-byte boundary.
///
/// Blocks of 64 KiB and more are cut out of regions of 64 MiB that ask the system for huge pages, one after
/// the other, so that touching them for the first time costs one page fault for 2 MiB; those of over 32 MiB
/// have regions of their own. What is given back goes to the next who asks: at most two regions are kept that
/// nobody uses. Where the system has no such pages, and under AddressSanitizer, it is the heap's. Safe from
/// many threads.
class WELKIN_API LargeMemory {
 public:
  /// What new memory holds.
  enum class Contents {
    zero,   ///< all bytes 0
    unset,  ///< unspecified values: for those who write all of it
  };

  /// No memory: data() is null, size() 0.
  LargeMemory() = default;
  /// At least `bytes` of memory. Throws std::bad_alloc.
  LargeMemory(std::size_t bytes, Contents contents);
  /// Takes the memory over; `other` has none afterwards.
  LargeMemory(LargeMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  /// Swaps the two.
  LargeMemory& operator=(LargeMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~LargeMemory();

  /// The first byte, on a 64-byte boundary; null where there is none.
  /// @{
  std::byte* data() { return data_; }
  const std::byte* data() const { return data_; }
  /// @}

  /// In bytes: what was asked for, rounded up.
  std::size_t size() const { return size_; }

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace welkin
