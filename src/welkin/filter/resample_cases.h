#pragma once

#include "welkin/filter/resample.h"
#include "welkin/map/map_cases.h"

namespace welkin::cases {

/// A filter, and texels outside the valid ones left with the fill: filling borders changes those at a rim.
inline ResampleOptions with(Filter filter) {
  ResampleOptions options;
  options.filter = filter;
  options.borders = false;
  return options;
}

}  // namespace welkin::cases
