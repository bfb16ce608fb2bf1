#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// Where the bytes of a file go.
namespace welkin::io {

/// Where a file's bytes are written to. Formats go back to fill in sizes, and TIFF reads what it wrote, so a
/// sink must seek. Implement it to write elsewhere than to files and memory. Members throw Error when the
/// bytes can't be taken. Used by one thread at a time.
class WELKIN_API ByteSink {
 public:
  virtual ~ByteSink();

  /// Writes at the position, which moves on; bytes already there are overwritten.
  virtual void write(std::span<const std::byte> bytes) = 0;
  /// Copies to `data` up to `size` bytes from `offset` on that were written before; returns how many there
  /// were. The position stays.
  virtual std::size_t read_at(std::uint64_t offset, void* data, std::size_t size) = 0;
  /// Moves the position, also past the end: what lies between is 0 once something is written there.
  virtual void seek(std::uint64_t offset) = 0;
  /// The position, in bytes from the beginning.
  virtual std::uint64_t tell() const = 0;
  /// Bytes from the beginning to the end of what was written.
  virtual std::uint64_t size() const = 0;

  /// The same of `size` bytes at `data`.
  void write(const void* data, std::size_t size) {
    write(std::span(static_cast<const std::byte*>(data), size));
  }
};

/// A sink in memory. Throws std::bad_alloc where there is none left.
class WELKIN_API MemorySink final : public ByteSink {
 public:
  ~MemorySink() override;
  using ByteSink::write;
  void write(std::span<const std::byte> bytes) override;
  std::size_t read_at(std::uint64_t offset, void* data, std::size_t size) override;
  void seek(std::uint64_t offset) override { position_ = offset; }
  std::uint64_t tell() const override { return position_; }
  std::uint64_t size() const override { return bytes_.size(); }

  /// All bytes written; valid until the next write.
  const std::vector<std::byte>& bytes() const { return bytes_; }
  /// Hands the bytes over; none are left, and the position is 0.
  std::vector<std::byte> take();

 private:
  std::vector<std::byte> bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace welkin::io
