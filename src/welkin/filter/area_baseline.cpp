#include "welkin/filter/area_impl.h"

namespace welkin {

AreaMean area_mean_baseline(int channels) {
  return area_mean_of<xsimd::default_arch, BaselineFour>(channels);
}

}  // namespace welkin
