#include <array>
#include <string>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/lookup/cone_filters.h"

namespace welkin {
namespace {

/// The cone's middle alone, at one level: nearest and bilinear.
class PointLookUp final : public ConeLookUp {
 public:
  PointLookUp(const SharedMap& map, Filter filter, double level)
      : sampler_(map, {.filter = filter, .levels = level > 0 ? 0 : 1}),
        level_(level),
        channels_(static_cast<std::size_t>(map->channels())) {
    if (level >= 0 && level <= sampler_.levels() - 1) return;
    throw Error(ErrorKind::bad_request, "look-up: there is no level " + std::to_string(level) +
                                            ": there are 0 to " + std::to_string(sampler_.levels() - 1));
  }

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    std::array<Vec3<float>, kConeTile> directions;
    for (std::size_t i = 0; i < cones.size(); ++i) directions[i] = cones[i].world;
    sampler_.look_up(std::span<const Vec3<float>>(directions.data(), cones.size()),
                     {radiance, cones.size() * channels_}, level_);
  }

 private:
  Sampler sampler_;
  double level_;
  std::size_t channels_;
};

}  // namespace

ConeLookUpPtr make_point_look_up(const SharedMap& map, const ConeSamplerOptions& options) {
  const Filter filter = options.filter == ConeFilter::nearest ? Filter::nearest : Filter::bilinear;
  return std::make_unique<PointLookUp>(map, filter, options.level);
}

}  // namespace welkin
