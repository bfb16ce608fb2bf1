#include <fmt/core.h>

#include <cstdio>

#include "plot.h"
#include "welkin/io/capabilities.h"
#include "welkin/plot/draw_cone_sheet.h"

namespace welkin::cli {
namespace {

struct PlotCones {
  std::string in, out, format;
  std::vector<std::string> filters;
  ReadFlags read;
  ConeSheet sheet;

  void run() {
    read.parse();
    for (const std::string& name : filters) {
      sheet.filters.push_back(parse_option("--filter", [&] { return cone_filter_from_name(name); }));
    }
    const auto camera = parse_option("--to", [&] { return sphere::AnyParameterization::make(sheet.camera); });
    if (camera.charts() != 1)
      throw UsageError("--to: " + sheet.camera + " has several charts; a tile shows one");
    check_output(out, parse_map_shape("latlong"));
    const LoadedMap loaded = read.read(in);
    if (sheet.filters.empty()) sheet.filters = usable_cone_filters(loaded.map.parameterization);
    const Image picture = draw_cone_sheet(loaded.map, sheet);
    const io::WritePart part{"", picture.view(), {"R", "G", "B"}};
    io::WriteOptions options;
    if (io::capabilities_for(out).holds(io::PixelType::uint8)) options.type = io::PixelType::uint8;
    io::write(out, {&part, 1}, options);
    // Not among the picture's bytes.
    FILE* lines = format.empty() ? stdout : stderr;
    fmt::print(lines, "{:>2} {}\n", 0, "256 rays");
    for (std::size_t i = 0; i < sheet.filters.size(); ++i) {
      fmt::print(lines, "{:>2} {}\n", i + 1, name_of(sheet.filters[i]));
    }
  }
};

}  // namespace

void add_plot_cones(Command plot) {
  auto request = std::make_shared<PlotCones>();
  Command command = plot.add_command(
      "cones", "A map in a mirror ball by every filter of cones, beside the mean of 256 rays a pixel");
  command.add_option("IN", request->in, "Map to read; - is standard input").required();
  command.add_option("OUT", request->out, "Picture to write; - is standard output, see --format").required();
  command
      .add_option("--filter", request->filters,
                  "nearest, bilinear, trilinear, differential, mirrored, box, sat, probes, ewa, hybrid, "
                  "gaussian; again "
                  "for more tiles. Default: all that the map can be looked up with")
      .several_words(false);
  command.add_option("--to", request->sheet.camera, "Parameterization that tiles are pictures of")
      .show_default();
  command.add_option("--size", request->sheet.size, "Pixels along a tile's longer side")
      .within(16, 2048)
      .show_default();
  command.add_option("--exposure", request->sheet.exposure, "Brighten the picture by this many stops")
      .finite();
  request->read.add(command);
  add_format(command, request->format);
  command.callback([request] {
    request->out = output_path(request->out, request->format);
    request->in = input_path(request->in);
    request->run();
  });
}

}  // namespace welkin::cli
