#include "welkin/io/heif/functions.h"

#include "welkin/base/late_library.h"

namespace welkin::io::heif {

const Libheif& libheif() {
  static const Libheif loaded = [] {
    const LateLibrary file("libheif.so.1", "libheif1", "reads such files");
    Libheif functions;
#define WELKIN_FIND(NAME) file.find(#NAME, functions.NAME);
    WELKIN_LIBHEIF_FUNCTIONS(WELKIN_FIND)
#undef WELKIN_FIND
    return functions;
  }();
  return loaded;
}

}  // namespace welkin::io::heif
