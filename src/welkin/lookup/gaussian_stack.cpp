#include "welkin/lookup/gaussian_stack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "welkin/base/cpu.h"
#include "welkin/lookup/gaussian_state.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

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

/// A cone with unit vectors.
EllipticalCone straightened(const EllipticalCone& cone) {
  const Vec3d d = normalize(Vec3d{cone.direction.x, cone.direction.y, cone.direction.z});
  if (!(cone.wide > cone.narrow)) return {to_float(d), {}, cone.wide, cone.narrow};
  const Vec3d a = normalize(Vec3d{cone.axis.x, cone.axis.y, cone.axis.z});
  return {to_float(d), to_float(normalize(a - dot(a, d) * d)), cone.wide, cone.narrow};
}

}  // namespace

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
    if (scale.positive && a > 0 && b > interval.flank * a) {
      // A flank of a Gaussian, exp(−x²/2σ²)/σ²: the logarithm of σ² times it is linear in 1/σ².
      const float u = t * interval.wider / within;
      value = a * interval.node / within * std::exp2(u * std::log2(b * interval.wider / (a * interval.node)));
    } else if (scale.positive) {
      // The line goes on past its nodes, where one of them may be 0.
      value = std::max(value, 0.0f);
    }
    value *= scale.scale;
    out[c] = kept < 1 ? scale.mean + kept * (value - scale.mean) : value;
  }
}

void GaussianStack::State::flush(Batch& batch, float* sums, float* radiance) const {
  kernels_.locate(batch.taps, batch.used);
  constexpr std::size_t kTogether = 4, kAhead = 8;
  // The cache is told of texels some taps before they are read: it can wait for few at a time.
  std::size_t told = 0, told_of = 0;
  const auto tell = [&](std::size_t end) {
    for (; told < std::min(end, batch.used); ++told) {
      while (told >= batch.pending[told_of].to) ++told_of;
      const GaussianInterval& interval = *batch.pending[told_of].interval;
      const std::uint16_t* texel =
          texels_of(interval) + static_cast<std::size_t>(batch.taps.texel[told]) * width();
      for (std::size_t r = 0; r < 3; ++r, texel += pitch_of(interval)) {
        __builtin_prefetch(texel);
        __builtin_prefetch(texel + 3 * width() - 1);
      }
    }
  };
  const std::size_t channels = static_cast<std::size_t>(levels_.channels);
  for (std::size_t i = 0; i < batch.waiting; ++i) {
    const Pending& one = batch.pending[i];
    float* out = radiance + one.cone * channels;
    if (one.share > 0) {
      std::fill_n(sums, width() + 8, 0.0f);
      for (std::size_t k = one.from; k < one.to; k += kTogether) {
        tell(k + kTogether + kAhead);
        kernels_.gather(batch.taps, k, std::min(k + kTogether, one.to), texels_of(*one.interval), width(),
                        pitch_of(*one.interval), sums);
      }
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
