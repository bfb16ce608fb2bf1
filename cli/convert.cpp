#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>

#include "command.h"
#include "progress.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/map/convention.h"
#include "welkin/map/resample.h"

namespace welkin::cli {
namespace {

struct Convert {
  std::string in, out, to, size, filter = "auto", rotation, convention, fill;
  ReadFlags read;
  WriteFlags write;
  double exposure = 0, scale = 1;
  bool allow_ringing = false, sanitize = false;

  void run() const;
};

void Convert::run() const {
  // Everything that can be wrong with the request, before any file is touched.
  read.parse();
  const WriteMapOptions write_options = write.parse();
  ResampleOptions options;
  options.filter = parse_option("--filter", [&] { return filter_from_name(filter); });
  options.allow_ringing = allow_ringing;
  if (!rotation.empty()) options.rotation = parse_rotation("--rotate", rotation);
  if (!fill.empty()) {
    for (double value : parse_numbers("--fill", fill)) options.fill.push_back(static_cast<float>(value));
  }
  std::optional<MapShape> shape;
  if (!to.empty()) shape = parse_option("--to", [&] { return parse_map_shape(to); });
  if (!convention.empty()) parse_option("--to-convention", [&] { return convention_from_name(convention); });
  if (shape) check_output(out, *shape, write);
  if (shape && !size.empty()) parse_chart_size("--size", size, shape->parameterization);

  LoadedMap source = read.read(in);
  if (!shape) {
    // By its name: the turns that the input's faces were given are undone by reading it.
    shape = parse_map_shape(source.info.shape->text());
    check_output(out, *shape, write);
  }
  if (options.fill.size() > static_cast<std::size_t>(source.map.channels())) {
    throw UsageError(fmt::format("--fill: {} values, but {} has {} channels", options.fill.size(), in,
                                 source.map.channels()));
  }
  // A change of format, layout or turn alone keeps the size, odd or not.
  ChartSize chart = source.info.chart;
  if (!size.empty()) {
    chart = parse_chart_size("--size", size, shape->parameterization);
  } else if (!(for_chart_size(*shape, chart).parameterization == source.map.parameterization)) {
    chart = default_chart_size(source.map, shape->parameterization);
  }
  if (sanitize) {
    const std::uint64_t replaced = welkin::sanitize(source.map);
    tell(fmt::format("welkin: {}: {} texels with NaN or infinite values mended\n", in, replaced));
    fill_borders(source.map);
  }
  check_output_size(chart, *shape, write);
  shape = for_chart_size(*shape, chart);
  Map target(shape->parameterization, chart.width, chart.height, source.map.channels());
  target.channel_names = source.map.channel_names;
  target.orientation = convention.empty()
                           ? Matrix3{}
                           : orientation_for(convention_from_name(convention), shape->parameterization);
  options.monitor = progress_monitor("convert");
  resample(source.map, target, options);
  end_progress();
  const double factor = scale * std::exp2(exposure);
  source.map.level = Level();  // the writer may need the room for a second copy of the result
  if (factor != 1) welkin::scale(target, static_cast<float>(factor));
  if (write.border > 0) fill_borders(target);
  report_losses(out, write_map(out, target, shape->layout, write_options));
}

}  // namespace

void add_convert(CLI::App& app) {
  auto convert = std::make_shared<Convert>();
  CLI::App* command =
      app.add_subcommand("convert", "Convert a map between parameterizations, layouts and file formats");
  command->add_option("IN", convert->in, "Map to read; %s in the name stands for a face's name (px, nx…)")
      ->required();
  command->add_option("OUT", convert->out, "Map to write; its extension names the format")->required();
  command->add_option(
      "--to", convert->to,
      "Parameterization of the output: NAME[:LAYOUT][,PARAMETER=VALUE]. Default: the input's");
  command->add_option(
      "--size", convert->size,
      "Size of a chart (a face) in texels: N across, or WxH. Default: as many texels as the input has");
  command->add_option("--filter", convert->filter, "auto (antialiased), nearest, bilinear, bicubic, lanczos")
      ->capture_default_str();
  command->add_option(
      "--rotate", convert->rotation,
      "Turn the world: yaw,pitch,roll in degrees, a quaternion w,x,y,z, or nine matrix entries");
  command->add_option("--convention,--to-convention", convert->convention,
                      "World of the output: three.js, blender… (`welkin list conventions`)");
  command->add_option("--exposure", convert->exposure, "Brighten by this many stops")->check(finite_number());
  command->add_option("--scale", convert->scale, "Multiply radiance")->check(finite_number());
  command->add_option(
      "--fill", convert->fill,
      "Value, one per channel, where the input shows nothing or the output has no place. Default: 0");
  command->add_flag("--allow-ringing", convert->allow_ringing,
                    "Let the negative weights of bicubic and lanczos show beside bright spots");
  command->add_flag("--sanitize", convert->sanitize,
                    "Replace NaN and infinite values by their neighbours' mean");
  convert->read.add(*command);
  convert->write.add(*command);
  command->callback([convert] { convert->run(); });
}

}  // namespace welkin::cli
