#include "welkin/lookup/trilinear.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin {
namespace {

constexpr int kAllLevels = 0;

Sampler pyramid_of(const SharedMap& map) {
  return Sampler(map, {.filter = Filter::bilinear, .levels = kAllLevels});
}

/// One look-up at the middle of every cone, at the level of √(wide·narrow).
class TrilinearLookUp final : public ConeLookUp {
 public:
  explicit TrilinearLookUp(const SharedMap& map) : trilinear_(map) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    std::array<float, kConeTile> areas;
    trilinear_.areas_of(cones, areas.data());
    std::array<Vec3<float>, kConeTile> directions;
    std::array<MeanLevel, kConeTile> levels;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      directions[i] = cones[i].world;
      levels[i] = trilinear_.level_of(cones[i].wide * cones[i].narrow, areas[i]);
    }
    trilinear_.look_up({directions.data(), cones.size()}, {levels.data(), cones.size()}, radiance);
  }

 private:
  Trilinear trilinear_;
};

}  // namespace

Trilinear::Trilinear(const SharedMap& map)
    : squares_(map->parameterization, {map->width(), map->height()}),
      sampler_(pyramid_of(map)),
      channels_(static_cast<std::size_t>(map->channels())),
      last_(static_cast<float>(sampler_.levels() - 1)),
      mean_(mean_over_sphere(*map)) {}

MeanLevel Trilinear::level_of(float variance, float area) const {
  // Against texels that are one value over their area, in units of their side h: a texel of level l has the
  // variance (4ˡ − 1)/12 of where its own texels lie in it, the bilinear tent 4ˡ/6, and what is looked up
  // has σ² + 1/12. So 4ˡ = 4σ² + ⅔, and between two levels variance is linear.
  const float wanted = std::min(4 * variance / area + 2.0f / 3, 1e18f);
  if (!(wanted > 1)) return {0, 0};
  int power;  // wanted = m · 2^power, ½ ≤ m < 1
  const float mantissa = std::frexp(wanted, &power);
  const int whole = (power - 1) / 2;
  const float share = (std::ldexp(mantissa, power - 2 * whole) - 1) * (1.0f / 3);
  const float level = static_cast<float>(whole);
  if (level + 1 <= last_) return {level + share, 0};
  if (level <= last_) return {last_, share};
  return {last_, 1};
}

void Trilinear::areas_of(std::span<const AimedCone> cones, float* areas) const {
  std::array<float, kConeTile> x{}, y{}, z{};
  const std::size_t padded = sphere::padded(cones.size());
  for (std::size_t i = 0; i < padded; ++i) {
    const Vec3<float>& d = cones[std::min(i, cones.size() - 1)].direction;
    x[i] = d.x;
    y[i] = d.y;
    z[i] = d.z;
  }
  squares_.areas_at(x.data(), y.data(), z.data(), cones.size(), areas);
}

void Trilinear::look_up(std::span<const Vec3<float>> directions, std::span<const MeanLevel> levels,
                        float* radiance) const {
  std::array<float, kConeTile> real;
  bool any_mean = false;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    real[i] = levels[i].level;
    any_mean |= levels[i].mean > 0;
  }
  sampler_.look_up(directions, {radiance, directions.size() * channels_}, {real.data(), directions.size()});
  if (!any_mean) return;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const float share = levels[i].mean;
    if (!(share > 0)) continue;
    float* out = radiance + i * channels_;
    for (std::size_t c = 0; c < channels_; ++c) out[c] = (1 - share) * out[c] + share * mean_[c];
  }
}

ConeLookUpPtr make_trilinear(const SharedMap& map, const ConeSamplerOptions&) {
  return std::make_unique<TrilinearLookUp>(map);
}

std::vector<float> mean_over_sphere(const Map& map) {
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  std::vector<double> sum(channels);
  std::vector<float> solid_angles(static_cast<std::size_t>(map.width()));
  double total = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      texel_solid_angles(map.parameterization, map.width(), map.height(), chart, y, solid_angles.data());
      const float* texel = map.level.chart(chart).row(y);
      for (const float each : solid_angles) {
        const double weight = static_cast<double>(each);
        if (weight > 0) {
          total += weight;
          for (std::size_t c = 0; c < channels; ++c) sum[c] += weight * static_cast<double>(texel[c]);
        }
        texel += channels;
      }
    }
  }
  std::vector<float> mean;
  for (const double each : sum) mean.push_back(static_cast<float>(total > 0 ? each / total : 0));
  return mean;
}

}  // namespace welkin
