#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "welkin/math/angles.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {
namespace {

struct Lamp {
  Vec3d direction;
  Color radiance;
};

/// A stream of numbers that is the same on every machine: SplitMix64 (Steele, Lea & Flood 2014).
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : state_(seed) {}

  /// Uniform in (0, 1).
  double uniform() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return (static_cast<double>(z >> 11) + 0.5) * 0x1p-53;
  }

  /// Standard normal (Box & Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * kPi * uniform());
  }

 private:
  std::uint64_t state_;
};

/// The lamps sorted into cells of the cube [−1, 1]³; a lamp is in each cell that its disc may touch.
class LampField {
 public:
  LampField(std::vector<Lamp> lamps, double radius) : lamps_(std::move(lamps)), cosine_(cos(radius)) {
    const double reach = 2 * sin(radius / 2);
    std::vector<std::array<std::size_t, 2>> entries;  // cell, lamp
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
      const Vec3d& d = lamps_[i].direction;
      for (std::size_t z = slot(d.z - reach); z <= slot(d.z + reach); ++z) {
        for (std::size_t y = slot(d.y - reach); y <= slot(d.y + reach); ++y) {
          for (std::size_t x = slot(d.x - reach); x <= slot(d.x + reach); ++x)
            entries.push_back({cell(x, y, z), i});
        }
      }
    }
    std::sort(entries.begin(), entries.end());
    starts_.assign(kSlots * kSlots * kSlots + 1, 0);
    for (const auto& [where, lamp] : entries) {
      ++starts_[where + 1];
      members_.push_back(lamp);
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  }

  /// Sum of the lamps that shine along d.
  Color operator()(const Vec3d& d) const {
    Color sum{0, 0, 0};
    const std::size_t where = cell(slot(d.x), slot(d.y), slot(d.z));
    for (std::size_t i = starts_[where]; i < starts_[where + 1]; ++i) {
      const Lamp& lamp = lamps_[members_[i]];
      if (dot(lamp.direction, d) >= cosine_) sum = sum + lamp.radiance;
    }
    return sum;
  }

 private:
  static constexpr std::size_t kSlots = 48;
  static std::size_t slot(double x) {
    return static_cast<std::size_t>(clamp((x + 1) / 2 * kSlots, 0.0, kSlots - 1.0));
  }
  static std::size_t cell(std::size_t x, std::size_t y, std::size_t z) {
    return (z * kSlots + y) * kSlots + x;
  }

  std::vector<Lamp> lamps_;
  std::vector<std::size_t> starts_, members_;
  double cosine_;
};

}  // namespace

/// Equal discs, evenly scattered over the sphere. The logarithm of radiance is normal with σ = 4/3, redrawn
/// outside ±3σ: a range of e⁸ about the median, `intensity`. Colours run from amber to daylight. Where discs
/// overlap they add.
Radiance make_lamps(const SynthOptions& options) {
  const int count = whole_option_or(options.frequency, 3000, 1, {"lamps", "frequency", 1, 1e6});
  const double radius = option_or(options.angle, 0.5, {"lamps", "angle", 0, 3}) * kDegree / 2;
  const double median = option_or(options.intensity, 50, {"lamps", "intensity", 0, 1e9});
  const double background = checked_option(options.background, {"lamps", "background", 0, 1e9});

  Stream stream(options.seed);
  std::vector<Lamp> lamps(static_cast<std::size_t>(count));
  for (Lamp& lamp : lamps) {
    const double y = 2 * stream.uniform() - 1, turn = 2 * kPi * stream.uniform();
    const double level = std::sqrt(1 - y * y);
    lamp.direction = {level * std::sin(turn), y, level * std::cos(turn)};
    double sigmas = stream.normal();
    while (abs(sigmas) > 3) sigmas = stream.normal();
    const Color tint = mix({1.0, 0.55, 0.20}, {0.80, 0.90, 1.0}, stream.uniform());
    lamp.radiance = (median * std::exp(sigmas * 4 / 3) / luminance(tint)) * tint;
  }
  const auto field = std::make_shared<const LampField>(std::move(lamps), radius);
  return [=](const Vec3d& d) { return to_radiance(Color{background, background, background} + (*field)(d)); };
}

}  // namespace welkin::synth
