// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/texture/bc6h_encoder_impl.h"

namespace welkin::texture::bc6h {

EncodeBlocks encoder_avx2() {
  return &Encoder<xsimd::fma3<xsimd::avx2>>::encode;
}

}  // namespace welkin::texture::bc6h
