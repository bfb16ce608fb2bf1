#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "json_text.h"
#include "plot.h"
#include "welkin/math/scalar.h"
#include "welkin/plot/draw_fresnel.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

struct PlotFresnel {
  std::string out, format;
  std::vector<std::string> specs{"1.5", "5", "200"};
  int width = 720;
  bool json = false;

  void run() const;
};

brdf::Boundary parse_boundary(const std::string& spec) {
  const std::vector<double> numbers = parse_numbers("--eta", spec);
  if (numbers.size() > 2) throw UsageError("--eta: '" + spec + "' is not N or N,K");
  const brdf::Boundary boundary{numbers[0], numbers.size() == 2 ? numbers[1] : 0};
  parse_option("--eta", [&] { brdf::check(boundary); });
  return boundary;
}

void PlotFresnel::run() const {
  std::vector<brdf::Boundary> boundaries;
  for (const std::string& spec : specs) boundaries.push_back(parse_boundary(spec));
  if (!out.empty()) {
    check_output(out, parse_map_shape("latlong"));
    const Image picture = draw_fresnel(boundaries, width);
    const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
    io::write(out, {&part, 1});
  }
  const auto at = [](const brdf::Boundary& b, double degrees) {
    return brdf::fresnel(std::cos(degrees * kPi / 180), b);
  };
  ordered_json list = ordered_json::array();
  if (!json)
    fmt::print("{:>2}  {:>10} {:>10} {:>9} {:>9} {:>9} {:>9}\n", "", "n", "k", "0°", "45°", "60°", "80°");
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const brdf::Boundary& b = boundaries[i];
    if (!json) {
      fmt::print("{:>2}  {:>10g} {:>10g} {:>9.5f} {:>9.5f} {:>9.5f} {:>9.5f}\n", i + 1, b.n, b.k, at(b, 0),
                 at(b, 45), at(b, 60), at(b, 80));
    }
    list.push_back({{"n", b.n},
                    {"k", b.k},
                    {"f0", at(b, 0)},
                    {"degrees_45", at(b, 45)},
                    {"degrees_60", at(b, 60)},
                    {"degrees_80", at(b, 80)}});
  }
  if (json) print_json_text(list);
}

}  // namespace

void add_plot_fresnel(Command plot) {
  auto request = std::make_shared<PlotFresnel>();
  Command command =
      plot.add_command("fresnel", "Reflectance of glass and metals against the angle of incidence");
  command.add_option("OUT", request->out,
                     "Picture to write; without it, only the numbers; - is standard output, see --format");
  command
      .add_option("--eta,--ior", request->specs,
                  "Index behind over index in front, N, or of a metal N,K; again for more curves. Default: "
                  "1.5, 5 and 200")
      .several_words(false);
  command.add_option("--size", request->width, "Width of the picture").within(200, 4096).show_default();
  command.add_flag("--json", request->json, "Machine-readable, on standard output");
  add_format(command, request->format);
  command.callback([request] {
    request->out = output_path(request->out, request->format);
    request->run();
  });
}

}  // namespace welkin::cli
