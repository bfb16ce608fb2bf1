#include "welkin/base/version.h"

namespace welkin {

std::string_view version() {
  return WELKIN_VERSION;
}

}  // namespace welkin
