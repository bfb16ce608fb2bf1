#include "welkin/io/texels/format_names.h"

#include <algorithm>
#include <string_view>

namespace welkin::io::texels {
namespace {

/// Consecutive formats, without their common `VK_FORMAT_`.
struct Names {
  std::uint32_t first;
  std::string_view names;
};

constexpr Names kNames[] = {
    {0,
     "UNDEFINED R4G4_UNORM_PACK8 R4G4B4A4_UNORM_PACK16 B4G4R4A4_UNORM_PACK16 R5G6B5_UNORM_PACK16 "
     "B5G6R5_UNORM_PACK16 R5G5B5A1_UNORM_PACK16 B5G5R5A1_UNORM_PACK16 A1R5G5B5_UNORM_PACK16 R8_UNORM "
     "R8_SNORM R8_USCALED R8_SSCALED R8_UINT R8_SINT R8_SRGB R8G8_UNORM R8G8_SNORM R8G8_USCALED "
     "R8G8_SSCALED R8G8_UINT R8G8_SINT R8G8_SRGB R8G8B8_UNORM R8G8B8_SNORM R8G8B8_USCALED "
     "R8G8B8_SSCALED R8G8B8_UINT R8G8B8_SINT R8G8B8_SRGB B8G8R8_UNORM B8G8R8_SNORM B8G8R8_USCALED "
     "B8G8R8_SSCALED B8G8R8_UINT B8G8R8_SINT B8G8R8_SRGB R8G8B8A8_UNORM R8G8B8A8_SNORM "
     "R8G8B8A8_USCALED R8G8B8A8_SSCALED R8G8B8A8_UINT R8G8B8A8_SINT R8G8B8A8_SRGB B8G8R8A8_UNORM "
     "B8G8R8A8_SNORM B8G8R8A8_USCALED B8G8R8A8_SSCALED B8G8R8A8_UINT B8G8R8A8_SINT B8G8R8A8_SRGB "
     "A8B8G8R8_UNORM_PACK32 A8B8G8R8_SNORM_PACK32 A8B8G8R8_USCALED_PACK32 A8B8G8R8_SSCALED_PACK32 "
     "A8B8G8R8_UINT_PACK32 A8B8G8R8_SINT_PACK32 A8B8G8R8_SRGB_PACK32 A2R10G10B10_UNORM_PACK32 "
     "A2R10G10B10_SNORM_PACK32 A2R10G10B10_USCALED_PACK32 A2R10G10B10_SSCALED_PACK32 "
     "A2R10G10B10_UINT_PACK32 A2R10G10B10_SINT_PACK32 A2B10G10R10_UNORM_PACK32 "
     "A2B10G10R10_SNORM_PACK32 A2B10G10R10_USCALED_PACK32 A2B10G10R10_SSCALED_PACK32 "
     "A2B10G10R10_UINT_PACK32 A2B10G10R10_SINT_PACK32 R16_UNORM R16_SNORM R16_USCALED R16_SSCALED "
     "R16_UINT R16_SINT R16_SFLOAT R16G16_UNORM R16G16_SNORM R16G16_USCALED R16G16_SSCALED "
     "R16G16_UINT R16G16_SINT R16G16_SFLOAT R16G16B16_UNORM R16G16B16_SNORM R16G16B16_USCALED "
     "R16G16B16_SSCALED R16G16B16_UINT R16G16B16_SINT R16G16B16_SFLOAT R16G16B16A16_UNORM "
     "R16G16B16A16_SNORM R16G16B16A16_USCALED R16G16B16A16_SSCALED R16G16B16A16_UINT "
     "R16G16B16A16_SINT R16G16B16A16_SFLOAT R32_UINT R32_SINT R32_SFLOAT R32G32_UINT R32G32_SINT "
     "R32G32_SFLOAT R32G32B32_UINT R32G32B32_SINT R32G32B32_SFLOAT R32G32B32A32_UINT "
     "R32G32B32A32_SINT R32G32B32A32_SFLOAT R64_UINT R64_SINT R64_SFLOAT R64G64_UINT R64G64_SINT "
     "R64G64_SFLOAT R64G64B64_UINT R64G64B64_SINT R64G64B64_SFLOAT R64G64B64A64_UINT "
     "R64G64B64A64_SINT R64G64B64A64_SFLOAT B10G11R11_UFLOAT_PACK32 E5B9G9R9_UFLOAT_PACK32 D16_UNORM "
     "X8_D24_UNORM_PACK32 D32_SFLOAT S8_UINT D16_UNORM_S8_UINT D24_UNORM_S8_UINT D32_SFLOAT_S8_UINT "
     "BC1_RGB_UNORM_BLOCK BC1_RGB_SRGB_BLOCK BC1_RGBA_UNORM_BLOCK BC1_RGBA_SRGB_BLOCK "
     "BC2_UNORM_BLOCK BC2_SRGB_BLOCK BC3_UNORM_BLOCK BC3_SRGB_BLOCK BC4_UNORM_BLOCK BC4_SNORM_BLOCK "
     "BC5_UNORM_BLOCK BC5_SNORM_BLOCK BC6H_UFLOAT_BLOCK BC6H_SFLOAT_BLOCK BC7_UNORM_BLOCK "
     "BC7_SRGB_BLOCK ETC2_R8G8B8_UNORM_BLOCK ETC2_R8G8B8_SRGB_BLOCK ETC2_R8G8B8A1_UNORM_BLOCK "
     "ETC2_R8G8B8A1_SRGB_BLOCK ETC2_R8G8B8A8_UNORM_BLOCK ETC2_R8G8B8A8_SRGB_BLOCK "
     "EAC_R11_UNORM_BLOCK EAC_R11_SNORM_BLOCK EAC_R11G11_UNORM_BLOCK EAC_R11G11_SNORM_BLOCK "
     "ASTC_4x4_UNORM_BLOCK ASTC_4x4_SRGB_BLOCK ASTC_5x4_UNORM_BLOCK ASTC_5x4_SRGB_BLOCK "
     "ASTC_5x5_UNORM_BLOCK ASTC_5x5_SRGB_BLOCK ASTC_6x5_UNORM_BLOCK ASTC_6x5_SRGB_BLOCK "
     "ASTC_6x6_UNORM_BLOCK ASTC_6x6_SRGB_BLOCK ASTC_8x5_UNORM_BLOCK ASTC_8x5_SRGB_BLOCK "
     "ASTC_8x6_UNORM_BLOCK ASTC_8x6_SRGB_BLOCK ASTC_8x8_UNORM_BLOCK ASTC_8x8_SRGB_BLOCK "
     "ASTC_10x5_UNORM_BLOCK ASTC_10x5_SRGB_BLOCK ASTC_10x6_UNORM_BLOCK ASTC_10x6_SRGB_BLOCK "
     "ASTC_10x8_UNORM_BLOCK ASTC_10x8_SRGB_BLOCK ASTC_10x10_UNORM_BLOCK ASTC_10x10_SRGB_BLOCK "
     "ASTC_12x10_UNORM_BLOCK ASTC_12x10_SRGB_BLOCK ASTC_12x12_UNORM_BLOCK ASTC_12x12_SRGB_BLOCK"},
    {1000054000,
     "PVRTC1_2BPP_UNORM_BLOCK_IMG PVRTC1_4BPP_UNORM_BLOCK_IMG PVRTC2_2BPP_UNORM_BLOCK_IMG "
     "PVRTC2_4BPP_UNORM_BLOCK_IMG PVRTC1_2BPP_SRGB_BLOCK_IMG PVRTC1_4BPP_SRGB_BLOCK_IMG "
     "PVRTC2_2BPP_SRGB_BLOCK_IMG PVRTC2_4BPP_SRGB_BLOCK_IMG"},
    {1000066000,
     "ASTC_4x4_SFLOAT_BLOCK ASTC_5x4_SFLOAT_BLOCK ASTC_5x5_SFLOAT_BLOCK ASTC_6x5_SFLOAT_BLOCK "
     "ASTC_6x6_SFLOAT_BLOCK ASTC_8x5_SFLOAT_BLOCK ASTC_8x6_SFLOAT_BLOCK ASTC_8x8_SFLOAT_BLOCK "
     "ASTC_10x5_SFLOAT_BLOCK ASTC_10x6_SFLOAT_BLOCK ASTC_10x8_SFLOAT_BLOCK ASTC_10x10_SFLOAT_BLOCK "
     "ASTC_12x10_SFLOAT_BLOCK ASTC_12x12_SFLOAT_BLOCK"},
    {1000156000,
     "G8B8G8R8_422_UNORM B8G8R8G8_422_UNORM G8_B8_R8_3PLANE_420_UNORM G8_B8R8_2PLANE_420_UNORM "
     "G8_B8_R8_3PLANE_422_UNORM G8_B8R8_2PLANE_422_UNORM G8_B8_R8_3PLANE_444_UNORM "
     "R10X6_UNORM_PACK16 R10X6G10X6_UNORM_2PACK16 R10X6G10X6B10X6A10X6_UNORM_4PACK16 "
     "G10X6B10X6G10X6R10X6_422_UNORM_4PACK16 B10X6G10X6R10X6G10X6_422_UNORM_4PACK16 "
     "G10X6_B10X6_R10X6_3PLANE_420_UNORM_3PACK16 G10X6_B10X6R10X6_2PLANE_420_UNORM_3PACK16 "
     "G10X6_B10X6_R10X6_3PLANE_422_UNORM_3PACK16 G10X6_B10X6R10X6_2PLANE_422_UNORM_3PACK16 "
     "G10X6_B10X6_R10X6_3PLANE_444_UNORM_3PACK16 R12X4_UNORM_PACK16 R12X4G12X4_UNORM_2PACK16 "
     "R12X4G12X4B12X4A12X4_UNORM_4PACK16 G12X4B12X4G12X4R12X4_422_UNORM_4PACK16 "
     "B12X4G12X4R12X4G12X4_422_UNORM_4PACK16 G12X4_B12X4_R12X4_3PLANE_420_UNORM_3PACK16 "
     "G12X4_B12X4R12X4_2PLANE_420_UNORM_3PACK16 G12X4_B12X4_R12X4_3PLANE_422_UNORM_3PACK16 "
     "G12X4_B12X4R12X4_2PLANE_422_UNORM_3PACK16 G12X4_B12X4_R12X4_3PLANE_444_UNORM_3PACK16 "
     "G16B16G16R16_422_UNORM B16G16R16G16_422_UNORM G16_B16_R16_3PLANE_420_UNORM "
     "G16_B16R16_2PLANE_420_UNORM G16_B16_R16_3PLANE_422_UNORM G16_B16R16_2PLANE_422_UNORM "
     "G16_B16_R16_3PLANE_444_UNORM"},
    {1000288000,
     "ASTC_3x3x3_UNORM_BLOCK_EXT ASTC_3x3x3_SRGB_BLOCK_EXT ASTC_3x3x3_SFLOAT_BLOCK_EXT "
     "ASTC_4x3x3_UNORM_BLOCK_EXT ASTC_4x3x3_SRGB_BLOCK_EXT ASTC_4x3x3_SFLOAT_BLOCK_EXT "
     "ASTC_4x4x3_UNORM_BLOCK_EXT ASTC_4x4x3_SRGB_BLOCK_EXT ASTC_4x4x3_SFLOAT_BLOCK_EXT "
     "ASTC_4x4x4_UNORM_BLOCK_EXT ASTC_4x4x4_SRGB_BLOCK_EXT ASTC_4x4x4_SFLOAT_BLOCK_EXT "
     "ASTC_5x4x4_UNORM_BLOCK_EXT ASTC_5x4x4_SRGB_BLOCK_EXT ASTC_5x4x4_SFLOAT_BLOCK_EXT "
     "ASTC_5x5x4_UNORM_BLOCK_EXT ASTC_5x5x4_SRGB_BLOCK_EXT ASTC_5x5x4_SFLOAT_BLOCK_EXT "
     "ASTC_5x5x5_UNORM_BLOCK_EXT ASTC_5x5x5_SRGB_BLOCK_EXT ASTC_5x5x5_SFLOAT_BLOCK_EXT "
     "ASTC_6x5x5_UNORM_BLOCK_EXT ASTC_6x5x5_SRGB_BLOCK_EXT ASTC_6x5x5_SFLOAT_BLOCK_EXT "
     "ASTC_6x6x5_UNORM_BLOCK_EXT ASTC_6x6x5_SRGB_BLOCK_EXT ASTC_6x6x5_SFLOAT_BLOCK_EXT "
     "ASTC_6x6x6_UNORM_BLOCK_EXT ASTC_6x6x6_SRGB_BLOCK_EXT ASTC_6x6x6_SFLOAT_BLOCK_EXT"},
    {1000330000,
     "G8_B8R8_2PLANE_444_UNORM G10X6_B10X6R10X6_2PLANE_444_UNORM_3PACK16 "
     "G12X4_B12X4R12X4_2PLANE_444_UNORM_3PACK16 G16_B16R16_2PLANE_444_UNORM"},
    {1000340000, "A4R4G4B4_UNORM_PACK16 A4B4G4R4_UNORM_PACK16"},
    {1000464000, "R16G16_SFIXED5_NV"},
    {1000470000, "A1B5G5R5_UNORM_PACK16 A8_UNORM"},
};

/// Without its `VK_FORMAT_`; empty where it has none.
std::string_view short_name(std::uint32_t number) {
  for (const Names& each : kNames) {
    if (number < each.first) continue;
    std::string_view names = each.names;
    for (std::uint32_t i = each.first; !names.empty(); ++i) {
      const std::size_t end = std::min(names.find(' '), names.size());
      if (i == number) return names.substr(0, end);
      names.remove_prefix(std::min(end + 1, names.size()));
    }
  }
  return {};
}

/// What a word in a format's name says of all formats that have it. The first that fits is told.
struct Family {
  std::string_view word;
  std::string_view is;
  std::string_view remedy;
};

constexpr std::string_view kDecompress =
    "decompress it to R16G16B16A16_SFLOAT or R8G8B8A8_SRGB, for instance by PVRTexTool";
constexpr std::string_view kSfloat = "make it one of R16G16B16A16_SFLOAT or R8G8B8A8_SRGB";

constexpr Family kFamilies[] = {
    {"BC", "compressed blocks (BC, S3TC)", kDecompress},
    {"ETC2_", "compressed blocks (ETC2)", kDecompress},
    {"EAC_", "compressed blocks (EAC)", kDecompress},
    {"PVRTC", "compressed blocks (PVRTC)", kDecompress},
    {"SFLOAT_BLOCK", "blocks of HDR colours (ASTC HDR of other than 4×4 texels)", kDecompress},
    {"ASTC_", "compressed blocks (ASTC)", kDecompress},
    {"PLANE_", "a video's planes of Y′CbCr", kSfloat},
    {"_422_", "a video's Y′CbCr", kSfloat},
    {"D16_", "depth", "name a texture of colours"},
    {"D24_", "depth", "name a texture of colours"},
    {"D32_", "depth", "name a texture of colours"},
    {"S8_", "a stencil", "name a texture of colours"},
    {"UINT", "whole numbers, which are no radiance", "make it one of UNORM or SFLOAT"},
    {"SINT", "whole numbers, which are no radiance", "make it one of SNORM or SFLOAT"},
    {"USCALED", "scaled whole numbers, which KTX2 forbids", "make it one of UNORM or SFLOAT"},
    {"SSCALED", "scaled whole numbers, which KTX2 forbids", "make it one of SNORM or SFLOAT"},
};

constexpr std::string_view kTranscode =
    "make it readable by `ktx transcode --target rgba8 IN OUT` of Khronos's KTX-Software";

std::string refusal_of_basis(std::uint32_t colour_model) {
  constexpr std::uint32_t kEtc1s = 163, kUastc = 166, kUastcHdr6x6 = 168;
  switch (colour_model) {
    case kEtc1s:
      return refusal_of_basis_lz();
    case kUastc:
      return "texels of Basis Universal (UASTC) are not read; " + std::string(kTranscode);
    case kUastcHdr6x6:
      return "texels of Basis Universal (UASTC HDR 6×6) are not read; unpack it to EXR by `basisu -unpack`, "
             "or "
             "make it UASTC HDR 4×4, which is read";
    default:
      return "texels of VK_FORMAT_UNDEFINED, which only their descriptor describes, are not read; " +
             std::string(kSfloat);
  }
}

}  // namespace

std::string format_name(std::uint32_t number) {
  const std::string_view name = short_name(number);
  return name.empty() ? "a VkFormat that has no name here" : "VK_FORMAT_" + std::string(name);
}

std::string refusal_of_basis_lz() {
  return "texels of Basis Universal (ETC1S, supercompressed by BasisLZ) are not read; " +
         std::string(kTranscode);
}

std::string refusal_of(std::uint32_t number, std::uint32_t colour_model) {
  if (number == 0) return refusal_of_basis(colour_model);
  const std::string_view name = short_name(number);
  const std::string texels = "texels of " + format_name(number);
  for (const Family& family : kFamilies) {
    if (name.find(family.word) == std::string_view::npos) continue;
    return texels + ", " + std::string(family.is) + ", are not read; " + std::string(family.remedy);
  }
  return texels + " are not read; " + std::string(kSfloat);
}

}  // namespace welkin::io::texels
