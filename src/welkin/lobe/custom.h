#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"

/// @file
/// Lobes of one's own: a struct becomes an AnyLobe, and maps are pre-filtered, verified and plotted with it.
/// Its float functions are compiled where this is used, for whatever instruction set that is compiled for.
namespace welkin::lobe {

/// @cond INTERNAL
/// What AnyLobe forwards to. Implemented by ModelOf.
class WELKIN_API AnyLobe::Model {
 public:
  virtual ~Model();
  virtual std::string name() const = 0;
  virtual std::string description() const = 0;
  virtual std::string source() const = 0;
  /// What stands behind the name in the spec, where that isn't the parameters.
  virtual std::string origin() const = 0;
  virtual std::vector<Parameter> parameters() const = 0;
  virtual std::vector<Parameter> synonyms() const = 0;
  /// `name` is a parameter's or a synonym's.
  virtual void set(std::string_view name, double value) = 0;
  virtual std::unique_ptr<Model> copy() const = 0;
  virtual std::unique_ptr<Model> with_defaults() const = 0;
  virtual bool mirror() const = 0;
  virtual double weight(double s) const = 0;
  virtual void weights64(const double* s, double* weights, std::size_t count) const = 0;
  /// Where there is a closed form.
  virtual std::optional<double> integral() const = 0;
  virtual double width() const = 0;
  virtual std::vector<double> breakpoints() const = 0;
  virtual const void* self() const = 0;

  Weights weights = nullptr;
  PointSums point_sums = nullptr;
};

/// A lobe's functions over arrays, a value at a time.
template <class L>
struct ScalarSums {
  static void weights(const void* self, const float* s, float* weights, std::size_t count) {
    const L& lobe = *static_cast<const L*>(self);
    for (std::size_t i = 0; i < count; ++i) weights[i] = lobe.template weight<float>(s[i]);
  }
  static void sums(const void* self, const Points& points, const float* x, const float* y, const float* z,
                   float* values, std::size_t count) {
    const L& lobe = *static_cast<const L*>(self);
    const auto channels = static_cast<std::size_t>(points.channels);
    for (std::size_t i = 0; i < count; ++i) {
      const float* weights_of = points.weight;
      for (int k = 0; k < points.count; ++k, weights_of += channels) {
        const float dx = x[i] - points.x[k], dy = y[i] - points.y[k], dz = z[i] - points.z[k];
        const float weight = lobe.template weight<float>(0.5f * (dx * dx + dy * dy + dz * dz));
        for (std::size_t c = 0; c < channels; ++c) values[i * channels + c] += weight * weights_of[c];
      }
    }
  }
};

/// Gives every parameter or synonym to a visitor, where the lobe has any.
template <class L, class Visitor>
void visit_parameters(L& lobe, Visitor&& visit) {
  if constexpr (requires { lobe.visit_parameters(visit); }) lobe.visit_parameters(visit);
}
template <class L, class Visitor>
void visit_synonyms(L& lobe, Visitor&& visit) {
  if constexpr (requires { lobe.visit_synonyms(visit); }) lobe.visit_synonyms(visit);
}

template <class L>
class ModelOf final : public AnyLobe::Model {
 public:
  explicit ModelOf(L lobe = L()) : lobe_(std::move(lobe)) {
    weights = &ScalarSums<L>::weights;
    point_sums = &ScalarSums<L>::sums;
  }

  std::string name() const override { return L::kName; }
  std::string description() const override {
    if constexpr (requires { L::kDescription; }) return L::kDescription;
    return {};
  }
  std::string source() const override {
    if constexpr (requires { L::kSource; }) return L::kSource;
    return {};
  }
  std::string origin() const override {
    if constexpr (requires { lobe_.origin; }) return lobe_.origin;
    return {};
  }

