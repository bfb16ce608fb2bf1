#pragma once

#include <cstddef>

#include "welkin/base/large_memory.h"

namespace welkin::prefilter {

/// `count` floats on a 64-byte boundary, not initialised.
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t count)
      : memory_(count * sizeof(float) + 64, LargeMemory::Contents::unset), count_(count) {}

  float* data() { return reinterpret_cast<float*>(memory_.data()); }
  const float* data() const { return reinterpret_cast<const float*>(memory_.data()); }
  std::size_t size() const { return count_; }

 private:
  LargeMemory memory_;
  std::size_t count_ = 0;
};

}  // namespace welkin::prefilter
