#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace welkin::io {

/// The pictures of a file of several JPEGs one after the other, as the Multi-Picture Format (CIPA DC-007) and
/// Ultra HDR have it: the spans from each start of image on, at most `most`. What lies between them is
/// skipped. The first is the file itself, as far as its end of image is found.
std::vector<std::span<const std::byte>> jpegs_in(std::span<const std::byte> file, std::size_t most);

}  // namespace welkin::io
