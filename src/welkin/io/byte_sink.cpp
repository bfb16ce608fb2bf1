#include "welkin/io/byte_sink.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace welkin::io {

// Here, so that the library holds the classes' type information.
ByteSink::~ByteSink() = default;
MemorySink::~MemorySink() = default;

void MemorySink::write(std::span<const std::byte> bytes) {
  const std::uint64_t end = position_ + bytes.size();
  if (end > bytes_.size()) {
    if (end > bytes_.capacity()) bytes_.reserve(std::max<std::size_t>(end, 2 * bytes_.capacity()));
    bytes_.resize(end);
  }
  if (!bytes.empty()) std::memcpy(bytes_.data() + position_, bytes.data(), bytes.size());
  position_ = end;
}

std::size_t MemorySink::read_at(std::uint64_t offset, void* data, std::size_t size) {
  if (offset >= bytes_.size()) return 0;
  const std::size_t got = std::min<std::size_t>(size, bytes_.size() - offset);
  if (got > 0) std::memcpy(data, bytes_.data() + offset, got);
  return got;
}

std::vector<std::byte> MemorySink::take() {
  position_ = 0;
  return std::exchange(bytes_, {});
}

}  // namespace welkin::io
