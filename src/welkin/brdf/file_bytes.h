#pragma once

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <string>

#include "welkin/base/error.h"

namespace welkin::brdf {

/// All of a file. Throws Error: it can't be opened or read, or is larger than `most` bytes, which is `why`
/// too many.
inline std::string file_bytes(const std::string& path, std::uint64_t most, const std::string& why) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw Error(errno == EACCES   ? ErrorKind::denied
                : errno == ENOENT ? ErrorKind::not_found
                                  : ErrorKind::system,
                path, "cannot be opened");
  // In pieces, so that memory is taken for what is there.
  std::string bytes;
  std::string piece(std::size_t{1} << 20, '\0');
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0) {
    bytes.append(piece, 0, static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > most)
      throw Error(ErrorKind::too_large, path, "is over " + std::to_string(most >> 20) + " MiB, " + why);
  }
  if (in.bad()) throw Error(ErrorKind::system, path, "cannot be read");
  return bytes;
}

}  // namespace welkin::brdf
