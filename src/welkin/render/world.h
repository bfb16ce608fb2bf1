#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/filter/sampler.h"
#include "welkin/lookup/cone_sampler.h"
#include "welkin/map/chain.h"
#include "welkin/map/map.h"
#include "welkin/render/trace/surface.h"

/// @file
/// The worlds that surfaces reflect.
namespace welkin::scene {

/// Where the world of a map lies, so that what is near is seen from where a surface is and not from the map's
/// centre (parallax correction).
struct Proxy {
  /// The shape on which the world is painted.
  enum class Shape {
    far,     ///< infinitely far: no correction
    sphere,  ///< about `centre`, of `radius`
    box,     ///< from `least` to `most`, axes along the world's
    ground,  ///< the sphere, cut by the plane `height` below the centre
  };
  Shape shape = Shape::far;    ///< which
  Vec3d centre = {0, 0, 0};    ///< where the map was taken
  double radius = 1;           ///< of sphere and ground
  double height = 1;           ///< of ground: of the camera that took the map
  Vec3d least = {-1, -1, -1};  ///< of box
  Vec3d most = {1, 1, 1};      ///< of box
};

/// The direction in which the map shows what is seen from `position` along `direction`: from the map's centre
/// to where the ray meets the proxy. Of a position outside of it, `direction`. Brennan 2002; Lagarde &
/// Zanuttini 2012.
WELKIN_API Vec3d seen_from(const Proxy& proxy, const Vec3d& position, const Vec3d& direction);

/// A map, and all that surfaces look up in it, each made when it is first needed: cones, diffuse light, and
/// chains over roughness. Cheap to copy; safe from many threads.
class WELKIN_API World {
 public:
  /// The map's borders are filled. Without options cones are looked up by `gaussian` in maps of the whole
  /// sphere of up to two million texels, by `probes` in others, whose levels take less memory and time to
  /// make. Throws Error (bad_value) where texels are not finite.
  explicit World(Map map, const Proxy& proxy = {}, const std::optional<ConeSamplerOptions>& cones = {});

  /// Takes this chain for `rough` in place of one of its own: pre-filtered with GGX, with the roughness of
  /// its levels noted, of the map's orientation. Before anything has asked for `rough`. Throws Error
  /// (bad_request) for a chain without levels or without their roughness, or whose roughness falls.
  void use_chain(Chain chain);

  const Map& map() const;            ///< what was given
  const Proxy& proxy() const;        ///< where it lies
  const ConeSampler& cones() const;  ///< by the filter that was asked for
  const Sampler& bilinear() const;   ///< the map itself
  const Sampler& diffuse() const;    ///< filtered with lambert
  const Sampler& rough() const;      ///< a chain filtered with GGX over roughness
  /// The level of `rough` for a roughness, 0 … 1.
  double level_of(double roughness) const;
  const Sampler& sheen() const;  ///< a chain filtered with Charlie's lobe over roughness
  /// The level of `sheen` for a roughness, 0 … 1.
  double sheen_level_of(double roughness) const;
  /// Filtered with Phong's lobe of this exponent. Kept as long as the world.
  const Sampler& phong(double exponent) const;

  class State;

 private:
  std::shared_ptr<State> state_;
};

}  // namespace welkin::scene
