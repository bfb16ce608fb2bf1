#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/lookup/cone.h"
#include "welkin/lookup/gaussian_stack.h"
#include "welkin/map/map.h"

/// @file
/// Radiance over cones of directions: the filters of renderers.
namespace welkin {

/// How a map is averaged over a cone (docs/look-ups.md compares them). σ are the cone's `wide` and `narrow`.
enum class ConeFilter {
  nearest,       ///< the texel that holds the direction, at ConeSamplerOptions::level
  bilinear,      ///< 2×2 texels, at ConeSamplerOptions::level
  trilinear,     ///< eight texels of two levels (Williams 1983), whose σ is √(wide·narrow)
  differential,  ///< the same at the level log₂ of the pixel's longer side in texels, as graphics
                 ///< processors choose it (Engelhardt & Dachsbacher 2008, eq. 4)
  mirrored,      ///< the same from differences of texture coordinates, and of those of the cell mirrored into
                 ///< the other hemisphere: whichever is smaller (their §4.2). For octahedral and
                 ///< octahedral-equal-area maps alone
  box,           ///< a square of the pixel's area in two levels (Greene 1986): constant cost
  sat,           ///< rectangles of a summed-area table (Crow 1984). For latlong, cube, eac,
                 ///< openexr-cube, octahedral and octahedral-equal-area maps
  probes,        ///< trilinear probes along the wide axis (McCormack et al. 1999): footprint assembly
  ewa,           ///< the elliptical Gaussian over all of its texels (Heckbert 1989)
  hybrid,        ///< the same inside two levels, blended (Greene & Heckbert 1986): bounded cost
  gaussian,  ///< sums of look-ups in exactly blurred levels (gaussian_stack.h), with a chosen error. For maps
             ///< of the whole sphere alone
};

/// `nearest`, `bilinear`, `trilinear`, `differential`, `mirrored`, `box`, `sat`, `probes`, `ewa`, `hybrid`,
/// `gaussian`.
/// Throws Error (bad_request) for another name.
WELKIN_API ConeFilter cone_filter_from_name(std::string_view name);
/// The name that cone_filter_from_name takes.
WELKIN_API std::string_view name_of(ConeFilter filter);
/// All of them.
WELKIN_API const std::vector<std::string>& cone_filter_names();

/// Whether a filter can be used on maps of a parameterization: all can on all, but `mirrored` and `sat`.
WELKIN_API bool is_usable(ConeFilter filter, const sphere::AnyParameterization& parameterization);

/// How cones are looked up.
struct ConeSamplerOptions {
  ConeFilter filter = ConeFilter::hybrid;  ///< one for all look-ups
  double level = 0;  ///< nearest, bilinear: of the pyramid, 0 … its last; between two it is linear
  int probes = 16;   ///< probes: at most so many, 1 … 64; longer cones are blurred across as well
  int boxes = 3;     ///< sat: concentric boxes whose sum is near a Gaussian, 1 … 4
  GaussianAccuracy accuracy = GaussianAccuracy::percent;  ///< gaussian: of its levels
};

/// Looks radiance up over cones: a map, what a filter needs besides, and the filter.
///
/// Never changes after it is made; all of it can be used from many threads at once. Cheap to copy: copies
/// share everything. Look-ups take no memory, and one gives the same bits alone and among others.
///
/// **Cones** are in the world: the map's `orientation` is applied. Any width is taken, 0 and more than the
/// sphere too. A cone narrower than the texels around it is read between them. As cones grow, every
/// filter but nearest and bilinear tends to the map's mean over the sphere, the cost of all but ewa stays
/// bounded; `differential` and `mirrored` end at the coarsest level.
///
/// **Results** are channels() values for each cone, interleaved; `radiance` has room for that many at least,
/// and what is past them stays as it was. Of a map that shows a part of the world: 0 for cones about a
/// direction that it does not show, else the mean over what it shows.
///
/// A map of one radiance has that radiance over every cone, to 1e-6; where radiance is positive
/// everywhere, it is over every cone; over those of `gaussian` it is at least not negative.
///
/// Throws Error, before anything is written: a cone that fault_of finds a fault with (the message has its
/// number); `radiance` too short.
class WELKIN_API ConeSampler {
 public:
  /// Moves the map in. Its texels must be finite, and its borders filled (borders.h). Throws Error: options
  /// out of range (bad_request), a parameterization that the filter is not for (unsupported), texels that are
  /// not finite (bad_value).
  explicit ConeSampler(Map map, const ConeSamplerOptions& options = {});
  /// The map is shared, and must not change any more. Throws Error also when there is none.
  explicit ConeSampler(std::shared_ptr<const Map> map, const ConeSamplerOptions& options = {});

  /// Looks the caller's map up, which must outlive the sampler and all its copies, and not change meanwhile.
  static ConeSampler borrow(const Map& map, const ConeSamplerOptions& options = {});
  static ConeSampler borrow(const Map&& map, const ConeSamplerOptions& options = {}) = delete;

  /// Values over a cone.
  int channels() const;

  /// Over each of many cones. In the calling thread.
  void look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const;
  /// The same of quadrilateral cones, each taken as the elliptical one of its second moments (cone_of).
  void look_up(std::span<const QuadCone> cones, std::span<float> radiance) const;
  /// Over one.
  /// @{
  void look_up(const EllipticalCone& cone, std::span<float> radiance) const { look_up({&cone, 1}, radiance); }
  void look_up(const QuadCone& cone, std::span<float> radiance) const { look_up({&cone, 1}, radiance); }
  /// @}

  class State;

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace welkin
