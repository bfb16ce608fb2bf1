#include "welkin/prefilter/verify_texels.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "welkin/base/parallel.h"
#include "welkin/map/luminance.h"

namespace welkin::prefilter {
namespace {

/// Lights are looked for in squares of so many texels, one in each.
constexpr int kBlock = 16;
const double kCosineApart = std::cos(3 * kPi / 180);

Texel texel_at(const Map& map, std::int64_t index) {
  const std::int64_t row = index / map.width();
  return {static_cast<int>(row / map.height()), static_cast<int>(index % map.width()),
          static_cast<int>(row % map.height())};
}

double centre(int i, int count) {
  return (i + 0.5) / count;
}

bool is_valid_texel(const Map& map, const Texel& t) {
  return map.parameterization.valid(t.chart, centre(t.x, map.width()), centre(t.y, map.height()));
}

std::int64_t texels_of(const Map& map) {
  return std::int64_t{map.charts()} * map.width() * map.height();
}

const float* values_of(const Map& map, const Texel& t) {
  return map.level.chart(t.chart).at(t.x, t.y);
}

}  // namespace

Vec3d direction_of(const Map& map, const Texel& t) {
  return transpose(map.orientation) *
         map.parameterization.to_sphere(t.chart, centre(t.x, map.width()), centre(t.y, map.height()));
}

std::vector<Texel> random_texels(const Map& level, int count, std::uint64_t seed) {
  const std::int64_t all = texels_of(level);
  std::vector<Texel> texels;
  // Where most of the texels may be drawn, each is tested.
  if (all <= std::int64_t{4} * count) {
    for (std::int64_t i = 0; i < all; ++i) {
      if (is_valid_texel(level, texel_at(level, i))) texels.push_back(texel_at(level, i));
    }
    if (texels.size() <= static_cast<std::size_t>(count)) return texels;
    texels.clear();
  }
  std::mt19937_64 random(seed);
  std::set<Texel> drawn;
  while (texels.size() < static_cast<std::size_t>(count)) {
    const auto index = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(all));
    const Texel texel = texel_at(level, index);
    if (is_valid_texel(level, texel) && drawn.insert(texel).second) texels.push_back(texel);
  }
  return texels;
}

std::vector<Texel> hot_texels(const Map& level, const std::vector<Vec3d>& lights,
                              const VerifyOptions& options) {
  const TexelLuminance luminance(level.channel_names);
  const std::int64_t all = texels_of(level);
  float maximum = 0;
  for (std::int64_t i = 0; i < all; ++i) {
    maximum = std::max(maximum, luminance(values_of(level, texel_at(level, i))));
  }
  if (!(maximum > 0)) return {};
  struct Hot {
    float luminance;
    std::int64_t index;
  };
  std::vector<Hot> hot;
  const auto minimum = static_cast<float>(options.hot) * maximum;
  for (std::int64_t i = 0; i < all; ++i) {
    const Texel texel = texel_at(level, i);
    const float value = luminance(values_of(level, texel));
    if (value >= minimum && is_valid_texel(level, texel)) hot.push_back({value, i});
  }
  std::stable_sort(hot.begin(), hot.end(),
                   [](const Hot& a, const Hot& b) { return a.luminance > b.luminance; });
  const std::size_t taken = std::min(hot.size(), static_cast<std::size_t>(options.most_hot));
  std::set<Texel> texels;
  for (std::size_t i = 0; i < taken; ++i) texels.insert(texel_at(level, hot[i * hot.size() / taken].index));
  for (const Vec3d& light : lights) {
    const Vec3d d = level.orientation * light;
    if (!level.parameterization.covers(d)) continue;
    const auto position = level.parameterization.from_sphere(d);
    const Texel texel{static_cast<int>(position.chart),
                      std::clamp(static_cast<int>(position.u * level.width()), 0, level.width() - 1),
                      std::clamp(static_cast<int>(position.v * level.height()), 0, level.height() - 1)};
    if (is_valid_texel(level, texel)) texels.insert(texel);
  }
  return {texels.begin(), texels.end()};
}

std::vector<Vec3d> brightest_lights(const Map& source, int count) {
  const TexelLuminance luminance(source.channel_names);
  struct Candidate {
    double power = 0;
    Texel texel;
  };
  const int across = (source.width() + kBlock - 1) / kBlock, down = (source.height() + kBlock - 1) / kBlock;
  std::vector<Candidate> candidates(static_cast<std::size_t>(source.charts()) *
                                    static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  parallel_for(source.charts() * down, [&](int band) {
    const int chart = band / down;
    std::vector<float> omega(static_cast<std::size_t>(source.width()));
    const int first = band % down * kBlock;
    for (int y = first; y < std::min(first + kBlock, source.height()); ++y) {
      texel_solid_angles(source.parameterization, source.width(), source.height(), chart, y, omega.data());
      for (int x = 0; x < source.width(); ++x) {
        const Texel texel{chart, x, y};
        const double power = static_cast<double>(luminance(values_of(source, texel))) *
                             static_cast<double>(omega[static_cast<std::size_t>(x)]);
        Candidate& best = candidates[static_cast<std::size_t>(band) * static_cast<std::size_t>(across) +
                                     static_cast<std::size_t>(x / kBlock)];
        if (power > best.power) best = {power, texel};
      }
    }
  });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.power > b.power; });
  std::vector<Vec3d> lights;
  for (const Candidate& each : candidates) {
    if (lights.size() == static_cast<std::size_t>(count) || !(each.power > 0)) break;
    const Vec3d d = direction_of(source, each.texel);
    const auto near = [&](const Vec3d& other) { return dot(d, other) > kCosineApart; };
    if (std::none_of(lights.begin(), lights.end(), near)) lights.push_back(d);
  }
  return lights;
}

}  // namespace welkin::prefilter
