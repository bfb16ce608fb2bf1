#include "command.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "progress.h"
#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/io/output_file.h"
#include "welkin/io/process.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {
namespace {

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    parts.push_back(text.substr(from, comma - from));
    from = comma + 1;
  }
  return parts;
}

io::Colour parse_colour(std::string_view option, const std::string& text) {
  const std::vector<std::string> names{"auto", "linear", "srgb"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return static_cast<io::Colour>(i);
  }
  throw UsageError(std::string(option) + ": " + unknown_name("transfer function", text, names));
}

}  // namespace

std::optional<double> finite_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string printable(std::string text, std::size_t longest) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  if (text.size() > longest) text = text.substr(0, longest) + "…";
  return text;
}

std::vector<double> parse_numbers(std::string_view option, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : split_list(text)) {
    const std::optional<double> value = finite_number(part);
    if (!value) throw UsageError(fmt::format("{}: '{}' is not a number", option, part));
    numbers.push_back(*value);
  }
  return numbers;
}

ChartSize parse_chart_size(std::string_view option, const std::string& text,
                           const sphere::AnyParameterization& parameterization) {
  const auto whole = [&](const std::string& part) {
    char* end = nullptr;
    const long value = std::strtol(part.c_str(), &end, 10);
    if (part.empty() || *end != '\0' || value < 1 || value > (1 << 20)) {
      throw UsageError(
          fmt::format("{}: '{}' is not a size: write N or WxH in texels, 1 to 1048576", option, text));
    }
    return static_cast<int>(value);
  };
  const std::size_t x = text.find('x');
  if (x != std::string::npos) return {whole(text.substr(0, x)), whole(text.substr(x + 1))};
  const int width = whole(text);
  return {width, std::max(1, static_cast<int>(std::lround(width / parameterization.aspect())))};
}

Matrix3 parse_rotation(std::string_view option, const std::string& text) {
  const std::vector<double> n = parse_numbers(option, text);
  if (n.size() == 3) return rotation_from_yaw_pitch_roll(n[0], n[1], n[2]);
  if (n.size() == 4) {
    if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3] < 1e-12) {
      throw UsageError(fmt::format("{}: the quaternion {} has no length", option, text));
    }
    return rotation_from_quaternion(n[0], n[1], n[2], n[3]);
  }
  if (n.size() == 9) {
    const Matrix3 matrix{{{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}}}};
    if (!is_orthonormal(matrix)) {
      throw UsageError(fmt::format("{}: the matrix is no rotation (its rows are not orthonormal)", option));
    }
    return orthonormalize(matrix);
  }
  throw UsageError(
      fmt::format("{}: give yaw,pitch,roll in degrees, a quaternion w,x,y,z or nine matrix entries", option));
}

void ReadFlags::add(Command command) {
  command.add_option("--from", from,
                     "Parameterization of the input: NAME[:LAYOUT][,PARAMETER=VALUE] (see `welkin list`). "
                     "Default: what the file declares, else a guess from its size");
  command.add_option("--from-faces", faces,
                     "Order and quarter turns of the input's faces, as px,nx,py:90,ny:270:mirror,pz,nz");
  command.add_option("--from-convention", convention,
                     "World of the input: three.js, blender… (`welkin list conventions`)");
  command.add_option("--colour", colour, "Transfer function of the input: auto, linear, srgb").show_default();
  command
      .add_option("--primaries", primaries,
                  "Colours of other primaries than BT.709's: convert them, or keep them as they are")
      .one_of({"convert", "keep"})
      .show_default();
  command.add_option("--from-encoding", encoding,
                     "How radiance lies in the input's R G B A of 8 bits: rgbm,range=6, rgbd, rgbp, rgbe. "
                     "Default: as files of ours say, else not at all");
  command.add_option("--channels", channels,
                     "Channels to read, by name: R,G,B. Default: R,G,B and A of the layer, or Y, or the "
                     "first three");
  command.add_option(
      "--eye", eye,
      "Of a picture that holds two eyes' pictures, the one to read: left, right. Default: left, "
      "where the file declares them");
  command.add_option("--stereo", stereo,
                     "How two eyes' pictures lie in the input's: none, top-bottom, left-right. Default: what "
                     "the file declares, else by its aspect where --eye is given");
  command
      .add_option("--layer", layer,
                  "Layer to read: what its channels' names have before the last dot, or some of that; or a "
                  "part's or a view's name (see `welkin info`). Default: the picture with colour")
      .check([](const std::string& name) { return name.empty() ? "is empty" : ""; });
  command
      .add_option("--part", part,
                  "Which picture of a file with several, or which cube of an array (from 0). Default: the "
                  "picture with colour")
      .within(0, 1 << 30);
  command
      .add_option("--from-border", border,
                  "Texels of safety border around every chart of the input, where it doesn't declare them")
      .within(0, 65536);
}

