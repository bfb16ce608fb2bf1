#include "welkin/brdf/brdf.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/brdf/measured.h"
#include "welkin/brdf/merl.h"
#include "welkin/brdf/model.h"
#include "welkin/brdf/models.h"

namespace welkin::brdf {
namespace {

using Model = AnyBrdf::Model;

/// A BRDF with a formula.
template <class B>
class Formula final : public Model {
 public:
  explicit Formula(B brdf = {}) : brdf_(brdf) {}

  std::string name() const override { return B::kName; }
  std::string description() const override { return B::kDescription; }
  std::string source() const override { return B::kSource; }
  std::vector<Parameter> parameters() const override {
    std::vector<Parameter> list;
    B copy = brdf_;
    copy.visit_parameters(
        [&](const char* name, double& value, double minimum, double maximum, const char* text) {
          list.push_back({name, value, minimum, maximum, text});
        });
    return list;
  }
  std::shared_ptr<const Model> with(std::string_view name, double value) const override {
    B copy = brdf_;
    copy.visit_parameters([&](const char* each, double& field, double, double, const char*) {
      if (name == each) field = value;
    });
    return std::make_shared<Formula>(copy);
  }
  bool mirror() const override { return brdf_.roughness < lobe::kMirrorRoughness; }
  double value(const Vec3d& view, const Vec3d& light) const override { return brdf_.value(view, light); }
  double width() const override { return brdf_.width(); }

 private:
  B brdf_;
};

class Function final : public Model {
 public:
  Function(std::string_view name, double width, std::function<double(const Vec3d&, const Vec3d&)> function)
      : name_(name), width_(width), function_(std::move(function)) {}

  std::string name() const override { return name_; }
  std::string description() const override { return "a program's own"; }
  std::string source() const override { return "the program"; }
  double value(const Vec3d& view, const Vec3d& light) const override { return function_(view, light); }
  double width() const override { return width_; }

 private:
  std::string name_;
  double width_;
  std::function<double(const Vec3d&, const Vec3d&)> function_;
};

const std::vector<std::shared_ptr<const Model>>& formulas() {
  static const std::vector<std::shared_ptr<const Model>> all{std::make_shared<Formula<GgxBrdf>>(),
                                                             std::make_shared<Formula<WardBrdf>>()};
  return all;
}

/// The path of `NAME,file=PATH`.
std::string path_of(const std::string& name, std::string_view assignment) {
  constexpr std::string_view kFile = "file=";
  if (assignment.substr(0, kFile.size()) != kFile || assignment == kFile)
    throw Error(ErrorKind::bad_request, name + ": write " + name + ",file=PATH");
  return std::string(assignment.substr(kFile.size()));
}

}  // namespace

const std::vector<std::string>& brdf_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& each : formulas()) list.push_back(each->name());
    return list;
  }();
  return names;
}

AnyBrdf AnyBrdf::make(std::string_view spec) {
  const std::size_t comma = spec.find(',');
  const std::string name(spec.substr(0, comma));
  std::string_view rest = comma == std::string_view::npos ? std::string_view{} : spec.substr(comma + 1);
  if (name == "table") return AnyBrdf(read_measured(path_of(name, rest), std::string(rest)));
  if (name == "merl") return AnyBrdf(read_merl(path_of(name, rest), std::string(rest)));
  std::vector<std::string> known = brdf_names();
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    known.insert(known.end(), {"table", "merl"});
    throw Error(ErrorKind::bad_request, unknown_name("BRDF", name, known));
  }
  std::shared_ptr<const Model> made = formulas()[static_cast<std::size_t>(found - known.begin())];
  while (!rest.empty()) {
    const std::size_t next = rest.find(',');
    const Parameter parameter = parse_parameter(name, made->parameters(), rest.substr(0, next));
    made = made->with(parameter.name, parameter.value);
    rest = next == std::string_view::npos ? std::string_view{} : rest.substr(next + 1);
  }
  return AnyBrdf(std::move(made));
}

AnyBrdf AnyBrdf::from_grid(std::string_view name, MeasuredGrid grid) {
  return AnyBrdf(measured_model(std::string(name), std::string(name), std::move(grid)));
}

AnyBrdf AnyBrdf::from_function(std::string_view name, double width,
                               std::function<double(const Vec3d&, const Vec3d&)> function) {
  require(function != nullptr, "a BRDF needs a function");
  require(width >= 1e-7 && width <= kPi, "the width of a BRDF's features is 1e-7 to π radians");
  return AnyBrdf(std::make_shared<Function>(name, width, std::move(function)));
}

std::string AnyBrdf::name() const {
  return model_->name();
}

std::string AnyBrdf::spec() const {
  std::string text = name();
  if (const std::string origin = model_->origin(); !origin.empty()) return text + "," + origin;
  const std::vector<Parameter> now = parameters();
  if (now.empty()) return text;
  const std::vector<Parameter> defaults = make(text).parameters();
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].value != defaults[i].value) text += "," + now[i].name + "=" + number_text(now[i].value);
  }
  return text;
}

std::string AnyBrdf::description() const {
  return model_->description();
}
std::string AnyBrdf::source() const {
  return model_->source();
}
std::vector<Parameter> AnyBrdf::parameters() const {
  return model_->parameters();
}
std::vector<std::string> AnyBrdf::notes() const {
  return model_->notes();
}

bool AnyBrdf::has_roughness() const {
  const std::vector<Parameter> known = parameters();
  return std::any_of(known.begin(), known.end(), [](const Parameter& p) { return p.name == "roughness"; });
}

double AnyBrdf::roughness() const {
  for (const Parameter& each : parameters()) {
    if (each.name == "roughness") return each.value;
  }
  return 0;
}

AnyBrdf AnyBrdf::with_roughness(double roughness) const {
  for (const Parameter& each : parameters()) {
    if (each.name != "roughness") continue;
    check_range(name(), each, roughness, number_text(roughness));
    return AnyBrdf(model_->with("roughness", roughness));
  }
  throw Error(ErrorKind::bad_request, "the BRDF " + name() + " has no roughness");
}

bool AnyBrdf::is_mirror() const {
  return model_->mirror();
}

double AnyBrdf::value(const Vec3d& view, const Vec3d& light) const {
  return view.z > 0 && light.z > 0 ? model_->value(view, light) : 0.0;
}

double AnyBrdf::width() const {
  return model_->width();
}

}  // namespace welkin::brdf
