#pragma once

#include <cmath>

#include "welkin/math/gauss_legendre.h"

namespace welkin::brdf {

/// Calls visit(x, weight) for nodes of a quadrature over x = 0…length of functions that vary over distances
/// of about x + scale: x = scale · sinh u makes them vary evenly. Exact to about 1e-10 for functions with
/// singularities at ±i·scale.
template <class Visit>
void for_graded_nodes(double length, double scale, const Visit& visit) {
  const double end = std::asinh(length / scale);
  const QuadratureRule& rule = gauss_rule(static_cast<int>(8 + 2.5 * end));
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double grown = std::exp(0.5 * end * (1 + rule.nodes[i])), shrunk = 1 / grown;
    visit(0.5 * scale * (grown - shrunk), 0.25 * scale * (grown + shrunk) * end * rule.weights[i]);
  }
}

}  // namespace welkin::brdf
