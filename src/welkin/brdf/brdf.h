#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/parameter.h"
#include "welkin/math/vec.h"

/// @file
/// Isotropic BRDFs: how much of the light from one direction a surface reflects into another. This room knows
/// surfaces and angles only; maps are pre-filtered with them in prefilter/.
namespace welkin::brdf {

/// A measured BRDF on a grid of angles: values[(i · out + o) · across + d] for the i-th angle of `light`, the
/// o-th of `view` and the d-th of `between`; sr⁻¹.
struct MeasuredGrid {
  std::vector<double> light;    ///< θi, degrees from the normal, ascending from 0 to at most 90
  std::vector<double> view;     ///< θr, as light
  std::vector<double> between;  ///< Δφ, degrees from 0, where light and viewer are on the same side, to 180
  std::vector<double> values;   ///< of every combination
};

/// An isotropic BRDF, chosen by name at run time, with its parameters; or measured, or a function. Cheap to
/// copy; never changes; safe from many threads.
///
/// Directions are of the surface's own frame, unit vectors away from it, with the normal at +z.
class WELKIN_API AnyBrdf {
 public:
  /// By name, with parameters: `ggx`, `ggx,roughness=0.3,f0=0.04`, `ward,roughness=0.5`; or from a file,
  /// whose path is all the rest: `table,file=PATH` (text: θi, θr, Δφ in degrees, and the value),
  /// `merl,file=PATH` (docs/view-dependent-lobes.md). Throws Error: unknown names (the nearest is suggested),
  /// values out of range, files that can't be read, that end early, have gaps, values that are negative or
  /// not finite.
  static AnyBrdf make(std::string_view spec);
  /// Linear in each of the three angles; beyond the last θ it keeps the value there. `name` begins errors,
  /// and the spec is `table,NAME`. Throws Error as make does of files.
  static AnyBrdf from_grid(std::string_view name, MeasuredGrid grid);
  /// A function of the directions to the viewer and to the light, both above the surface: sr⁻¹, finite, not
  /// negative, isotropic, symmetric about the plane through the normal and the viewer, and safe from many
  /// threads. `width`, over 0 radians: what the narrowest features are about as wide as, seen along the
  /// normal.
  static AnyBrdf from_function(std::string_view name, double width,
                               std::function<double(const Vec3d& view, const Vec3d& light)> function);

  std::string name() const;         ///< `ggx`
  std::string spec() const;         ///< name and parameters that aren't at their defaults, as make takes them
  std::string description() const;  ///< one line: what it is for
  std::string source() const;       ///< author, year, equation
  /// Its parameters, with their values.
  std::vector<Parameter> parameters() const;
  /// What was assumed or left out of a measured one, in words; empty where there is nothing to tell.
  std::vector<std::string> notes() const;

  /// Whether it has the parameter `roughness`, 0 … 1, with 0 a mirror.
  bool has_roughness() const;
  /// Its roughness; 0 where it has none.
  double roughness() const;
  /// The same with another roughness. Throws Error when it has none, or for a value out of range.
  AnyBrdf with_roughness(double roughness) const;
  /// Whether it is a mirror, of which value() is meaningless.
  bool is_mirror() const;

  /// The BRDF, sr⁻¹; 0 where one of the directions is below the surface.
  double value(const Vec3d& view, const Vec3d& light) const;
  /// About how wide its narrowest features are, seen along the normal, radians: for steps of quadrature.
  double width() const;

  /// @cond INTERNAL
  class Model;
  explicit AnyBrdf(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  /// @endcond

 private:
  std::shared_ptr<const Model> model_;
};

/// Names of those that `make` knows without a file.
WELKIN_API const std::vector<std::string>& brdf_names();

}  // namespace welkin::brdf
