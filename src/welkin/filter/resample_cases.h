#pragma once

#include "welkin/filter/resample.h"
#include "welkin/map/map_cases.h"

namespace welkin::cases {

inline ResampleOptions with(Filter filter) {
  ResampleOptions options;
  options.filter = filter;
  return options;
}

}  // namespace welkin::cases
