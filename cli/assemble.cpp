#include "welkin/assemble/assemble.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "assemble_pieces.h"
#include "command.h"
#include "welkin/assemble/exposure.h"
#include "welkin/assemble/ground.h"
#include "welkin/base/number_text.h"
#include "welkin/filter/resample.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {
namespace {

/// Of overlaps that are told: less of the sphere is a seam.
constexpr double kLeastOverlap = 0.002;

struct Assemble {
  std::string out, to = "latlong", size, list, background, ground, mix = "finer", convention, format;
  std::vector<std::string> panels, balls;
  bool alpha = false, match = false;
  WriteFlags write;

  void run() const;

 private:
  std::vector<PieceRequest> requests() const;
  /// R G B, where the background is a colour.
  std::optional<std::array<float, 3>> colour() const;
};

std::optional<std::array<float, 3>> Assemble::colour() const {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= background.size();) {
    const std::size_t comma = std::min(background.find(',', from), background.size());
    const std::optional<double> value = parse_number(background.substr(from, comma - from));
    if (!value) return std::nullopt;
    numbers.push_back(*value);
    from = comma + 1;
  }
  std::array<float, 3> colour{};
  bool is_colour = numbers.size() == colour.size();
  for (std::size_t c = 0; c < colour.size() && is_colour; ++c) {
    colour[c] = static_cast<float>(numbers[c]);
    is_colour = std::isfinite(colour[c]);
  }
  if (!is_colour)
    throw UsageError("--background: '" + printable(background) + "' is not R,G,B, three numbers");
  return colour;
}

std::vector<PieceRequest> Assemble::requests() const {
  std::vector<PieceRequest> all;
  if (!list.empty()) all = read_piece_list(list);
  for (const std::string& text : panels) all.push_back(parse_piece("--panel", text));
  for (const std::string& text : balls) {
    all.push_back(parse_piece("--ball", text));
    all.back().kind = PieceRequest::Kind::ball;
  }
  if (all.empty()) throw UsageError("give at least one picture, with --panel, --ball or --list");
  if (!background.empty() && !colour()) {
    PieceRequest backdrop = parse_piece("--background", background);
    backdrop.kind = PieceRequest::Kind::backdrop;
    all.push_back(std::move(backdrop));
  }
  for (const PieceRequest& each : all) check_piece(each);
  return all;
}

/// As many texels per steradian as the finest of the pieces.
ChartSize size_for(const std::vector<Piece>& pieces, const sphere::AnyParameterization& parameterization) {
  ChartSize size;
  for (const Piece& piece : pieces) {
    const ChartSize of_piece = default_chart_size(piece.map, parameterization);
    if (piece.layer != kBackdrop && of_piece.width > size.width) size = of_piece;
  }
  return size;
}

void print_report(const std::vector<Piece>& pieces, const Assembly& made, const std::string& behind) {
  std::size_t widest = std::string_view("together").size();
  for (const Piece& piece : pieces) widest = std::max(widest, printable(piece.name).size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k].layer != kBackdrop)
      fmt::print("{:<{}} {:6.2f} %{}\n", printable(pieces[k].name), widest, 100 * made.shown_by[k],
                 std::fabs(pieces[k].gain - 1) > 1e-6 ? fmt::format(", times {:.4f}", pieces[k].gain) : "");
  }
  fmt::print("{:<{}} {:6.2f} %; {:.2f} % {}\n", "together", widest, 100 * made.shown, 100 * (1 - made.shown),
             behind);
}

void print_overlaps(const std::vector<Piece>& pieces, const std::vector<Overlap>& overlaps) {
  for (const Overlap& each : overlaps) {
    if (each.share < kLeastOverlap) continue;
    fmt::print(
        "{} and {}: {:.1f} % of the sphere in both, differ by {:.2f} % (rel. RMSE), brightness by {:+.2f} "
        "%\n",
        printable(pieces[each.first].name), printable(pieces[each.second].name), 100 * each.share,
        100 * each.error, 100 * (each.ratio - 1));
  }
}

