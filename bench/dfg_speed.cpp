// How long a split-sum table takes, and how far it is from the integrals; beside importance sampling, as
// cmgen does it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "harness.h"
#include "welkin/base/parallel.h"
#include "welkin/brdf/dfg_table.h"
#include "welkin/brdf/microfacet.h"

namespace {

using namespace welkin;
using namespace welkin::bench;
using namespace welkin::brdf;

constexpr int kSize = 128;

DfgTable spec() {
  return {.width = kSize, .height = kSize, .channels = {DfgChannel::bias, DfgChannel::one}};
}

double radical_inverse(unsigned i) {
  double sum = 0, place = 0.5;
  for (; i != 0; i /= 2, place /= 2) sum += place * (i % 2);
  return sum;
}

/// Half vectors drawn in proportion to D (n·h), by Hammersley's points, in float64: 4 Σ V (n·l)
/// (v·h)/(n·h)/N. Walter et al. 2007, eq. 35; Karis 2013. Filament's cmgen takes 1024 of them.
SplitSum sampled(double nv, double roughness, int samples) {
  const double alpha = roughness * roughness, sv = std::sqrt(1 - nv * nv);
  SplitSum sum;
  for (int i = 0; i < samples; ++i) {
    const double phi = 2 * kPi * i / samples, u = radical_inverse(static_cast<unsigned>(i));
    const double nh2 = (1 - u) / (1 + (alpha + 1) * (alpha - 1) * u), nh = std::sqrt(nh2),
                 sh = std::sqrt(1 - nh2);
    const double vh = sv * sh * std::cos(phi) + nv * nh, nl = 2 * vh * nh - nv;
    if (nl <= 0) continue;
    const double weight = 4.0 / samples * ggx_visibility_correlated(nl, nv, alpha) * nl * vh / nh;
    sum.one += weight;
    sum.fc += weight * schlick_weight(vh);
  }
  return sum;
}

Image sampled_table(int samples) {
  const DfgTable table = spec();
  Image image(kSize, kSize, 2);
  parallel_for(kSize, [&](int y) {
    for (int x = 0; x < kSize; ++x) {
      const SplitSum sum = sampled(table.cosine_at(x, y), table.roughness_at(x, y), samples);
      image.at(x, y)[0] = static_cast<float>(sum.fc);
      image.at(x, y)[1] = static_cast<float>(sum.one);
    }
  });
  return image;
}

struct Errors {
  double largest = 0, mean = 0;
};

/// Against the integrals at every texel.
Errors errors_of(const Image& image, const std::vector<SplitSum>& reference) {
  Errors errors;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const SplitSum& wanted = reference[static_cast<std::size_t>(y * kSize + x)];
      for (const double error :
           {std::fabs(image.at(x, y)[0] - wanted.fc), std::fabs(image.at(x, y)[1] - wanted.one)}) {
        errors.largest = std::max(errors.largest, error);
        errors.mean += error / (2 * kSize * kSize);
      }
    }
  }
  return errors;
}

std::string scientific(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1e", value);
  return text.data();
}

}  // namespace

int main() {
  const Threads one(1);
  heading("Split-sum tables");
  paragraph(
      "Two channels of 128×128, ∫Fc and ∫1 of GGX with correlated masking, on one thread. *Sampling* is "
      "importance sampling of half "
      "vectors with so many samples, as Filament's cmgen makes its table (1024), in float64. Errors are "
      "absolute, against the integral at "
      "every texel.");
  const DfgTable table = spec();
  std::vector<SplitSum> reference(static_cast<std::size_t>(kSize) * kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x)
      reference[static_cast<std::size_t>(y * kSize + x)] =
          ggx_split_sum(table.cosine_at(x, y), table.roughness_at(x, y));
  }
  const auto timings = time_jobs({[&] { make_dfg_table(table); }, [] { sampled_table(1024); }}, 7);
  const Table rows({"method", "CPU ms", "largest error", "mean error", "target", "met"});
  const Errors ours = errors_of(make_dfg_table(table), reference);
  rows.row({"integrated", cpu_milliseconds(timings[0]), scientific(ours.largest), scientific(ours.mean),
            "≤ 50 ms, ≤ 1e-5", met(timings[0].median().cpu <= 0.050 && ours.largest <= 1e-5)});
  const Errors theirs = errors_of(sampled_table(1024), reference);
  rows.row({"sampling, 1024", cpu_milliseconds(timings[1]), scientific(theirs.largest),
            scientific(theirs.mean), "", ""});
}
