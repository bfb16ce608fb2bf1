#include "welkin/io/ktx2/formats.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "welkin/io/decode_pixels.h"

namespace welkin::io::ktx2 {
namespace {

constexpr auto kByte = PixelType::uint8, kWord = PixelType::uint16, kHalf = PixelType::half,
               kFloat = PixelType::float32;

constexpr std::array kRead{TexelFormat{9, kByte, "R", false},
                           TexelFormat{15, kByte, "R", true},
                           TexelFormat{16, kByte, "RG", false},
                           TexelFormat{22, kByte, "RG", true},
                           TexelFormat{23, kByte, "RGB", false},
                           TexelFormat{29, kByte, "RGB", true},
                           TexelFormat{30, kByte, "BGR", false},
                           TexelFormat{36, kByte, "BGR", true},
                           TexelFormat{37, kByte, "RGBA", false},
                           TexelFormat{43, kByte, "RGBA", true},
                           TexelFormat{44, kByte, "BGRA", false},
                           TexelFormat{50, kByte, "BGRA", true},
                           TexelFormat{70, kWord, "R", false},
                           TexelFormat{77, kWord, "RG", false},
                           TexelFormat{84, kWord, "RGB", false},
                           TexelFormat{91, kWord, "RGBA", false},
                           TexelFormat{76, kHalf, "R", false},
                           TexelFormat{83, kHalf, "RG", false},
                           TexelFormat{90, kHalf, "RGB", false},
                           TexelFormat{97, kHalf, "RGBA", false},
                           TexelFormat{100, kFloat, "R", false},
                           TexelFormat{103, kFloat, "RG", false},
                           TexelFormat{106, kFloat, "RGB", false},
                           TexelFormat{109, kFloat, "RGBA", false},
                           TexelFormat{122, PixelType::r11g11b10, "RGB", false},
                           TexelFormat{123, PixelType::rgb9e5, "RGB", false}};

/// Of the formats 0, 1, 2…, without their common `VK_FORMAT_`.
constexpr std::string_view kNames =
    "UNDEFINED R4G4_UNORM_PACK8 R4G4B4A4_UNORM_PACK16 B4G4R4A4_UNORM_PACK16 R5G6B5_UNORM_PACK16 "
    "B5G6R5_UNORM_PACK16 R5G5B5A1_UNORM_PACK16 B5G5R5A1_UNORM_PACK16 A1R5G5B5_UNORM_PACK16 R8_UNORM "
    "R8_SNORM R8_USCALED R8_SSCALED R8_UINT R8_SINT R8_SRGB R8G8_UNORM R8G8_SNORM R8G8_USCALED "
    "R8G8_SSCALED R8G8_UINT R8G8_SINT R8G8_SRGB R8G8B8_UNORM R8G8B8_SNORM R8G8B8_USCALED R8G8B8_SSCALED "
    "R8G8B8_UINT R8G8B8_SINT R8G8B8_SRGB B8G8R8_UNORM B8G8R8_SNORM B8G8R8_USCALED B8G8R8_SSCALED "
    "B8G8R8_UINT B8G8R8_SINT B8G8R8_SRGB R8G8B8A8_UNORM R8G8B8A8_SNORM R8G8B8A8_USCALED R8G8B8A8_SSCALED "
    "R8G8B8A8_UINT R8G8B8A8_SINT R8G8B8A8_SRGB B8G8R8A8_UNORM B8G8R8A8_SNORM B8G8R8A8_USCALED "
    "B8G8R8A8_SSCALED B8G8R8A8_UINT B8G8R8A8_SINT B8G8R8A8_SRGB A8B8G8R8_UNORM_PACK32 "
    "A8B8G8R8_SNORM_PACK32 A8B8G8R8_USCALED_PACK32 A8B8G8R8_SSCALED_PACK32 A8B8G8R8_UINT_PACK32 "
    "A8B8G8R8_SINT_PACK32 A8B8G8R8_SRGB_PACK32 A2R10G10B10_UNORM_PACK32 A2R10G10B10_SNORM_PACK32 "
    "A2R10G10B10_USCALED_PACK32 A2R10G10B10_SSCALED_PACK32 A2R10G10B10_UINT_PACK32 "
    "A2R10G10B10_SINT_PACK32 A2B10G10R10_UNORM_PACK32 A2B10G10R10_SNORM_PACK32 "
    "A2B10G10R10_USCALED_PACK32 A2B10G10R10_SSCALED_PACK32 A2B10G10R10_UINT_PACK32 "
    "A2B10G10R10_SINT_PACK32 R16_UNORM R16_SNORM R16_USCALED R16_SSCALED R16_UINT R16_SINT R16_SFLOAT "
    "R16G16_UNORM R16G16_SNORM R16G16_USCALED R16G16_SSCALED R16G16_UINT R16G16_SINT R16G16_SFLOAT "
    "R16G16B16_UNORM R16G16B16_SNORM R16G16B16_USCALED R16G16B16_SSCALED R16G16B16_UINT R16G16B16_SINT "
    "R16G16B16_SFLOAT R16G16B16A16_UNORM R16G16B16A16_SNORM R16G16B16A16_USCALED R16G16B16A16_SSCALED "
    "R16G16B16A16_UINT R16G16B16A16_SINT R16G16B16A16_SFLOAT R32_UINT R32_SINT R32_SFLOAT R32G32_UINT "
    "R32G32_SINT R32G32_SFLOAT R32G32B32_UINT R32G32B32_SINT R32G32B32_SFLOAT R32G32B32A32_UINT "
    "R32G32B32A32_SINT R32G32B32A32_SFLOAT R64_UINT R64_SINT R64_SFLOAT R64G64_UINT R64G64_SINT "
    "R64G64_SFLOAT R64G64B64_UINT R64G64B64_SINT R64G64B64_SFLOAT R64G64B64A64_UINT R64G64B64A64_SINT "
    "R64G64B64A64_SFLOAT B10G11R11_UFLOAT_PACK32 E5B9G9R9_UFLOAT_PACK32 D16_UNORM X8_D24_UNORM_PACK32 "
    "D32_SFLOAT S8_UINT D16_UNORM_S8_UINT D24_UNORM_S8_UINT D32_SFLOAT_S8_UINT BC1_RGB_UNORM_BLOCK "
    "BC1_RGB_SRGB_BLOCK BC1_RGBA_UNORM_BLOCK BC1_RGBA_SRGB_BLOCK BC2_UNORM_BLOCK BC2_SRGB_BLOCK "
    "BC3_UNORM_BLOCK BC3_SRGB_BLOCK BC4_UNORM_BLOCK BC4_SNORM_BLOCK BC5_UNORM_BLOCK BC5_SNORM_BLOCK "
    "BC6H_UFLOAT_BLOCK BC6H_SFLOAT_BLOCK BC7_UNORM_BLOCK BC7_SRGB_BLOCK ETC2_R8G8B8_UNORM_BLOCK "
    "ETC2_R8G8B8_SRGB_BLOCK ETC2_R8G8B8A1_UNORM_BLOCK ETC2_R8G8B8A1_SRGB_BLOCK ETC2_R8G8B8A8_UNORM_BLOCK "
    "ETC2_R8G8B8A8_SRGB_BLOCK EAC_R11_UNORM_BLOCK EAC_R11_SNORM_BLOCK EAC_R11G11_UNORM_BLOCK "
    "EAC_R11G11_SNORM_BLOCK ASTC_4x4_UNORM_BLOCK ASTC_4x4_SRGB_BLOCK ASTC_5x4_UNORM_BLOCK "
    "ASTC_5x4_SRGB_BLOCK ASTC_5x5_UNORM_BLOCK ASTC_5x5_SRGB_BLOCK ASTC_6x5_UNORM_BLOCK "
    "ASTC_6x5_SRGB_BLOCK ASTC_6x6_UNORM_BLOCK ASTC_6x6_SRGB_BLOCK ASTC_8x5_UNORM_BLOCK "
    "ASTC_8x5_SRGB_BLOCK ASTC_8x6_UNORM_BLOCK ASTC_8x6_SRGB_BLOCK ASTC_8x8_UNORM_BLOCK "
    "ASTC_8x8_SRGB_BLOCK ASTC_10x5_UNORM_BLOCK ASTC_10x5_SRGB_BLOCK ASTC_10x6_UNORM_BLOCK "
    "ASTC_10x6_SRGB_BLOCK ASTC_10x8_UNORM_BLOCK ASTC_10x8_SRGB_BLOCK ASTC_10x10_UNORM_BLOCK "
    "ASTC_10x10_SRGB_BLOCK ASTC_12x10_UNORM_BLOCK ASTC_12x10_SRGB_BLOCK ASTC_12x12_UNORM_BLOCK "
    "ASTC_12x12_SRGB_BLOCK";

}  // namespace

std::size_t TexelFormat::bytes() const {
  return packed() ? 4 : channels.size() * size_of(type);
}

std::uint32_t TexelFormat::type_size() const {
  return packed() ? 4 : static_cast<std::uint32_t>(size_of(type));
}

const TexelFormat* find_format(std::uint32_t number) {
  const auto found =
      std::find_if(kRead.begin(), kRead.end(), [&](const auto& each) { return each.number == number; });
  return found == kRead.end() ? nullptr : &*found;
}

const TexelFormat& format_for(PixelType type) {
  constexpr std::uint32_t kHalfRgba = 97, kFloatRgba = 109, kB10G11R11 = 122, kE5B9G9R9 = 123;
  std::uint32_t number = kFloatRgba;
  if (type == PixelType::half) number = kHalfRgba;
  if (type == PixelType::r11g11b10) number = kB10G11R11;
  if (type == PixelType::rgb9e5) number = kE5B9G9R9;
  const TexelFormat* format = find_format(number);
  assert(format != nullptr && format->type == type);
  return *format;
}

std::string format_name(std::uint32_t number) {
  std::string_view names = kNames;
  for (std::uint32_t i = 0; !names.empty(); ++i) {
    const std::size_t end = std::min(names.find(' '), names.size());
    if (i == number) return "VK_FORMAT_" + std::string(names.substr(0, end));
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  return "VkFormat " + std::to_string(number);
}

}  // namespace welkin::io::ktx2
