#pragma once

#include <cstdint>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/map/map.h"

/// @file
/// Values that pre-filtering refuses.
namespace welkin {

/// Values of a map's valid texels that pre-filtering refuses, or that are suspicious.
struct SourceFaults {
  std::uint64_t not_finite = 0;  ///< texels with a value that is NaN or infinite
  std::uint64_t excessive = 0;   ///< texels with a value of over kMaxRadiance, either sign; besides those
  std::uint64_t negative = 0;    ///< texels with a value below 0, which are filtered; besides those
};

/// The largest magnitude that PrefilterPlan::run takes.
inline constexpr float kMaxRadiance = 1e30f;

/// Reads the charts once, at the speed of memory where there is nothing to find. Texels that are not valid
/// (AnyParameterization::valid) are ignored. Throws Cancelled.
WELKIN_API SourceFaults faults_of(const Map& map, const Monitor& monitor = {});

}  // namespace welkin
