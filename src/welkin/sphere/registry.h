#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/parameter.h"
#include "welkin/sphere/kernels.h"
#include "welkin/sphere/parameterization.h"

namespace welkin::sphere {

/// One of the registered parameterizations, chosen by name at run time, with its parameters. Cheap to copy;
/// never changes; safe from many threads. Double-precision functions are the reference; `kernels` are the
/// fast ones.
class WELKIN_API AnyParameterization {
 public:
  /// By name, with parameters: `latlong`, `fisheye-equidistant,fov=200`. Throws Error: unknown names (the
  /// nearest is suggested) and values out of range.
  static AnyParameterization make(std::string_view spec);

  std::string name() const;
  /// What `make` takes to get this one again: the name and the parameters that aren't at their default.
  std::string spec() const;
  std::vector<Parameter> parameters() const;

  /// The same for charts of this size: where the edges of an edge-centred one lie depends on it. Others don't
  /// change.
  AnyParameterization at_size(int width, int height) const;

  int charts() const;
  double aspect() const;    ///< width / height of a chart with square texels
  double coverage() const;  ///< sr
  bool whole_world() const { return coverage() > 4 * kPi * (1 - 1e-9); }
  const Traits& traits() const;
  bool density_by_row() const { return traits().density_by_row; }
  bool full_charts() const;  ///< every place of every chart is valid: no discs, no triangles
  bool filled_to_edges() const { return traits().filled_to_edges; }

  // See the concept in parameterization.h.
  Vec3d to_sphere(int chart, double u, double v) const;
  ChartPoint<double> from_sphere(const Vec3d& d) const;
  double solid_angle_density(int chart, double u, double v) const;
  bool valid(int chart, double u, double v) const;
  bool covers(const Vec3d& d) const;

  /// The same over arrays of float, for the best instruction set of this processor; `self()` is their first
  /// argument.
  const Kernels& kernels() const;
  const void* self() const;

  friend bool operator==(const AnyParameterization& a, const AnyParameterization& b) {
    return a.spec() == b.spec();
  }

  class Model;
  /// See custom.h.
  static AnyParameterization from_model(std::shared_ptr<const Model> model);
  static void add(const AnyParameterization& parameterization);

 private:
  explicit AnyParameterization(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  std::shared_ptr<const Model> model_;
};

/// Names of all registered parameterizations, in order of registration: the built-in ones first.
WELKIN_API std::vector<std::string> parameterization_names();

}  // namespace welkin::sphere