void ReadFlags::add_level(Command command, const std::string& description) {
  command.add_option("--level", level, description).within(0, 20);
}

ReadMapOptions ReadFlags::parse() const {
  ReadMapOptions options;
  if (!from.empty()) {
    parse_option("--from", [&] { return parse_map_shape(from); });
    options.shape = from;
  }
  options.faces = faces;
  if (!channels.empty()) options.channels = split_list(channels);
  for (const std::string& channel : options.channels) {
    if (channel.empty()) throw UsageError("--channels: '" + channels + "' has an empty name");
    if (std::count(options.channels.begin(), options.channels.end(), channel) > 1) {
      throw UsageError("--channels: '" + channel + "' is named twice");
    }
  }
  if (!eye.empty()) {
    const std::vector<std::string> names{"left", "right"};
    if (eye != names[0] && eye != names[1]) throw UsageError("--eye: " + unknown_name("eye", eye, names));
    options.eye = eye == names[0] ? Eye::left : Eye::right;
  }
  if (!stereo.empty()) {
    const std::vector<std::string> names{"none", "top-bottom", "left-right"};
    const auto found = std::find(names.begin(), names.end(), stereo);
    if (found == names.end()) throw UsageError("--stereo: " + unknown_name("arrangement", stereo, names));
    constexpr io::Stereo kinds[] = {io::Stereo::mono, io::Stereo::top_bottom, io::Stereo::left_right};
    options.stereo = kinds[found - names.begin()];
  }
  options.border = border;
  options.layer = layer;
  if (part) options.part = static_cast<std::size_t>(*part);
  options.image.colour = parse_colour("--colour", colour);
  options.image.keep_primaries = primaries == "keep";
  if (!encoding.empty())
    options.image.encoding =
        parse_option("--from-encoding", [&] { return io::LightEncoding::from_name(encoding); });
  if (!convention.empty())
    parse_option("--from-convention", [&] { return convention_from_name(convention); });
  return options;
}

MapReader ReadFlags::open(const std::string& path) const {
  MapReader reader = open_unknown(path);
  if (reader.info().shape) return reader;
  try {
    reader.shape();
  } catch (const Error& error) {
    throw Error(error.kind(), error.file(),
                error.cause() + "; name it with --from (octahedral, angular, sphere, fisheye-equidistant…)");
  }
  return reader;
}

MapReader ReadFlags::open_unknown(const std::string& path) const {
  ReadMapOptions options = parse();
  options.faces.clear();
  options.join_faces = pixels && faces.empty() && convention.empty();
  MapReader reader(path, options);
  if (reader.info().shape && !convention.empty() && reader.info().reason.starts_with("guessed")) {
    MapShape guessed = *reader.info().shape;
    fit_to_convention(path, convention, guessed);
    if (!(guessed.parameterization == reader.info().shape->parameterization)) {
      options.shape = guessed.text();
      reader = MapReader(path, options);
    }
  }
  if (reader.info().shape && !convention.empty()) {
    reader.set_orientation(
        orientation_for(convention_from_name(convention), reader.info().shape->parameterization));
  }
  if (reader.info().shape) {
    if (!faces.empty()) parse_option("--from-faces", [&] { reader.set_faces(faces); });
    if (level) parse_option("--level", [&] { reader.set_level(*level); });
    if (pixels && !options.join_faces) reader.check_faces();
  }
  if (warn) print_warnings(path, reader.info().image.warnings);
  return reader;
}

