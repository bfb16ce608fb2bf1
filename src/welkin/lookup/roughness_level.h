#pragma once

#include <span>

#include "welkin/base/export.h"
#include "welkin/map/chain.h"

/// @file
/// Which level of a pre-filtered chain a surface reads: blurry reflections by mip level.
///
/// Of a whole object, one level for all directions; of a surface whose roughness changes, one for each:
///
///     sampler.look_up(directions, radiance, level_of_roughness(notes, 0.3));
///     levels_of_roughness(notes, roughness, levels);
///     sampler.look_up(directions, radiance, levels);
///
/// A chain that was pre-filtered for a lobe needs no cone: its levels are exact (prefilter/bake.h). A plain
/// map is looked up over cones that the lobe widens: `blurred(cone, lobe_sigma_of(lobe))` (cone_shapes.h).
namespace welkin {

/// The level, real, where a chain's noted roughness, linear between levels, is `roughness`; the first where
/// several have it, and the first or last where all are rougher or smoother. Throws Error (bad_request) for a
/// roughness that is not of 0 … 1, and for notes without roughness, or whose roughness falls.
WELKIN_API double level_of_roughness(const ChainNotes& notes, double roughness);

/// The same of each; there is room for as many levels. Throws the same, before anything is written.
WELKIN_API void levels_of_roughness(const ChainNotes& notes, std::span<const float> roughness,
                                    std::span<float> levels);

}  // namespace welkin
