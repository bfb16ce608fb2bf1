#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/base/export.h"

namespace welkin::io {

/// Where a file's bytes are written to. Formats go back to fill in sizes, and TIFF reads what it wrote, so a
/// sink must seek. Members throw Error when the bytes can't be taken.
class WELKIN_API ByteSink {
 public:
  virtual ~ByteSink();

  /// At the position, which moves on; bytes already there are overwritten.
  virtual void write(std::span<const std::byte> bytes) = 0;
  /// Up to `size` bytes from `offset` on that were written before; returns how many there were.
  virtual std::size_t read_at(std::uint64_t offset, void* data, std::size_t size) = 0;
  /// Also past the end: what lies between is 0 once something is written there.
  virtual void seek(std::uint64_t offset) = 0;
  virtual std::uint64_t tell() const = 0;
  virtual std::uint64_t size() const = 0;

  void write(const void* data, std::size_t size) {
    write(std::span(static_cast<const std::byte*>(data), size));
  }
};

/// Bytes in memory.
class WELKIN_API MemorySink final : public ByteSink {
 public:
  ~MemorySink() override;
  using ByteSink::write;
  void write(std::span<const std::byte> bytes) override;
  std::size_t read_at(std::uint64_t offset, void* data, std::size_t size) override;
  void seek(std::uint64_t offset) override { position_ = offset; }
  std::uint64_t tell() const override { return position_; }
  std::uint64_t size() const override { return bytes_.size(); }

  const std::vector<std::byte>& bytes() const { return bytes_; }
  /// Hands the bytes over; none are left.
  std::vector<std::byte> take();

 private:
  std::vector<std::byte> bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace welkin::io
