#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/lookup/probe_row.h"
#include "welkin/lookup/trilinear.h"

namespace welkin {
namespace {

static_assert(kMostProbes <= static_cast<int>(kConeTile));

/// Half of the row of probes, in σ of what they spread by.
constexpr float kReach = 2.25f;
/// Between two probes, in σ of each: a sum of Gaussians so far apart ripples by 2 exp(−2π²/s²) = 1.4 %.
constexpr float kSpacing = 2;

class ProbesLookUp final : public ConeLookUp {
 public:
  ProbesLookUp(const SharedMap& map, int most)
      : trilinear_(map), most_(most), whole_world_(map->parameterization.whole_world()) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    const std::size_t channels = trilinear_.channels();
    std::fill_n(radiance, cones.size() * channels, 0.0f);
    std::array<float, kConeTile> areas;
    trilinear_.areas_of(cones, areas.data());
    Batch batch;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const AimedCone& cone = cones[i];
      const ProbeRow row = probe_row(cone.wide, cone.narrow, most_);
      const MeanLevel level = trilinear_.level_of(row.sigma * row.sigma, areas[i]);
      for (int k = 0; k < row.count; ++k) {
        if (batch.count == kConeTile) flush(batch, radiance);
        const float angle = row.angle[static_cast<std::size_t>(k)];
        batch.directions[batch.count] = std::cos(angle) * cone.world + std::sin(angle) * cone.world_axis;
        batch.levels[batch.count] = level;
        batch.share[batch.count] = row.share[static_cast<std::size_t>(k)];
        batch.owner[batch.count] = i;
        ++batch.count;
      }
    }
    flush(batch, radiance);
    if (whole_world_) return;
    // What the map doesn't show is left out. Where a wide row misses all of it, its middle stands for it.
    for (std::size_t i = 0; i < cones.size(); ++i) {
      if (batch.shown[i] > 0) continue;
      batch.directions[batch.count] = cones[i].world;
      batch.levels[batch.count] = trilinear_.level_of(cones[i].wide * cones[i].narrow, areas[i]);
      batch.share[batch.count] = 1;
      batch.owner[batch.count] = i;
      ++batch.count;
    }
    flush(batch, radiance);
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const float shown = batch.shown[i];
      for (std::size_t c = 0; c < channels; ++c) {
        if (shown > 0) radiance[i * channels + c] /= shown;
      }
    }
  }

 private:
  /// Probes of several cones, looked up together.
  struct Batch {
    std::size_t count = 0;
    std::array<Vec3<float>, kConeTile> directions;
    std::array<MeanLevel, kConeTile> levels;
    std::array<float, kConeTile> share;
    std::array<std::size_t, kConeTile> owner;
    std::array<float, kConeTile * kMaxChannels> values;
    std::array<float, kConeTile> shown{};  ///< by cone: the shares of probes that the map shows
  };

  void flush(Batch& batch, float* radiance) const {
    if (batch.count == 0) return;
    const std::size_t channels = trilinear_.channels();
    trilinear_.look_up({batch.directions.data(), batch.count}, {batch.levels.data(), batch.count},
                       batch.values.data());
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (!whole_world_) {
        if (!trilinear_.covers(batch.directions[i])) continue;
        batch.shown[batch.owner[i]] += batch.share[i];
      }
      float* out = radiance + batch.owner[i] * channels;
      for (std::size_t c = 0; c < channels; ++c) out[c] += batch.share[i] * batch.values[i * channels + c];
    }
    batch.count = 0;
  }

  Trilinear trilinear_;
  int most_;
  bool whole_world_;
};

}  // namespace

ProbeRow probe_row(float wide, float narrow, int most) {
  ProbeRow row;
  row.angle[0] = 0;
  row.share[0] = 1;
  row.count = 1;
  row.sigma = std::sqrt(wide * narrow);
  const float gap = wide * wide - narrow * narrow;
  if (most == 1 || !(gap > 1e-6f * wide * wide)) return row;
  // As many as lie no farther apart than kSpacing; where those are too many, each becomes wider until `most`
  // are enough: 2·kReach·√(wide² − σ²) = (most − 1)·kSpacing·σ.
  const float wanted =
      std::ceil(2 * kReach * std::sqrt(gap) / (kSpacing * std::max(narrow, 1e-6f * wide))) + 1;
  row.count = wanted < static_cast<float>(most) ? static_cast<int>(wanted) : most;
  const float slope = 2 * kReach / (kSpacing * static_cast<float>(row.count - 1));
  row.sigma = std::max(narrow, wide * slope / std::sqrt(1 + slope * slope));
  const float spread = std::sqrt(wide * wide - row.sigma * row.sigma);
  const float step = 2 * kReach * spread / static_cast<float>(row.count - 1);
  float total = 0, variance = 0;
  for (int i = 0; i < row.count; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const float x = (static_cast<float>(i) - 0.5f * static_cast<float>(row.count - 1)) * step;
    row.angle[k] = x;
    row.share[k] = std::exp(-0.5f * (x / spread) * (x / spread));
    total += row.share[k];
    variance += row.share[k] * x * x;
  }
  // Moved so that the variance is that of the cone, for all that the ends cut off.
  const float stretch = spread * std::sqrt(total / variance);
  for (int i = 0; i < row.count; ++i) {
    row.angle[static_cast<std::size_t>(i)] *= stretch;
    row.share[static_cast<std::size_t>(i)] /= total;
  }
  return row;
}

ConeLookUpPtr make_probes(const SharedMap& map, const ConeSamplerOptions& options) {
  if (options.probes < 1 || options.probes > kMostProbes) {
    throw Error(ErrorKind::bad_request, "look-up: " + std::to_string(options.probes) +
                                            " probes; there can be 1 to " + std::to_string(kMostProbes));
  }
  return std::make_unique<ProbesLookUp>(map, options.probes);
}

}  // namespace welkin
