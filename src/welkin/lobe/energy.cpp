#include "welkin/lobe/energy.h"

#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/lobe/angle.h"
#include "welkin/lobe/panels.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::lobe {
namespace {

/// ∫ w sin θ dθ between two angles with no breakpoint between them.
double energy_between(const AnyLobe& lobe, double begin, double end) {
  static const QuadratureRule rule = gauss_legendre(24);
  const double half = 0.5 * (end - begin), middle = 0.5 * (end + begin);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double angle = middle + half * rule.nodes[i];
    sum += rule.weights[i] * lobe.weight(s_of_angle(angle)) * std::sin(angle);
  }
  return sum * half;
}

}  // namespace

double energy_cone_angle(const AnyLobe& lobe, double share) {
  require(share >= 0 && share <= 1, "the share of a lobe's energy is in 0…1");
  if (lobe.is_mirror()) return 0;
  const std::vector<double> edges = panel_edges(lobe);
  std::vector<double> energies;
  double all = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    energies.push_back(energy_between(lobe, edges[i], edges[i + 1]));
    all += energies.back();
  }
  double wanted = share * all;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (wanted > energies[i]) {
      wanted -= energies[i];
      continue;
    }
    double low = edges[i], high = edges[i + 1];
    while (high - low > 1e-12 * high) {
      const double middle = 0.5 * (low + high);
      (energy_between(lobe, edges[i], middle) < wanted ? low : high) = middle;
    }
    return high;
  }
  return edges.back();
}

}  // namespace welkin::lobe
