#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// Integers in files: at any address, in either byte order.
namespace welkin::io {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

constexpr std::uint32_t swap_bytes(std::uint32_t x) {
  return x >> 24 | (x >> 8 & 0xff00u) | (x << 8 & 0xff0000u) | x << 24;
}
constexpr std::uint16_t swap_bytes(std::uint16_t x) {
  return static_cast<std::uint16_t>(x << 8 | x >> 8);
}

/// A value in the machine's own byte order, at an address of any alignment.
template <class T>
T load_native(const void* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// An unsigned integer stored in the byte order `order`.
template <class T>
T load(const void* bytes, std::endian order) {
  const T value = load_native<T>(bytes);
  return order == std::endian::native ? value : swap_bytes(value);
}

}  // namespace welkin::io
