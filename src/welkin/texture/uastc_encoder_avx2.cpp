// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/texture/uastc_encoder_impl.h"

namespace welkin::texture::uastc {

EncodeBlocks encoder_avx2() {
  return &Encoder<xsimd::fma3<xsimd::avx2>>::encode;
}

}  // namespace welkin::texture::uastc
