#include "welkin/io/texels/formats.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace welkin::io::texels {
namespace {

constexpr auto kByte = PixelType::uint8, kWord = PixelType::uint16, kHalf = PixelType::half,
               kFloat = PixelType::float32;

constexpr std::uint32_t kAstcHdr = 1000066000;  // of 4×4 texels

constexpr TexelFormat kUastcHdr = {kAstcHdr, PixelType::uastc_hdr, "RGB", false, Coding::blocks, 1};

constexpr TexelFormat kRead[] = {{9, kByte, "R", false, Coding::plain, 1},
                                 {15, kByte, "R", true, Coding::plain, 1},
                                 {10, kFloat, "R", false, Coding::snorm, 1},
                                 {16, kByte, "RG", false, Coding::plain, 1},
                                 {22, kByte, "RG", true, Coding::plain, 1},
                                 {17, kFloat, "RG", false, Coding::snorm, 1},
                                 {23, kByte, "RGB", false, Coding::plain, 1},
                                 {29, kByte, "RGB", true, Coding::plain, 1},
                                 {24, kFloat, "RGB", false, Coding::snorm, 1},
                                 {30, kByte, "BGR", false, Coding::plain, 1},
                                 {36, kByte, "BGR", true, Coding::plain, 1},
                                 {31, kFloat, "BGR", false, Coding::snorm, 1},
                                 {37, kByte, "RGBA", false, Coding::plain, 1},
                                 {43, kByte, "RGBA", true, Coding::plain, 1},
                                 {38, kFloat, "RGBA", false, Coding::snorm, 1},
                                 {44, kByte, "BGRA", false, Coding::plain, 1},
                                 {50, kByte, "BGRA", true, Coding::plain, 1},
                                 {45, kFloat, "BGRA", false, Coding::snorm, 1},
                                 {70, kWord, "R", false, Coding::plain, 2},
                                 {71, kFloat, "R", false, Coding::snorm, 2},
                                 {76, kHalf, "R", false, Coding::plain, 2},
                                 {77, kWord, "RG", false, Coding::plain, 2},
                                 {78, kFloat, "RG", false, Coding::snorm, 2},
                                 {83, kHalf, "RG", false, Coding::plain, 2},
                                 {84, kWord, "RGB", false, Coding::plain, 2},
                                 {85, kFloat, "RGB", false, Coding::snorm, 2},
                                 {90, kHalf, "RGB", false, Coding::plain, 2},
                                 {91, kWord, "RGBA", false, Coding::plain, 2},
                                 {92, kFloat, "RGBA", false, Coding::snorm, 2},
                                 {97, kHalf, "RGBA", false, Coding::plain, 2},
                                 {100, kFloat, "R", false, Coding::plain, 4},
                                 {103, kFloat, "RG", false, Coding::plain, 4},
                                 {106, kFloat, "RGB", false, Coding::plain, 4},
                                 {109, kFloat, "RGBA", false, Coding::plain, 4},
                                 {112, kFloat, "R", false, Coding::doubles, 8},
                                 {115, kFloat, "RG", false, Coding::doubles, 8},
                                 {118, kFloat, "RGB", false, Coding::doubles, 8},
                                 {121, kFloat, "RGBA", false, Coding::doubles, 8},
                                 {122, PixelType::r11g11b10, "RGB", false, Coding::packed, 4},
                                 {123, PixelType::rgb9e5, "RGB", false, Coding::packed, 4},
                                 {143, PixelType::bc6h, "RGB", false, Coding::blocks, 1},
                                 {144, PixelType::bc6h, "RGB", false, Coding::blocks, 1, {}, true},
                                 {kAstcHdr, PixelType::astc_hdr, "RGBA", false, Coding::blocks, 1},
                                 {1, kByte, "RG", false, Coding::fields, 1, "R4G4", false},
                                 {2, kByte, "RGBA", false, Coding::fields, 2, "R4G4B4A4", false},
                                 {3, kByte, "RGBA", false, Coding::fields, 2, "B4G4R4A4", false},
                                 {4, kByte, "RGB", false, Coding::fields, 2, "R5G6B5", false},
                                 {5, kByte, "RGB", false, Coding::fields, 2, "B5G6R5", false},
                                 {6, kByte, "RGBA", false, Coding::fields, 2, "R5G5B5A1", false},
                                 {7, kByte, "RGBA", false, Coding::fields, 2, "B5G5R5A1", false},
                                 {8, kByte, "RGBA", false, Coding::fields, 2, "A1R5G5B5", false},
                                 {51, kByte, "RGBA", false, Coding::fields, 4, "A8B8G8R8", false},
                                 {52, kFloat, "RGBA", false, Coding::fields, 4, "A8B8G8R8", true},
                                 {57, kByte, "RGBA", true, Coding::fields, 4, "A8B8G8R8", false},
                                 {58, kWord, "RGBA", false, Coding::fields, 4, "A2R10G10B10", false},
                                 {59, kFloat, "RGBA", false, Coding::fields, 4, "A2R10G10B10", true},
                                 {64, kWord, "RGBA", false, Coding::fields, 4, "A2B10G10R10", false},
                                 {65, kFloat, "RGBA", false, Coding::fields, 4, "A2B10G10R10", true},
                                 {1000340000, kByte, "RGBA", false, Coding::fields, 2, "A4R4G4B4", false},
                                 {1000340001, kByte, "RGBA", false, Coding::fields, 2, "A4B4G4R4", false},
                                 {1000470000, kByte, "RGBA", false, Coding::fields, 2, "A1B5G5R5", false}};

}  // namespace

const TexelFormat* find_format(std::uint32_t number, std::uint32_t colour_model) {
  // Some writers leave VK_FORMAT_UNDEFINED, as in other files of Basis Universal's.
  if (colour_model == kModelUastcHdr && (number == kAstcHdr || number == 0)) return &kUastcHdr;
  const auto found = std::find_if(std::begin(kRead), std::end(kRead),
                                  [&](const auto& each) { return each.number == number; });
  return found == std::end(kRead) ? nullptr : found;
}

const TexelFormat& format_for(PixelType type, bool two_channels) {
  constexpr std::uint32_t kHalfRg = 83, kFloatRg = 103, kHalfRgba = 97, kFloatRgba = 109, kB10G11R11 = 122,
                          kE5B9G9R9 = 123, kBc6hUfloat = 143;
  if (type == PixelType::uastc_hdr) return kUastcHdr;
  std::uint32_t number = two_channels ? kFloatRg : kFloatRgba;
  if (type == PixelType::half) number = two_channels ? kHalfRg : kHalfRgba;
  if (type == PixelType::r11g11b10) number = kB10G11R11;
  if (type == PixelType::rgb9e5) number = kE5B9G9R9;
  if (type == PixelType::bc6h) number = kBc6hUfloat;
  const TexelFormat* format = find_format(number);
  assert(format != nullptr && format->type == type);
  return *format;
}

}  // namespace welkin::io::texels
