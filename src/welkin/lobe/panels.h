#pragma once

#include <vector>

#include "welkin/lobe/lobe.h"

namespace welkin::lobe {

/// Nodes s and weights of a quadrature of the lobe over the sphere: Σ weights[i] f(s[i]) = 2π ∫ w(s) f(s)
/// ds. Those where w is 0 are left out.
struct LobeNodes {
  std::vector<double> s, weights;
  /// 2 − s, with its full precision near the axis' far end.
  std::vector<double> s_behind;
};

/// For f that are polynomials of 1 − s of this degree: relative error 1e-13 of ∫ w for lobes that are smooth
/// between their breakpoints. Not for mirrors.
LobeNodes lobe_nodes(const AnyLobe& lobe, int degree);

/// Where the panels of that quadrature begin and end: angles ascending from 0 to π, dense where the lobe
/// is narrow.
std::vector<double> panel_edges(const AnyLobe& lobe);

}  // namespace welkin::lobe
