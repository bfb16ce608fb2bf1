#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/parameter.h"

/// @file
/// Rotationally symmetric lobes: how radiance is weighted by its angle θ from the lobe's axis. This room
/// knows angles only; maps are pre-filtered with lobes in prefilter/.
namespace welkin::lobe {

/// `weights` for one instruction set: see AnyLobe::weights. `self` is the lobe's struct.
using Weights = void (*)(const void* self, const float* s, float* weights, std::size_t count);

/// Weighted points, for sums over them: `weight` has `channels` values for each.
struct Points {
  const float* x;       ///< unit directions, `count` of them
  const float* y;       ///< as x
  const float* z;       ///< as x
  const float* weight;  ///< count · channels, interleaved
  int count = 0;        ///< points
  int channels = 0;     ///< values of a point
};

/// values[i·channels + c] += Σ_k w(|d_i − point_k|²/2) weight[k·channels + c] for unit directions d_i, i <
/// count. Arrays of directions are read up to the next multiple of 16.
using PointSums = void (*)(const void* self, const Points& points, const float* x, const float* y,
                           const float* z, float* values, std::size_t count);

/// A lobe, chosen by name at run time, with its parameters; or made of a table, or of a struct (custom.h).
/// Cheap to copy; never changes; safe from many threads.
///
/// A lobe is a weight w(s) of s = 1 − cos θ, 0 ≤ s ≤ 2, which keeps its precision at the axis, where cos θ
/// doesn't: for unit vectors a and b, s = |a − b|²/2. Weights are finite, never negative, and not normalised.
class WELKIN_API AnyLobe {
 public:
  /// By name, with parameters: `lambert`, `ggx,roughness=0.5`, `phong,exponent=50`; or from a file:
  /// `table,file=PATH`, where the path is all the rest (docs/lobes.md). Throws Error: unknown names (the
  /// nearest is suggested), values out of range, a table that doesn't integrate (bad_request, damaged), a
  /// file that can't be read.
  static AnyLobe make(std::string_view spec);
  /// A lobe from values at ascending angles, in degrees from 0 to at most 180; linear in the angle between
  /// them, 0 beyond the last. Its spec is `table,NAME`, which `make` cannot make again. Throws Error, which
  /// begins with `name`: fewer than two points or over kMaxTablePoints, values that are negative or not
  /// finite, all 0, unequal numbers of angles and values, angles that don't ascend from 0, a width under 1e-7
  /// radians.
  static AnyLobe from_table(std::string_view name, std::span<const double> degrees,
                            std::span<const double> values);

  /// All weight at the axis: a map filtered with it is the map, resampled.
  static AnyLobe mirror();

  /// `ggx`; of a table `table`.
  std::string name() const;
  /// What `make` takes to get this one again: the name and the parameters that aren't at their default.
  std::string spec() const;
  /// Its parameters, with their values.
  std::vector<Parameter> parameters() const;
  /// Other numbers that `make` takes in place of a parameter: phong's roughness is 1/exponent.
  std::vector<Parameter> synonyms() const;
  std::string description() const;  ///< one line: what it is for
  std::string source() const;       ///< author, year, equation

  /// Whether it has the parameter `roughness`, 0 … 1, with 0 a mirror (besides `charlie`, which has none and
  /// begins at 0.01).
  bool has_roughness() const;
  /// The same lobe with another roughness. Throws Error when it has none, or for a value out of its range.
  AnyLobe with_roughness(double roughness) const;
  /// Whether it is a mirror: all weight at s = 0. Its weight() is meaningless; its zonal coefficients are 1.
  bool is_mirror() const;

  /// w(s), 0 ≤ s ≤ 2: the reference that the fast functions are held to. Of a mirror meaningless.
  double weight(double s) const;
  /// The same for `count` values: weights[i] = w(s[i]). The arrays may be the same one.
  void weights64(const double* s, double* weights, std::size_t count) const;
  /// ∫ w dω over the sphere, sr: 2π ∫ w ds. Relative error 1e-11, a few microseconds. 0 for a mirror.
  double integral() const;
  /// Half width at half maximum, about, radians: where the weight has fallen to half of its largest; of
  /// `charlie` the ring's width. For choosing steps of quadrature.
  double width() const;
  /// The s between 0 and 2 at which w isn't smooth: 1 when it is cut at the horizon. For placing quadrature
  /// nodes.
  std::vector<double> breakpoints() const;

  /// The same over arrays of float, for the best instruction set of this processor; `self()` is its first
  /// argument. Values up to the next multiple of 16 beyond `count` are read and written too. Relative error
  /// 1e-5 where the weight is above 1e-20 of the largest, below that an absolute one of 1e-25 of it; of a
  /// table 1e-6 of the largest.
  Weights weights() const;
  /// Weighted sums over points, for the same instruction set; first argument self().
  PointSums point_sums() const;
  /// The lobe's struct, for `weights` and `point_sums`; valid as long as this lobe or a copy of it.
  const void* self() const;

  class Model;
  /// For make_lobe (custom.h). Throws Error (bad_request) for no model, or one whose width isn't over 0 and
  /// at most π.
  static AnyLobe from_model(std::shared_ptr<const Model> model);

 private:
  explicit AnyLobe(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  std::shared_ptr<const Model> model_;
};

/// The most points that a table can have.
inline constexpr std::size_t kMaxTablePoints = 10000;

/// Names of all lobes that `make` knows without a file, in order of registration.
WELKIN_API const std::vector<std::string>& lobe_names();
/// One line on `table`, which needs a file.
WELKIN_API std::string table_description();

}  // namespace welkin::lobe
