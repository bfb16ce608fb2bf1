#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "welkin/io/image_file.h"
#include "welkin/io/texels/formats.h"
#include "welkin/io/texels/texels.h"

/// One picture of a texture ↔ its bytes: rows of texels, or rows of blocks, one behind the other.
namespace welkin::io::texels {

/// Rows as they are stored, of texels or of blocks.
int stored_rows(const TexelFormat& format, int height);
/// Bytes of such a row, tightly packed.
std::uint64_t row_bytes(const TexelFormat& format, int width);
/// Of all rows.
std::uint64_t picture_bytes(const TexelFormat& format, int width, int height);

/// A channel that isn't stored.
inline constexpr int kZero = -1, kOne = -2;

struct StoredPicture {
  const TexelFormat* format = nullptr;
  const std::byte* bytes = nullptr;
  std::size_t row_stride = 0;      ///< bytes from one stored row to the next
  Colour colour = Colour::linear;  ///< that is undone
  bool from_right = false;         ///< rows run from the right to the left
  bool from_bottom = false;        ///< the first row is the lowest
};

/// Decodes into `out`, of the picture's size. `channels`: indices into TexelFormat::channels, kZero or kOne.
void read_picture(const StoredPicture& picture, std::span<const int> channels, ImageView<float> out);

/// Encodes all rows to `out`, of picture_bytes.
WriteReport write_picture(const TexelEncoder& encoder, const TexelFormat& format,
                          ImageView<const float> picture, std::span<std::byte> out);

}  // namespace welkin::io::texels
