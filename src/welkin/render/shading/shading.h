#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/render/shading/view_maps.h"
#include "welkin/render/trace/surface.h"
#include "welkin/render/world.h"

/// @file
/// What surfaces send to the viewer, looked up in maps of the world: no rays are traced, so nothing that is
/// near is reflected.
namespace welkin::scene {

/// Linear R G B.
using Rgb = std::array<float, 3>;

/// The worlds of a scene's instances.
struct Worlds {
  World whole;                        ///< of everything that has none of its own, and the background
  std::vector<World> own = {};        ///< others, each with its own centre
  std::vector<int> of_instance = {};  ///< index into `own`, −1: `whole`; may be shorter than the instances

  /// That of an instance.
  const World& of(std::uint32_t instance) const;
};

/// How reflection and what lies under it go together (Heidrich & Seidel 1999, §4.3), F by H6's formula.
enum class Fresnel {
  none,   ///< reflection alone
  add,    ///< F·Lm + Ld
  share,  ///< F·Lm + (1 − F)·Ld
};

/// What shading can be asked for. Materials give the rest.
struct ShadingOptions {
  Fresnel fresnel = Fresnel::none;  ///< of `mirror` and `phong`
  double eta = 1.5;                 ///< index of refraction of `mirror`, `phong`, `refraction`
  double exponent = 50;             ///< of `phong`, and of the highlights of `chrome`
  bool quadrilateral = false;       ///< cones by their four corners rather than as ellipses
  bool no_spread = false;           ///< directions alone: no cones (for comparison)
  std::string brdf = "ggx";         ///< of `stack` and `warped`, as brdf::AnyBrdf::make takes it
  int views = 20;                   ///< of `warped`: directions that are baked, 3 … 1000
  std::vector<std::shared_ptr<const ViewMap>> view_maps = {};  ///< of `warped`: photographs, in their place
  /// Of `matcap` the picture of a ball, square, its disc filling it; of `chrome` colours by elevation, the
  /// zenith's in the top row.
  std::shared_ptr<const Image> picture = {};
  /// Of `matcap`, from the world to the eye: x right, y up, z towards the viewer (eye_of).
  Matrix3 to_eye = {};
  bool reflected_coordinates = false;   ///< of `matcap`: by the reflected direction, not the normal
  std::vector<PointLight> lights = {};  ///< whose highlights `chrome` shows
  bool sheen = false;  ///< of `material`: make what a sheen looks up at once, not where one is first seen
};

/// The eye's frame of a camera of this rotation.
WELKIN_API Matrix3 eye_of(const Matrix3& camera_rotation);

/// A way to shade surfaces. Never changes after it is made; safe from many threads.
class WELKIN_API Shading {
 public:
  virtual ~Shading();
  /// Radiance towards the viewer from each surface. There is room for as many.
  virtual void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const = 0;
};

/// By name (shading_names). Makes all that it looks up, which takes the time of a bake. Throws Error
/// (bad_request) for another name or options out of range, and what bakes throw.
WELKIN_API std::unique_ptr<Shading> make_shading(std::string_view name, const Worlds& worlds,
                                                 const ShadingOptions& options = {});

/// A shading's name and what it does, in one line.
struct ShadingName {
  std::string name;         ///< `mirror`
  std::string description;  ///< one line
};
/// All of them, the default first.
WELKIN_API std::vector<ShadingName> shading_names();

}  // namespace welkin::scene
