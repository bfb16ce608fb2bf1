#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "json_text.h"
#include "plot.h"
#include "welkin/plot/draw_density.h"
#include "welkin/plot/draw_distortion.h"
#include "welkin/plot/mip_sheet.h"
#include "welkin/prefilter/paraboloid_convolution.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

struct PlotDensity {
  std::string out, of, format;
  int size = 256;
  bool json = false;

  void run() const;
};

void PlotDensity::run() const {
  std::vector<sphere::AnyParameterization> list;
  if (of.empty()) {
    if (!out.empty()) throw UsageError("plot density: name the parameterization to draw with --of");
    for (const std::string& name : sphere::parameterization_names())
      list.push_back(sphere::AnyParameterization::make(name));
  } else {
    list.push_back(parse_option("--of", [&] { return parse_map_shape(of).parameterization; }));
  }
  if (!out.empty()) check_output(out, parse_map_shape("latlong"));
  ordered_json all = ordered_json::array();
  for (const auto& p : list) {
    const DensityReport report = density_of(p, size);
    if (!out.empty()) {
      const Image picture = draw_density(p, report);
      const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
      io::write(out, {&part, 1});
    }
    if (!json && all.empty()) {
      fmt::print("{:<24} {:>10} {:>10} {:>10} {:>12}\n", "solid angle / average", "min", "max", "ratio",
                 "limit ratio");
    }
    all.push_back(
        {{"name", p.spec()},
         {"charts", p.charts()},
         {"width", report.width},
         {"height", report.height},
         {"average", report.average},
         {"min", report.minimum},
         {"max", report.maximum},
         {"ratio", report.ratio},
         {"limit_ratio", report.unbounded ? ordered_json(nullptr) : ordered_json(report.limit_ratio)}});
    if (!json) {
      fmt::print("{:<24} {:>10.4f} {:>10.4f} {:>10.4g} {:>12}\n", p.spec(), report.minimum, report.maximum,
                 report.ratio, report.unbounded ? "unbounded" : fmt::format("{:.4f}", report.limit_ratio));
    }
  }
  if (json) print_json_text(of.empty() ? all : all[0]);
}

struct PlotMips {
  std::string in, out, format;
  ReadFlags read;
  double exposure = 0;

  void run() const {
    read.parse();
    check_output(out, parse_map_shape("latlong"));
    const LoadedMap loaded = read.read(in);
    const Image sheet = draw_mip_sheet(loaded.map, exposure);
    const io::WritePart part{"", sheet.view(), {"R", "G", "B"}};
    io::write(out, {&part, 1});
  }
};

struct PlotDistortion {
  std::string out, format;
  int width = 720;

  void run() const {
    if (!out.empty()) {
      check_output(out, parse_map_shape("latlong"));
      const Image picture = draw_circle_distortion(width);
      const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
      io::write(out, {&part, 1});
    }
    fmt::print(
        "distortion %, radius r of the circle, distance d of its centre from the face's; the rim is 1\n");
    fmt::print("{:>5}", "r");
    for (int i = 0; i <= 4; ++i) fmt::print(" {:>8}", fmt::format("d {:g}", i / 4.0));
    fmt::print("\n");
    for (int k = 1; k <= 5; ++k) {
      fmt::print("{:>5g}", k / 10.0);
      for (int i = 0; i <= 4; ++i) fmt::print(" {:>8.2f}", 100 * circle_distortion(k / 10.0, i / 4.0));
      fmt::print("\n");
    }
  }
};

void add_plot_distortion(Command plot) {
  auto request = std::make_shared<PlotDistortion>();
  Command command = plot.add_command(
      "distortion", "How far circles on a paraboloid map are from circles about the same point");
  command.add_option("OUT", request->out,
                     "Picture to write; without it, only the numbers; - is standard output, see --format");
  command.add_option("--size", request->width, "Width of the picture").within(200, 4096).show_default();
  add_format(command, request->format);
  command.callback([request] {
    request->out = output_path(request->out, request->format);
    request->run();
  });
}

}  // namespace

void add_plot(Command app) {
  Command plot = app.add_command(
      "plot",
      "Plot texel densities, lobes, reflectances, a map's pyramid, its look-ups or circles on paraboloids");
  plot.require_command();

  auto density = std::make_shared<PlotDensity>();
  Command command = plot.add_command(
      "density", "Solid angle of a texel over the average: picture, minimum, maximum, ratio");
  command.add_option("OUT", density->out,
                     "Picture to write; without it, only the numbers; - is standard output, see --format");
  command.add_option("--of", density->of, "Parameterization. Default: the numbers of all");
  command.add_option("--size", density->size, "Texels across a chart").within(2, 16384).show_default();
  command.add_flag("--json", density->json, "Machine-readable, on standard output");
  add_format(command, density->format);
  command.callback([density] {
    density->out = output_path(density->out, density->format);
    density->run();
  });

  auto mips = std::make_shared<PlotMips>();
  command = plot.add_command(
      "mips", "A map's pyramid twice: plain 2×2 averages above, weighted by solid angle below");
  command.add_option("IN", mips->in, "Map to read; - is standard input").required();
  command.add_option("OUT", mips->out, "Picture to write; - is standard output, see --format").required();
  command.add_option("--exposure", mips->exposure, "Brighten the picture by this many stops").finite();
  mips->read.add(command);
  add_format(command, mips->format);
  command.callback([mips] {
    mips->out = output_path(mips->out, mips->format);
    mips->in = input_path(mips->in);
    mips->run();
  });

  add_plot_cones(plot);
  add_plot_lobe(plot);
  add_plot_fresnel(plot);
  add_plot_distortion(plot);
}

}  // namespace welkin::cli
