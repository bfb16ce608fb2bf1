#include <algorithm>
#include <cmath>

#include "welkin/filter/sampler_job.h"

namespace welkin {
namespace {

/// Values of a tile's results that are kept aside; 8 more because fetch kernels write past the last.
constexpr std::size_t kTileValues = 1024;
using Values = float[kTileValues + 8];

/// Copies values, those of one texel without a call of memcpy, which takes longer.
void copy_values(const float* from, std::size_t count, float* to) {
  switch (count) {
    case 4:
      to[3] = from[3];
      [[fallthrough]];
    case 3:
      to[2] = from[2];
      to[1] = from[1];
      [[fallthrough]];
    case 1:
      to[0] = from[0];
      break;
    default:
      std::copy_n(from, count, to);
  }
}

void blend(float weight, const float* coarser, std::size_t count, float* finer) {
  for (std::size_t i = 0; i < count; ++i) finer[i] += weight * (coarser[i] - finer[i]);
}

}  // namespace

/// Up to kSize directions, and where they are in a level. Values past the last are not set. For one direction
/// a small one is faster: in a large one, arrays lie 4096 bytes apart, which processors take for the same
/// address at first.
template <std::size_t kSize>
struct Sampler::State::Tile {
  alignas(64) float x[kSize], y[kSize], z[kSize];
  alignas(64) float shown[kSize];  ///< 1, or 0 where radiance is 0 because the map shows nothing
  alignas(64) float chart[kSize], u[kSize], v[kSize];
};

Sampler::State::State(std::shared_ptr<const void> owner, const Map& map, const SamplerOptions& options)
    : fetch_(fetch_for(options.filter, options.allow_ringing, map.channels())),
      aim_(aim_kernels()),
      channels_(map.channels()),
      whole_world_(map.parameterization.whole_world()),
      tile_size_(std::min(kSamplerTile, kTileValues / static_cast<std::size_t>(map.channels()) /
                                            sphere::kLanes * sphere::kLanes)),
      float_orientation_(map.orientation),
      orientation_(map.orientation),
      owner_(std::move(owner)) {
  static_assert(kTileValues / kMaxChannels >= sphere::kLanes);
}

/// Finds the directions in a level. Returns whether all of them are shown.
template <std::size_t kSize>
inline bool Sampler::State::locate(int level, const StridedDirections& directions, std::size_t count,
                                   Tile<kSize>& tile) const {
  const SampledLevel& in = levels_[static_cast<std::size_t>(level)];
  bool all = aim_.many(float_orientation_, directions, {tile.x, tile.y, tile.z, tile.shown}, count);
  in.kernels->from_sphere(in.self, tile.x, tile.y, tile.z, tile.chart, tile.u, tile.v, count);
  if (!whole_world_) {
    alignas(64) float covered[kSize];
    in.kernels->covers(in.self, tile.x, tile.y, tile.z, covered, count);
    for (std::size_t i = 0; i < count; ++i) {
      tile.shown[i] *= covered[i];
      all &= tile.shown[i] > 0;
    }
  }
  return all;
}

/// The same in float64: a direction is scaled only where its square would overflow or lose digits.
template <std::size_t kSize>
inline bool Sampler::State::locate(int level, const Vec3d* directions, std::size_t count,
                                   Tile<kSize>& tile) const {
  const sphere::AnyParameterization& in = levels_[static_cast<std::size_t>(level)].parameterization;
  bool all = true;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3d d = directions[i];
    const double longest = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    const bool usable = longest > 0 && std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z);
    if (!usable) {
      d = {0, 0, 1};
    } else if (longest < 0x1p-100 || longest > 0x1p100) {
      const int exponent = -std::ilogb(longest);
      d = {std::scalbn(d.x, exponent), std::scalbn(d.y, exponent), std::scalbn(d.z, exponent)};
    }
    d = orientation_ * d;
    const sphere::ChartPoint<double> at = in.from_sphere(d);
    const bool shown = usable && (whole_world_ || in.covers(d));
    tile.chart[i] = static_cast<float>(at.chart);
    tile.u[i] = static_cast<float>(at.u);
    tile.v[i] = static_cast<float>(at.v);
    tile.shown[i] = shown ? 1.0f : 0.0f;
    all &= shown;
  }
  // Kernels read whole packs.
  for (std::size_t i = count; i < sphere::padded(count); ++i) {
    tile.chart[i] = tile.chart[0];
    tile.u[i] = tile.u[0];
    tile.v[i] = tile.v[0];
  }
  return all;
}

template <std::size_t kSize, class Directions>
inline void Sampler::State::look_up_tile(const Directions& directions, std::size_t count,
                                         const LevelBlend& level, float* radiance, std::size_t room) const {
  Tile<kSize> tile;
  Values finer, coarser;
  const auto channels = static_cast<std::size_t>(channels_);
  const std::size_t values = count * channels;
  const SampledLevel* in = &levels_[static_cast<std::size_t>(level.finer)];
  const bool all_shown = locate(level.finer, directions, count, tile);
  float* to = room >= values + 8 ? radiance : finer;
  fetch_(in->view, tile.chart, tile.u, tile.v, to, count);
  if (level.weight > 0) {
    ++in;
    if (!in->same_positions) locate(level.finer + 1, directions, count, tile);
    fetch_(in->view, tile.chart, tile.u, tile.v, coarser, count);
    blend(level.weight, coarser, values, to);
  }
  if (to != radiance) copy_values(finer, values, radiance);
  if (all_shown) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(tile.shown[i] > 0)) std::fill_n(radiance + i * channels, channels, 0.0f);
  }
}

