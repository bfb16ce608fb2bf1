#include "welkin/lobe/panels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {
namespace {

/// P_n(x) and its derivative.
struct Polynomial {
  double value, slope;
};
Polynomial legendre(int n, double x) {
  double before = 1, value = x;
  for (int l = 1; l < n; ++l) {
    const double next = ((2 * l + 1) * x * value - l * before) / (l + 1);
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1)};
}

/// A panel of width Δθ turns P_l through k = l Δθ/2 radians on either side of its middle, and n nodes
/// integrate cos(k x) to (e k/4n)^2n.
constexpr int kFewNodes = 12, kManyNodes = 32;
constexpr double kFewReach = 4, kManyReach = 26;

void add_panel(const AnyLobe& lobe, const Rule& rule, double begin, double end, LobeNodes& nodes) {
  const double half = 0.5 * (end - begin), middle = 0.5 * (end + begin);
  for (std::size_t i = 0; i < rule.places.size(); ++i) {
    const double angle = middle + half * rule.places[i];
    const double s = s_of_angle(angle), weight = lobe.weight(s);
    if (weight == 0) continue;
    nodes.s.push_back(s);
    nodes.s_behind.push_back(s_of_angle(kPi - angle));
    nodes.weights.push_back(2 * kPi * weight * std::sin(angle) * half * rule.weights[i]);
  }
}

}  // namespace

Rule gauss_legendre(int count) {
  assert(count >= 2);
  Rule rule;
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(kPi * (i + 0.75) / (count + 0.5));
    for (int step = 0; step < 6; ++step) {
      const Polynomial p = legendre(count, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(count, x).slope;
    rule.places.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

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
  static const Rule few = gauss_legendre(kFewNodes), many = gauss_legendre(kManyNodes);
  assert(!lobe.mirror());
  LobeNodes nodes;
  const std::vector<double> edges = panel_edges(lobe);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double begin = edges[i], width = edges[i + 1] - begin, reach = 0.5 * degree * width;
    const Rule& rule = reach <= kFewReach ? few : many;
    const int parts = std::max(1, static_cast<int>(std::ceil(reach / kManyReach)));
    for (int part = 0; part < parts; ++part) {
      add_panel(lobe, rule, begin + width * part / parts, begin + width * (part + 1) / parts, nodes);
    }
  }
  return nodes;
}

}  // namespace welkin::lobe
