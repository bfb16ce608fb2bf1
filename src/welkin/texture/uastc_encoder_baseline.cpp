#include "welkin/texture/uastc_encoder_impl.h"

namespace welkin::texture::uastc {

EncodeBlocks encoder_baseline() {
  return &Encoder<xsimd::default_arch>::encode;
}

}  // namespace welkin::texture::uastc
