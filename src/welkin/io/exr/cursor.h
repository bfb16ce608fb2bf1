#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "welkin/base/error.h"

namespace welkin::io::exr {

static_assert(std::endian::native == std::endian::little, "EXR's numbers are read as they lie in memory");

/// The number at `offset`, which the caller has checked.
template <class T>
T number_at(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// Reads little-endian numbers and zero-ended names in order. Throws Error, with the byte offset, at the end.
class Cursor {
 public:
  Cursor(std::span<const std::byte> bytes, std::string_view name, std::size_t offset)
      : bytes_(bytes), name_(name), offset_(offset) {}

  std::size_t offset() const { return offset_; }
  std::size_t left() const { return bytes_.size() - offset_; }

  std::span<const std::byte> take_bytes(std::size_t size) {
    if (size > left()) fail("the header ends early");
    const auto taken = bytes_.subspan(offset_, size);
    offset_ += size;
    return taken;
  }

  template <class T>
  T take() {
    return number_at<T>(take_bytes(sizeof(T)), 0);
  }

  std::string_view take_name() {
    constexpr std::size_t kLongest = 255;
    const char* const start = reinterpret_cast<const char*>(bytes_.data() + offset_);
    const std::size_t reach = left() < kLongest + 1 ? left() : kLongest + 1;
    const void* const end = reach == 0 ? nullptr : std::memchr(start, 0, reach);
    if (!end) fail("a name in the header has no end");
    const std::string_view text(start, static_cast<std::size_t>(static_cast<const char*>(end) - start));
    offset_ += text.size() + 1;
    return text;
  }

  /// Of what is right but not read here.
  [[noreturn]] void refuse(const std::string& cause) const {
    throw Error(ErrorKind::unsupported, std::string(name_), cause);
  }

  [[noreturn]] void fail(const std::string& cause) const {
    throw Error(ErrorKind::damaged, std::string(name_), cause + " (byte " + std::to_string(offset_) + ")");
  }

 private:
  std::span<const std::byte> bytes_;
  std::string_view name_;
  std::size_t offset_;
};

}  // namespace welkin::io::exr
