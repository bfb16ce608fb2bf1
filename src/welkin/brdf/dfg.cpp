#include "welkin/brdf/dfg.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/brdf/azimuth_rule.h"
#include "welkin/brdf/dfg_limits.h"
#include "welkin/brdf/graded_rule.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/lobe/angle.h"

// The light's direction is taken as its elevation e above the surface, sin e = n·l, and its azimuth. V
// depends on n·l and n·v alone, so that
//
//     ∫ f (n·l) dω = ∫ V(n·l, n·v) n·l (∫ D F dφ) cos e de
//
// and the inner integral belongs to the distribution. With C = n·l + n·v, cosines s_l, s_v of the elevations,
// and ψ = π − φ counted from the mirror's side,
//
//     S = (s_l − s_v)² + 4 s_l s_v sin²(ψ/2),   |l + v|² = S + C²,   sin²θh = S/(S + C²),   v·h = ½ √(S + C²)
//
// in which nothing cancels, however narrow the lobe and however low the light: s_l − s_v is made of the
// elevations' difference.
namespace welkin::brdf {
namespace {

void check_arguments(double nv, double roughness) {
  const auto refuse = [](const char* what, double value) {
    throw Error(ErrorKind::bad_request,
                std::string(what) + " is " + number_text(value) + ", not a number from 0 to 1");
  };
  if (!(nv >= 0 && nv <= 1)) refuse("n·v", nv);
  if (!(roughness >= 0 && roughness <= 1)) refuse("the roughness", roughness);
}

/// The viewer, or the light.
struct Elevation {
  double angle, sine, cosine;
};

Elevation elevation_of_sine(double sine) {
  return {std::asin(sine), sine, std::sqrt((1 - sine) * (1 + sine))};
}

/// What the inner integral needs of a light and a viewer.
struct Pair {
  double nl;
  double c_squared;  ///< C²
  double nearest;    ///< S at ψ = 0
  double product;    ///< 4 s_l s_v
};

/// Calls visit(pair, weight) for lights at all elevations; the weight includes cos e. The function is taken
/// to vary over `peak` about the viewer's own elevation, and over `horizon` at the horizon.
template <class Visit>
void for_lights(const Elevation& v, double peak, double horizon, const Visit& visit) {
  const auto at = [&](double angle, double above, double weight) {
    const double nl = std::sin(angle), cosine = std::cos(angle), c = nl + v.sine;
    const double step = 2 * std::sin(0.5 * (angle + v.angle)) * std::sin(0.5 * above);
    visit(Pair{nl, c * c, step * step, 4 * cosine * v.cosine}, weight * cosine);
  };
  if (v.angle < kPi / 2) {
    for_graded_nodes(kPi / 2 - v.angle, peak, [&](double x, double weight) { at(v.angle + x, x, weight); });
  }
  // What lies below a viewer at the horizon is nothing, and too little for float64.
  if (v.angle > 1e-30) {
    const double half = 0.5 * v.angle;
    for_graded_nodes(half, peak, [&](double x, double weight) { at(v.angle - x, -x, weight); });
    for_graded_nodes(half, horizon, [&](double x, double weight) { at(x, x - v.angle, weight); });
  }
}

double ggx_visibility(double nl, double nv, double alpha, GgxMasking masking) {
  switch (masking) {
    case GgxMasking::separable:
      return ggx_visibility_separable(nl, nv, alpha);
    case GgxMasking::schlick:
      return schlick_visibility(nl, nv, 0.5 * alpha);
    case GgxMasking::approximate:
      return ggx_visibility_approximate(nl, nv, alpha);
    case GgxMasking::correlated:
      break;
  }
  return ggx_visibility_correlated(nl, nv, alpha);
}

/// ∫ D dφ and ∫ D Fc dφ of GGX, all around. With T = S + α² C² and κ = (1 − α²) C²,
///
///     D = (α²/π) (1 + κ/T)²,   T between m = nearest + α² C² and M = m + product
///
/// whose integral is 2 α² (1 + 2κ/R + κ² (m + M)/2R³), R = √(m M).
SplitSum ggx_around(const Pair& pair, double alpha) {
  const double a = alpha * alpha, kappa = (1 - a) * pair.c_squared;
  const double low = pair.nearest + a * pair.c_squared, high = low + pair.product;
  const double root = std::sqrt(low * high), ratio = kappa / root;
  SplitSum sums;
  sums.one = 2 * a * (1 + ratio * (2 + ratio * 0.5 * (low + high) / root));
  const AzimuthRule& rule = azimuth_rule(std::sqrt(low / high));
  double sum = 0;
  for (std::size_t i = 0; i < rule.weights.size(); ++i) {
    const double t = low + pair.product * rule.sine_squared[i], y = t + kappa, share = y / t;
    const double x = 1 - 0.5 * std::sqrt(y), square = x * x;
    sum += rule.weights[i] * share * share * square * square * x;
  }
  sums.fc = 2 * a / kPi * sum;
  return sums;
}

}  // namespace

SplitSum ggx_split_sum(double nv, double roughness, GgxMasking masking) {
  check_arguments(nv, roughness);
  const double alpha = roughness * roughness;
  if (roughness < lobe::kMirrorRoughness) return {1, schlick_weight(nv)};
  const Elevation v = elevation_of_sine(nv);
  // Besides at the peak, whose half width is 2α, the integrand varies where C does: it has a logarithm there.
  const double logarithm = std::max(v.angle, alpha * 1e-4);
  SplitSum total;
  for_lights(v, std::min(2 * alpha, 2 * logarithm), std::min(0.5 * alpha, logarithm),
             [&](const Pair& pair, double weight) {
               const SplitSum around = ggx_around(pair, alpha);
               const double w = weight * pair.nl * ggx_visibility(pair.nl, nv, alpha, masking);
               total.one += w * around.one;
               total.fc += w * around.fc;
             });
  return within_limits(total, masking);
}

double ggx_average_albedo(double roughness, GgxMasking masking) {
  check_arguments(1, roughness);
  if (roughness < lobe::kMirrorRoughness) return 1;
  double sum = 0;
  for_graded_nodes(kPi / 2, 0.5 * roughness * roughness, [&](double angle, double weight) {
    const double mu = std::sin(std::min(angle, kPi / 2));
    sum += weight * 2 * mu * std::cos(angle) * ggx_split_sum(mu, roughness, masking).one;
  });
  return sum;
}

double charlie_albedo(double nv_asked, double roughness_asked, ClothMasking masking) {
  check_arguments(nv_asked, roughness_asked);
  const double nv = std::max(nv_asked, kSmallestClothCosine),
               roughness = std::max(roughness_asked, kSmallestClothRoughness);
  const double alpha = roughness * roughness, exponent = 0.5 / alpha;
  const Elevation v = elevation_of_sine(nv);
  const double lambda_v = charlie_lambda(nv, alpha);
  const double scale = std::min(roughness, v.angle);
  double total = 0;
  for_lights(v, scale, scale * 1e-2, [&](const Pair& pair, double weight) {
    const double visibility = masking == ClothMasking::neubelt
                                  ? pair.nl * neubelt_visibility(pair.nl, nv)
                                  : 0.25 / ((1 + charlie_lambda(pair.nl, alpha) + lambda_v) * nv);
    // sin^(1/α)θh = (1 + C²/S)^(−1/2α), which falls off at S ≈ C²/2α.
    const AzimuthRule& rule = azimuth_rule(std::sqrt(pair.c_squared / (pair.c_squared + pair.product)));
    double sum = 0;
    for (std::size_t i = 0; i < rule.weights.size(); ++i) {
      const double s = pair.nearest + pair.product * rule.sine_squared[i];
      if (s > 0) sum += rule.weights[i] * std::exp(-exponent * std::log1p(pair.c_squared / s));
    }
    total += weight * visibility * (2 + 1 / alpha) / kPi * sum;
  });
  return total;
}

double disney_diffuse_albedo(double nv, double roughness) {
  check_arguments(nv, roughness);
  // With g = roughness (1 + l·v) − ½, the mean over azimuth and the rest are polynomials of n·l, of degree 13
  // at most.
  const QuadratureRule& rule = gauss_rule(8);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double nl = 0.5 * (1 + rule.nodes[i]);
    const double al = schlick_weight(nl), av = schlick_weight(nv);
    const double mean = roughness * (1 + nl * nv) - 0.5;
    const double swing = roughness * roughness * (1 - nl * nl) * (1 - nv * nv);
    sum += rule.weights[i] * nl * ((1 + mean * al) * (1 + mean * av) + 0.5 * swing * al * av);
  }
  return sum;
}

}  // namespace welkin::brdf
