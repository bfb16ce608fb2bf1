#include "assemble_pieces.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command.h"
#include "welkin/assemble/ball_photograph.h"
#include "welkin/base/number_text.h"
#include "welkin/math/angles.h"

namespace welkin::cli {
namespace {

using nlohmann::json;

/// What the settings of a kind may be, besides the parameters of a panel's shape.
std::vector<std::string> known_settings(PieceRequest::Kind kind) {
  std::vector<std::string> known{"yaw", "pitch", "roll", "exposure", "colour"};
  const auto add = [&](std::initializer_list<const char*> more) {
    known.insert(known.end(), more.begin(), more.end());
  };
  if (kind != PieceRequest::Kind::backdrop) add({"fov", "feather", "layer", "x", "y", "radius"});
  if (kind == PieceRequest::Kind::ball) add({"distance", "camera", "rim"});
  if (kind != PieceRequest::Kind::ball) add({"as"});
  return known;
}

/// The settings of one picture, by name.
class Settings {
 public:
  explicit Settings(const PieceRequest& request) : request_(request) {}

  std::optional<std::string> text(const std::string& key) const {
    const auto at = request_.settings.find(key);
    if (at == request_.settings.end()) return std::nullopt;
    return at->second;
  }
  std::optional<double> number(const std::string& key) const {
    const std::optional<std::string> value = text(key);
    if (!value) return std::nullopt;
    const std::optional<double> parsed = parse_number(*value);
    if (!parsed || !std::isfinite(*parsed))
      refuse(fmt::format("{}: '{}' is not a number", key, printable(*value)));
    return parsed;
  }
  double number_or(const std::string& key, double otherwise) const { return number(key).value_or(otherwise); }

  [[noreturn]] void refuse(const std::string& cause) const {
    throw UsageError(printable(request_.file) + ": " + cause);
  }

 private:
  const PieceRequest& request_;
};

bool is_flat(const PieceRequest& request) {
  return request.kind == PieceRequest::Kind::panel && request.settings.contains("fov") &&
         !request.settings.contains("as");
}

/// The shape of a picture that isn't flat: `as`, and the settings that are its parameters. None: as the file
/// declares.
std::optional<std::string> shape_of(const PieceRequest& request) {
  const auto as = request.settings.find("as");
  if (as == request.settings.end() || as->second == "auto") return std::nullopt;
  std::string shape = as->second;
  const MapShape plain = parse_map_shape(shape);
  for (const Parameter& each : plain.parameterization.parameters()) {
    const auto given = request.settings.find(each.name);
    if (given != request.settings.end()) shape += "," + each.name + "=" + given->second;
  }
  parse_map_shape(shape);
  return shape;
}

/// Whether a picture of it holds a disc, which a photograph may hold anywhere; not the frame of a lens, whose
/// aspect is that of the picture.
bool has_disc(const sphere::AnyParameterization& p) {
  for (const Parameter& each : p.parameters()) {
    if (each.name == "aspect") return false;
  }
  return p.traits().projection == sphere::Projection::disc && !p.full_charts();
}

PanelOptions panel_options(const PieceRequest& request) {
  const Settings settings(request);
  PanelOptions options;
  options.look = {settings.number_or("yaw", 0), settings.number_or("pitch", 0),
                  settings.number_or("roll", 0)};
  options.feather = settings.number_or("feather", 0);
  if (!(options.feather >= 0 && options.feather <= 90))
    settings.refuse("feather: is 0 to 90 degrees inside the picture's edges");
  const double layer = settings.number_or("layer", 0);
  if (layer != std::floor(layer) || std::fabs(layer) > 1000)
    settings.refuse("layer: is a whole number of -1000 to 1000");
  options.layer = request.kind == PieceRequest::Kind::backdrop ? kBackdrop : static_cast<int>(layer);
  const double exposure = settings.number_or("exposure", 0);
  if (std::fabs(exposure) > 100) settings.refuse("exposure: is -100 to 100 stops");
  options.gain = std::exp2(exposure);
  return options;
}

std::optional<PictureCircle> circle_of(const PieceRequest& request) {
  const Settings settings(request);
  const auto x = settings.number("x"), y = settings.number("y"), radius = settings.number("radius");
  if (!x && !y && !radius) return std::nullopt;
  if (!x || !y || !radius)
    settings.refuse("x, y and radius say together where the circle is: give all three");
  return PictureCircle{*x, *y, *radius};
}

BallPhotographOptions ball_options(const PieceRequest& request) {
  const Settings settings(request);
  const PanelOptions common = panel_options(request);
  BallPhotographOptions options;
  options.look = common.look;
  options.layer = common.layer;
  options.gain = common.gain;
  options.feather = settings.number_or("feather", options.feather);
  options.distance = settings.number_or("distance", options.distance);
  options.fov = settings.number("fov");
  options.camera = settings.number_or("camera", 0);
  options.rim = settings.number_or("rim", options.rim);
  if (options.fov && settings.text("distance"))
    settings.refuse("distance: follows from fov; give one of them");
  options.circle = circle_of(request);
  return options;
}

io::Colour colour_of(const PieceRequest& request) {
  const Settings settings(request);
  const std::string name = settings.text("colour").value_or("auto");
  if (name == "auto") return io::Colour::automatic;
  if (name == "linear") return io::Colour::linear;
  if (name == "srgb") return io::Colour::srgb;
  settings.refuse("colour: is auto, linear or srgb");
}

}  // namespace

PieceRequest parse_piece(std::string_view option, const std::string& text) {
  PieceRequest request;
  request.file = text;
  // From the end, as names of files may have commas too.
  while (true) {
    const std::size_t comma = request.file.rfind(',');
    if (comma == std::string::npos) break;
    const std::string last = request.file.substr(comma + 1);
    const std::size_t equals = last.find('=');
    if (equals == std::string::npos || equals == 0) break;
    const std::string key = last.substr(0, equals);
    if (!request.settings.emplace(key, last.substr(equals + 1)).second)
      throw UsageError(fmt::format("{}: '{}' is given twice", option, printable(key)));
    request.file.resize(comma);
  }
  if (request.file.empty())
    throw UsageError(fmt::format("{}: '{}' names no file: write FILE,KEY=VALUE…", option, printable(text)));
  return request;
}

std::vector<PieceRequest> read_piece_list(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw Error(ErrorKind::not_found, path, "is a directory");
  std::ifstream in(path);
  if (!in) throw Error(ErrorKind::not_found, path, "cannot be read");
  const auto damaged = [&](const std::string& cause) { return Error(ErrorKind::damaged, path, cause); };
  const json all = json::parse(in, nullptr, false);
  if (!all.is_object()) throw damaged("is not a JSON object with lists of \"panels\" and \"balls\"");
  std::vector<PieceRequest> requests;
  for (const auto& [kind, list] : all.items()) {
    if (kind != "panels" && kind != "balls")
      throw damaged(unknown_name("list", printable(kind), std::vector<std::string>{"panels", "balls"}));
    if (!list.is_array()) throw damaged("\"" + kind + "\" is not a list");
    for (const json& each : list) {
      if (!each.is_object() || !each.contains("file") || !each["file"].is_string())
        throw damaged(fmt::format("entry {} of \"{}\" has no \"file\"", requests.size() + 1, kind));
      PieceRequest request;
      if (kind == "balls") request.kind = PieceRequest::Kind::ball;
      for (const auto& [key, value] : each.items()) {
        if (key == "file") continue;
        if (value.is_number()) {
          request.settings[key] = number_text(value.get<double>());
        } else if (value.is_string()) {
          request.settings[key] = value.get<std::string>();
        } else {
          throw damaged(fmt::format("\"{}\" of entry {} is neither a number nor a text", printable(key),
                                    requests.size() + 1));
        }
      }
      request.file = (std::filesystem::path(path).parent_path() / each["file"].get<std::string>()).string();
      requests.push_back(std::move(request));
    }
  }
  return requests;
}

void check_piece(const PieceRequest& request) {
  const Settings settings(request);
  std::vector<std::string> known = known_settings(request.kind);
  if (const auto as = settings.text("as"); as && *as != "auto") {
    const MapShape shape =
        parse_option(printable(request.file) + ": as", [&] { return parse_map_shape(*as); });
    for (const Parameter& each : shape.parameterization.parameters()) known.push_back(each.name);
    if (shape.parameterization.parameters().empty()) std::erase(known, "fov");
  }
  for (const auto& [key, value] : request.settings) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      settings.refuse(unknown_name("setting", printable(key), known));
  }
  parse_option(printable(request.file), [&] { return shape_of(request); });
  panel_options(request);
  colour_of(request);
  if (request.kind == PieceRequest::Kind::ball) ball_options(request);
  if (request.kind != PieceRequest::Kind::ball && circle_of(request) &&
      settings.text("as").value_or("auto") == "auto")
    settings.refuse("x, y and radius: are of a disc, which as=fisheye-equidistant… says");
  if (!is_flat(request)) return;
  const std::optional<double> fov = settings.number("fov");
  if (!(*fov >= 0.001 && *fov <= 179))
    settings.refuse(fmt::format("fov: a flat picture's is 0.001 to 179 degrees, not {}", number_text(*fov)));
}

