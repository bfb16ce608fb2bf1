#pragma once

#include "welkin/math/scalar.h"

namespace welkin::prefilter {

/// Weights of Lagrange's polynomials through the nodes −2 … 3 at f, 0 ≤ f ≤ 1.
template <Scalar T>
void lagrange6(T f, T* w) {
  const T a = f + 2, b = f + 1, c = f, d = f - 1, e = f - 2, g = f - 3;
  w[0] = -b * c * d * e * g / 120;
  w[1] = a * c * d * e * g / 24;
  w[2] = -a * b * d * e * g / 12;
  w[3] = a * b * c * e * g / 12;
  w[4] = -a * b * c * d * g / 24;
  w[5] = a * b * c * d * e / 120;
}

}  // namespace welkin::prefilter
