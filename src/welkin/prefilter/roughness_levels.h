#pragma once

#include <optional>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/lobe/roughness_curve.h"
#include "welkin/prefilter/prefilter.h"

/// @file
/// The levels of a chain over roughness.
namespace welkin {

/// The levels of a chain: `count` of them from `finest` down (chain_size), level k for the lobe at the
/// curve's roughness there. Where a named curve is below the lobe's least roughness, as `charlie` has one, it
/// is half of the next level's. Throws Error: a lobe without roughness, a list for another number of levels
/// or with a roughness below the lobe's least.
WELKIN_API std::vector<PrefilterLevel> roughness_levels(const lobe::AnyLobe& lobe,
                                                        const lobe::RoughnessCurve& curve, ChartSize finest,
                                                        int count);

/// The lobe's own roughness, or none where it has none: 1/exponent of phong.
WELKIN_API std::optional<double> roughness_of(const lobe::AnyLobe& lobe);

}  // namespace welkin
