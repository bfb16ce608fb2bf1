#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/math/gauss_legendre.h"

/// Panels of quadrature that shrink by halves towards where a lobe is steep. Internal to brdf.
namespace welkin::brdf {

/// Edges of panels from `from` to `to`, ascending: `even` equal ones, and towards each of `centres` that lies
/// there ever smaller ones, from the whole length by halves to `finest`.
inline std::vector<double> around(const std::vector<double>& centres, double from, double to, double finest,
                                  int even) {
  std::vector<double> edges;
  for (int k = 0; k <= even; ++k) edges.push_back(from + (to - from) * k / even);
  for (const double centre : centres) {
    if (!(centre >= from && centre <= to)) continue;
    edges.push_back(centre);
    for (double step = (to - from) / 4; step > finest / 2; step /= 2) {
      if (centre - step > from) edges.push_back(centre - step);
      if (centre + step < to) edges.push_back(centre + step);
    }
  }
  std::sort(edges.begin(), edges.end());
  // Edges that nearly coincide make panels that are not worth their nodes; the ends stay.
  std::vector<double> kept{edges.front()};
  for (const double edge : edges) {
    if (edge - kept.back() > finest / 8 && to - edge > finest / 8) kept.push_back(edge);
  }
  kept.push_back(to);
  return kept;
}

/// The same towards both ends.
inline std::vector<double> both_ends(double from, double to, double finest) {
  std::vector<double> edges{from, to};
  for (double step = (to - from) / 2; step > finest / 2; step /= 2) {
    edges.push_back(from + step);
    edges.push_back(to - step);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// use(position, weight) for Gauss–Legendre's nodes of every panel.
template <class Use>
void for_each_node(const std::vector<double>& edges, int nodes, const Use& use) {
  static const std::vector<QuadratureRule> rules = [] {
    std::vector<QuadratureRule> all;
    for (int n = 0; n <= 16; ++n) all.push_back(n >= 2 ? gauss_legendre(n) : QuadratureRule{});
    return all;
  }();
  const QuadratureRule& rule = rules[static_cast<std::size_t>(nodes)];
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double half = 0.5 * (edges[i + 1] - edges[i]), middle = 0.5 * (edges[i + 1] + edges[i]);
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      use(middle + half * rule.nodes[k], half * rule.weights[k]);
  }
}

}  // namespace welkin::brdf
