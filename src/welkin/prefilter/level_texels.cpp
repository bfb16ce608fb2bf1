#include "welkin/prefilter/level_texels.h"

#include <algorithm>
#include <cstring>
#include <mutex>

#include "welkin/base/parallel.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/plan.h"

namespace welkin::prefilter {
namespace {

/// One thread's work: a worker that waits for this must not be given other work meanwhile.
bool has_negative(const Map& map) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const float* row = map.level.chart(chart).row(y);
      int below = 0;
      for (int i = 0; i < map.width() * map.channels(); ++i) below += row[i] < 0 ? 1 : 0;
      if (below > 0) return true;
    }
  }
  return false;
}

}  // namespace

void LevelTexels::aim(int chart, int from, std::size_t first, Tile& tile) const {
  const int width = result_.width(), height = result_.height();
  alignas(64) float u[Tile::kMost], v[Tile::kMost];
  for (std::size_t i = 0; i < sphere::padded(tile.count); ++i) {
    const int k = static_cast<int>(first + std::min(i, tile.count - 1));
    u[i] = (static_cast<float>(k % width) + 0.5f) / static_cast<float>(width);
    v[i] = (static_cast<float>(from + k / width) + 0.5f) / static_cast<float>(height);
  }
  const auto& p = result_.parameterization;
  p.kernels().to_sphere(p.self(), chart, u, v, tile.x, tile.y, tile.z, tile.count);
  if (rotated_) multiply(to_source_, tile.x, tile.y, tile.z, sphere::padded(tile.count));
  grid_shape_.kernels().from_sphere(grid_shape_.self(), tile.x, tile.y, tile.z, tile.at_chart, tile.at_u,
                                    tile.at_v, tile.count);
}

void LevelTexels::fill(int chart, int from, std::size_t first, const Tile& tile, const float* bright,
                       std::size_t stride) const {
  const int width = result_.width(), n = result_.channels();
  const std::size_t size = tile.count * static_cast<std::size_t>(n);
  std::vector<float> values(Tile::kMost * static_cast<std::size_t>(n) + 8);
  fetch_(view_, tile.at_chart, tile.at_u, tile.at_v, values.data(), tile.count);
  if (near_ != nullptr) {
    std::vector<float> more(values.size());
    fetch_(view_of(*near_), tile.at_chart, tile.at_u, tile.at_v, more.data(), tile.count);
    for (std::size_t i = 0; i < size; ++i) values[i] += more[i];
  } else if (bright != nullptr) {
    for (std::size_t i = 0; i < size; ++i) values[i] += bright[i * stride];
  } else {
    add_bright(tile.x, tile.y, tile.z, values.data(), tile.count);
  }
  float minimum = 0;
  for (std::size_t i = 0; i < size; ++i) minimum = std::min(minimum, values[i]);
  if (minimum < 0 && is_nonnegative_()) {
    for (std::size_t i = 0; i < size; ++i) values[i] = std::max(values[i], 0.0f);
  }
  // Rows of a tile follow each other in the chart with its borders between.
  for (std::size_t i = 0; i < tile.count;) {
    const int k = static_cast<int>(first + i);
    const std::size_t run = std::min(tile.count - i, static_cast<std::size_t>(width - k % width));
    std::memcpy(result_.level.chart(chart).at(k % width, from + k / width),
                values.data() + i * static_cast<std::size_t>(n),
                run * static_cast<std::size_t>(n) * sizeof(float));
    i += run;
  }
}

void LevelTexels::rows(int chart, int from, int rows) const {
  const std::size_t all = static_cast<std::size_t>(rows) * static_cast<std::size_t>(result_.width());
  Tile tile;
  for (std::size_t first = 0; first < all; first += Tile::kMost) {
    tile.count = std::min(Tile::kMost, all - first);
    aim(chart, from, first, tile);
    fill(chart, from, first, tile, nullptr, 0);
  }
}

