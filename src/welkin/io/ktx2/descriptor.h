#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/declared.h"
#include "welkin/io/texels/formats.h"

/// KTX2's data format descriptor: how the bits of a texel are to be understood, and its colour space. Source:
/// "Khronos Data Format Specification" 1.3, chapters 3 to 5 and the examples B10G11R11 and E5B9G9R9.
namespace welkin::io::ktx2 {

using texels::TexelFormat;

/// The descriptor of a format's texels: RGB primaries of BT.709. `colour` is linear or srgb; `premultiplied`
/// says that colours are multiplied by the alpha beside them.
std::vector<std::byte> written_descriptor(const TexelFormat& format, Colour colour, bool premultiplied);

/// What reading needs from a descriptor.
struct Descriptor {
  Colour colour = Colour::linear;
  Curve curve = Curve::none;  ///< where it is neither linear nor sRGB
  double gamma = 1;           ///< of Curve::gamma
  std::optional<Chromaticities> primaries;
  bool premultiplied = false;         ///< colours are multiplied by alpha
  std::vector<std::string> warnings;  ///< primaries and transfer functions that are not converted
};

/// Throws Error, the cause only, when the descriptor is cut off or is not of the format's kind of texels.
/// `offset` is where `bytes` begin in the file.
Descriptor parse_descriptor(std::span<const std::byte> bytes, std::uint64_t offset,
                            const TexelFormat& format);

}  // namespace welkin::io::ktx2
