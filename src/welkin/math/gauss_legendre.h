#pragma once

#include <vector>

namespace welkin {

/// Nodes and weights of a quadrature on [−1, 1].
struct QuadratureRule {
  std::vector<double> nodes, weights;
};

/// Gauss–Legendre: exact for polynomials of degree 2·count − 1.
QuadratureRule gauss_legendre(int count);

/// The same, 2 … kMostGaussNodes, made when it is first asked for. Safe from many threads.
const QuadratureRule& gauss_rule(int count);
inline constexpr int kMostGaussNodes = 256;

}  // namespace welkin
