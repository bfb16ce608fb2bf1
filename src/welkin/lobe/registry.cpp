#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/lobe/all.h"
#include "welkin/lobe/custom.h"
#include "welkin/lobe/kernels.h"
#include "welkin/lobe/lobe.h"
#include "welkin/lobe/panels.h"
#include "welkin/lobe/table_file.h"
#include "welkin/lobe/table_points.h"

namespace welkin::lobe {

AnyLobe::Model::~Model() = default;

namespace {

using Model = AnyLobe::Model;

Weights best_weights(std::size_t index) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return weights_avx2(index);
#endif
  return weights_baseline(index);
}

PointSums best_point_sums(std::size_t index) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return point_sums_avx2(index);
#endif
  return point_sums_baseline(index);
}

template <class... L>
std::vector<std::unique_ptr<Model>> make_models(TypeList<L...>) {
  std::vector<std::unique_ptr<Model>> models;
  (models.push_back(std::make_unique<ModelOf<L>>()), ...);
  for (std::size_t i = 0; i < models.size(); ++i) {
    models[i]->weights = best_weights(i);
    models[i]->point_sums = best_point_sums(i);
  }
  return models;
}

/// Every lobe with its defaults, in the order of AllLobes.
const std::vector<std::unique_ptr<Model>>& models() {
  static const auto all = make_models(AllLobes{});
  return all;
}

const Model& model_named(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& model : models()) {
    if (model->name() == name) return *model;
    names.push_back(model->name());
  }
  throw Error(ErrorKind::bad_request, unknown_name("lobe", name, names));
}

/// Parameters and synonyms.
std::vector<Parameter> settable(const Model& model) {
  std::vector<Parameter> all = model.parameters();
  for (Parameter& synonym : model.synonyms()) all.push_back(std::move(synonym));
  return all;
}

void set_parameter(Model& model, std::string_view assignment) {
  const Parameter parameter = parse_parameter(model.name(), settable(model), assignment);
  model.set(parameter.name, parameter.value);
}

std::unique_ptr<Model> model_of(Table table, std::string origin) {
  table.origin = std::move(origin);
  auto made = std::make_unique<ModelOf<Table>>(std::move(table));
  made->weights = model_named(Table::kName).weights;
  made->point_sums = model_named(Table::kName).point_sums;
  return made;
}

/// The table named after `table,`.
std::unique_ptr<Model> table_from_file(std::string_view assignment) {
  constexpr std::string_view kFile = "file=";
  if (assignment.substr(0, kFile.size()) != kFile || assignment == kFile) {
    throw Error(ErrorKind::bad_request, "table: write table,file=PATH");
  }
  const std::string path(assignment.substr(kFile.size()));
  const TablePoints points = read_table_file(path);
  return model_of(make_table(path, points.degrees, points.values), std::string(assignment));
}

}  // namespace

const std::vector<std::string>& lobe_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& model : models()) {
      if (model->name() != Table::kName) list.push_back(model->name());
    }
    return list;
  }();
  return names;
}

std::string table_description() {
  return Table::kDescription;
}

AnyLobe AnyLobe::make(std::string_view spec) {
  const std::size_t comma = spec.find(',');
  std::string_view rest = comma == std::string_view::npos ? std::string_view{} : spec.substr(comma + 1);
  const Model& prototype = model_named(spec.substr(0, comma));
  if (prototype.name() == Table::kName) return AnyLobe(table_from_file(rest));
  std::unique_ptr<Model> made = prototype.copy();
  while (!rest.empty()) {
    const std::size_t next = rest.find(',');
    set_parameter(*made, rest.substr(0, next));
    rest = next == std::string_view::npos ? std::string_view{} : rest.substr(next + 1);
  }
  return AnyLobe(std::move(made));
}

AnyLobe AnyLobe::from_table(std::string_view name, std::span<const double> degrees,
                            std::span<const double> values) {
  return AnyLobe(model_of(make_table(name, degrees, values), std::string(name)));
}

AnyLobe AnyLobe::from_model(std::shared_ptr<const Model> model) {
  require(model != nullptr, "a lobe needs a model");
  require(model->mirror() || (model->width() >= 1e-7 && model->width() <= kPi),
          "the width of a lobe is 1e-7 to π radians");
  return AnyLobe(std::move(model));
}

AnyLobe AnyLobe::mirror() {
  return make("ggx,roughness=0");
}

AnyLobe AnyLobe::with_roughness(double roughness) const {
  const std::vector<Parameter> known = settable(*model_);
  const auto found =
      std::find_if(known.begin(), known.end(), [](const auto& p) { return p.name == "roughness"; });
  if (found == known.end()) throw Error(ErrorKind::bad_request, "the lobe " + name() + " has no roughness");
  std::unique_ptr<Model> made = model_->copy();
  check_range(name(), *found, roughness, number_text(roughness));
  made->set(found->name, roughness);
  return AnyLobe(std::move(made));
}

bool AnyLobe::has_roughness() const {
  const std::vector<Parameter> known = settable(*model_);
  return std::any_of(known.begin(), known.end(), [](const auto& p) { return p.name == "roughness"; });
}

std::string AnyLobe::spec() const {
  std::string text = name();
  if (const std::string origin = model_->origin(); !origin.empty()) return text + "," + origin;
  const std::vector<Parameter> now = parameters(), defaults = model_->with_defaults()->parameters();
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].value != defaults[i].value) text += "," + now[i].name + "=" + number_text(now[i].value);
  }
  return text;
}

double AnyLobe::integral() const {
  if (is_mirror()) return 0;
  if (const std::optional<double> known = model_->integral()) return *known;
  const LobeNodes nodes = lobe_nodes(*this, 0);
  return std::accumulate(nodes.weights.begin(), nodes.weights.end(), 0.0);
}

std::string AnyLobe::name() const {
  return model_->name();
}
std::string AnyLobe::description() const {
  return model_->description();
}
std::string AnyLobe::source() const {
  return model_->source();
}
std::vector<Parameter> AnyLobe::parameters() const {
  return model_->parameters();
}
std::vector<Parameter> AnyLobe::synonyms() const {
  return model_->synonyms();
}
bool AnyLobe::is_mirror() const {
  return model_->mirror();
}
double AnyLobe::weight(double s) const {
  return model_->weight(s);
}
double AnyLobe::width() const {
  return model_->width();
}
std::vector<double> AnyLobe::breakpoints() const {
  return model_->breakpoints();
}
void AnyLobe::weights64(const double* s, double* weights, std::size_t count) const {
  model_->weights64(s, weights, count);
}
PointSums AnyLobe::point_sums() const {
  return model_->point_sums;
}
Weights AnyLobe::weights() const {
  return model_->weights;
}
const void* AnyLobe::self() const {
  return model_->self();
}

}  // namespace welkin::lobe