void Assemble::run() const {
  WriteMapOptions write_options = write.parse();
  write_options.convention = convention;
  if (!convention.empty()) parse_option("--convention", [&] { return convention_from_name(convention); });
  MapShape shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
  fit_to_convention(out, convention, shape);
  check_output(out, shape, write);
  if (!size.empty()) parse_chart_size("--size", size, shape.parameterization);
  const std::vector<PieceRequest> asked = requests();
  if (alpha && colour()) throw UsageError("--alpha: says what isn't covered, and --background covers it");

  std::vector<Piece> pieces;
  std::vector<std::string> notes;
  for (const PieceRequest& each : asked) {
    ReadPiece read = read_piece(each);
    pieces.push_back(std::move(read.piece));
    if (!read.note.empty()) notes.push_back(std::move(read.note));
  }
  const ChartSize chart = size.empty() ? size_for(pieces, shape.parameterization)
                                       : parse_chart_size("--size", size, shape.parameterization);
  check_output_size(chart, shape, write);
  shape = for_chart_size(shape, chart);
  MapFrame frame(shape.parameterization, chart);
  if (!convention.empty())
    frame.orientation = orientation_for(convention_from_name(convention), shape.parameterization);
  if (match) match_exposures(pieces);
  const std::vector<Overlap> overlaps = compare_overlaps(pieces);
  if (match && overlaps.empty()) print_warning(out, "no pictures overlap, and all keep their brightness");
  if (!ground.empty()) add_ground(pieces, ground == "mirror" ? Ground::mirrored : Ground::stretched);
  AssembleOptions options;
  options.fill = colour();
  options.alpha = alpha;
  options.by_fineness = mix == "finer";
  options.monitor = progress_monitor("assemble");
  Assembly made = assemble(pieces, frame, options);
  end_progress();
  fit_channels_to(made.map, out, write_options);
  report_losses(out, write_map(out, made.map, shape.layout, write_options));
  if (!format.empty()) return;
  for (const std::string& note : notes) fmt::print("{}\n", note);
  print_report(pieces, made, background.empty() ? "no picture shows" : "are of the background");
  print_overlaps(pieces, overlaps);
}

}  // namespace

void add_assemble(Command app) {
  auto assemble = std::make_shared<Assemble>();
  Command command = app.add_command("assemble", "Make a world of pictures that each show a part of it");
  command
      .add_option("OUT", assemble->out,
                  "Map to write; its extension names the format; - is standard output, see --format")
      .required();
  command.add_option("--panel", assemble->panels,
                     "A picture: FILE,fov=DEGREES[,KEY=VALUE]…, its horizontal field of view; yaw, pitch and "
                     "roll say where it looks, feather over how many degrees its edges fade, layer which "
                     "pictures it lies over, exposure by how many stops it is brightened; "
                     "as=fisheye-equidistant,fov=180 that it isn't flat");
  command.add_option("--ball", assemble->balls,
                     "A photograph of a mirror ball: FILE[,KEY=VALUE]…; yaw, pitch and roll say where the "
                     "camera looked, distance how many ball radii it was from the ball's centre (or fov, the "
                     "photograph's horizontal field of view), x, y and radius where the ball is, in texels "
                     "(without them it touches the edges), camera the half angle, degrees, that the camera "
                     "hides; also rim, feather, layer, exposure");
  command.add_option("--list", assemble->list,
                     "JSON file that lists pictures: {\"panels\": [{\"file\": …, \"fov\": …, \"yaw\": …}, "
                     "…], \"balls\": […]}");
  command.add_flag("--match", assemble->match,
                   "Brighten or darken pictures so that they agree where they overlap; the first stays as it "
                   "is");
  command.add_option("--background", assemble->background,
                     "What is behind: R,G,B, or a map: FILE[,KEY=VALUE]… Default: black");
  command
      .add_option(
          "--ground", assemble->ground,
          "What is made of a sky below its horizon: mirror (the sky upside down), stretch (the row of "
          "texels on the horizon). Default: the background")
      .one_of({"mirror", "stretch"});
  command.add_flag("--alpha", assemble->alpha, "Write A, how much is covered");
  command
      .add_option(
          "--mix", assemble->mix,
          "Which of pictures that overlap counts more: finer (the one with more texels per degree), even")
      .one_of({"finer", "even"})
      .show_default();
  command.add_option("--to", assemble->to, "Parameterization: NAME[:LAYOUT][,PARAMETER=VALUE]")
      .show_default();
  command.add_option("--size", assemble->size,
                     "Size of a chart in texels: N across, or WxH. Default: as fine as the finest picture");
  command.add_option("--convention,--to-convention", assemble->convention,
                     "World of the output: three.js, blender…");
  assemble->write.add(command);
  add_format(command, assemble->format);
  command.callback([assemble] {
    assemble->out = output_path(assemble->out, assemble->format);
    assemble->run();
  });
}

}  // namespace welkin::cli
