#pragma once

#include "welkin/base/export.h"

/// @file
/// Integrals of microfacet BRDFs over the light's direction, ∫ f (n·l) dω: the share of light from everywhere
/// that a surface of white facets reflects to a viewer, and what Fresnel's term makes of it. They are what
/// split-sum tables hold.
///
/// All take the cosine n·v from 0 (grazing) to 1, and the roughness from 0 to 1, α = roughness²; both ends
/// included. They throw Error (bad_request) for other numbers. By Gauss's quadrature in float64, nothing is
/// sampled. Safe from many threads.
namespace welkin::brdf {

/// How GGX facets hide each other (microfacet.h).
enum class GgxMasking {
  correlated,   ///< Smith's, correlated by height: most engines
  separable,    ///< Smith's, G1(l) G1(v)
  schlick,      ///< Schlick's, twice, k = α/2: Karis 2013
  approximate,  ///< correlated, without its roots: Unreal
};

/// How cloth hides itself.
enum class ClothMasking {
  neubelt,  ///< Neubelt & Pettineo 2013: Filament, Babylon, Khronos' tables
  charlie,  ///< Estevez & Kulla 2017, the Λ of glTF's KHR_materials_sheen
};

/// The two integrals of Schlick's Fresnel term, F = f0 + (f90 − f0) Fc, which is linear in f0 and f90. Karis
/// 2013.
struct SplitSum {
  double one = 0;  ///< ∫ f (n·l) dω with F = 1: the directional albedo E
  double fc = 0;   ///< the same with F = Fc = (1 − v·h)⁵

  double scale() const { return one - fc; }  ///< what f0 is multiplied by
  double bias() const { return fc; }         ///< what f90 is multiplied by
  /// What a surface reflects of light that is the same from everywhere, scattered once.
  double reflectance(double f0, double f90 = 1) const { return f0 * scale() + f90 * bias(); }
};

/// Of GGX. Absolute error 1e-6. Below roughness 1e-4 it is a mirror, 1 and (1 − n·v)⁵, as for
/// lobes (docs/lobes.md); where n·v < 1e-7 too, that is not the limit.
WELKIN_API SplitSum ggx_split_sum(double nv, double roughness, GgxMasking masking = GgxMasking::correlated);

/// E's mean over the hemisphere, 2 ∫ E(μ) μ dμ: what a white surface reflects, scattered once. Absolute error
/// 1e-6.
WELKIN_API double ggx_average_albedo(double roughness, GgxMasking masking = GgxMasking::correlated);

/// The smallest roughness of charlie_albedo, as lobe/charlie.h has it for maps, but smaller: at 0 there is no
/// such surface.
inline constexpr double kSmallestClothRoughness = 1.0 / 1024;
/// The smallest n·v of charlie_albedo: nearer to the horizon, ClothMasking::charlie's fit grows without
/// bound.
inline constexpr double kSmallestClothCosine = 1e-4;

/// ∫ f (n·l) dω of Charlie with F = 1. It isn't bounded by 1: the model makes light at grazing angles. Error,
/// absolute below 1 and relative above it: 1e-6, of ClothMasking::charlie, whose fit bends, 1e-5; of both
/// 2e-5 below roughness 0.1, where the albedo rises to 100 at the horizon. Smaller roughness and n·v give
/// what the smallest (above) do.
WELKIN_API double charlie_albedo(double nv, double roughness, ClothMasking masking = ClothMasking::neubelt);

/// ∫ f (n·l) dω of Disney's diffuse term, (1 + g (1 − n·l)⁵)(1 + g (1 − n·v)⁵)/π with g = 2 roughness (l·h)²
/// − ½: Burley 2012, §5.3. Absolute error 1e-13.
WELKIN_API double disney_diffuse_albedo(double nv, double roughness);

}  // namespace welkin::brdf
