#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/prefilter/prefilter.h"

/// @file
/// Measures pre-filtered levels against brute force.
namespace welkin {

/// Which texels are compared.
struct VerifyOptions {
  /// How the levels were made.
  PrefilterOptions prefilter = {};
  /// Texels of every level, drawn uniformly without replacement; all where a level has no more.
  int random_texels = 64;
  /// At most `most_hot` texels of every level, of at least `hot` of its highest luminance; evenly spread over
  /// the order of luminance where there are more. Besides them, the texels in the direction of the source's
  /// brightest lights.
  int most_hot = 64;
  double hot = 0.5;        ///< share of the highest luminance, 0 … 1
  std::uint64_t seed = 1;  ///< of the random choice
  /// The levels are not PrefilterPlan's: energy is that of their own texels, and there is no furnace.
  bool own_texels = false;
  Monitor monitor = {};  ///< progress and cancelling
};

/// Texels of a level against brute force in float64; those of a mirror's level, which is the source
/// resampled, against resample_reference with as many samples as it takes. All numbers are over the channels
/// together, but for A where there are others.
struct ReferenceErrors {
  int random_texels = 0;  ///< compared
  int hot_texels = 0;     ///< compared
  /// √(Σ Ω |error|²) / √(Σ Ω |reference|²) over the random texels, Ω their solid angles. 0 where both are 0.
  double relative_rmse = 0;
  /// Largest |error| / |reference| of all texels, where the reference counts as no smaller than 1e-6 of the
  /// source's mean |radiance|.
  double maximum = 0;
  Vec3d maximum_direction{0, 0, 1};  ///< in the world
};

/// What is found of a level.
struct LevelVerification {
  /// How far the level is from its definition.
  ReferenceErrors reference;
  /// ∫ level dω / ∫ source dω, of the channel where it is farthest from 1; as 1 + difference / ∫ |source| dω,
  /// which is the same where nothing is negative, and 1 where there is no light. A level has too few texels
  /// for a quadrature, so it is computed again, by the same methods, at the nodes of an exact quadrature; a
  /// mirror's own texels are summed up. None where no quadrature is good enough.
  std::optional<double> energy;
  /// Largest |value − 1| of all texels of the same level made of a source that is 1 everywhere. Of a source
  /// that shows a part of the sphere: |value − reference| at the texels compared; none of its mirror.
  std::optional<double> furnace;
};

/// Sources with more texels are refused: the reference would need over 13 GB.
inline constexpr std::int64_t kMaxVerifiedTexels = std::int64_t{1} << 26;

/// Holds maps, as PrefilterPlan::run made them of `source`, one for each of `levels`, to the definition:
/// brute force with PrefilterMethod::lobe, and of mirrors PrefilterOptions::mirror_filter. The same numbers
/// whatever the number of threads, and for the same seed. Takes some 3 ms for every texel compared and half a
/// million texels of source, and core; for a texel of a mirror 1 to 200 ms, the most at its hardest edges.
/// Throws Error: a source of over kMaxVerifiedTexels, and as PrefilterPlan does; Cancelled.
WELKIN_API std::vector<LevelVerification> verify_prefilter(const Map& source, std::span<const Map> maps,
                                                           std::span<const PrefilterLevel> levels,
                                                           const VerifyOptions& options = {});

/// Throws as verify_prefilter does for a source of that size.
WELKIN_API void check_verifiable(const PrefilterShape& source);

}  // namespace welkin