LoadedMap ReadFlags::read(const std::string& path) const {
  MapReader reader = open(path);
  return {reader.read(), reader.info()};
}

void WriteFlags::add(Command command) {
  command.add_option("--to-faces", faces,
                     "Order and quarter turns of the output's faces, as px,nx,py:90,ny:270:mirror,pz,nz");
  command.add_option(
      "--type", type,
      "Stored values: uint8, uint16, uint32, half, float; rgb9e5, r11g11b10, bc6h, uastc-hdr in textures. "
      "Default: the format's best");
  command.add_option("--encoding,--to-encoding", encoding,
                     "Radiance in R G B A of 8 bits, of PNG: rgbm,range=6, rgbd, rgbp, rgbe");
  command.add_option("--to-colour", colour, "Transfer function of the output: auto, linear, srgb")
      .show_default();
  command.add_option("--compression", compression, "none, rle, zip, piz, dwaa…, as the format has it");
  command
      .add_option("--quality", quality,
                  "Of lossy formats 1 to 100; of bc6h and uastc-hdr how long the best blocks are searched: "
                  "fast, normal, best")
      .help_value("TEXT [95, normal]");
  command
      .add_option("--border", border,
                  "Texels of safety border to write around every chart, for renderers that sample charts as "
                  "plain textures")
      .within(0, 65536);
}

namespace {

void parse_quality(const std::string& text, io::WriteOptions& options) {
  if (text.empty()) return;
  constexpr std::pair<std::string_view, TextureQuality> kNames[] = {
      {"fast", TextureQuality::fast}, {"normal", TextureQuality::normal}, {"best", TextureQuality::best}};
  for (const auto& [name, quality] : kNames) {
    if (text == name) {
      options.texture_quality = quality;
      return;
    }
  }
  const std::optional<double> number = parse_number(text);
  if (!number || *number != std::floor(*number) || *number < 1 || *number > 100)
    throw UsageError(
        fmt::format("--quality: '{}' is neither a whole number of 1 to 100 nor one of fast, normal, best",
                    printable(text)));
  options.quality = static_cast<int>(*number);
}

}  // namespace

WriteMapOptions WriteFlags::parse() const {
  WriteMapOptions options;
  options.faces = faces;
  options.border = border;
  options.image.colour = parse_colour("--to-colour", colour);
  options.image.compression = compression;
  parse_quality(quality, options.image);
  if (!encoding.empty())
    options.image.encoding =
        parse_option("--encoding", [&] { return io::LightEncoding::from_name(encoding); });
  if (!type.empty()) {
    options.image.type = parse_option("--type", [&] { return io::pixel_type_from_name(type); });
  }
  return options;
}

void add_format(Command command, std::string& format) {
  command.add_option("--format", format,
                     "Format of what is written to standard output, where OUT is -: exr, png…");
}

std::string output_path(const std::string& out, const std::string& format) {
  if (out != "-") {
    if (format.empty()) return out;
    throw UsageError("--format: is for standard output, OUT -; the format of a file follows its extension");
  }
  if (format.empty())
    throw UsageError("-: name the format to write to standard output with --format (exr, hdr, png…)");
  try {
    io::capabilities_for("x." + format);
  } catch (const Error& error) {
    throw UsageError("--format: " + error.cause());
  }
  if (io::standard_output_is_terminal())
    throw UsageError("-: standard output is a terminal: redirect it to a file or another program");
  return io::take_standard_output(format).string();
}

std::string input_path(const std::string& in) {
  return in == "-" ? io::take_standard_input().string() : in;
}

void check_extension(const std::string& path) {
  try {
    io::capabilities_for(path);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

int levels_of(const MapFileInfo& info) {
  return std::max(1, static_cast<int>(info.levels.size()));
}

void fit_channels_to(Map& map, const std::string& path, const WriteMapOptions& options, bool told) {
  const std::vector<std::string> notes = fit_channels(map, path, options.image);
  for (std::size_t i = 0; i < notes.size() && !told; ++i) print_warning(path, notes[i]);
}

}  // namespace welkin::cli
