#pragma once

#include <memory>
#include <utility>

#include "welkin/base/export.h"
#include "welkin/sphere/registry.h"

/// @file
/// Parameterizations of one's own: a struct that meets the concept of parameterization.h becomes an
/// AnyParameterization, and everything works on it: convert, bake, measure, plot, read and write. Its float
/// functions are compiled where this is used, for whatever instruction set that is compiled for.
namespace welkin::sphere {

/// @cond INTERNAL
/// What AnyParameterization forwards to. Implemented by ModelOf.
class WELKIN_API AnyParameterization::Model {
 public:
  virtual ~Model();
  virtual std::string name() const = 0;
  virtual const Traits& traits() const = 0;
  virtual std::vector<Parameter> parameters() const = 0;
  virtual bool set(std::string_view parameter, double value) = 0;
  virtual std::unique_ptr<Model> with_defaults() const = 0;
  /// What is wrong with the parameters that were set, or nothing.
  virtual std::string fault() const = 0;
  virtual int charts() const = 0;
  virtual double aspect() const = 0;
  virtual double coverage() const = 0;
  virtual Vec3d to_sphere(int chart, double u, double v) const = 0;
  virtual ChartPoint<double> from_sphere(const Vec3d& d) const = 0;
  virtual double solid_angle_density(int chart, double u, double v) const = 0;
  virtual bool valid(int chart, double u, double v) const = 0;
  virtual bool covers(const Vec3d& d) const = 0;
  virtual const void* self() const = 0;

  const Kernels* kernels = nullptr;
};

/// The functions of a parameterization over arrays, a value at a time.
template <class P>
struct ScalarKernels {
  static const P& of(const void* self) { return *static_cast<const P*>(self); }

  static void to_sphere(const void* self, int chart, const float* u, const float* v, float* x, float* y,
                        float* z, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3<float> d = of(self).template to_sphere<float>(chart, u[i], v[i]);
      x[i] = d.x;
      y[i] = d.y;
      z[i] = d.z;
    }
  }
  static void from_sphere(const void* self, const float* x, const float* y, const float* z, float* chart,
                          float* u, float* v, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const ChartPoint<float> at = of(self).template from_sphere<float>(Vec3<float>{x[i], y[i], z[i]});
      chart[i] = at.chart;
      u[i] = at.u;
      v[i] = at.v;
    }
  }
  static void density(const void* self, int chart, const float* u, const float* v, float* density,
                      std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      density[i] = of(self).template solid_angle_density<float>(chart, u[i], v[i]);
  }
  static void valid(const void* self, int chart, const float* u, const float* v, float* mask,
                    std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      mask[i] = of(self).template valid<float>(chart, u[i], v[i]) ? 1.0f : 0.0f;
  }
  static void covers(const void* self, const float* x, const float* y, const float* z, float* mask,
                     std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      mask[i] = of(self).template covers<float>(Vec3<float>{x[i], y[i], z[i]}) ? 1.0f : 0.0f;
  }

  static const Kernels& table() {
    static constexpr Kernels kernels{&to_sphere, &from_sphere, &density, &valid, &covers};
    return kernels;
  }
};

template <class P>
concept HasParameters = requires(P& p) {
  p.visit_parameters([](auto&&...) {});
};

/// The model of one struct.
template <class P>
class ModelOf final : public AnyParameterization::Model {
 public:
  explicit ModelOf(P p = P()) : p_(std::move(p)) {
    kernels = &ScalarKernels<typename KernelStructOf<P>::Type>::table();
  }

  std::string name() const override { return P::kName; }
  const Traits& traits() const override {
    static constexpr Traits kTraits = traits_of<P>();
    return kTraits;
  }

  std::vector<Parameter> parameters() const override {
    std::vector<Parameter> list;
    if constexpr (HasParameters<P>) {
      P copy = p_;
      copy.visit_parameters(
          [&](const char* name, double& value, double minimum, double maximum, const char* text) {
            list.push_back({name, value, minimum, maximum, text});
          });
    } else if constexpr (requires { typename P::WithParameters; }) {
      return ModelOf<typename P::WithParameters>().parameters();
    }
    return list;
  }

  bool set([[maybe_unused]] std::string_view parameter, [[maybe_unused]] double value) override {
    bool found = false;
    if constexpr (HasParameters<P>) {
      p_.visit_parameters([&](const char* name, double& field, double, double, const char*) {
        if (parameter == name) {
          field = value;
          found = true;
        }
      });
      if constexpr (requires { p_.update(); }) p_.update();
    }
    return found;
  }

  std::unique_ptr<AnyParameterization::Model> with_defaults() const override {
    auto fresh = std::make_unique<ModelOf>();
    fresh->kernels = kernels;
    return fresh;
  }

  std::string fault() const override {
    if constexpr (requires { p_.fault(); }) return p_.fault();
    return "";
  }

  int charts() const override { return P::kCharts; }
  double aspect() const override { return p_.aspect(); }
  double coverage() const override { return p_.coverage(); }
  Vec3d to_sphere(int chart, double u, double v) const override {
    return p_.template to_sphere<double>(chart, u, v);
  }
  ChartPoint<double> from_sphere(const Vec3d& d) const override { return p_.template from_sphere<double>(d); }
  double solid_angle_density(int chart, double u, double v) const override {
    return p_.template solid_angle_density<double>(chart, u, v);
  }
  bool valid(int chart, double u, double v) const override { return p_.template valid<double>(chart, u, v); }
  bool covers(const Vec3d& d) const override { return p_.template covers<double>(d); }
  const void* self() const override { return static_cast<const typename KernelStructOf<P>::Type*>(&p_); }

 private:
  P p_;
};

/// @endcond

/// A parameterization of this struct, with the values that its parameters have now. `P` is default
/// constructible, copied, and never changed afterwards; its functions are called from many threads at once.
/// Two of them count as equal when their specs are: kName must differ from the names of all others, and what
/// distinguishes two structs must be parameters.
///
/// Parameters, where it has any, are shown by a member template
/// `void visit_parameters(auto&& visit) { visit("fov", fov, 1.0, 360.0, "field of view, degrees"); }`: name,
/// member (a double), least, largest, description. A member `update()`, where there is one, is called after
/// they were set. A member `std::string fault() const` says what is wrong with values that don't go together;
/// AnyParameterization::make refuses them. A struct that is faster without parameters can name another of its
/// kName with them as `WithParameters`.
///
/// The laws of parameterization.h are not checked: positions, density or coverage that contradict each other
/// make results wrong, in silence.
template <Parameterization P>
AnyParameterization make_parameterization(P p = P()) {
  return AnyParameterization::from_model(std::make_shared<ModelOf<P>>(std::move(p)));
}

/// Makes AnyParameterization::make, and with it files and options, know the struct by its name. Safe from
/// many threads. There is no way to unregister: once in a program. Throws Error (bad_request) when the name
/// is taken, or has characters other than a–z, 0–9 and hyphens.
template <Parameterization P>
AnyParameterization register_parameterization() {
  AnyParameterization made = make_parameterization<P>();
  AnyParameterization::add(made);
  return made;
}

}  // namespace welkin::sphere
