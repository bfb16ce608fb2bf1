#pragma once

// libjpeg's header needs these two first.
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <csetjmp>

namespace welkin::io {

/// libjpeg's error manager, which leaves a failing function by longjmp (skipping C++ destructors) after
/// keeping the text.
struct JpegFailure {
  jpeg_error_mgr manager;
  jmp_buf jump;
  char text[JMSG_LENGTH_MAX] = {};

  JpegFailure() { jpeg_std_error(&manager); }
};

/// The error_exit of a JpegFailure.
[[noreturn]] inline void fail_jpeg(j_common_ptr codec) {
  auto* failure = reinterpret_cast<JpegFailure*>(codec->err);
  codec->err->format_message(codec, failure->text);
  std::longjmp(failure->jump, 1);
}

/// Calls libjpeg inside `call`; false if it failed. `call` must hold no object with a destructor: it may be
/// left halfway.
template <class Call>
bool guarded_jpeg(JpegFailure& failure, Call call) {
  if (setjmp(failure.jump) != 0) return false;
  call();
  return true;
}

}  // namespace welkin::io
