#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "welkin/base/error.h"
#include "welkin/base/export.h"
#include "welkin/filter/filter.h"
#include "welkin/map/chain.h"

/// @file
/// Radiance along directions.
namespace welkin {

/// How a map is looked up.
struct SamplerOptions {
  /// `automatic` means `bicubic` here: a direction has no area to average over.
  Filter filter = Filter::bilinear;
  /// false: overshoot of bicubic and Lanczos is clamped to near the range of the footprint's texels, so that
  /// positive radiance stays positive (docs/filtering.md, "Overshoot"). true: unclamped.
  bool allow_ringing = false;
  /// Levels of a map's own pyramid, weighted by solid angle, that can be looked up, the map itself included;
  /// at most as many as there are down to one texel, and 0 is all of them. Those of a chain are its own.
  int levels = 1;
};

/// Directions as three arrays of one length.
struct DirectionArrays {
  std::span<const float> x;  ///< first components
  std::span<const float> y;  ///< second components
  std::span<const float> z;  ///< third components
};

/// Looks radiance up along directions: a map (or a chain), its pyramid and a filter.
///
/// Never changes after it is made; all of it can be used from many threads at once. Cheap to copy: copies
/// share the pixels. Look-ups take no memory.
///
/// **Directions** are the world's: the map's `orientation` is applied. They have any length > 0, down to the
/// smallest number and up to the largest. Along a direction that the map does not show, and along one that is
/// zero or not finite, radiance is 0; `covers` tells. **Levels** are real numbers, 0 is the finest: 2.5 is
/// the mean of levels 2 and 3, and between two levels radiance is linear.
///
/// **Results** are channels() values for each direction, interleaved; `radiance` has room for that many at
/// least, and what is past them stays as it was. It must not overlap the directions.
///
/// **Exactness**, against double directions, whose positions in the map are computed in float64: a float
/// direction is looked up at most 5e-7 radians, and then at most 3e-7 of a chart's side, from where it is.
/// A float direction gives the same bits alone and among others, in either memory layout (with
/// Filter::lanczos: within 1e-6 of the largest value of the texels read).
///
/// Throws Error: a level that is not a number from 0 to levels() − 1; `radiance` too short; arrays of
/// different lengths. It is thrown before anything is written.
class WELKIN_API Sampler {
 public:
  /// Move the map in; the borders of its charts are filled (fill_borders), as those of maps that were read
  /// are.
  explicit Sampler(Map map, const SamplerOptions& options = {});
  /// The map is shared, and must not change any more. Throws Error when there is none.
  explicit Sampler(std::shared_ptr<const Map> map, const SamplerOptions& options = {});
  /// The chain's levels as they are. Throws Error when it has none, or they differ in parameterization,
  /// orientation or number of channels.
  explicit Sampler(Chain chain, const SamplerOptions& options = {});
  /// The same of a chain that is shared, and must not change any more.
  explicit Sampler(std::shared_ptr<const Chain> chain, const SamplerOptions& options = {});

  /// Looks the caller's map up, which must outlive the sampler and all its copies, and not change meanwhile.
  static Sampler borrow(const Map& map, const SamplerOptions& options = {});
  static Sampler borrow(const Map&& map, const SamplerOptions& options = {}) = delete;

  /// Values along a direction.
  int channels() const;
  /// How many levels can be looked up, at least 1.
  int levels() const;

  /// Along one direction.
  /// @{
  void look_up(const Vec3<float>& direction, std::span<float> radiance, double level = 0) const;
  void look_up(const Vec3d& direction, std::span<float> radiance, double level = 0) const;
  /// @}

  /// The first three channels along one direction. Throws Error when there are fewer.
  /// @{
  std::array<float, 3> rgb(const Vec3<float>& direction, double level = 0) const;
  std::array<float, 3> rgb(const Vec3d& direction, double level = 0) const;
  /// @}

  /// Along many directions, all at one level. In the calling thread.
  /// @{
  void look_up(std::span<const Vec3<float>> directions, std::span<float> radiance, double level = 0) const;
  void look_up(std::span<const Vec3d> directions, std::span<float> radiance, double level = 0) const;
  void look_up(const DirectionArrays& directions, std::span<float> radiance, double level = 0) const;
  /// @}

  /// Each at a level of its own; there are as many levels as directions. In the calling thread.
  /// @{
  void look_up(std::span<const Vec3<float>> directions, std::span<float> radiance,
               std::span<const float> levels) const;
  void look_up(std::span<const Vec3d> directions, std::span<float> radiance,
               std::span<const float> levels) const;
  void look_up(const DirectionArrays& directions, std::span<float> radiance,
               std::span<const float> levels) const;
  /// @}

  /// Whether the map shows a direction. At the rim of what is shown, by the same arithmetic as look_up.
  /// @{
  bool covers(const Vec3<float>& direction) const;
  bool covers(const Vec3d& direction) const;
  /// @}

  class State;

 private:
  explicit Sampler(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace welkin
