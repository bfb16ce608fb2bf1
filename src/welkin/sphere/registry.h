#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/parameter.h"
#include "welkin/sphere/kernels.h"
#include "welkin/sphere/parameterization.h"

/// @file
/// Parameterizations by name.
namespace welkin::sphere {

/// A parameterization, chosen by name at run time, with its parameters; or made of a struct (custom.h). Cheap
/// to copy; never changes; safe from many threads. Double-precision functions are the reference; `kernels`
/// are the fast ones.
class WELKIN_API AnyParameterization {
 public:
  /// By name, with parameters: `latlong`, `fisheye-equidistant,fov=200`. Throws Error (bad_request): unknown
  /// names (the nearest is suggested) and values out of range.
  static AnyParameterization make(std::string_view spec);

  /// `latlong`, `fisheye-equidistant`.
  std::string name() const;
  /// What `make` takes to get this one again: the name and the parameters that aren't at their default.
  std::string spec() const;
  /// Its parameters, with their values.
  std::vector<Parameter> parameters() const;

  /// The same for charts of this size, where it depends on it: the parameters `width` and `height`, at least
  /// 2, follow (Traits::follows_size), or `aspect` where it is 0 (Traits::follows_aspect). Others don't
  /// change.
  AnyParameterization at_size(int width, int height) const;

  /// How many charts: 6 of a cube.
  int charts() const;
  /// Width / height of a chart with square texels.
  double aspect() const;
  /// Solid angle of what a map shows, sr: 4π for a whole world.
  double coverage() const;
  /// Whether that is the whole sphere.
  bool whole_world() const { return coverage() > 4 * kPi * (1 - 1e-9); }
  /// What is special about it; valid as long as this one or a copy of it.
  const Traits& traits() const;
  /// Traits::density_by_row.
  bool density_by_row() const { return traits().density_by_row; }
  /// Whether every position of every chart is valid: no discs, no triangles.
  bool full_charts() const;
  /// Traits::filled_to_edges.
  bool filled_to_edges() const { return traits().filled_to_edges; }

  /// Unit direction at a position of a chart and, continuously, of a margin of a whole chart's side around
  /// it. Throws Error (bad_request) for a chart that there isn't, as do the others that take one.
  Vec3d to_sphere(int chart, double u, double v) const;
  /// The position of a direction of any length > 0; finite also where `covers` is false.
  ChartPoint<double> from_sphere(const Vec3d& d) const;
  /// Solid angle per unit of (u, v) area, sr, inside the chart.
  double solid_angle_density(int chart, double u, double v) const;
  /// Whether (u, v) is a position of the map: false in the corners of a disc.
  bool valid(int chart, double u, double v) const;
  /// Whether the map shows a direction: false behind a hemisphere.
  bool covers(const Vec3d& d) const;

  /// The same over arrays of float, for the best instruction set of this processor; `self()` is their first
  /// argument.
  const Kernels& kernels() const;
  /// The parameterization's struct; valid as long as this one or a copy of it.
  const void* self() const;

  /// Whether both have one spec.
  friend bool operator==(const AnyParameterization& a, const AnyParameterization& b) {
    return a.spec() == b.spec();
  }

  class Model;
  /// For make_parameterization (custom.h). Throws Error (bad_request) for no model, or one without charts.
  static AnyParameterization from_model(std::shared_ptr<const Model> model);
  /// For register_parameterization (custom.h).
  static void add(const AnyParameterization& parameterization);

 private:
  explicit AnyParameterization(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  std::shared_ptr<const Model> model_;
};

/// Names of all registered parameterizations, in order of registration: the built-in ones first. Safe from
/// many threads.
WELKIN_API std::vector<std::string> parameterization_names();

}  // namespace welkin::sphere
