#pragma once

#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/table_axis.h"

/// @file
/// How much of the light a smooth boundary reflects, by angle: at run time, and as one-dimensional tables.
namespace welkin::brdf {

/// What light meets, relative to what it comes from: a medium of index n, or with k > 0 a metal of index n +
/// ik.
struct Boundary {
  double n = 1.5;  ///< index behind over index in front; above 0
  double k = 0;    ///< extinction coefficient, likewise relative; not negative
};

/// The largest n and k: beyond it a boundary differs from a perfect mirror by less than float64 shows.
inline constexpr double kLargestIndex = 1e9;

/// Throws Error (bad_request), naming the number, unless n lies in 1/kLargestIndex…kLargestIndex and k in
/// 0…kLargestIndex.
WELKIN_API void check(const Boundary& boundary);

/// The reflectance of unpolarised light at the angle with this cosine, 0…1: fresnel_dielectric for k = 0,
/// fresnel_conductor otherwise (microfacet.h). Total reflection, for n < 1, is 1. Absolute error 1e-13.
/// Throws what check does, and Error (bad_request) for a cosine out of its range.
WELKIN_API double fresnel(double cosine, const Boundary& boundary);

/// The cosine below which all is reflected, √(1 − n²), of a medium with n < 1; 0 otherwise.
WELKIN_API double critical_cosine(const Boundary& boundary);

/// `count` texels of `fresnel` along the cosine, from grazing to facing, rounded to float. Throws Error
/// (bad_request) for what check says, for fewer than 1 texel and more than 65536.
WELKIN_API std::vector<float> fresnel_table(const Boundary& boundary, int count,
                                            TexelPlacement placement = TexelPlacement::ends);

/// The largest absolute difference between `fresnel` and the table as a texture unit reads it, linear between
/// texels and constant outside the outermost, over cosines 0…1.
WELKIN_API double fresnel_table_error(const Boundary& boundary, const std::vector<float>& table,
                                      TexelPlacement placement = TexelPlacement::ends);

}  // namespace welkin::brdf
