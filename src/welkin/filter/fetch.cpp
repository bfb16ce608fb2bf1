#include "welkin/filter/fetch.h"

#include "welkin/base/cpu.h"

namespace welkin {

LevelView view_of(const Level& level) {
  const ImageView<const float> first = level.chart(0);
  return {first.data,    first.row_stride, level.chart_stride(), level.charts(),
          level.width(), level.height(),   level.channels()};
}

FetchKernels fetch_kernels(int channels) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return fetch_kernels_avx2(channels);
#endif
  return fetch_kernels_baseline(channels);
}

Fetch fetch_for(Filter filter, bool allow_ringing, int channels) {
  const FetchKernels kernels = fetch_kernels(channels);
  const auto choose = [&](const RingingFetch& kernel) {
    return allow_ringing ? kernel.unclamped : kernel.clamped;
  };
  switch (filter) {
    case Filter::nearest:
      return kernels.nearest;
    case Filter::bilinear:
      return kernels.bilinear;
    case Filter::lanczos:
      return choose(kernels.lanczos3);
    case Filter::automatic:
    case Filter::bicubic:
      break;
  }
  return choose(kernels.bicubic);
}

}  // namespace welkin