void Sampler::State::look_up(const StridedDirections& directions, std::size_t count, const LevelBlend& level,
                             float* radiance, std::size_t room) const {
  look_up_tile<kSamplerTile>(directions, count, level, radiance, room);
}

void Sampler::State::look_up(const Vec3d* directions, std::size_t count, const LevelBlend& level,
                             float* radiance, std::size_t room) const {
  look_up_tile<kSamplerTile>(directions, count, level, radiance, room);
}

/// As look_up_tile for one direction at one level, with the same results, in two thirds of the instructions.
void Sampler::State::look_up_one(const Vec3<float>& direction, const LevelBlend& level,
                                 float* radiance) const {
  const auto channels = static_cast<std::size_t>(channels_);
  if (level.weight > 0) {
    const StridedDirections one{&direction.x, &direction.y, &direction.z, 3};
    return look_up_tile<sphere::kLanes>(one, 1, level, radiance, channels);
  }
  constexpr std::size_t kLanes = sphere::kLanes;
  alignas(64) float at[6 * kLanes];
  float values[kMaxChannels + 8];
  float *x = at, *y = x + kLanes, *z = y + kLanes, *chart = z + kLanes, *u = chart + kLanes, *v = u + kLanes;
  const SampledLevel& in = levels_[static_cast<std::size_t>(level.finer)];
  bool shown = aim_.one(float_orientation_, &direction.x, at);
  in.kernels->from_sphere(in.self, x, y, z, chart, u, v, 1);
  fetch_(in.view, chart, u, v, values, 1);
  if (!whole_world_) {
    in.kernels->covers(in.self, x, y, z, chart, 1);
    shown &= chart[0] > 0;
  }
  if (shown) {
    copy_values(values, channels, radiance);
  } else {
    std::fill_n(radiance, channels, 0.0f);
  }
}

void Sampler::State::look_up_one(const Vec3d& direction, const LevelBlend& level, float* radiance) const {
  look_up_tile<sphere::kLanes>(&direction, 1, level, radiance, static_cast<std::size_t>(channels_));
}

/// Those of a tile's directions that lie at one level, or between it and the next.
struct Sampler::State::Group {
  alignas(64) float chart[kSamplerTile], u[kSamplerTile], v[kSamplerTile];
  float weight[kSamplerTile];  ///< of the next level
  std::size_t index[kSamplerTile];
  std::size_t count;
  bool any_between;  ///< a weight is not 0

  void choose(const float* levels, std::size_t tile_count, int level) {
    count = 0;
    any_between = false;
    for (std::size_t i = 0; i < tile_count; ++i) {
      if (static_cast<int>(levels[i]) != level) continue;
      index[count] = i;
      weight[count] = levels[i] - static_cast<float>(level);
      any_between |= weight[count] > 0;
      ++count;
    }
  }

  void take_positions(const Tile<kSamplerTile>& tile) {
    for (std::size_t i = 0; i < sphere::padded(count); ++i) {
      const std::size_t at = index[i < count ? i : 0];
      chart[i] = tile.chart[at];
      u[i] = tile.u[at];
      v[i] = tile.v[at];
    }
  }
};

template <class Directions>
inline void Sampler::State::look_up_levels(const Directions& directions, std::size_t count,
                                           const float* levels, float* radiance) const {
  Tile<kSamplerTile> tile;
  Group group;
  Values finer, coarser;
  const auto channels = static_cast<std::size_t>(channels_);
  const auto [minimum, maximum] = std::minmax_element(levels, levels + count);
  const int first = static_cast<int>(*minimum), last = static_cast<int>(*maximum);
  for (int level = first; level <= last; ++level) {
    const SampledLevel* in = &levels_[static_cast<std::size_t>(level)];
    if (level == first || !in->same_positions) locate(level, directions, count, tile);
    group.choose(levels, count, level);
    if (group.count == 0) continue;
    group.take_positions(tile);
    fetch_(in->view, group.chart, group.u, group.v, finer, group.count);
    if (group.any_between) {
      ++in;
      if (!in->same_positions) {
        locate(level + 1, directions, count, tile);
        group.take_positions(tile);
      }
      fetch_(in->view, group.chart, group.u, group.v, coarser, group.count);
    }
    for (std::size_t i = 0; i < group.count; ++i) {
      float* value = finer + i * channels;
      float* to = radiance + group.index[i] * channels;
      if (group.weight[i] > 0) blend(group.weight[i], coarser + i * channels, channels, value);
      if (tile.shown[group.index[i]] > 0) {
        copy_values(value, channels, to);
      } else {
        std::fill_n(to, channels, 0.0f);
      }
    }
  }
}

void Sampler::State::look_up(const StridedDirections& directions, std::size_t count, const float* levels,
                             float* radiance) const {
  look_up_levels(directions, count, levels, radiance);
}

void Sampler::State::look_up(const Vec3d* directions, std::size_t count, const float* levels,
                             float* radiance) const {
  look_up_levels(directions, count, levels, radiance);
}

bool Sampler::State::covers(const Vec3<float>& direction) const {
  Tile<sphere::kLanes> tile;
  return locate(0, StridedDirections{&direction.x, &direction.y, &direction.z, 3}, 1, tile);
}

bool Sampler::State::covers(const Vec3d& direction) const {
  Tile<sphere::kLanes> tile;
  return locate(0, &direction, 1, tile);
}

}  // namespace welkin
