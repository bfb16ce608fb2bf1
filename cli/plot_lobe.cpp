#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>

#include "json_text.h"
#include "plot.h"
#include "welkin/base/number_text.h"
#include "welkin/lobe/energy.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/scalar.h"
#include "welkin/plot/draw_lobes.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

constexpr double kDegrees = 180 / kPi;
constexpr std::array kShares{0.5, 0.9, 0.99};
constexpr int kPrintedDegree = 8;

struct PlotLobe {
  std::string out, axis = "linear", format;
  std::vector<std::string> specs;
  LobePlot plot;
  bool json = false;

  void run();
};

std::vector<lobe::AnyLobe> make_lobes(const std::vector<std::string>& specs) {
  std::vector<lobe::AnyLobe> lobes;
  for (const std::string& spec : specs)
    lobes.push_back(parse_option("--lobe", [&] { return lobe::AnyLobe::make(spec); }));
  return lobes;
}

/// What the table and the JSON show. Angles in degrees.
struct Facts {
  std::string spec, source;
  bool mirror;
  double integral, width;
  std::array<double, kShares.size()> holding;
  std::vector<double> zonal;
};

/// The spec with all parameters, those at their defaults too.
std::string full_spec(const lobe::AnyLobe& lobe) {
  if (lobe.parameters().empty()) return lobe.spec();
  std::string text = lobe.name();
  for (const Parameter& p : lobe.parameters()) text += "," + p.name + "=" + number_text(p.value);
  return text;
}

Facts facts_of(const lobe::AnyLobe& lobe) {
  Facts facts{
      full_spec(lobe), lobe.source(), lobe.is_mirror(), 0, 0, {}, zonal_coefficients(lobe, kPrintedDegree)};
  if (facts.mirror) return facts;
  facts.integral = lobe.integral();
  facts.width = lobe.width() * kDegrees;
  for (std::size_t i = 0; i < kShares.size(); ++i)
    facts.holding[i] = lobe::energy_cone_angle(lobe, kShares[i]) * kDegrees;
  return facts;
}

void print_table(const std::vector<Facts>& all) {
  fmt::print("{:>2}  {:<26} {:>11} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8}\n", "", "lobe", "integral sr",
             "width °", "50 % °", "90 % °", "99 % °", "λ1", "λ2");
  int number = 0;
  for (const Facts& f : all) {
    const std::string integral = f.mirror ? "mirror" : fmt::format("{:.5g}", f.integral);
    fmt::print("{:>2}  {:<26} {:>11} {:>9.4g} {:>9.4g} {:>9.4g} {:>9.4g} {:>8.5f} {:>8.5f}\n", ++number,
               printable(f.spec), integral, f.width, f.holding[0], f.holding[1], f.holding[2], f.zonal[1],
               f.zonal[2]);
  }
}

void print_json(const std::vector<Facts>& all) {
  ordered_json list = ordered_json::array();
  for (const Facts& f : all) {
    list.push_back({{"lobe", f.spec},
                    {"source", f.source},
                    {"mirror", f.mirror},
                    {"integral", f.mirror ? ordered_json(nullptr) : ordered_json(f.integral)},
                    {"width_degrees", f.width},
                    {"degrees_holding_50_percent", f.holding[0]},
                    {"degrees_holding_90_percent", f.holding[1]},
                    {"degrees_holding_99_percent", f.holding[2]},
                    {"zonal", f.zonal}});
  }
  print_json_text(list);
}

void PlotLobe::run() {
  const std::vector<lobe::AnyLobe> lobes = make_lobes(specs.empty() ? lobe::lobe_names() : specs);
  plot.axis = axis == "log" ? WeightAxis::logarithmic : WeightAxis::linear;
  if (!out.empty()) {
    check_output(out, parse_map_shape("latlong"));
    const Image picture = draw_lobes(lobes, plot);
    const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
    io::write(out, {&part, 1});
  }
  std::vector<Facts> all;
  for (const lobe::AnyLobe& lobe : lobes) all.push_back(facts_of(lobe));
  json ? print_json(all) : print_table(all);
}

}  // namespace

void add_plot_lobe(Command plot) {
  auto request = std::make_shared<PlotLobe>();
  Command command = plot.add_command("lobe", "Weight against angle: curves, integral, width, energy cones");
  command.add_option("OUT", request->out,
                     "Picture to write; without it, only the numbers; - is standard output, see --format");
  command
      .add_option("--lobe", request->specs,
                  "NAME[,PARAMETER=VALUE], or table,file=PATH; again for more curves. Default: all, see "
                  "`welkin list lobes`")
      .several_words(false);
  command.add_option("--axis", request->axis, "Vertical axis: linear, log (six decades)")
      .one_of({"linear", "log"})
      .show_default();
  command.add_option("--angle", request->plot.degrees, "Degrees at the right edge")
      .within(1, 180)
      .show_default();
  command.add_option("--size", request->plot.width, "Width of the picture").within(200, 4096).show_default();
  command.add_flag("--json", request->json, "Machine-readable, on standard output");
  add_format(command, request->format);
  command.callback([request] {
    request->out = output_path(request->out, request->format);
    request->run();
  });
}

}  // namespace welkin::cli
