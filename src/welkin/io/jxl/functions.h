#pragma once

#include <jxl/decode.h>

namespace welkin::io {

/// The functions of libjxl that are called, by one list.
#define WELKIN_LIBJXL_FUNCTIONS(EACH)      \
  EACH(JxlDecoderCloseInput)               \
  EACH(JxlDecoderCreate)                   \
  EACH(JxlDecoderDestroy)                  \
  EACH(JxlDecoderGetBasicInfo)             \
  EACH(JxlDecoderGetBoxType)               \
  EACH(JxlDecoderGetColorAsEncodedProfile) \
  EACH(JxlDecoderGetColorAsICCProfile)     \
  EACH(JxlDecoderGetExtraChannelInfo)      \
  EACH(JxlDecoderGetICCProfileSize)        \
  EACH(JxlDecoderProcessInput)             \
  EACH(JxlDecoderReleaseBoxBuffer)         \
  EACH(JxlDecoderSetBoxBuffer)             \
  EACH(JxlDecoderSetDecompressBoxes)       \
  EACH(JxlDecoderSetImageOutCallback)      \
  EACH(JxlDecoderSetInput)                 \
  EACH(JxlDecoderSetParallelRunner)        \
  EACH(JxlDecoderSetPreferredColorProfile) \
  EACH(JxlDecoderSubscribeEvents)

/// libjxl, loaded: `libjxl().JxlDecoderProcessInput(…)`.
struct Libjxl {
#define WELKIN_MEMBER(NAME) decltype(&::NAME) NAME = nullptr;
  WELKIN_LIBJXL_FUNCTIONS(WELKIN_MEMBER)
#undef WELKIN_MEMBER
};

/// Loads it at the first call; from any thread. Throws Error (unsupported), as LateLibrary does.
const Libjxl& libjxl();

}  // namespace welkin::io
