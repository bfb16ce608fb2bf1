#include "welkin/prefilter/lobe_sum_bake.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/brdf/lobe_sum.h"
#include "welkin/map/texel_points.h"
#include "welkin/prefilter/table_digits.h"
#include "welkin/prefilter/view_stack.h"

namespace welkin {
namespace {

/// A mirror's albedo is that of a surface this rough.
constexpr double kNearMirror = 0.02;

/// Between which two roughnesses one lies, and how far from the first.
struct RoughnessPosition {
  std::size_t below, above;
  double part;
};

RoughnessPosition position_in(const std::vector<double>& all, double roughness) {
  if (all.size() == 1) return {0, 0, 0};
  if (!(roughness >= all.front() && roughness <= all.back()))
    throw Error(ErrorKind::bad_request, "the roughness " + number_text(roughness) +
                                            " is not in the table's " + number_text(all.front()) + "…" +
                                            number_text(all.back()));
  const auto next = std::upper_bound(all.begin() + 1, all.end() - 1, roughness);
  const auto above = static_cast<std::size_t>(next - all.begin());
  return {above - 1, above, (roughness - all[above - 1]) / (all[above] - all[above - 1])};
}

}  // namespace

LobeSums fit_lobe_sums(const LobeSumOptions& options, const Monitor& monitor) {
  require(options.bake.lobe.has_roughness() && options.bake.chain,
          "lobes are added from a chain, whose lobe has a roughness");
  require(options.count >= 1 && options.count <= 16, "a sum has 1 to 16 look-ups");
  const std::vector<PrefilterLevel> levels = bake_levels(options.bake);
  std::vector<lobe::AnyLobe> lobes;
  for (const PrefilterLevel& each : levels) lobes.push_back(each.lobe);
  LobeSums sums;
  const bool rough = options.brdf.has_roughness();
  sums.brdf = rough ? options.brdf.with_roughness(brdf::AnyBrdf::make(options.brdf.name()).roughness()).spec()
                    : options.brdf.spec();
  sums.view_cosines = options.view_cosines;
  sums.roughness = !rough ? std::vector{0.0} : options.roughness;
  if (sums.roughness.empty()) sums.roughness = bake_notes(options.bake).roughness;
  sums.roughness.erase(std::unique(sums.roughness.begin(), sums.roughness.end()), sums.roughness.end());
  sums.count = options.count;
  const std::size_t rows = sums.roughness.size(), pairs = sums.view_cosines.size() * rows;
  require(pairs > 0 && pairs <= 65536, "a table of sums has 1 to 65536 entries");
  sums.look_ups.resize(pairs * static_cast<std::size_t>(sums.count));
  sums.albedo = {static_cast<int>(rows), std::vector<double>(pairs)};
  const brdf::LobeBasis basis(lobes, mean_texel(options.bake.target, levels.front().size));
  parallel_for(
      static_cast<int>(pairs),
      [&](int pair) {
        const auto at = static_cast<std::size_t>(pair);
        const double cosine = sums.view_cosines[at / rows], from_normal = std::acos(std::min(1.0, cosine));
        brdf::AnyBrdf brdf = options.brdf;
        if (rough) brdf = brdf.with_roughness(sums.roughness[at % rows]);
        LobeLookUp* to = &sums.look_ups[at * static_cast<std::size_t>(sums.count)];
        if (brdf.is_mirror()) {
          to[0] = {1, 0, 0};
          sums.albedo.values[at] =
              prefilter::table_digits(brdf::directional_albedo(brdf.with_roughness(kNearMirror), cosine));
          return;
        }
        sums.albedo.values[at] = prefilter::table_digits(brdf::directional_albedo(brdf, cosine));
        double rest = 1;
        LobeLookUp* strongest = to;
        for (const brdf::LobeTerm& term : brdf::fit_lobe_sum(brdf, cosine, basis, sums.count)) {
          *to = {prefilter::table_digits(term.weight), prefilter::table_digits(term.level),
                 from_normal > 1e-6 ? prefilter::table_digits(term.tilt / from_normal) : 0.0};
          rest -= to->weight;
          ++to;
        }
        strongest->weight += rest;  // what rounding left
      },
      monitor);
  return sums;
}

LobeSumChain bake_lobe_sums(const Map& source, const LobeSumOptions& options, const Monitor& monitor) {
  LobeSums sums = fit_lobe_sums(options, part_of(monitor, 0, 0.7));
  LobeSumChain made{bake(source, options.bake, part_of(monitor, 0.7, 1)), std::move(sums)};
  made.check();
  return made;
}

LobeSumSampler::LobeSumSampler(LobeSumChain chain, const SamplerOptions& options)
    : sums_((chain.check(), std::move(chain.sums))), sampler_(std::move(chain.chain), options) {}

void LobeSumSampler::look_up(const Vec3d& normal, const Vec3d& view, double roughness,
                             std::span<float> radiance) const {
  const auto channels = static_cast<std::size_t>(sampler_.channels());
  require(radiance.size() >= channels, "a look-up has room for all channels");
  const ViewPosition view_at = view_position(sums_.view_cosines, dot(normal, view));
  const RoughnessPosition at = position_in(sums_.roughness, roughness);
  std::array<float, kMaxChannels> values;
  std::array<double, kMaxChannels> total{};
  for (int k = 0; k < 4; ++k) {
    const double part = (k % 2 == 0 ? 1 - view_at.part : view_at.part) * (k / 2 == 0 ? 1 - at.part : at.part);
    if (part == 0) continue;
    const LobeLookUp* sum =
        sums_.at(k % 2 == 0 ? view_at.below : view_at.above, k / 2 == 0 ? at.below : at.above);
    for (int i = 0; i < sums_.count; ++i) {
      if (sum[i].weight == 0) continue;
      const Vec3d direction = ViewStack::look_up_direction(normal, view, sum[i].lift);
      sampler_.look_up(direction, std::span(values).first(channels), sum[i].level);
      for (std::size_t c = 0; c < channels; ++c)
        total[c] += part * sum[i].weight * static_cast<double>(values[c]);
    }
  }
  for (std::size_t c = 0; c < channels; ++c) radiance[c] = static_cast<float>(total[c]);
}

std::array<float, 3> LobeSumSampler::rgb(const Vec3d& normal, const Vec3d& view, double roughness) const {
  require(channels() >= 3, "the chain has fewer than three channels");
  std::array<float, kMaxChannels> values;
  look_up(normal, view, roughness, values);
  return {values[0], values[1], values[2]};
}

double LobeSumSampler::albedo(double view_cosine, double roughness) const {
  const ViewPosition view_at = view_position(sums_.view_cosines, view_cosine);
  const RoughnessPosition at = position_in(sums_.roughness, roughness);
  const auto between = [&](std::size_t row) {
    const double a = sums_.albedo.at(view_at.below, row), b = sums_.albedo.at(view_at.above, row);
    return a + view_at.part * (b - a);
  };
  return between(at.below) + at.part * (between(at.above) - between(at.below));
}

}  // namespace welkin
