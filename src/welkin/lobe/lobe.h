#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Rotationally symmetric lobes: how much light from an angle θ off the lobe's axis counts. This room knows
/// angles only; maps are pre-filtered with lobes in prefilter/.
namespace welkin::lobe {

/// A number that a lobe can be given: its roughness, its exponent.
struct Parameter {
  std::string name;
  double value = 0;
  double lowest = 0;
  double highest = 0;
  std::string description;
};

/// `weights` for one instruction set: see AnyLobe::weights. `self` is the lobe's struct.
using Weights = void (*)(const void* self, const float* s, float* weights, std::size_t count);

/// One of the registered lobes, chosen by name at run time, with its parameters; or a lobe from a table.
/// Cheap to copy; never changes; safe from many threads.
///
/// A lobe is a weight w(s) of s = 1 − cos θ, 0 ≤ s ≤ 2, which keeps its precision at the axis, where cos θ
/// doesn't: for unit vectors a and b, s = |a − b|²/2. Weights are finite, never negative, and not normalised.
class AnyLobe {
 public:
  /// By name, with parameters: `lambert`, `ggx,roughness=0.5`, `phong,exponent=50`. Throws Error: unknown
  /// names (the nearest is suggested), values out of range, a lobe that doesn't integrate.
  static AnyLobe make(std::string_view spec);

  std::string name() const;
  /// What `make` takes to get this one again: the name and the parameters that aren't at their default.
  std::string spec() const;
  std::vector<Parameter> parameters() const;
  std::string description() const;  ///< one line: what it is for
  std::string source() const;       ///< author, year, equation

  /// Whether it has the parameter `roughness`, 0 … 1, with 0 a mirror.
  bool has_roughness() const;
  /// The same lobe with another roughness. Throws Error when it has none, or for a value outside 0 … 1.
  AnyLobe with_roughness(double roughness) const;
  /// Whether it is a mirror: all weight at s = 0. Its weight() is meaningless; its zonal coefficients are 1.
  bool mirror() const;

  double weight(double s) const;  ///< the reference
  /// ∫ w dω over the sphere, sr: 2π ∫ w ds.
  double integral() const;
  /// Radius of the core, radians: about where the weight has fallen to half of its largest. For choosing
  /// steps.
  double width() const;
  /// Where between 0 and 2 w isn't smooth: 1 when it is cut at the horizon. For placing quadrature nodes.
  std::vector<double> breakpoints() const;

  /// The same over arrays of float, for the best instruction set of this processor; `self()` is its first
  /// argument. Values up to the next multiple of 16 beyond `count` are read and written too. Relative error
  /// 1e-5.
  Weights weights() const;
  const void* self() const;

  class Model;

 private:
  explicit AnyLobe(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  std::shared_ptr<const Model> model_;
};

/// Names of all registered lobes, in order of registration.
const std::vector<std::string>& lobe_names();

}  // namespace welkin::lobe
