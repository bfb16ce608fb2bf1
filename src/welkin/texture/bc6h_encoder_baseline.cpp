#include "welkin/texture/bc6h_encoder_impl.h"

namespace welkin::texture::bc6h {

EncodeBlocks encoder_baseline() {
  return &Encoder<xsimd::default_arch>::encode;
}

}  // namespace welkin::texture::bc6h
