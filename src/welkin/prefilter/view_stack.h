#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/view_chains.h"

/// @file
/// Radiance reflected towards a viewer, looked up in a stack.
namespace welkin {

/// A stack to look up: what a surface with the stack's BRDF reflects, seen from any direction.
///
/// Never changes after it is made; all of it can be used from many threads at once. Cheap to copy.
///
/// `normal` and `view`, from the surface to the viewer, are unit vectors of the world. Where they are at
/// right angles or more, n·v counts as 0. Levels are real numbers, as Sampler's.
class WELKIN_API ViewStack {
 public:
  /// Move the stack in; the borders of its levels are filled. Throws as ViewChains::check does.
  explicit ViewStack(ViewChains stack, const SamplerOptions& options = {});

  int channels() const { return channels_; }  ///< values of a look-up
  int levels() const { return levels_; }      ///< of each angle of view

  /// The mean radiance in the lobe, channels() values: between angles of view linear in √(n·v), between
  /// levels linear, each level looked up along its own axis. The radiance seen is this times albedo(). Throws
  /// Error: a level that isn't a number of 0 … levels() − 1, too little room.
  void look_up(const Vec3d& normal, const Vec3d& view, std::span<float> radiance, double level = 0) const;
  /// The first three channels. Throws Error when there are fewer.
  std::array<float, 3> rgb(const Vec3d& normal, const Vec3d& view, double level = 0) const;

  /// The share of light from all around that is reflected, interpolated as look_up does. Throws as it does.
  double albedo(double view_cosine, double level = 0) const;
  /// The level of a roughness by the chains' notes, linear between levels. Throws Error where they have none,
  /// or it is out of their range.
  double level_of(double roughness) const;
  /// Where a level is looked up: `lift` of the angle from the reflected direction to the normal, in the plane
  /// of normal and viewer.
  static Vec3d look_up_direction(const Vec3d& normal, const Vec3d& view, double lift);

  /// What the stack is for.
  const ViewNotes& notes() const { return notes_; }

 private:
  void check_level(double level) const;

  ViewNotes notes_;
  std::vector<double> roughness_;
  std::vector<Sampler> samplers_;
  int channels_, levels_;
};

}  // namespace welkin
