#include "welkin/texture/bc6h.h"

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/texture/bc6h_encoder.h"

namespace welkin {
namespace {

using namespace texture::bc6h;

Search search_of(TextureQuality quality) {
  switch (quality) {
    case TextureQuality::fast:
      return {1, 1, 1, false, false};
    case TextureQuality::normal:
      return {2, 1, 2, true, false};
    default:
      return {3, 1, 2, true, true};
  }
}

EncodeBlocks encoder() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return encoder_avx2();
#endif
  return encoder_baseline();
}

}  // namespace

std::size_t bc6h_bytes(int width, int height) {
  return texture::bytes_of_blocks(width, height);
}

ClampedValues encode_bc6h(ImageView<const float> picture, TextureQuality quality, std::span<std::byte> blocks,
                          const Monitor& monitor) {
  return texture::encode_picture(
      picture,
      [search = search_of(quality), encode = encoder()](const std::uint16_t* halves, std::size_t count,
                                                        std::byte* bytes) {
        encode(halves, count, search, bytes);
      },
      blocks, monitor);
}

void decode_bc6h(std::span<const std::byte> blocks, bool is_signed, ImageView<float> picture) {
  require(picture.channels == 3, "BC6H holds three channels");
  texture::decode_picture(
      blocks, 3,
      [is_signed](const std::byte* bytes, std::uint16_t* halves) { decode(bytes, is_signed, halves); },
      picture);
}

}  // namespace welkin