ReadPiece read_piece(const PieceRequest& request) {
  const bool is_ball = request.kind == PieceRequest::Kind::ball;
  ReadMapOptions how;
  how.image.colour = colour_of(request);
  // Whatever shape a picture of one chart is read as, its pixels are the same.
  const std::optional<std::string> shape = shape_of(request);
  const bool is_disc = shape && has_disc(parse_map_shape(*shape).parameterization);
  how.shape = is_flat(request) || is_ball || is_disc ? std::optional<std::string>("latlong") : shape;
  if (how.shape) how.orientation = Matrix3{};
  MapReader reader(request.file, how);
  print_warnings(request.file, reader.info().image.warnings);
  const bool is_known = how.shape || request.settings.contains("as") ||
                        (reader.info().shape && reader.info().reason.starts_with("declared"));
  if (!is_known && request.kind == PieceRequest::Kind::panel)
    Settings(request).refuse(
        "does not declare what it shows: say its horizontal field of view, fov=DEGREES, or what it is if it "
        "isn't "
        "flat, as=fisheye-equidistant…");
  Map map = reader.read();
  if (is_ball) {
    BallPiece ball = make_ball_piece(request.file, std::move(map), ball_options(request));
    std::string note = fmt::format(
        "{}: the camera at {:.4g} ball radii; half angle of the cone behind the ball that is hidden {:.2f}°, "
        "and left "
        "out {:.2f}°",
        printable(request.file), ball.distance, ball.blind / kDegree, ball.left_out / kDegree);
    return {std::move(ball.piece), std::move(note)};
  }
  const PanelOptions options = panel_options(request);
  if (is_flat(request))
    return {make_flat_panel(request.file, std::move(map), Settings(request).number_or("fov", 0), options),
            ""};
  if (is_disc)
    return {make_disc_panel(request.file, std::move(map), parse_map_shape(*shape).parameterization,
                            circle_of(request), options),
            ""};
  const Matrix3 declared = map.orientation;
  Piece piece = make_panel(request.file, std::move(map), options);
  piece.map.orientation = declared * piece.map.orientation;
  return {std::move(piece), ""};
}

}  // namespace welkin::cli
