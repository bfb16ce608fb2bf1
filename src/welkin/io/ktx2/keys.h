#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

/// KTX2's key/value data: each entry is the bytes of key, zero, value; entries are sorted by key and padded
/// to four bytes.
namespace welkin::io::ktx2 {

struct Keys {
  std::map<std::string, std::string> texts;  ///< values that are text, without the zero at their end
  std::vector<std::string> notes;            ///< values that are not
  std::vector<std::string> warnings;         ///< what the values ask for and is not done
};

/// Throws Error, the cause only, with the byte offset: `offset` is where `bytes` begin in the file.
Keys parse_keys(std::span<const std::byte> bytes, std::uint64_t offset);

/// The attributes, `KTXorientation` (`rd`: rows from the top, texels from the left) and `KTXwriter`. Text is
/// kept as it is, so nothing is escaped. Keys that begin with `KTX` or `ktx` describe the file that they were
/// read from, and are left out. Throws Error for an empty key, and for a zero byte in a key or value.
std::vector<std::byte> written_keys(const std::map<std::string, std::string>& attributes);

}  // namespace welkin::io::ktx2
