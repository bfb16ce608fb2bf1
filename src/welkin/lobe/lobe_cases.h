#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "welkin/lobe/lobe.h"

/// What the tests of lobes share.
namespace welkin::lobe::cases {

/// Every registered lobe at its defaults, and at narrow, wide and unusual parameters.
inline std::vector<AnyLobe> all_lobes() {
  std::vector<AnyLobe> list;
  for (const std::string& name : lobe_names()) list.push_back(AnyLobe::make(name));
  for (const char* spec :
       {"phong,exponent=0", "phong,exponent=0.5", "phong,exponent=1", "phong,exponent=2.5",
        "phong,exponent=10000", "phong,exponent=1e7", "blinn,roughness=1", "blinn,roughness=0.015625",
        "ggx,roughness=1", "ggx,roughness=0.9", "ggx,roughness=0.125", "ggx,roughness=0.015625",
        "ggx,roughness=0.001", "charlie,roughness=1", "charlie,roughness=0.1", "charlie,roughness=0.01",
        "vmf,kappa=0", "vmf,kappa=1", "vmf,kappa=1e8"}) {
    list.push_back(AnyLobe::make(spec));
  }
  const double degrees[] = {0, 3, 20, 60}, values[] = {2, 5, 1, 0};
  list.push_back(AnyLobe::from_table("hat", degrees, values));
  const double wide[] = {0, 180}, even[] = {1, 1};
  list.push_back(AnyLobe::from_table("even", wide, even));
  return list;
}

/// Values of s from 0 to 2: powers of two toward 0, toward the horizon from both sides, and an even lattice.
inline std::vector<double> s_values() {
  std::vector<double> list{0, 1, 2};
  for (double small = 0.5; small > 1e-14; small /= 2) {
    for (const double s : {small, 1 - small, 1 + small, 2 - small}) list.push_back(s);
  }
  for (int i = 0; i < 1000; ++i) list.push_back((i + 0.37) / 500);
  return list;
}

/// The largest weight on a fine lattice.
inline double largest_weight(const AnyLobe& lobe) {
  double maximum = 0;
  for (const double s : s_values()) maximum = std::max(maximum, lobe.weight(s));
  for (int i = 0; i < 2000; ++i) {
    const double half_sine = std::sin(0.5 * 3.14159265358979 * i / 2000);
    maximum = std::max(maximum, lobe.weight(2 * half_sine * half_sine));
  }
  return maximum;
}

}  // namespace welkin::lobe::cases
