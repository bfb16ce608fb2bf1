#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

#include "welkin/base/large_memory.h"

namespace welkin::prefilter {

/// `count` floats on a 64-byte boundary, not initialised.
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t count) : count_(count) {
    void* memory = std::aligned_alloc(64, (count * sizeof(float) + 127) / 64 * 64);
    if (memory == nullptr) throw std::bad_alloc();
    values_.reset(static_cast<float*>(memory));
    prefer_large_pages(memory, count * sizeof(float));
  }

  float* data() { return values_.get(); }
  const float* data() const { return values_.get(); }
  std::size_t size() const { return count_; }

 private:
  struct Free {
    void operator()(float* p) const { std::free(p); }
  };
  std::unique_ptr<float[], Free> values_;
  std::size_t count_ = 0;
};

}  // namespace welkin::prefilter
