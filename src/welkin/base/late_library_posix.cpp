#include <dlfcn.h>

#include <string>

#include "welkin/base/error.h"
#include "welkin/base/late_library.h"

namespace welkin {
namespace {

[[noreturn]] void fail(const std::string& what, const char* package) {
  const char* reason = ::dlerror();
  throw Error(ErrorKind::unsupported, what + (reason != nullptr ? " (" + std::string(reason) + ")" : "") +
                                          "; on Debian it comes with the package " + package);
}

}  // namespace

LateLibrary::LateLibrary(const char* file, const char* package, const char* purpose)
    : file_(file), package_(package), handle_(::dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr)
    fail("the library " + std::string(file) + ", which " + purpose + ", cannot be loaded", package);
}

void* LateLibrary::address_of(const char* name) const {
  void* address = ::dlsym(handle_, name);
  if (address == nullptr)
    fail("the library " + std::string(file_) + " is of another version, without " + name, package_);
  return address;
}

}  // namespace welkin
