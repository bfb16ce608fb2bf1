#include "welkin/sphere/registry.h"

#include <algorithm>
#include <mutex>
#include <shared_mutex>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/sphere/all.h"
#include "welkin/sphere/custom.h"

namespace welkin::sphere {

AnyParameterization::Model::~Model() = default;

namespace {

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

/// The built-in ones, and those that were added.
class Registry {
 public:
  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  /// None when there is none of that name.
  std::shared_ptr<const AnyParameterization::Model> find(std::string_view name) const {
    const std::shared_lock lock(mutex_);
    return found(models_, name);
  }
  /// The one of that name that takes parameters, where it is another.
  std::shared_ptr<const AnyParameterization::Model> find_with_parameters(std::string_view name) const {
    const auto other = found(with_parameters_, name);
    return other != nullptr ? other : find(name);
  }
  std::vector<std::string> names() const {
    const std::shared_lock lock(mutex_);
    std::vector<std::string> list;
    for (const auto& model : models_) list.push_back(model->name());
    return list;
  }
  /// False when the name is taken.
  bool add(std::shared_ptr<const AnyParameterization::Model> model) {
    const std::unique_lock lock(mutex_);
    const std::string name = model->name();
    if (std::any_of(models_.begin(), models_.end(), [&](const auto& each) { return each->name() == name; }))
      return false;
    models_.push_back(std::move(model));
    return true;
  }

 private:
  using Models = std::vector<std::shared_ptr<const AnyParameterization::Model>>;

  static std::shared_ptr<const AnyParameterization::Model> found(const Models& models,
                                                                 std::string_view name) {
    const auto at =
        std::find_if(models.begin(), models.end(), [&](const auto& each) { return each->name() == name; });
    return at == models.end() ? nullptr : *at;
  }

  Registry() {
    for (auto& model : make_models(AllParameterizations{})) {
      Models& list = found(models_, model->name()) == nullptr ? models_ : with_parameters_;
      list.push_back(std::move(model));
    }
  }

  mutable std::shared_mutex mutex_;
  Models models_;           // one of each name
  Models with_parameters_;  // WithParameters of some of them; never changes
};

void check_chart(const AnyParameterization::Model& model, int chart) {
  require(chart >= 0 && chart < model.charts(), "the parameterization has no chart of that number");
}

void set_parameter(AnyParameterization::Model& model, std::string_view assignment) {
  const Parameter parameter = parse_parameter(model.name(), model.parameters(), assignment);
  model.set(parameter.name, parameter.value);
}

}  // namespace

std::vector<std::string> parameterization_names() {
  return Registry::instance().names();
}

AnyParameterization AnyParameterization::make(std::string_view spec) {
  const std::size_t comma = spec.find(',');
  const std::string_view name = spec.substr(0, comma);
  const std::shared_ptr<const Model> plain = Registry::instance().find(name);
  if (plain == nullptr)
    throw Error(ErrorKind::bad_request, unknown_name("parameterization", name, parameterization_names()));
  std::string_view rest = comma == std::string_view::npos ? std::string_view{} : spec.substr(comma + 1);
  if (rest.empty()) return AnyParameterization(std::shared_ptr<const Model>(plain->with_defaults()));
  std::unique_ptr<Model> made = Registry::instance().find_with_parameters(name)->with_defaults();
  while (!rest.empty()) {
    const std::size_t next = rest.find(',');
    set_parameter(*made, rest.substr(0, next));
    rest = next == std::string_view::npos ? std::string_view{} : rest.substr(next + 1);
  }
  if (const std::string fault = made->fault(); !fault.empty())
    throw Error(ErrorKind::bad_request, std::string(spec) + ": " + fault);
  AnyParameterization parameterization(std::shared_ptr<const Model>(std::move(made)));
  // Parameters at their defaults are none: the plain one may be faster.
  if (parameterization.spec() == name) return AnyParameterization(plain);
  return parameterization;
}

AnyParameterization AnyParameterization::from_model(std::shared_ptr<const Model> model) {
  require(model != nullptr, "a parameterization needs a model");
  require(model->charts() > 0, "a parameterization has at least one chart");
  return AnyParameterization(std::move(model));
}

void AnyParameterization::add(const AnyParameterization& parameterization) {
  const std::string name = parameterization.name();
  const bool sound = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!sound) {
    throw Error(
        ErrorKind::bad_request,
        "the name '" + name + "' of a parameterization has characters other than a–z, 0–9 and hyphens");
  }
  if (!Registry::instance().add(parameterization.model_))
    throw Error(ErrorKind::bad_request, "there is a parameterization called '" + name + "' already");
}

AnyParameterization AnyParameterization::at_size(int width, int height) const {
  const auto aspect_of = [](const Parameter& p) { return p.name == "aspect"; };
  const std::vector<Parameter> now = parameters();
  const bool open = traits().follows_aspect && std::find_if(now.begin(), now.end(), aspect_of)->value == 0;
  if (!traits().follows_size && !open) return *this;
  std::unique_ptr<Model> made = model_->with_defaults();
  if (open) {
    for (const Parameter& each : now) made->set(each.name, each.value);
    made->set("aspect", static_cast<double>(width) / height);
  } else {
    made->set("width", std::max(width, 2));
    made->set("height", std::max(height, 2));
  }
  if (const std::string fault = made->fault(); !fault.empty())
    throw Error(ErrorKind::bad_request,
                spec() + " of " + std::to_string(width) + "×" + std::to_string(height) + ": " + fault);
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
const Traits& AnyParameterization::traits() const {
  return model_->traits();
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
  check_chart(*model_, chart);
  return model_->to_sphere(chart, u, v);
}
ChartPoint<double> AnyParameterization::from_sphere(const Vec3d& d) const {
  return model_->from_sphere(d);
}
double AnyParameterization::solid_angle_density(int chart, double u, double v) const {
  check_chart(*model_, chart);
  return model_->solid_angle_density(chart, u, v);
}
bool AnyParameterization::valid(int chart, double u, double v) const {
  check_chart(*model_, chart);
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
