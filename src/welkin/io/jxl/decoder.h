#pragma once

#include <memory>

#include "welkin/io/format.h"
#include "welkin/io/jxl/functions.h"

namespace welkin::io {

/// libjxl's decoder over a whole file. Its threads are TBB's; the result doesn't depend on their number.
class JxlFile {
 public:
  /// `events` are JXL_DEC_… that `next` returns. JXL_DEC_BOX is for files whose boxes are complete.
  JxlFile(const Source& source, int events);

  /// The next event, or JXL_DEC_SUCCESS at the end. Throws Error (damaged) where there is none.
  JxlDecoderStatus next();

  JxlDecoder* get() const { return decoder_.get(); }

  [[noreturn]] void fail(const char* cause) const;

 private:
  std::string name_;
  std::unique_ptr<JxlDecoder, void (*)(JxlDecoder*)> decoder_;
};

}  // namespace welkin::io
