#include "welkin/lookup/gaussian_stack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "welkin/base/cpu.h"
#include "welkin/filter/sampler.h"
#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/lookup/gaussian_levels.h"
#include "welkin/lookup/gaussian_taps.h"

namespace welkin {
namespace {

/// For each reach.
using TapRules = std::vector<GaussianTapRules>;

const TapRules& tap_rules(GaussianAccuracy accuracy) {
  const auto make = [](GaussianAccuracy which) {
    TapRules rules;
    for (int i = 0; i < GaussianTapRules::kReaches; ++i)
      rules.emplace_back(quality_of(which), GaussianTapRules::reach_at(i));
    return rules;
  };
  static const TapRules percent = make(GaussianAccuracy::percent);
  static const TapRules permille = make(GaussianAccuracy::permille);
  return accuracy == GaussianAccuracy::permille ? permille : percent;
}

float squared(const Vec3<float>& v) {
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// Whether float arithmetic does for a cone, and shows it to be without a fault.
bool is_plain(const EllipticalCone& cone) {
  constexpr float kLeast = 1e-12f, kMost = 1e12f;
  const float d = squared(cone.direction);
  if (!(d > kLeast && d < kMost && cone.narrow >= 0 && cone.wide >= cone.narrow && cone.wide < kMost))
    return false;
  if (cone.wide == cone.narrow) return true;
  const float a = squared(cone.axis);
  return a > kLeast && a < kMost && squared(cross(cone.direction, cone.axis)) > 1e-4f * a * d;
}

Vec3<float> to_float(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A cone with unit vectors.
EllipticalCone straightened(const EllipticalCone& cone) {
  const Vec3d d = normalize(Vec3d{cone.direction.x, cone.direction.y, cone.direction.z});
  if (!(cone.wide > cone.narrow)) return {to_float(d), {}, cone.wide, cone.narrow};
  const Vec3d a = normalize(Vec3d{cone.axis.x, cone.axis.y, cone.axis.z});
  return {to_float(d), to_float(normalize(a - dot(a, d) * d)), cone.wide, cone.narrow};
}

}  // namespace

/// What copies share.
class GaussianStack::State {
 public:
  State(Sampler source, const Map& map, const GaussianStackOptions& options, const Monitor& monitor)
      : source_(std::move(source)),
        levels_(make_gaussian_levels(map, options.accuracy, monitor)),
        rules_(tap_rules(options.accuracy)),
        kernels_(gaussian_kernels()) {
    const float lowest = levels_.intervals[0].lowest;
    base_ = std::log2(lowest);
    per_step_ = static_cast<float>(levels_.intervals.size()) / (std::log2(levels_.highest) - base_);
    bilinear_ = static_cast<float>(levels_.texel * levels_.texel / 6);
    narrowest_tap_ = static_cast<float>(std::sqrt(std::max(double{bilinear_}, 1e-12)));
  }

  int channels() const { return levels_.channels; }
  std::size_t bytes() const { return levels_.halves.size(); }
  double texel() const { return levels_.texel; }

  void look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const;

 private:
  struct Pending;
  struct Batch;
  static constexpr std::size_t kFewChannels = 4;

  /// What the levels have in a cone of this σ²; below them the source's bilinear interpolation has the rest.
  float share_of(float variance) const {
    return std::clamp((variance - bilinear_) / (levels_.intervals[0].lowest - bilinear_), 0.0f, 1.0f);
  }

  std::size_t width() const { return 2 * static_cast<std::size_t>(levels_.channels); }
  const std::uint16_t* texels_of(const GaussianInterval& interval) const {
    return levels_.values() + static_cast<std::size_t>(interval.first) * width();
  }
  std::size_t pitch_of(const GaussianInterval& interval) const {
    return static_cast<std::size_t>(interval.size + 2) * width();
  }
  const GaussianInterval& interval_at(float variance) const;
  const GaussianTapRules& rules_at(const GaussianInterval& interval) const {
    return rules_[static_cast<std::size_t>(interval.reach)];
  }
  /// A look-up's last step: from the sums of the pair to radiance.
  void finish(const GaussianInterval& interval, float variance, const float* sums, float* out) const;
  void flush(Batch& batch, float* sums, float* radiance) const;
  void look_up_alone(const EllipticalCone& cone, Batch& batch, float* sums, float* out) const;
  void add_source(const GaussianTaps& taps, std::size_t count, double* out) const;

  Sampler source_;
  GaussianLevels levels_;
  const TapRules& rules_;
  const GaussianKernels& kernels_;
  float base_, per_step_;  ///< log2 of the least σ²; intervals for each doubling
  float bilinear_;         ///< σ² of the source's bilinear interpolation
  float narrowest_tap_;    ///< σ of the narrowest thing that taps can see
};

/// A cone whose taps are in the batch.
struct GaussianStack::State::Pending {
  const GaussianInterval* interval;
  float variance;  ///< σ² at which the levels are looked up
  float share;     ///< that the levels have; the source has the rest
  std::size_t cone, from, to;
};

struct GaussianStack::State::Batch {
  GaussianTaps taps;
  std::size_t used = 0, waiting = 0;
  Pending pending[GaussianTaps::kMost];
};

const GaussianInterval& GaussianStack::State::interval_at(float variance) const {
  const int last = static_cast<int>(levels_.intervals.size()) - 1;
  // log2 from the exponent and a linear mantissa, at most 0.09 too small; put right by the table.
  const float log2 =
      static_cast<float>(static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(variance)) - 0x3f800000) *
      0x1p-23f;
  int k = std::clamp(static_cast<int>((log2 - base_) * per_step_), 0, last);
  while (k > 0 && variance < levels_.intervals[static_cast<std::size_t>(k)].lowest) --k;
  while (k < last && variance >= levels_.intervals[static_cast<std::size_t>(k) + 1].lowest) ++k;
  return levels_.intervals[static_cast<std::size_t>(k)];
}

void GaussianStack::State::finish(const GaussianInterval& interval, float variance, const float* sums,
                                  float* out) const {
  const float within = std::min(variance, levels_.highest);
  const float t = (within - interval.node) * interval.per_variance;
  // Past 90° what is left are differences of degree 1, which fall as exp(−σ²).
  const float kept = variance > levels_.highest ? std::exp(levels_.highest - variance) : 1.0f;
  const std::size_t channels = static_cast<std::size_t>(levels_.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const ChannelScale& scale = levels_.scales[c];
    const float a = sums[c], b = sums[channels + c];
    float value = a + t * (b - a);
    // The line goes on past its nodes. Far out in a Gaussian's tail, where the two differ by large factors,
    // it must not reach 0.
    if (scale.positive) value = std::max(value, 0.25f * std::max(0.0f, std::min(a, b)));
    value *= scale.scale;
    out[c] = kept < 1 ? scale.mean + kept * (value - scale.mean) : value;
  }
}

void GaussianStack::State::flush(Batch& batch, float* sums, float* radiance) const {
  kernels_.locate(batch.taps, batch.used);
  // The cache is told of everything before the first texel is read.
  for (std::size_t i = 0; i < batch.waiting; ++i) {
    const Pending& one = batch.pending[i];
    const std::size_t pitch = pitch_of(*one.interval), last = 3 * width() - 1;
    for (std::size_t k = one.from; k < one.to; ++k) {
      const std::uint16_t* texel =
          texels_of(*one.interval) + static_cast<std::size_t>(batch.taps.texel[k]) * width();
      for (std::size_t r = 0; r < 3; ++r, texel += pitch) {
        __builtin_prefetch(texel);
        __builtin_prefetch(texel + last);
      }
    }
  }
  const std::size_t channels = static_cast<std::size_t>(levels_.channels);
  for (std::size_t i = 0; i < batch.waiting; ++i) {
    const Pending& one = batch.pending[i];
    float* out = radiance + one.cone * channels;
    if (one.share > 0) {
      std::fill_n(sums, width() + 8, 0.0f);
      kernels_.gather(batch.taps, one.from, one.to, texels_of(*one.interval), width(),
                      pitch_of(*one.interval), sums);
      finish(*one.interval, one.variance, sums, out);
    } else {
      std::fill_n(out, channels, 0.0f);
    }
  }
  // Those that see the source too: the taps of neighbouring cones lie side by side.
  for (std::size_t i = 0; i < batch.waiting; ++i) {
    std::size_t end = i;
    while (end < batch.waiting && batch.pending[end].share < 1) ++end;
    if (end == i) continue;
    float values[kFewChannels * GaussianTaps::kMost];
    const GaussianTaps& taps = batch.taps;
    const std::size_t first = batch.pending[i].from, count = batch.pending[end - 1].to - first;
    source_.look_up(
        DirectionArrays{{taps.x + first, count}, {taps.y + first, count}, {taps.z + first, count}}, values);
    for (; i < end; ++i) {
      const Pending& one = batch.pending[i];
      float* out = radiance + one.cone * channels;
      for (std::size_t c = 0; c < channels; ++c) {
        float sum = 0;
        for (std::size_t k = one.from; k < one.to; ++k)
          sum += taps.weight[k] * values[(k - first) * channels + c];
        out[c] = one.share * out[c] + (1 - one.share) * sum;
      }
    }
  }
  batch.used = batch.waiting = 0;
}

void GaussianStack::State::look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const {
  bool plain = true;
  for (const EllipticalCone& cone : cones) {
    if (is_plain(cone)) continue;
    plain = false;
    const std::string fault = fault_of(cone);
    if (!fault.empty()) throw Error(ErrorKind::bad_request, fault);
  }
  require(radiance.size() / static_cast<std::size_t>(channels()) >= cones.size(),
          "there is not enough room for the radiance of all cones");

  Batch batch;
  float few[72];
  std::vector<float> many(width() + 8 > std::size(few) ? width() + 8 : 0);
  float* sums = many.empty() ? few : many.data();
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const EllipticalCone& given = cones[i];
    const bool round = !(given.wide > given.narrow);
    const float variance = given.narrow * given.narrow, lowest = levels_.intervals[0].lowest;
    const float share = variance < lowest ? share_of(variance) : 1;
    const GaussianInterval& interval = interval_at(variance);
    const GaussianTapRules& rules = rules_at(interval);
    std::size_t count = 1;
    float spread = 0;
    if (!round) {
      spread = std::sqrt(given.wide * given.wide - variance);
      const float tap = std::max(given.narrow, narrowest_tap_);
      count = rules.count(std::sqrt(spread * spread + tap * tap), tap, spread);
    }
    if (count > GaussianTapRules::kMost || spread * rules.reach() > kPi || !(plain || is_plain(given)) ||
        (share < 1 && width() > 2 * kFewChannels)) {
      flush(batch, sums, radiance.data());
      look_up_alone(straightened(given), batch, sums,
                    radiance.data() + i * static_cast<std::size_t>(channels()));
      continue;
    }
    if (batch.used + count > GaussianTaps::kMost) flush(batch, sums, radiance.data());

    GaussianTaps& taps = batch.taps;
    const std::size_t at = batch.used;
    if (round) {
      taps.x[at] = given.direction.x;
      taps.y[at] = given.direction.y;
      taps.z[at] = given.direction.z;
      taps.weight[at] = 1;
    } else {
      const Vec3<float> d = normalize(given.direction);
      const Vec3<float> a = normalize(given.axis - dot(given.axis, d) * d);
      const GaussianTapRules::Rule rule = rules.rule(count);
      kernels_.spread({{d.x, d.y, d.z}, {a.x, a.y, a.z}, spread, rule.nodes, count}, taps, at);
      std::copy_n(rule.weights, count, taps.weight + at);
    }
    std::fill_n(taps.size + at, count, static_cast<float>(interval.size));
    batch.pending[batch.waiting++] = {&interval, std::max(variance, lowest), share, i, at, at + count};
    batch.used += count;
  }
  flush(batch, sums, radiance.data());
}

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

GaussianStack::GaussianStack(std::shared_ptr<const Map> map, const GaussianStackOptions& options,
                             const Monitor& monitor) {
  require(map != nullptr, "there is no map to look up");
  state_ = std::make_shared<const State>(Sampler(map), *map, options, monitor);
}

GaussianStack::GaussianStack(Map map, const GaussianStackOptions& options, const Monitor& monitor)
    : GaussianStack(std::make_shared<const Map>(std::move(map)), options, monitor) {}

GaussianStack GaussianStack::borrow(const Map& map, const GaussianStackOptions& options,
                                    const Monitor& monitor) {
  return GaussianStack(std::make_shared<const State>(Sampler::borrow(map), map, options, monitor));
}

int GaussianStack::channels() const {
  return state_->channels();
}

std::size_t GaussianStack::bytes() const {
  return state_->bytes();
}

double GaussianStack::narrowest() const {
  return state_->texel();
}

void GaussianStack::look_up(const EllipticalCone& cone, std::span<float> radiance) const {
  state_->look_up({&cone, 1}, radiance);
}

void GaussianStack::look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const {
  state_->look_up(cones, radiance);
}

std::array<float, 3> GaussianStack::rgb(const EllipticalCone& cone) const {
  require(channels() >= 3, "the map has fewer than three channels");
  std::array<float, 3> rgb;
  if (channels() == 3) {
    look_up(cone, rgb);
    return rgb;
  }
  std::vector<float> all(static_cast<std::size_t>(channels()));
  look_up(cone, all);
  std::copy_n(all.begin(), 3, rgb.begin());
  return rgb;
}

GaussianAccuracy gaussian_accuracy_from_name(std::string_view name) {
  if (name == "1%") return GaussianAccuracy::percent;
  if (name == "0.1%") return GaussianAccuracy::permille;
  const std::string known[] = {"1%", "0.1%"};
  throw Error(ErrorKind::bad_request, unknown_name("accuracy", name, known));
}

const GaussianKernels& gaussian_kernels() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2 && has_f16c()) return gaussian_kernels_avx2();
#endif
  return gaussian_kernels_baseline();
}

}  // namespace welkin