  std::vector<Parameter> parameters() const override {
    std::vector<Parameter> list;
    L copy = lobe_;
    visit_parameters(copy, collector(list));
    return list;
  }
  std::vector<Parameter> synonyms() const override {
    std::vector<Parameter> list;
    L copy = lobe_;
    visit_synonyms(copy, collector(list));
    return list;
  }
  void set(std::string_view name, double value) override {
    const auto assign = [&](const char* each, double& field, double, double, const char*) {
      if (name == each) field = value;
    };
    visit_parameters(lobe_, assign);
    visit_synonyms(lobe_, assign);
  }
  std::unique_ptr<AnyLobe::Model> copy() const override { return std::make_unique<ModelOf>(*this); }
  std::unique_ptr<AnyLobe::Model> with_defaults() const override { return std::make_unique<ModelOf>(); }

  bool mirror() const override {
    if constexpr (requires { lobe_.mirror(); }) return lobe_.mirror();
    return false;
  }
  double weight(double s) const override { return lobe_.template weight<double>(s); }
  void weights64(const double* s, double* weights, std::size_t count) const override {
    const L lobe = lobe_;  // a copy that the stores can't change
    for (std::size_t i = 0; i < count; ++i) weights[i] = lobe.template weight<double>(s[i]);
  }
  std::optional<double> integral() const override {
    if constexpr (requires { lobe_.integral(); }) return lobe_.integral();
    return {};
  }
  double width() const override { return lobe_.width(); }
  std::vector<double> breakpoints() const override { return lobe_.breakpoints(); }
  const void* self() const override { return &lobe_; }

 private:
  static auto collector(std::vector<Parameter>& list) {
    return [&list](const char* name, double& value, double minimum, double maximum, const char* text) {
      list.push_back({name, value, minimum, maximum, text});
    };
  }

  L lobe_;
};

/// @endcond

// clang-format off
/// What a lobe of one's own provides: a default constructible, copyable struct.
///
///     struct Name {
///       static constexpr const char* kName = "name";  // differs from those of lobe_names()
///
///       // w(s), s = 1 − cos θ, 0 ≤ s ≤ 2, for double and float: finite, not negative, not normalised, not all 0.
///       template <class T> T weight(T s) const;
///
///       // Radians, 1e-7 … π: about where the weight has fallen to half of its largest.
///       double width() const;
///
///       // The s between 0 and 2 where w isn't smooth, ascending.
///       std::vector<double> breakpoints() const;
///
///       // Optional:
///       static constexpr const char* kDescription = "one line: what it is for";
///       static constexpr const char* kSource = "author, year, equation";
///       double roughness = 0.5;                       // a parameter: any member that is a double
///       template <class V> void visit_parameters(V&& visit) {
///         visit("roughness", roughness, 0.0, 1.0, "0 is a mirror");  // name, member, least, largest, description
///       }
///       template <class V> void visit_synonyms(V&& visit);  // as well: other names for numbers, 0 when not given
///       bool mirror() const;                          // all weight at s = 0
///       std::optional<double> integral() const;       // ∫ w dω, sr, where there is a closed form
///     };
///
/// Its functions are called from many threads at once.
// clang-format on
template <class L>
concept Lobe = std::default_initializable<L> && std::copyable<L> &&
    requires(const L& lobe, double s, float f) {
  { L::kName } -> std::convertible_to<const char*>;
  { lobe.template weight<double>(s) } -> std::same_as<double>;
  { lobe.template weight<float>(f) } -> std::same_as<float>;
  { lobe.width() } -> std::convertible_to<double>;
  { lobe.breakpoints() } -> std::convertible_to<std::vector<double>>;
};

/// The lobe of this struct, copied. Throws Error (bad_request) when its width isn't over 0 and at most π. Its
/// spec is its name and parameters, which AnyLobe::make doesn't know.
template <Lobe L>
AnyLobe make_lobe(L lobe = L()) {
  return AnyLobe::from_model(std::make_shared<ModelOf<L>>(std::move(lobe)));
}

}  // namespace welkin::lobe
