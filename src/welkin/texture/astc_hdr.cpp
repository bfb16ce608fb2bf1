#include "welkin/texture/astc_hdr.h"

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/texture/astc_block.h"
#include "welkin/texture/uastc_encoder.h"

namespace welkin {
namespace {

using namespace texture;

uastc::Search search_of(TextureQuality quality) {
  switch (quality) {
    case TextureQuality::fast:
      return {1, false, 0, 2, 1, 0};
    case TextureQuality::normal:
      return {1, false, 1, 2, 2, 1};
    default:
      return {3, true, 1, 4, 2, 2};
  }
}

uastc::EncodeBlocks encoder() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return uastc::encoder_avx2();
#endif
  return uastc::encoder_baseline();
}

}  // namespace

std::size_t astc_bytes(int width, int height) {
  return bytes_of_blocks(width, height);
}

ClampedValues encode_uastc_hdr(ImageView<const float> picture, TextureQuality quality,
                               std::span<std::byte> blocks, const Monitor& monitor) {
  return encode_picture(
      picture,
      [search = search_of(quality), encode = encoder()](const std::uint16_t* halves, std::size_t count,
                                                        std::byte* bytes) {
        encode(halves, count, search, bytes);
      },
      blocks, monitor);
}

void decode_astc_hdr(std::span<const std::byte> blocks, ImageView<float> picture) {
  require(picture.channels == 3 || picture.channels == 4, "ASTC holds three channels or four");
  decode_picture(blocks, 4, &astc::decode, picture);
}

}  // namespace welkin
