#include "welkin/lookup/gaussian_state.h"

namespace welkin {

/// Adds what the source shows at the taps, interpolated between its texels, to `out`.
void GaussianStack::State::add_source(const GaussianTaps& taps, std::size_t count, double* out) const {
  const std::size_t channels = static_cast<std::size_t>(levels_.channels);
  float few[512];
  std::vector<float> many(channels > std::size(few) ? channels : 0);
  const std::span<float> values = many.empty() ? std::span<float>(few) : std::span<float>(many);
  const std::size_t most = values.size() / channels;
  for (std::size_t from = 0; from < count; from += most) {
    const std::size_t here = std::min(most, count - from);
    source_.look_up(DirectionArrays{{taps.x + from, here}, {taps.y + from, here}, {taps.z + from, here}},
                    values);
    for (std::size_t i = 0; i < here; ++i) {
      for (std::size_t c = 0; c < channels; ++c)
        out[c] += double{taps.weight[from + i]} * values[i * channels + c];
    }
  }
}

/// A cone with so many taps that they go all around or don't fit a batch, or with odd numbers; and narrow
/// ones of many channels.
void GaussianStack::State::look_up_alone(const EllipticalCone& cone, Batch& batch, float* sums,
                                         float* out) const {
  GaussianTaps& taps = batch.taps;
  const std::size_t channels = static_cast<std::size_t>(levels_.channels);
  const float variance = cone.narrow * cone.narrow;
  const float seen = std::max(variance, levels_.intervals[0].lowest);
  const GaussianInterval& interval = interval_at(seen);
  const float share = share_of(variance);

  // Steps along the great circle: all around it, or as far as the taps reach.
  const double sigma =
      std::sqrt(std::max(0.0, double{cone.wide} * cone.wide - double{cone.narrow} * cone.narrow));
  const float tap = std::max(cone.narrow, narrowest_tap_);
  const GaussianTapRules& rules = rules_at(interval);
  std::size_t count =
      sigma > 0 ? rules.count(static_cast<float>(std::hypot(sigma, tap)), tap, static_cast<float>(sigma)) : 1;
  const bool all_around = sigma * rules.reach() > kPi;
  const bool tabled = count <= GaussianTapRules::kMost && !all_around;
  const double step = all_around ? 0 : 2 * rules.reach() * sigma / static_cast<double>(count);
  if (all_around) {
    const double widest = tap * 1.5;
    count = static_cast<std::size_t>(std::ceil(2 * kPi / widest));
  }
  const double apart = all_around ? 2 * kPi / static_cast<double>(count) : step;
  const auto weight_at = [&](double angle) {
    if (!all_around) return std::exp(-0.5 * angle * angle / (sigma * sigma));
    // Where σ is over 3 radians, nothing is left of the wrapped Gaussian's waves.
    if (sigma > 6) return 1.0;
    double sum = 0;
    for (int turn = -8; turn <= 8; ++turn) {
      const double a = (angle + turn * 2 * kPi) / sigma;
      sum += std::exp(-0.5 * a * a);
    }
    return sum;
  };

  std::vector<double> all(width()), source(channels);
  double total = 0;
  float nodes[GaussianTaps::kMost + GaussianTaps::kLanes] = {};
  for (std::size_t from = 0; from < count; from += GaussianTaps::kMost) {
    const std::size_t here = std::min(GaussianTaps::kMost, count - from);
    const GaussianTapRules::Rule rule = tabled ? rules.rule(count) : GaussianTapRules::Rule{};
    for (std::size_t i = 0; i < here; ++i) {
      if (count == 1) {
        nodes[i] = 0;
        taps.weight[i] = 1;
      } else if (tabled) {
        nodes[i] = rule.nodes[i] * static_cast<float>(sigma);
        taps.weight[i] = rule.weights[i];
      } else {
        const double angle = (static_cast<double>(from + i) - 0.5 * static_cast<double>(count - 1)) * apart;
        nodes[i] = static_cast<float>(angle);
        taps.weight[i] = static_cast<float>(weight_at(angle));
      }
      total += taps.weight[i];
      taps.size[i] = static_cast<float>(interval.size);
    }
    kernels_.spread({{cone.direction.x, cone.direction.y, cone.direction.z},
                     {cone.axis.x, cone.axis.y, cone.axis.z},
                     1,
                     nodes,
                     here},
                    taps, 0);
    if (share > 0) {
      std::fill_n(sums, width() + 8, 0.0f);
      kernels_.locate(taps, here);
      kernels_.gather(taps, 0, here, texels_of(interval), width(), pitch_of(interval), sums);
      for (std::size_t c = 0; c < width(); ++c) all[c] += sums[c];
    }
    if (share < 1) add_source(taps, here, source.data());
  }
  for (std::size_t c = 0; c < width(); ++c) sums[c] = static_cast<float>(all[c] / total);
  std::vector<float> wide(channels);
  if (share > 0) finish(interval, seen, sums, wide.data());
  for (std::size_t c = 0; c < channels; ++c)
    out[c] = share * wide[c] + (1 - share) * static_cast<float>(source[c] / total);
}

}  // namespace welkin
