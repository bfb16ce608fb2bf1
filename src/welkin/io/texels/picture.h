#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// Writes pictures of the float types, for formats that cannot say that values are sRGB-encoded.
class PictureWriter {
 public:
  static constexpr PixelType kTypes[] = {PixelType::float32, PixelType::half, PixelType::rgb9e5,
                                         PixelType::r11g11b10, PixelType::bc6h};

  /// `title` is the format's, for messages. Throws Error for other types, and for sRGB.
  PictureWriter(const WriteOptions& options, std::string_view title);

  PixelType type() const { return type_; }
  const TexelFormat& format() const { return *format_; }

  /// All rows, tightly packed.
  WriteReport write(ByteSink& file, const WritePart& part);

 private:
  PixelType type_;
  const TexelFormat* format_;
  Colour colour_;
  TextureQuality quality_;
  std::string holder_;  ///< what holds only some channels, for messages
  std::vector<std::byte> bytes_;
};

}  // namespace welkin::io::texels
