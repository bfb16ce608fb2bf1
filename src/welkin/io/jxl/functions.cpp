#include "welkin/io/jxl/functions.h"

#include "welkin/base/late_library.h"

// Its interface changes with the minor version: the one whose headers this was compiled with is loaded.
#define WELKIN_TEXT_OF(NUMBER) #NUMBER
#define WELKIN_VERSION(MAJOR, MINOR) WELKIN_TEXT_OF(MAJOR) "." WELKIN_TEXT_OF(MINOR)
#define WELKIN_LIBJXL_VERSION WELKIN_VERSION(JPEGXL_MAJOR_VERSION, JPEGXL_MINOR_VERSION)

namespace welkin::io {

const Libjxl& libjxl() {
  static const Libjxl loaded = [] {
    const LateLibrary file("libjxl.so." WELKIN_LIBJXL_VERSION, "libjxl" WELKIN_LIBJXL_VERSION,
                           "reads such files");
    Libjxl functions;
#define WELKIN_FIND(NAME) file.find(#NAME, functions.NAME);
    WELKIN_LIBJXL_FUNCTIONS(WELKIN_FIND)
#undef WELKIN_FIND
    return functions;
  }();
  return loaded;
}

}  // namespace welkin::io
