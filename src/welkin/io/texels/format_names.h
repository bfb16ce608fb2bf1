#pragma once

#include <cstdint>
#include <string>

/// What texels that are not read are called, and what makes them readable.
namespace welkin::io::texels {

/// `VK_FORMAT_BC7_SRGB_BLOCK`; of one that has no name here, `a VkFormat that has no name here`.
std::string format_name(std::uint32_t number);

/// Why texels of a format that find_format doesn't know are not read, and what to do. `colour_model` is the
/// data format descriptor's, by which Basis Universal's textures differ: their VkFormat is 0.
std::string refusal_of(std::uint32_t number, std::uint32_t colour_model);

/// The same for the supercompression BasisLZ.
std::string refusal_of_basis_lz();

}  // namespace welkin::io::texels
