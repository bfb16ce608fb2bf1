#pragma once

#include <string>

#include "welkin/io/test_pictures.h"

/// JPEGs changed by hand, for tests.
namespace welkin::io::test {

/// The JPEG with a marker after its start.
inline Bytes with_marker(const Bytes& bytes, char marker, const std::string& body) {
  const std::size_t size = body.size() + 2;
  Bytes changed = bytes;
  const Bytes inserted = bytes_of(std::string("\xff") + marker + static_cast<char>(size >> 8) +
                                  static_cast<char>(size & 255) + body);
  changed.insert(changed.begin() + 2, inserted.begin(), inserted.end());
  return changed;
}

}  // namespace welkin::io::test
