#include "welkin/lobe/panels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "welkin/lobe/angle.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::lobe {
namespace {

/// A panel of width Δθ turns P_l through k = l Δθ/2 radians on either side of its middle, and n nodes
/// integrate cos(k x) to (e k/4n)^2n.
constexpr int kFewNodes = 12, kManyNodes = 32;
constexpr double kFewReach = 4, kManyReach = 26;

void add_panel(const AnyLobe& lobe, const QuadratureRule& rule, double begin, double end, LobeNodes& nodes) {
  const double half = 0.5 * (end - begin), middle = 0.5 * (end + begin);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double angle = middle + half * rule.nodes[i];
    const double s = s_of_angle(angle), weight = lobe.weight(s);
    if (weight == 0) continue;
    nodes.s.push_back(s);
    nodes.s_behind.push_back(s_of_angle(kPi - angle));
    nodes.weights.push_back(2 * kPi * weight * std::sin(angle) * half * rule.weights[i]);
  }
}

}  // namespace

std::vector<double> panel_edges(const AnyLobe& lobe) {
  assert(lobe.width() >= 1e-8);
  std::vector<double> edges{0, kPi};
  // Below the core for lobes that aren't smooth at the axis, above it for tails.
  for (double angle = lobe.width() / 64; angle < kPi; angle *= 2) edges.push_back(angle);
  for (const double s : lobe.breakpoints()) edges.push_back(angle_of_s(s));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

LobeNodes lobe_nodes(const AnyLobe& lobe, int degree) {
  static const QuadratureRule few = gauss_legendre(kFewNodes), many = gauss_legendre(kManyNodes);
  assert(!lobe.is_mirror());
  LobeNodes nodes;
  const std::vector<double> edges = panel_edges(lobe);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double begin = edges[i], width = edges[i + 1] - begin, reach = 0.5 * degree * width;
    const QuadratureRule& rule = reach <= kFewReach ? few : many;
    const int parts = std::max(1, static_cast<int>(std::ceil(reach / kManyReach)));
    for (int part = 0; part < parts; ++part) {
      add_panel(lobe, rule, begin + width * part / parts, begin + width * (part + 1) / parts, nodes);
    }
  }
  return nodes;
}

}  // namespace welkin::lobe
