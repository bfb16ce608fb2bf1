#include "welkin/lobe/zonal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/lobe/kernels.h"
#include "welkin/lobe/panels.h"

namespace welkin::lobe {
namespace {

LegendreSums best_legendre_sums() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return legendre_sums_avx2();
#endif
  return legendre_sums_baseline();
}

}  // namespace

std::vector<double> legendre_sums(std::vector<double> s, std::vector<double> weights, int degree) {
  require(degree >= 0 && s.size() == weights.size(),
          "sums of Legendre polynomials take as many weights as s");
  // Filled up with weights of 0 to a whole number of kernel steps.
  const std::size_t whole = (s.size() + kLanes - 1) / kLanes * kLanes;
  s.resize(whole);
  weights.resize(whole);
  std::vector<double> sums(static_cast<std::size_t>(degree) + 1, 0.0);
  best_legendre_sums()(s.data(), weights.data(), whole, degree, sums.data());
  return sums;
}

std::vector<double> zonal_coefficients(const AnyLobe& lobe, int degree) {
  require(degree >= 0, "the degree of harmonics is at least 0");
  if (lobe.is_mirror()) return std::vector<double>(static_cast<std::size_t>(degree) + 1, 1.0);
  const LobeNodes nodes = lobe_nodes(lobe, degree);
  // P_l(−t) = (−1)^l P_l(t) brings the far half of the sphere to s ≤ 1, where the recurrence is precise.
  std::vector<double> front, front_weights, behind, behind_weights;
  for (std::size_t i = 0; i < nodes.s.size(); ++i) {
    if (nodes.s[i] <= 1) {
      front.push_back(nodes.s[i]);
      front_weights.push_back(nodes.weights[i]);
    } else {
      behind.push_back(nodes.s_behind[i]);
      behind_weights.push_back(nodes.weights[i]);
    }
  }
  std::vector<double> coefficients = legendre_sums(std::move(front), std::move(front_weights), degree);
  const std::vector<double> far = legendre_sums(std::move(behind), std::move(behind_weights), degree);
  for (std::size_t l = 0; l < coefficients.size(); ++l) coefficients[l] += l % 2 == 0 ? far[l] : -far[l];
  const double all = coefficients[0];
  for (double& coefficient : coefficients) coefficient /= all;
  return coefficients;
}

ZonalTail zonal_tail(const std::vector<double>& coefficients) {
  ZonalTail tail;
  tail.largest.assign(coefficients.size(), 0.0);
  tail.sum.assign(coefficients.size(), 0.0);
  for (std::size_t l = coefficients.size(); l-- > 1;) {
    const double size = std::fabs(coefficients[l]);
    tail.largest[l - 1] = std::max(tail.largest[l], size);
    tail.sum[l - 1] = tail.sum[l] + (2 * static_cast<double>(l) + 1) * size / (4 * std::numbers::pi);
  }
  return tail;
}

int degree_for(const AnyLobe& lobe, double tolerance, int max_degree) {
  for (int tried = 16;; tried *= 2) {
    const ZonalTail tail = zonal_tail(zonal_coefficients(lobe, 2 * tried + 16));
    const auto enough = std::find_if(tail.largest.begin(), tail.largest.begin() + tried + 1,
                                     [&](double size) { return size <= tolerance; });
    const int found = static_cast<int>(enough - tail.largest.begin());
    if (found <= tried || tried >= max_degree) return std::min(found, max_degree);
  }
}

}  // namespace welkin::lobe
