#include "welkin/prefilter/legendre.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace welkin::prefilter {

namespace {

/// cos (i + ½)π/rows of the northern rows.
std::vector<double> even_cosines(int rows) {
  assert(rows >= 2 && rows % 2 == 0);
  std::vector<double> cosines;
  for (int i = 0; i < rows / 2; ++i) cosines.push_back(std::cos((i + 0.5) * std::numbers::pi / rows));
  return cosines;
}

}  // namespace

Latitudes::Latitudes(int rows, int degree) : Latitudes(even_cosines(rows), degree) {}

Latitudes::Latitudes(const std::vector<double>& cosines, int degree)
    : count(static_cast<int>(cosines.size())), packs((count + 7) / 8) {
  const std::size_t lanes = static_cast<std::size_t>(packs) * 8;
  cosine_squared.resize(lanes);
  cosine.resize(lanes);
  log_sine.resize(lanes);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double x = cosines[std::min(lane, cosines.size() - 1)];
    cosine[lane] = x;
    cosine_squared[lane] = static_cast<float>(x * x);
    log_sine[lane] = 0.5 * std::log(std::max(1e-300, (1 - x) * (1 + x)));
  }
  for (int pack = 0; pack < packs; ++pack) {
    // Beyond its turning point m = l sin θ a function decays within a few widths m^⅓ of Airy's.
    double widest = log_sine[static_cast<std::size_t>(pack) * 8];
    for (int i = 1; i < 8; ++i) widest = std::max(widest, log_sine[static_cast<std::size_t>(pack * 8 + i)]);
    const double turning = degree * std::exp(widest);
    last_order.push_back(static_cast<int>(turning + std::max(16.0, 6 * std::cbrt(turning))));
  }
}

Recurrence::Recurrence(int order, int degree) : m(order) {
  const std::size_t n = static_cast<std::size_t>(degree - m + 2);
  // e[i] is e of degree m + i.
  std::vector<double> e(n + 3);
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double l = m + static_cast<double>(i);
    e[i] = std::sqrt((l - m) * (l + m) / (4 * l * l - 1));
  }
  if (m == 0) e[0] = 0;
  center.resize(n);
  factor.resize(n);
  scale.resize(n);
  center32.resize(n);
  factor32.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i < 2) {
      scale[i] = 1 / std::sqrt(e[i + 1] * e[i + 2]);
    } else {
      scale[i] = 1 / (e[i - 1] * e[i] * scale[i - 2]);
    }
    center[i] = e[i + 1] * e[i + 1] + e[i] * e[i];
    factor[i] = scale[i] * scale[i];
    center32[i] = static_cast<float>(center[i]);
    factor32[i] = static_cast<float>(factor[i]);
  }
  // |P̄ₘᵐ|² at the equator = (2m+1)!! / (2m)!! / 4π.
  log_first = 0.5 * (std::lgamma(m + 1.5) - std::lgamma(m + 1.0) + std::log(2 / std::sqrt(std::numbers::pi)) -
                     std::log(4 * std::numbers::pi));
  next_ratio = 1 / e[1];
}

}  // namespace welkin::prefilter
