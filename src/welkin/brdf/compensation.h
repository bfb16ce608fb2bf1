#pragma once

#include <algorithm>

#include "welkin/brdf/dfg.h"
#include "welkin/math/scalar.h"

/// @file
/// What microfacets scatter more than once, from the tables' values: the terms by which renderers give back
/// the light that a BRDF of single scattering loses. Reflectances in 0…1.
namespace welkin::brdf {

/// Mean of Schlick's F over the hemisphere, 2 ∫ F(μ) μ dμ = f0 + (f90 − f0)/21.
inline double average_fresnel(double f0, double f90 = 1) {
  return f0 + (f90 - f0) / 21;
}

/// The lobe that makes up for what is lost: f_ms = (1 − E(l))(1 − E(v))/(π (1 − E_avg)), for a white surface;
/// 0 where nothing is lost. Kulla & Conty 2017, p. 16.
inline double kulla_conty_lobe(double albedo_l, double albedo_v, double average_albedo) {
  return average_albedo < 1 ? (1 - albedo_l) * (1 - albedo_v) / (kPi * (1 - average_albedo)) : 0;
}

/// What that lobe is multiplied by for a surface that isn't white: F_avg² E_avg/(1 − F_avg (1 − E_avg)).
/// Kulla & Conty 2017, p. 20.
inline double kulla_conty_fresnel(double average_fresnel, double average_albedo) {
  return average_fresnel * average_fresnel * average_albedo / (1 - average_fresnel * (1 - average_albedo));
}

/// The part of even light that leaves after being scattered more than once: FmsEms = FssEss F_avg Ems/(1 −
/// F_avg Ems), of what is reflected `once`, FssEss = f0 scale + f90 bias, F_avg = f0 + (f90 − f0)/21, and
/// what a white surface loses, Ems = 1 − E. Below 1. Fdez-Agüera 2019, eq. 18 … 20.
inline double fdez_aguera_again(double once, double average_fresnel, double lost) {
  return once * average_fresnel * lost / (1 - average_fresnel * lost);
}

/// Reflectance of a metal under even light, scattered once and more often: FssEss + FmsEms. Fdez-Agüera 2019,
/// eq. 9 … 20.
inline double fdez_aguera_reflectance(const SplitSum& sum, double f0, double f90 = 1) {
  const double once = sum.reflectance(f0, f90);
  return once + fdez_aguera_again(once, average_fresnel(f0), 1 - sum.one);
}

/// What the single-scattering BRDF is multiplied by: 1 + f0 (1/E − 1). Turquin 2019, eq. 16.
inline double turquin_factor(double albedo, double f0) {
  return 1 + f0 * (1 / albedo - 1);
}

/// What is left for the layers below sheen: min(1 − c E(v), 1 − c E(l)), c the largest of the sheen colour's
/// components; not below 0, as Charlie's albedo can be above 1. glTF 2.0, KHR_materials_sheen.
inline double sheen_albedo_scaling(double largest_colour, double albedo_v, double albedo_l) {
  return std::max(0.0, 1 - largest_colour * std::max(albedo_v, albedo_l));
}

}  // namespace welkin::brdf
