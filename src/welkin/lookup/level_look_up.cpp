#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/square_octahedron.h"
#include "welkin/lookup/trilinear.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

/// A box of a pixel's width has a σ of it /√12.
const double kPixelWidth = std::sqrt(12.0);

double squared(const PlanePoint& p) {
  return p.x * p.x + p.y * p.y;
}

/// l = log₂ √e, e the square of the longer side in texels.
double level_of(double e) {
  return 0.5 * std::log2(e);
}

/// One trilinear look-up at a level that `Level` chooses: double level(const AimedCone&).
template <class LevelOf>
class LevelLookUp final : public ConeLookUp {
 public:
  LevelLookUp(const SharedMap& map, LevelOf level) : trilinear_(map), level_(std::move(level)) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    std::array<Vec3<float>, kConeTile> directions;
    std::array<MeanLevel, kConeTile> levels;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      directions[i] = cones[i].world;
      const double level = level_(cones[i]);
      levels[i] = {level > 0
                       ? static_cast<float>(std::min(level, static_cast<double>(trilinear_.last_level())))
                       : 0.0f,
                   0};
    }
    trilinear_.look_up({directions.data(), cones.size()}, {levels.data(), cones.size()}, radiance);
  }

 private:
  Trilinear trilinear_;
  LevelOf level_;
};

template <class LevelOf>
ConeLookUpPtr make_level_look_up(const SharedMap& map, LevelOf level) {
  return std::make_unique<LevelLookUp<LevelOf>>(map, std::move(level));
}

/// The level of the difference of texture coordinates across a cell: between the middles of its sides.
class CellLevel {
 public:
  explicit CellLevel(const SharedMap& map) : map_(map) {}

  double operator()(const AimedCone& cone) const {
    const TangentPlane plane(to_double(cone.direction), to_double(cone.axis));
    const double wide = kPixelWidth * static_cast<double>(cone.wide),
                 narrow = std::min(kPixelWidth * static_cast<double>(cone.narrow), kPi);
    if (wide >= kPi) return std::log2(static_cast<double>(map_->width()));
    const Vec3d middles[4] = {plane.exponential({-0.5 * wide, 0}), plane.exponential({0.5 * wide, 0}),
                              plane.exponential({0, -0.5 * narrow}), plane.exponential({0, 0.5 * narrow})};
    // The other hemisphere's texture coordinates are those of the directions mirrored at the equator.
    const double own = longest(middles, 1), mirrored = longest(middles, -1);
    return level_of(std::min(own, mirrored));
  }

 private:
  double longest(const Vec3d* middles, double sign) const {
    PlanePoint at[4];
    for (int i = 0; i < 4; ++i) {
      const auto position =
          map_->parameterization.from_sphere({middles[i].x, sign * middles[i].y, middles[i].z});
      at[i] = {position.u * map_->width(), position.v * map_->height()};
    }
    return std::max(squared({at[1].x - at[0].x, at[1].y - at[0].y}),
                    squared({at[3].x - at[2].x, at[3].y - at[2].y}));
  }

  SharedMap map_;
};

}  // namespace

ConeLookUpPtr make_differential(const SharedMap& map, const ConeSamplerOptions&) {
  return make_level_look_up(map, [map](const AimedCone& cone) {
    const TangentPlane plane(to_double(cone.direction), to_double(cone.axis));
    const TexelSides sides = texel_sides(map->parameterization, {map->width(), map->height()}, plane);
    const PlanePoint x = sides.to_texels(PlanePoint{kPixelWidth * static_cast<double>(cone.wide), 0}),
                     y = sides.to_texels(PlanePoint{0, kPixelWidth * static_cast<double>(cone.narrow)});
    return level_of(std::max(squared(x), squared(y)));
  });
}

ConeLookUpPtr make_mirrored(const SharedMap& map, const ConeSamplerOptions&) {
  const std::string name = map->parameterization.name();
  if (!is_square_octahedron(map->parameterization)) {
    throw Error(ErrorKind::unsupported,
                "look-up: the mirrored cell is for octahedral and octahedral-equal-area maps, not for " +
                    name + "; the level by differentials needs no mirror");
  }
  return make_level_look_up(map, CellLevel(map));
}

}  // namespace welkin
