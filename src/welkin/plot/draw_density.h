#pragma once

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/measure/density.h"

/// @file
/// Pictures of texels' solid angles.
namespace welkin {

/// The solid angle per texel over the average as a picture of the charts side by side, 2 texels apart, on
/// white: a colour scale over its binary logarithm, dark violet at a quarter of the average (finely sampled),
/// light yellow at four times it (coarsely sampled) and beyond; contour lines at whole octaves, the average's
/// own the widest; grey outside the valid domain. Below is the scale with ticks at ¼ ½ 1 2 4. After
/// Engelhardt & Dachsbacher 2008, fig. 5.
///
/// Linear sRGB. The charts are as large as those of the report, which density_of made of the
/// parameterization.
WELKIN_API Image draw_density(const sphere::AnyParameterization& parameterization,
                              const DensityReport& report);

}  // namespace welkin
