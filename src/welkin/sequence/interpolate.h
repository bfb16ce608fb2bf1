#pragma once

#include "welkin/base/export.h"
#include "welkin/map/chain.h"

/// @file
/// Chains between two others.
namespace welkin {

/// (1 − t)·from + t·to, texel by texel at every level, for t in 0 … 1. Filtering is linear, so this is the
/// chain of the source interpolated the same way, within the tolerance of filtering. Borders too, so they are
/// filled where those of both are. Notes are those of `from`. Throws Error (mismatch) for chains of other
/// sizes, parameterizations, orientations or channels, (bad_request) for another t.
///
/// Source: Greene 1986, who makes the diffuse map of an animation every few frames and interpolates.
WELKIN_API Chain interpolated(const Chain& from, const Chain& to, double t);

}  // namespace welkin
