#include "welkin/map/fetch.h"

#include "welkin/base/cpu.h"
#include "welkin/map/area.h"

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

AreaMean area_mean(int channels) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return area_mean_avx2(channels);
#endif
  return area_mean_baseline(channels);
}

}  // namespace welkin
