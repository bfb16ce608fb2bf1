#include <fmt/core.h>

#include "command.h"
#include "welkin/sphere/convention.h"
#include "welkin/synth/render_synth.h"

namespace welkin::cli {
namespace {

struct Synth {
  std::string name, out, to = "latlong", size, convention, format;
  WriteFlags write;
  synth::SynthOptions options;
  int samples = 4;

  void run() const;
};

void Synth::run() const {
  WriteMapOptions write_options = write.parse();
  write_options.convention = convention;
  synth::Radiance radiance;
  try {
    radiance = synth::make(name, options);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  if (!convention.empty()) parse_option("--convention", [&] { return convention_from_name(convention); });
  MapShape shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
  fit_to_convention(out, convention, shape);
  check_output(out, shape, write);
  const std::string text = !size.empty() ? size : shape.parameterization.charts() == 1 ? "1024" : "256";
  const ChartSize chart = parse_chart_size("--size", text, shape.parameterization);
  check_output_size(chart, shape, write);
  shape = for_chart_size(shape, chart);
  RenderOptions render_options;
  render_options.samples = samples;
  if (!convention.empty()) {
    render_options.orientation = orientation_for(convention_from_name(convention), shape.parameterization);
  }
  render_options.monitor = progress_monitor("synth");
  const Map map = render(radiance, shape.parameterization, chart.width, chart.height, render_options);
  end_progress();
  report_losses(out, write_map(out, map, shape.layout, write_options));
}

}  // namespace

void add_synth(Command app) {
  auto synth = std::make_shared<Synth>();
  Command command = app.add_command("synth", "Make a built-in map: a test card, a studio, a sky…");
  std::string names;
  for (const std::string& name : synth::names()) names += (names.empty() ? "" : ", ") + name;
  command.add_option("NAME", synth->name, names + " (`welkin list maps` describes them)").required();
  command
      .add_option("OUT", synth->out,
                  "Map to write; its extension names the format; - is standard output, see --format")
      .required();
  command.add_option("--to", synth->to, "Parameterization: NAME[:LAYOUT][,PARAMETER=VALUE]").show_default();
  command.add_option("--size", synth->size,
                     "Size of a chart in texels: N across, or WxH. Default: 1024, faces 256");
  command.add_option("--convention,--to-convention", synth->convention,
                     "World of the output: three.js, blender…");
  command.add_option("--samples", synth->samples, "Samples per texel, squared").within(1, 64).show_default();
  auto& o = synth->options;
  command.add_option("--seed", o.seed, "lamps: seed of the random numbers").finite(0).show_default();
  command.add_option(
      "--frequency", o.frequency,
      "checker: cells around; lines: meridians; zoneplate: cycles per radian at −Z; lamps: how many");
  command.add_option("--angle", o.angle,
                     "Degrees. sun, sky: the sun's diameter; lines: their width; lamps: their diameter");
  command.add_option("--intensity", o.intensity, "sun: its radiance; lamps: their median; others: a factor");
  command.add_option("--elevation", o.elevation, "sun, sky: elevation of the sun, degrees").show_default();
  command.add_option("--azimuth", o.azimuth, "sun, sky: azimuth of the sun, degrees from +Z toward +X")
      .show_default();
  command.add_option("--background", o.background, "sun, lamps: radiance around them").show_default();
  command.add_option("--turbidity", o.turbidity, "sky: 2 (clear) to 10 (haze)").show_default();
  command.add_option("--albedo", o.albedo, "sky: reflectance of the ground").show_default();
  synth->write.add(command);
  add_format(command, synth->format);
  command.callback([synth] {
    synth->out = output_path(synth->out, synth->format);
    synth->run();
  });
}

}  // namespace welkin::cli
