#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "welkin/lookup/cone_sampler.h"
#include "welkin/map/map.h"

/// What a filter of ConeSampler is to it: one struct each, made by one function. Internal to lookup.
namespace welkin {

/// Cones looked up at once.
inline constexpr std::size_t kConeTile = 64;

/// A cone without faults: unit vectors, in the world's axes and in the map's.
struct AimedCone {
  Vec3<float> world, world_axis;
  Vec3<float> direction, axis, across;
  float wide, narrow;
};

/// Looks cones up. Never changes.
class ConeLookUp {
 public:
  virtual ~ConeLookUp() = default;
  /// Up to kConeTile cones, to channels values each.
  virtual void look_up(std::span<const AimedCone> cones, float* radiance) const = 0;

 protected:
  ConeLookUp() = default;
  ConeLookUp(const ConeLookUp&) = delete;
  ConeLookUp& operator=(const ConeLookUp&) = delete;
};

using ConeLookUpPtr = std::unique_ptr<const ConeLookUp>;
using SharedMap = std::shared_ptr<const Map>;

ConeLookUpPtr make_point_look_up(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_trilinear(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_differential(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_mirrored(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_box(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_summed_area(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_probes(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_ewa(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_gaussian(const SharedMap& map, const ConeSamplerOptions& options);
ConeLookUpPtr make_hybrid(const SharedMap& map, const ConeSamplerOptions& options);

/// The mean of a map over what it shows, a value for each channel.
std::vector<float> mean_over_sphere(const Map& map);

}  // namespace welkin
