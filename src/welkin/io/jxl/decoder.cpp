#include "welkin/io/jxl/decoder.h"

#include <jxl/parallel_runner.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "welkin/base/error.h"

namespace welkin::io {
namespace {

/// A JxlParallelRunner. No exception passes through libjxl's frames.
JxlParallelRetCode run_on_tbb(void* /*runner*/, void* jxl, JxlParallelRunInit init,
                              JxlParallelRunFunction run, std::uint32_t begin, std::uint32_t end) noexcept {
  if (begin == end) return 0;
  const int threads = tbb::this_task_arena::max_concurrency();
  if (const JxlParallelRetCode refused = init(jxl, static_cast<std::size_t>(threads)); refused != 0)
    return refused;
  try {
    tbb::parallel_for(begin, end, [&](std::uint32_t i) {
      run(jxl, i, static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
    });
    return 0;
  } catch (...) {
    return JXL_PARALLEL_RET_RUNNER_ERROR;
  }
}

}  // namespace

JxlFile::JxlFile(const Source& source, int events)
    : name_(source.name), decoder_(libjxl().JxlDecoderCreate(nullptr), libjxl().JxlDecoderDestroy) {
  if (decoder_ == nullptr) throw std::bad_alloc();
  const bool set =
      libjxl().JxlDecoderSetParallelRunner(get(), run_on_tbb, nullptr) == JXL_DEC_SUCCESS &&
      libjxl().JxlDecoderSubscribeEvents(get(), events) == JXL_DEC_SUCCESS &&
      libjxl().JxlDecoderSetDecompressBoxes(get(), JXL_TRUE) == JXL_DEC_SUCCESS &&
      libjxl().JxlDecoderSetInput(get(), reinterpret_cast<const std::uint8_t*>(source.bytes.data()),
                                  source.bytes.size()) == JXL_DEC_SUCCESS;
  if (!set) throw Error(ErrorKind::unsupported, name_, "libjxl is built without what is needed to read it");
  // libjxl needs to know the end of a last box. Otherwise it is left open, because libjxl prints what it
  // finds missing before the end of a closed one.
  if ((events & JXL_DEC_BOX) != 0) libjxl().JxlDecoderCloseInput(get());
}

JxlDecoderStatus JxlFile::next() {
  const JxlDecoderStatus status = libjxl().JxlDecoderProcessInput(get());
  if (status == JXL_DEC_ERROR) fail("the JPEG XL data is malformed");
  if (status == JXL_DEC_NEED_MORE_INPUT) fail("ends early");
  return status;
}

void JxlFile::fail(const char* cause) const {
  throw Error(ErrorKind::damaged, name_, cause);
}

}  // namespace welkin::io
