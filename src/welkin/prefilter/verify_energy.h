#pragma once

#include <optional>
#include <span>
#include <vector>

#include "welkin/prefilter/verify.h"

/// Energy of pre-filtered maps. Internal to prefilter.
///
/// A level is a function that is known at its texels, and these may be six. So the function is computed again
/// by a plan of the same options, where its integral is a sum:
///   - A lobe that a lat-long grid resolves: at the N×2N points of Fejér's first rule, which is exact for
///     harmonics below degree N; N = 16/width is beyond where lobes have anything left (at the horizon, where
///     they may have a kink, λ_l falls with l^−2.5, and N is at least 192). Error 1e-6.
///   - A narrower one: at the source's own texels, weighted by solid angle. These texels are also what the
///     light comes from: Σ_i Ω_i ∫_texel w(r_i·l) dω is the texel's own solid angle for a lobe far narrower
///     than a texel, and on an even lattice for every lobe, as the texels tile it. Error 1e-5 where the
///     texels' sizes vary slowly.
/// The second needs a source of the whole sphere, for light spills over the edge of one that shows a part.
namespace welkin::prefilter {

/// ∫ of each channel of each lobe's level, for LobeScale::average; none where neither rule holds, and of
/// mirrors.
std::vector<std::optional<std::vector<double>>> integrals_of_levels(const Map& source,
                                                                    std::span<const lobe::AnyLobe> lobes,
                                                                    const VerifyOptions& options);

/// ∫ map dω, texel by texel.
std::vector<double> integral_of_texels(const Map& map);
/// ∫ |map| dω.
std::vector<double> integral_of_magnitudes(const Map& map);

}  // namespace welkin::prefilter
