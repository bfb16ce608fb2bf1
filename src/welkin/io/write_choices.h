#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/io/image_file.h"

/// What a writer is asked for, checked against what its format can hold. All throw Error naming the format.
namespace welkin::io {

/// The only part, for formats that hold one picture.
const WritePart& only_part(std::span<const WritePart> parts, std::string_view format);

/// Throws unless both sides are at most `largest`.
void check_sides(const WritePart& part, int largest, std::string_view format);

/// Whether a format has an alpha channel.
enum class Alpha { none, allowed };

/// Which of the part's channels are stored, in the order Y, Y A, R G B or R G B A. A single channel of any
/// name is grey.
std::vector<int> channel_order(const WritePart& part, Alpha alpha, std::string_view format);

/// Whether the part's channels are R and G alone, in either order: textures of two channels.
bool is_red_green(const WritePart& part);
/// Which of them are R and G.
std::vector<int> red_green_order(const WritePart& part);

/// The type asked for, which must be one of `known`; the first of them by default.
PixelType pixel_type(const WriteOptions& options, std::span<const PixelType> known, std::string_view format);

/// The compression asked for, which must be one of `known`; the first of them by default.
std::string compression(const WriteOptions& options, std::span<const std::string> known,
                        std::string_view format);

/// WriteOptions::quality, which must be in 1…100.
int checked_quality(const WriteOptions& options);

/// The colour asked for; automatic is sRGB for 8 and 16 bits, linear for all others.
Colour colour_for(PixelType type, Colour asked);

}  // namespace welkin::io