void GroupTexels::rows(int chart, int from, int rows) const {
  const LevelTexels& any = *members_.front();
  const std::size_t all = static_cast<std::size_t>(rows) * static_cast<std::size_t>(any.result().width());
  const lobe::Points points{bright_.x.data(),      bright_.y.data(), bright_.z.data(),
                            bright_.weight.data(), bright_.count(),  bright_.channels};
  std::vector<float> sums(LevelTexels::Tile::kMost * static_cast<std::size_t>(any.result().channels()) *
                          lobes_.members);
  LevelTexels::Tile tile;
  for (std::size_t first = 0; first < all; first += LevelTexels::Tile::kMost) {
    tile.count = std::min(LevelTexels::Tile::kMost, all - first);
    any.aim(chart, from, first, tile);
    kernels().group_sums(lobes_, points, tile.x, tile.y, tile.z, sums.data(), tile.count);
    for (std::size_t k = 0; k < members_.size(); ++k)
      members_[k]->fill(chart, from, first, tile, sums.data() + k, lobes_.members);
  }
}

void LevelTexels::add_bright(const float* x, const float* y, const float* z, float* values,
                             std::size_t count) const {
  if (level_.all || bright_.count() == 0) return;
  const lobe::Points points{bright_.x.data(), bright_.y.data(), bright_.z.data(),
                            weights_.data(),  bright_.count(),  bright_.channels};
  if (!level_.sampled) {
    level_.lobe.point_sums()(level_.lobe.self(), points, x, y, z, values, count);
  } else {
    kernels().sampled_sums(&*level_.sampled, points, x, y, z, values, count);
  }
}

std::vector<Map> make_level_texels(const PrefilterPlan::Tables& t, const std::vector<HarmonicLevel>& levels,
                                   const std::vector<Level>& grids, const std::vector<const Level*>& near,
                                   const BrightPoints& bright, const Map& source, const Monitor& monitor) {
  // Sums of light that is never negative are clamped to that. Whether it is, is found out when it first
  // matters.
  std::once_flag once;
  bool negative = false;
  const std::function<bool()> is_nonnegative = [&] {
    std::call_once(once, [&] { negative = has_negative(source); });
    return !negative;
  };

  std::vector<Map> results;
  for (const HarmonicLevel& level : levels)
    results.push_back(t.result(static_cast<std::size_t>(level.index), source));
  std::vector<LevelTexels> texels;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    Map& map = results[i];
    const Matrix3 to_source = source.orientation * transpose(map.orientation);
    texels.emplace_back(levels[i], grids[i], near[i], bright, to_source, is_nonnegative, map);
  }
  std::vector<GroupTexels> groups;
  std::vector<bool> grouped(texels.size(), false);
  for (const LevelGroup& group : t.groups) {
    std::vector<const LevelTexels*> members;
    for (const std::size_t each : group.harmonic) {
      members.push_back(&texels[each]);
      grouped[each] = true;
    }
    groups.emplace_back(group.lobes, std::move(members), bright);
  }

  struct Band {
    const LevelTexels* level;
    const GroupTexels* group;  ///< null: the level alone
    int chart, row, rows;
  };
  std::vector<Band> bands;
  const auto add_bands = [&](const LevelTexels& level, const GroupTexels* group) {
    const Map& map = level.result();
    const int rows = std::max(1, (group != nullptr ? 512 : 2048) / map.width());
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < map.height(); y += rows)
        bands.push_back({&level, group, chart, y, std::min(rows, map.height() - y)});
    }
  };
  for (std::size_t i = 0; i < groups.size(); ++i) add_bands(texels[t.groups[i].harmonic.front()], &groups[i]);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (!grouped[i]) add_bands(texels[i], nullptr);
  }
  parallel_for(
      static_cast<int>(bands.size()),
      [&](int k) {
        const Band& band = bands[static_cast<std::size_t>(k)];
        if (band.group != nullptr) {
          band.group->rows(band.chart, band.row, band.rows);
        } else {
          band.level->rows(band.chart, band.row, band.rows);
        }
      },
      monitor);
  return results;
}

}  // namespace welkin::prefilter
