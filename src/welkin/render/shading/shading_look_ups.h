#pragma once

#include <functional>
#include <span>
#include <vector>

#include "welkin/render/shading/shading.h"

/// What the shadings share.
namespace welkin::scene {

/// A factory of one shading.
using MakeShading = std::unique_ptr<Shading> (*)(const Worlds& worlds, const ShadingOptions& options);

std::unique_ptr<Shading> make_material(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_mirror(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_glossy(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_refraction(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_diffuse(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_globe(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_phong(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_stack(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_warped(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_chrome(const Worlds& worlds, const ShadingOptions& options);
std::unique_ptr<Shading> make_matcap(const Worlds& worlds, const ShadingOptions& options);
/// By a built-in picture of a ball (sphere_picture).
std::unique_ptr<Shading> make_sketch(std::string_view picture, const ShadingOptions& options);
std::unique_ptr<Shading> make_normals(const Worlds& worlds, const ShadingOptions& options);

/// use(world) of all of them.
template <class Use>
void for_each_world(const Worlds& worlds, const Use& use) {
  use(worlds.whole);
  for (const World& world : worlds.own) use(world);
}

/// Calls `use(world, indices)` once for each world that some of the surfaces have.
void by_world(const Worlds& worlds, std::span<const Surface> surfaces,
              const std::function<void(const World& world, std::span<const std::uint32_t> indices)>& use);

/// A cone of the world from a place on a surface.
struct SurfaceCone {
  std::uint32_t surface;  ///< index
  RayDifferential ray;    ///< in which direction, and how that changes from pixel to pixel
  double sigma = 0;       ///< by which the cone is wider still, radians
};

/// Radiance over cones, each of its surface's world, seen from the surface where the world has a proxy.
void look_up_cones(const Worlds& worlds, std::span<const Surface> surfaces,
                   std::span<const SurfaceCone> cones, const ShadingOptions& options,
                   std::span<Rgb> radiance);

/// The σ of the reflected directions that a normal map adds: normals turn half as far.
double normal_spread(const Surface& surface);

/// The roughness of a surface whose normals, and whose reflected or bent directions `ray` within a pixel,
/// spread besides: slopes' variances add, and α²/2 is GGX's (of its core).
double widened(double roughness, const Surface& at, const RayDifferential& ray);

/// Reads a map's channels as R G B: one or two are grey.
void to_rgb(std::span<const float> values, int channels, std::span<Rgb> radiance);

/// Radiance of pre-filtered light: which sampler of a world, in which direction, at which level; none: the
/// first.
struct FilteredLook {
  std::function<const Sampler&(const World& world)> sampler;
  std::function<Vec3d(const Surface& surface)> direction;
  std::function<double(const World& world, const Surface& surface)> level;
};
void look_up_filtered(const Worlds& worlds, std::span<const Surface> surfaces, const FilteredLook& look,
                      std::span<Rgb> radiance);
/// Diffuse light, along the normal.
const FilteredLook& diffuse_light();
/// What a sheen reflects (Sheen::look_up).
const FilteredLook& sheen_light();

/// a + b·c, channel by channel.
inline Rgb operator+(const Rgb& a, const Rgb& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Rgb operator*(const Rgb& a, const Rgb& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
inline Rgb operator*(double a, const Rgb& b) {
  const auto f = static_cast<float>(a);
  return {f * b[0], f * b[1], f * b[2]};
}

}  // namespace welkin::scene
