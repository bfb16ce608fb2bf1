#pragma once

#include <vector>

namespace welkin::brdf {

/// Quadrature over an azimuth ψ from 0 to π of a function of sin²(ψ/2) that varies fastest near 0: ψ = 2σ
/// sinh u, Gauss's nodes in u. Weights include dψ/du.
struct AzimuthRule {
  std::vector<double> sine_squared;  ///< sin²(ψ/2) at the nodes
  std::vector<double> weights;       ///< their sum is π
};

/// The rule for functions that vary over ψ ≈ 2σ, 0 < σ; from a set whose σ halve from one to the next.
const AzimuthRule& azimuth_rule(double sigma);

}  // namespace welkin::brdf
