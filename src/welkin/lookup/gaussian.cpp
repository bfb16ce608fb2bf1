#include <array>

#include "welkin/base/error.h"
#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/gaussian_stack.h"

namespace welkin {
namespace {

/// ConeFilter::gaussian: a GaussianStack among the other filters.
class Gaussian final : public ConeLookUp {
 public:
  Gaussian(const SharedMap& map, GaussianAccuracy accuracy)
      : stack_(map, {.accuracy = accuracy}), channels_(static_cast<std::size_t>(map->channels())) {}

  void look_up(std::span<const AimedCone> cones, float* radiance) const override {
    std::array<EllipticalCone, kConeTile> tile;
    for (std::size_t i = 0; i < cones.size(); ++i)
      tile[i] = {cones[i].world, cones[i].world_axis, cones[i].wide, cones[i].narrow};
    stack_.look_up({tile.data(), cones.size()}, {radiance, cones.size() * channels_});
  }

 private:
  GaussianStack stack_;
  std::size_t channels_;
};

}  // namespace

ConeLookUpPtr make_gaussian(const SharedMap& map, const ConeSamplerOptions& options) {
  // A stack takes what a map doesn't show for black, the other filters leave it out.
  if (!map->parameterization.whole_world())
    throw Error(ErrorKind::unsupported,
                "look-up: gaussian is for maps of the whole sphere, not for " + map->parameterization.name());
  return std::make_unique<Gaussian>(map, options.accuracy);
}

}  // namespace welkin
