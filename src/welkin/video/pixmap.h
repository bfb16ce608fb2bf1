#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "welkin/image/image.h"
#include "welkin/io/image_file.h"
#include "welkin/video/stream_info.h"

/// Portable pixmaps and float maps, one after another. Source: Netpbm, ppm(5), pgm(5), pfm(5).
namespace welkin::video {

/// Header of one frame, and how its values are stored.
struct PixmapHeader {
  StreamInfo info;
  bool little_endian = false;  ///< of floats
};

/// The next byte of a stream, or none at its end.
using NextByte = std::function<std::optional<unsigned char>()>;

/// What follows the two characters `magic` of a frame. Throws Error without the stream's name.
PixmapHeader read_pixmap_header(char kind, const NextByte& next);

std::size_t pixmap_bytes(const PixmapHeader& header);

void decode_pixmap(const PixmapHeader& header, const StreamColour& colour, std::span<const std::byte> stored,
                   ImageView<float> out);

/// What stands before a frame's pixels.
std::string pixmap_header(const StreamInfo& info);

/// A frame with its header.
io::WriteReport encode_pixmap(const StreamInfo& info, const StreamColour& colour,
                              ImageView<const float> frame, std::vector<std::byte>& stored);

}  // namespace welkin::video
