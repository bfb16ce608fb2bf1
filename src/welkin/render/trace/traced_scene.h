#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/render/trace/surface.h"
#include "welkin/scene/scene.h"

/// @file
/// Scenes that rays can be traced through.
namespace welkin::scene {

/// From `origin` along `direction`, of any length > 0, between two distances in its lengths.
struct Ray {
  Vec3<float> origin;                                  ///< in the world
  Vec3<float> direction;                               ///< of any length > 0
  float near = 0;                                      ///< nothing nearer is met
  float far = std::numeric_limits<float>::infinity();  ///< nothing farther is met
};

/// What a ray meets first.
struct Hit {
  float distance = std::numeric_limits<float>::infinity();  ///< in lengths of the ray's direction
  std::uint32_t instance = 0;                               ///< of Scene::instances
  std::uint32_t triangle = 0;                               ///< of the mesh
  float b1 = 0;                                             ///< weight of the triangle's second vertex
  float b2 = 0;                                             ///< weight of its third
  Vec3<float> across = {0, 0, 0};  ///< across the triangle, away from its back, of any length

  /// Whether there is anything.
  explicit operator bool() const { return distance < std::numeric_limits<float>::infinity(); }
};

/// How rays that are traced together lie.
enum class Coherence {
  none,   ///< anyhow
  close,  ///< side by side, as those of neighbouring pixels
};

/// Where the reflected direction is found.
enum class Reflection {
  per_pixel,   ///< by the interpolated normal
  per_vertex,  ///< at the triangle's corners, and interpolated, not normalised, between them, as vertex
               ///< shaders did (the normal becomes the one that reflects so)
};

/// A scene's triangles, in the world, and the pictures that they wear, ready to be traced (Embree). Both
/// sides of a triangle are met.
///
/// Never changes after it is made; safe from many threads. Cheap to copy: copies share everything.
class WELKIN_API TracedScene {
 public:
  /// Moves the scene in. Throws as Scene::check does; Error (too_large) for more than 2³¹ triangles of all
  /// instances, (unsupported) where Embree isn't installed.
  explicit TracedScene(Scene scene);

  /// The scene, as it was given.
  const Scene& scene() const;

  /// The same scene whose instances stand elsewhere, one place for each, or are hidden (`hidden` may be
  /// shorter than there are instances); pictures are shared. Throws Error (bad_request) for another number of
  /// places, and for such as have no volume.
  TracedScene moved(const std::vector<Transform>& to_world, const std::vector<bool>& hidden = {}) const;

  /// The first thing along each ray, in the calling thread. There is room for as many hits.
  void closest(std::span<const Ray> rays, std::span<Hit> hits, Coherence coherence = Coherence::none) const;
  /// Along one.
  Hit closest(const Ray& ray) const;
  /// Whether anything lies between `near` and `far`.
  bool occluded(const Ray& ray) const;

  /// What a ray has met: the place, its normals and its material there, and how they change between pixels.
  Surface surface(const RaySpread& ray, const Hit& hit, Reflection reflection = Reflection::per_pixel) const;

  /// A distance by which a ray that leaves a surface at `position` starts off it, so that it doesn't meet it.
  double clearance(const Vec3d& position) const;

  class State;

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace welkin::scene
