#include "welkin/brdf/fresnel.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/brdf/microfacet.h"

namespace welkin::brdf {
namespace {

/// What a texture unit returns at a coordinate: linear between texel centres, constant beyond the outermost.
double read_linear(const std::vector<float>& table, double cosine, TexelPlacement placement) {
  const auto last = static_cast<double>(table.size() - 1);
  const double position = placement == TexelPlacement::ends ? cosine * last : cosine * (last + 1) - 0.5;
  const double inside = std::clamp(position, 0.0, last);
  const auto low = static_cast<std::size_t>(inside);
  const double rest = inside - static_cast<double>(low);
  return table[low] + rest * (table[std::min(low + 1, table.size() - 1)] - table[low]);
}

}  // namespace

void check(const Boundary& boundary) {
  const auto refuse = [](const char* name, double value, const std::string& range) {
    throw Error(ErrorKind::bad_request, std::string("the index's ") + name + " is " + number_text(value) +
                                            ", not a number in " + range);
  };
  const std::string largest = number_text(kLargestIndex);
  if (!(boundary.n >= 1 / kLargestIndex && boundary.n <= kLargestIndex))
    refuse("n", boundary.n, number_text(1 / kLargestIndex) + " to " + largest);
  if (!(boundary.k >= 0 && boundary.k <= kLargestIndex)) refuse("k", boundary.k, "0 to " + largest);
}

double fresnel(double cosine, const Boundary& boundary) {
  check(boundary);
  require(cosine >= 0 && cosine <= 1, "the cosine of an angle of incidence is a number from 0 to 1");
  return boundary.k == 0 ? fresnel_dielectric(cosine, boundary.n)
                         : fresnel_conductor(cosine, boundary.n, boundary.k);
}

double critical_cosine(const Boundary& boundary) {
  check(boundary);
  if (boundary.k > 0 || boundary.n >= 1) return 0;
  return std::sqrt((1 - boundary.n) * (1 + boundary.n));
}

std::vector<float> fresnel_table(const Boundary& boundary, int count, TexelPlacement placement) {
  constexpr int kLargestCount = 65536;
  require(count >= 1 && count <= kLargestCount, "a Fresnel table has 1 to 65536 texels");
  std::vector<float> table;
  for (int i = 0; i < count; ++i)
    table.push_back(static_cast<float>(fresnel(texel_coordinate(i, count, placement), boundary)));
  return table;
}

double fresnel_table_error(const Boundary& boundary, const std::vector<float>& table,
                           TexelPlacement placement) {
  require(!table.empty(), "a Fresnel table has at least one texel");
  // The difference is largest where F bends: between texels, most of all at both ends and where total
  // reflection begins.
  constexpr int kSteps = 8;
  double largest = 0;
  const auto look = [&](double cosine) {
    const double c = std::clamp(cosine, 0.0, 1.0);
    largest = std::max(largest, std::fabs(fresnel(c, boundary) - read_linear(table, c, placement)));
  };
  const int steps = kSteps * static_cast<int>(table.size());
  for (int i = 0; i <= steps; ++i) look(static_cast<double>(i) / steps);
  for (double away = 0.5; away > 1e-12; away /= 2) {
    look(away);
    look(critical_cosine(boundary) + away);
  }
  look(critical_cosine(boundary));
  return largest;
}

}  // namespace welkin::brdf
