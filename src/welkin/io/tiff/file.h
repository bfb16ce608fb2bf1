#pragma once

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <string>

namespace welkin::io {

/// libtiff's errors, kept instead of printed: the first error since it was last cleared.
struct TiffFailure {
  char text[300] = {};

  void clear() { text[0] = 0; }

  static int keep(TIFF*, void* self, const char* module, const char* format, va_list arguments) {
    auto& failure = *static_cast<TiffFailure*>(self);
    if (failure.text[0] != 0) return 1;
    // Some modules are functions of libtiff, some the name that the file was opened by.
    const int used =
        module == nullptr ? 0 : std::snprintf(failure.text, sizeof failure.text / 3, "%.90s: ", module);
    std::vsnprintf(failure.text + used, sizeof failure.text - static_cast<std::size_t>(used), format,
                   arguments);
    return 1;
  }
  static int ignore(TIFF*, void*, const char*, const char*, va_list) { return 1; }
};

/// The five functions by which libtiff reaches a file, and their argument.
struct TiffStream {
  thandle_t handle;
  TIFFReadWriteProc read;
  TIFFReadWriteProc write;
  TIFFSeekProc seek;
  TIFFSizeProc size;
  TIFFMapFileProc map;
};

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffHandle = std::unique_ptr<TIFF, CloseTiff>;

/// No allocation of libtiff's own passes `max_memory` bytes. Null when libtiff cannot open it; `failure`,
/// which must outlive the handle, then says why.
inline TiffHandle open_tiff_stream(const TiffStream& stream, const char* mode, std::uint64_t max_memory,
                                   TiffFailure& failure) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (options == nullptr) throw std::bad_alloc();
  constexpr std::uint64_t kMaxAllocation = std::numeric_limits<tmsize_t>::max();
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(),
                                      static_cast<tmsize_t>(std::min(max_memory, kMaxAllocation)));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), TiffFailure::keep, &failure);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), TiffFailure::ignore, nullptr);
  return TiffHandle(TIFFClientOpenExt(
      "TIFF", mode, stream.handle, stream.read, stream.write, stream.seek, [](thandle_t) { return 0; },
      stream.size, stream.map, [](thandle_t, void*, toff_t) {}, options.get()));
}

}  // namespace welkin::io
