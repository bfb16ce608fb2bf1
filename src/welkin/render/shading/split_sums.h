#pragma once

#include <vector>

#include "welkin/brdf/dfg.h"
#include "welkin/image/image.h"

namespace welkin::scene {

/// GGX's split sums over n·v and roughness, from a table: absolute error 1e-3 at grazing angles, 1e-4
/// elsewhere.
class SplitSums {
 public:
  SplitSums();

  /// n·v and roughness are clamped to 0 … 1.
  brdf::SplitSum at(double nv, double roughness) const;
  /// The mean over the hemisphere of what `at` gives, 2 ∫ … μ dμ, exactly.
  brdf::SplitSum average(double roughness) const;

 private:
  Image image_;
  std::vector<brdf::SplitSum> averages_;  // of each row
};

/// F₉₀ of a dielectric's Schlick term: 1, but where hardly anything is reflected along the normal, down to 0
/// at an index of 1 (Lagarde & de Rousiers 2014, §3.1.3).
inline double grazing_reflectance(double f0) {
  return f0 < 0.02 ? f0 / 0.02 : 1;
}

/// Made at first use.
const SplitSums& split_sums();

}  // namespace welkin::scene
