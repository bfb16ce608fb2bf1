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
///     harmonics below degree N. N = 16/width is beyond all coefficients but those of the kink at the
///     horizon; for these N is at least 256, and the grid is tilted, so that no row runs along the horizon of
///     lights overhead. Error 2e-5, mostly 1e-6.
///   - A narrower one: at the source's own texels, weighted by solid angle. These texels are also what the
///     light comes from. Σ_i Ω_i ∫_texel w(r_i·l) dω is the texel's own solid angle for a lobe far narrower
///     than a texel, and on an even lattice for every lobe, as the texels tile it. The remaining error comes
///     from the texels' uneven sizes, and falls with their square: 2e-3 for texels of 10°, 3e-6 for 0.35°.
///     About a pole of a lat-long there are few of them: where its rows resolve the lobe, they have Fejér's
///     weights.
/// The second needs a source of the whole sphere, for light spills over the edge of one that shows a part.
namespace welkin::prefilter {

/// Rows of the grid for a lobe; none where it would need too many.
std::optional<int> energy_rows(const lobe::AnyLobe& lobe);

/// Weights of Fejér's first rule: Σ_j w_j f(cos θ_j) = ∫ f(x) dx over −1…1 for θ_j = (j + ½)π/rows, exact for
/// polynomials of degree below `rows` (Fejér 1933; Waldvogel 2006, eq. 2.7).
std::vector<double> fejer_weights(int rows);

/// ∫ of each channel of each lobe's level, for LobeScale::average; none where neither rule holds, and of
/// mirrors.
std::vector<std::optional<std::vector<double>>> integrals_of_levels(const Map& source,
                                                                    std::span<const lobe::AnyLobe> lobes,
                                                                    const VerifyOptions& options);

/// The orientation of the grid.
Matrix3 energy_grid_orientation();

/// ∫ map dω, texel by texel: see summed_solid_angles.
std::vector<double> integral_of_texels(const Map& map);
/// ∫ |map| dω.
std::vector<double> integral_of_magnitudes(const Map& map);

}  // namespace welkin::prefilter
