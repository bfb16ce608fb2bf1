#include "welkin/sphere/registry.h"

#include <algorithm>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/sphere/all.h"

namespace welkin::sphere {

/// What AnyParameterization forwards to: one derived class per registered struct.
class AnyParameterization::Model {
 public:
  virtual ~Model() = default;
  virtual std::string name() const = 0;
  virtual std::vector<Parameter> parameters() const = 0;
  virtual bool set(std::string_view parameter, double value) = 0;
  virtual std::unique_ptr<Model> with_defaults() const = 0;
  virtual int charts() const = 0;
  virtual double aspect() const = 0;
  virtual double coverage() const = 0;
  virtual bool density_by_row() const = 0;
  virtual bool filled_to_edges() const = 0;
  virtual Vec3d to_sphere(int chart, double u, double v) const = 0;
  virtual ChartPoint<double> from_sphere(const Vec3d& d) const = 0;
  virtual double solid_angle_density(int chart, double u, double v) const = 0;
  virtual bool valid(int chart, double u, double v) const = 0;
  virtual bool covers(const Vec3d& d) const = 0;
  virtual const void* self() const = 0;

  const Kernels* kernels = nullptr;
};

namespace {

template <class P>
concept HasParameters = requires(P& p) {
  p.visit_parameters([](auto&&...) {});
};

template <class P>
class ModelOf final : public AnyParameterization::Model {
 public:
  std::string name() const override { return P::kName; }

  std::vector<Parameter> parameters() const override {
    std::vector<Parameter> list;
    if constexpr (HasParameters<P>) {
      P copy = p_;
      copy.visit_parameters(
          [&](const char* name, double& value, double lowest, double highest, const char* text) {
            list.push_back({name, value, lowest, highest, text});
          });
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
      p_.update();
    }
    return found;
  }

  std::unique_ptr<Model> with_defaults() const override {
    auto fresh = std::make_unique<ModelOf>();
    fresh->kernels = kernels;
    return fresh;
  }

  int charts() const override { return P::kCharts; }
  double aspect() const override { return p_.aspect(); }
  double coverage() const override { return p_.coverage(); }
  bool density_by_row() const override { return P::kDensityByRow; }
  bool filled_to_edges() const override {
    if constexpr (requires { P::kFilledToEdges; }) return P::kFilledToEdges;
    return false;
  }
  Vec3d to_sphere(int chart, double u, double v) const override { return p_.to_sphere(chart, u, v); }
  ChartPoint<double> from_sphere(const Vec3d& d) const override { return p_.from_sphere(d); }
  double solid_angle_density(int chart, double u, double v) const override {
    return p_.solid_angle_density(chart, u, v);
  }
  bool valid(int chart, double u, double v) const override { return p_.valid(chart, u, v); }
  bool covers(const Vec3d& d) const override { return p_.covers(d); }
  const void* self() const override { return &p_; }

 private:
  P p_;
};

const Kernels& best_kernels(std::size_t index) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return kernels_avx2(index);
#endif
  return kernels_baseline(index);
}

template <class... P>
std::vector<std::unique_ptr<AnyParameterization::Model>> make_models(TypeList<P...>) {
  std::vector<std::unique_ptr<AnyParameterization::Model>> models;
  (models.push_back(std::make_unique<ModelOf<P>>()), ...);
  for (std::size_t i = 0; i < models.size(); ++i) models[i]->kernels = &best_kernels(i);
  return models;
}

const std::vector<std::unique_ptr<AnyParameterization::Model>>& models() {
  static const auto all = make_models(AllParameterizations{});
  return all;
}

void set_parameter(AnyParameterization::Model& model, std::string_view assignment) {
  const Parameter parameter = parse_parameter(model.name(), model.parameters(), assignment);
  model.set(parameter.name, parameter.value);
}

}  // namespace

const std::vector<std::string>& parameterization_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& model : models()) list.push_back(model->name());
    return list;
  }();
  return names;
}

AnyParameterization AnyParameterization::make(std::string_view spec) {
  const std::size_t comma = spec.find(',');
  const std::string_view name = spec.substr(0, comma);
  for (const auto& model : models()) {
    if (model->name() != name) continue;
    std::unique_ptr<Model> made = model->with_defaults();
    std::string_view rest = comma == std::string_view::npos ? std::string_view{} : spec.substr(comma + 1);
    while (!rest.empty()) {
      const std::size_t next = rest.find(',');
      set_parameter(*made, rest.substr(0, next));
      rest = next == std::string_view::npos ? std::string_view{} : rest.substr(next + 1);
    }
    return AnyParameterization(std::shared_ptr<const Model>(std::move(made)));
  }
  throw Error(unknown_name("parameterization", name, parameterization_names()));
}

AnyParameterization AnyParameterization::at_size(int width, int height) const {
  const std::vector<Parameter> now = parameters();
  if (now.size() != 2 || now[0].name != "width" || now[1].name != "height") return *this;
  std::unique_ptr<Model> made = model_->with_defaults();
  made->set("width", std::max(width, 2));
  made->set("height", std::max(height, 2));
  return AnyParameterization(std::shared_ptr<const Model>(std::move(made)));
}

std::string AnyParameterization::name() const {
  return model_->name();
}

std::string AnyParameterization::spec() const {
  std::string text = model_->name();
  const std::vector<Parameter> now = parameters();
  const std::vector<Parameter> defaults = model_->with_defaults()->parameters();
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].value != defaults[i].value) text += "," + now[i].name + "=" + number_text(now[i].value);
  }
  return text;
}

std::vector<Parameter> AnyParameterization::parameters() const {
  return model_->parameters();
}
int AnyParameterization::charts() const {
  return model_->charts();
}
double AnyParameterization::aspect() const {
  return model_->aspect();
}
double AnyParameterization::coverage() const {
  return model_->coverage();
}
bool AnyParameterization::density_by_row() const {
  return model_->density_by_row();
}

bool AnyParameterization::filled_to_edges() const {
  return model_->filled_to_edges();
}

bool AnyParameterization::full_charts() const {
  // What isn't full lacks a corner or an edge: discs, triangles, crosses, inset pictures.
  for (int chart = 0; chart < charts(); ++chart) {
    for (double u : {1e-6, 0.5, 1 - 1e-6}) {
      for (double v : {1e-6, 0.5, 1 - 1e-6}) {
        if (!valid(chart, u, v)) return false;
      }
    }
  }
  return true;
}

Vec3d AnyParameterization::to_sphere(int chart, double u, double v) const {
  return model_->to_sphere(chart, u, v);
}
ChartPoint<double> AnyParameterization::from_sphere(const Vec3d& d) const {
  return model_->from_sphere(d);
}
double AnyParameterization::solid_angle_density(int chart, double u, double v) const {
  return model_->solid_angle_density(chart, u, v);
}
bool AnyParameterization::valid(int chart, double u, double v) const {
  return model_->valid(chart, u, v);
}
bool AnyParameterization::covers(const Vec3d& d) const {
  return model_->covers(d);
}
const Kernels& AnyParameterization::kernels() const {
  return *model_->kernels;
}
const void* AnyParameterization::self() const {
  return model_->self();
}

}  // namespace welkin::sphere
