#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/texel_shape.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

/// Greene's square: in each of two levels the exact mean over a square that is 2 to 4 texels of the finer
/// wide, so that it reads 5×5 texels at most and reaches no farther than the border.
class BoxLookUp final : public ConeLookUp {
 public:
  explicit BoxLookUp(const SharedMap& map)
      : map_(map),
        pyramid_(make_pyramid(*map, levels_below(map->width(), map->height()))),
        squares_(map->parameterization, {map->width(), map->height()}),
        mean_(mean_over_sphere(*map)) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    const std::size_t channels = static_cast<std::size_t>(map_->channels());
    const auto& p = map_->parameterization;
    std::array<float, kConeTile> x{}, y{}, z{}, chart, u, v;
    const std::size_t padded = sphere::padded(cones.size());
    for (std::size_t i = 0; i < padded; ++i) {
      const Vec3<float>& d = cones[std::min(i, cones.size() - 1)].direction;
      x[i] = d.x;
      y[i] = d.y;
      z[i] = d.z;
    }
    p.kernels().from_sphere(p.self(), x.data(), y.data(), z.data(), chart.data(), u.data(), v.data(),
                            cones.size());
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const float area = 12 * cones[i].wide * cones[i].narrow / squares_.area_at(chart[i], u[i], v[i]);
      look_up_one({static_cast<int>(chart[i]), std::clamp(u[i], 0.0f, 1.0f), std::clamp(v[i], 0.0f, 1.0f)},
                  std::sqrt(area), radiance + i * channels);
    }
  }

 private:
  struct Place {
    int chart;
    float u, v;
  };

  const Level& level(int index) const {
    return index == 0 ? map_->level : pyramid_[static_cast<std::size_t>(index - 1)];
  }

  /// `side` in texels of level 0.
  void look_up_one(const Place& place, float side, float* out) const {
    std::fill_n(out, map_->channels(), 0.0f);
    const int last = static_cast<int>(pyramid_.size());
    if (!(side > 2)) return add(level(0), place, std::max(side, 1.0f), 1, out);
    int power;  // side = m · 2^power, ½ ≤ m < 1
    const float mantissa = std::frexp(std::min(side, 1e9f), &power);
    const int finer = power - 2;
    const float share = 2 * mantissa - 1;  // of the coarser
    if (finer > last) return add_mean(1, out);
    add(level(finer), place, 4 * mantissa, 1 - share, out);
    if (finer == last) return add_mean(share, out);
    add(level(finer + 1), place, 2 * mantissa, share, out);
  }

  void add_mean(float share, float* out) const {
    for (int c = 0; c < map_->channels(); ++c) out[c] += share * mean_[static_cast<std::size_t>(c)];
  }

  /// Adds the mean over a square of `side` ≤ 4 texels of a level.
  static void add(const Level& level, const Place& place, float side, float share, float* out) {
    const Interval columns(place.u * static_cast<float>(level.width()), side),
        rows(place.v * static_cast<float>(level.height()), side);
    const auto chart = level.chart(place.chart);
    const int channels = level.channels();
    const float scale = share / (side * side);
    for (int j = 0; j < rows.count; ++j) {
      for (int i = 0; i < columns.count; ++i) {
        const float weight = scale * rows.part[j] * columns.part[i];
        const float* texel = chart.at(columns.first + i, rows.first + j);
        for (int c = 0; c < channels; ++c) out[c] += weight * texel[c];
      }
    }
  }

  /// An interval of up to 4 texels, and how much of each texel is in it.
  struct Interval {
    int first, count;
    float part[6];

    Interval(float middle, float side) {
      const float from = middle - 0.5f * side, to = middle + 0.5f * side;
      first = static_cast<int>(std::floor(from));
      count = 0;
      float left = side;
      for (float at = from; left > 0 && count < 5; ++count) {
        const float end = std::min(to, static_cast<float>(first + count + 1));
        part[count] = count == 4 ? left : std::min(left, end - at);
        left -= part[count];
        at = end;
      }
    }
  };

  SharedMap map_;
  std::vector<Level> pyramid_;
  TexelSquares squares_;
  std::vector<float> mean_;
};

}  // namespace

ConeLookUpPtr make_box(const SharedMap& map, const ConeSamplerOptions&) {
  return std::make_unique<BoxLookUp>(map);
}

}  // namespace welkin
