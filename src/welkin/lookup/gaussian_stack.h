#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/lookup/cone.h"
#include "welkin/map/map.h"

/// @file
/// Radiance over elliptical Gaussian cones, with an error that can be chosen (docs/gaussian-look-ups.md).
namespace welkin {

/// How near a look-up is to the exact mean over its cone: the RMS error over many look-ups, relative to the
/// value or, where that is darker, to a tenth of the map's mean, of cones whose `narrow` is a texel of the
/// map or more.
enum class GaussianAccuracy {
  percent,   ///< 1 %
  permille,  ///< 0.1 %, for about four times the memory
};

/// `1%`, `0.1%`. Throws Error (bad_request) for another name.
WELKIN_API GaussianAccuracy gaussian_accuracy_from_name(std::string_view name);

/// How a stack is made.
struct GaussianStackOptions {
  GaussianAccuracy accuracy = GaussianAccuracy::percent;  ///< what memory and time are spent for
};

/// A map and its levels, each blurred by exactly a von Mises–Fisher lobe, from about a texel wide to 90°:
/// looked up over elliptical cones, as a sum of looked up levels along the cone's long axis.
///
/// Never changes after it is made; all of it can be used from many threads at once. Cheap to copy: copies
/// share the pixels. Look-ups take no memory, save those over cones of a hundred times their narrow side's
/// length, and of more than 32 channels.
///
/// **Cones** are the world's: the map's `orientation` is applied. They may be of any width: the narrower than
/// a texel, the nearer to the bilinear interpolation of the map, as Sampler has it; of 90° and more nearly
/// the map's mean. What the map does not show counts as black. A cone's σ is that of the von Mises–Fisher
/// lobe whose mean cosine is exp(−σ²).
///
/// **Results** are channels() values for each cone, interleaved; `radiance` has room for that many at least,
/// and what is past them stays as it was. It must not overlap the cones. Where the map is not negative,
/// neither are they; a constant map stays constant to 1e-6. A cone gives the same bits alone and among
/// others.
///
/// Throws Error (bad_request): a cone in which fault_of finds a fault; `radiance` too short. It is thrown
/// before anything is written.
class WELKIN_API GaussianStack {
 public:
  /// Move the map in; the borders of its charts are filled (fill_borders), as those of maps that were read
  /// are. Throws Error (bad_value) for values that aren't finite, (too_large) for a map of which no stack can
  /// be held; Cancelled.
  explicit GaussianStack(Map map, const GaussianStackOptions& options = {}, const Monitor& monitor = {});
  /// The map is shared, and must not change any more. Throws Error when there is none.
  explicit GaussianStack(std::shared_ptr<const Map> map, const GaussianStackOptions& options = {},
                         const Monitor& monitor = {});

  /// Looks the caller's map up, which must outlive the stack and all its copies, and not change meanwhile.
  static GaussianStack borrow(const Map& map, const GaussianStackOptions& options = {},
                              const Monitor& monitor = {});
  static GaussianStack borrow(const Map&& map, const GaussianStackOptions& options = {},
                              const Monitor& monitor = {}) = delete;

  /// Values of a look-up.
  int channels() const;
  /// The memory of the levels, without the map's.
  std::size_t bytes() const;
  /// The least `narrow`, radians, for which the accuracy holds; about a texel of the map.
  double narrowest() const;

  /// The mean radiance over one cone.
  void look_up(const EllipticalCone& cone, std::span<float> radiance) const;
  /// Over many cones, in the calling thread.
  void look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const;
  /// The first three channels over one cone. Throws Error when there are fewer.
  std::array<float, 3> rgb(const EllipticalCone& cone) const;

  class State;

 private:
  explicit GaussianStack(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace welkin
