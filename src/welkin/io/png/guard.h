#pragma once

#include <png.h>

#include <csetjmp>
#include <cstdio>

namespace welkin::io {

/// The text of libpng's last error. libpng leaves a failing function by longjmp, which would skip C++
/// destructors.
struct PngFailure {
  char text[200] = {};
};

/// The error function of libpng, with a PngFailure as its pointer.
inline void fail_png(png_structp png, png_const_charp text) {
  auto* failure = static_cast<PngFailure*>(png_get_error_ptr(png));
  std::snprintf(failure->text, sizeof failure->text, "%s", text);
  png_longjmp(png, 1);
}

inline void ignore_png_warning(png_structp, png_const_charp) {}

/// Calls libpng inside `call`; false if it failed. `call` must hold no object with a destructor: it may be
/// left halfway.
template <class Call>
bool guarded_png(png_structp png, Call call) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  call();
  return true;
}

}  // namespace welkin::io
