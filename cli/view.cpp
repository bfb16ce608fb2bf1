#include "welkin/camera/view.h"

#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>

#include "bake_set.h"
#include "command.h"
#include "progress.h"
#include "view_frames.h"
#include "welkin/camera/camera_path.h"
#include "welkin/io/process.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/write_resampled.h"
#include "welkin/sequence/frame_names.h"

namespace welkin::cli {
namespace {

struct View {
  std::string in, out, format, size = "1920x1080", camera = "perspective", axis = "horizontal", look, shift;
  std::string filter = "auto", fill, pair, frames, path, shutter, over;
  std::optional<int> samples;
  bool resume = false;
  StreamFlags stream;
  std::optional<double> fov;
  double exposure = 0, scale = 1;
  bool allow_ringing = false;
  ReadFlags read;
  WriteFlags write;

  void run(const Command& command) const;
  Camera parse_camera() const;
  Shutter parse_shutter() const;
  ResampleOptions parse_options() const;
  float factor() const { return static_cast<float>(scale * std::exp2(exposure)); }
};

/// Up to `count` numbers; those that are left out are 0.
std::vector<double> few_numbers(std::string_view option, const std::string& text, std::size_t count,
                                std::string_view form) {
  std::vector<double> numbers;
  if (!text.empty()) numbers = parse_numbers(option, text);
  if (numbers.size() > count) throw UsageError(fmt::format("{}: '{}' is not {}", option, text, form));
  numbers.resize(count);
  return numbers;
}

Camera View::parse_camera() const {
  Camera made;
  made.lens = camera;
  made.fov = fov;
  made.axis = parse_option("--fov-axis", [&] { return fov_axis_from_name(axis); });
  if (size.find('x') == std::string::npos) throw UsageError("--size: '" + size + "' is not WIDTHxHEIGHT");
  made.size = parse_chart_size("--size", size, sphere::AnyParameterization::make("perspective"));
  const std::vector<double> angles = few_numbers("--look", look, 3, "YAW,PITCH,ROLL");
  made.rotation = rotation_of({angles[0], angles[1], angles[2]});
  const std::vector<double> shifts = few_numbers("--shift", shift, 2, "X,Y");
  made.shift_right = shifts[0];
  made.shift_up = shifts[1];
  return made;
}

ResampleOptions View::parse_options() const {
  ResampleOptions options;
  options.filter = parse_option("--filter", [&] { return filter_from_name(filter); });
  options.allow_ringing = allow_ringing;
  if (!fill.empty()) {
    for (const double value : parse_numbers("--fill", fill))
      options.fill.push_back(static_cast<float>(value));
  }
  return options;
}

Shutter View::parse_shutter() const {
  const std::vector<double> times = parse_numbers("--shutter", shutter);
  if (times.size() != 2 || !(times[0] < times[1]))
    throw UsageError("--shutter: '" + shutter + "' is not OPEN,CLOSE in frames, as 0,0.5");
  return {times[0], times[1]};
}

void View::run(const Command& command) const {
  read.parse();
  stream.check_unused(command);
  if (!(stream.asked() && out == "-")) check_extension(out);
  ViewRequest request{.in = in, .out = out, .camera = parse_camera(), .options = parse_options()};
  request.factor = factor();
  request.read = &read;
  request.write = &write;
  request.stream = &stream;
  request.over = over;
  request.resume = resume;
  if (stream.asked()) {
    stream.parse_kind();
    stream.parse_rate();
    stream.colour();
  }
  if (!shutter.empty()) request.shutter = parse_shutter();
  if (samples && !request.shutter) throw UsageError("--samples: is for --shutter");
  request.samples = samples;
  if (request.shutter && path.empty())
    throw UsageError("--shutter: the camera stands still; say how it moves with --path");
  if (request.shutter && !pair.empty())
    throw UsageError("--shutter: makes one eye's picture; take it with --eye");
  if (request.shutter && filter != "auto")
    throw UsageError("--shutter: averages what a pixel sweeps; leave --filter out");
  if (!pair.empty()) request.pair = parse_option("--pair", [&] { return pair_from_name(pair); });
  if (request.pair && !read.eye.empty()) throw UsageError("--pair: takes both eyes, and --eye one");
  if (!path.empty()) request.path = read_camera_path(path);
  if (resume) {
    request.request = command_line(command);
    if (request.path) {
      for (const CameraKey& key : request.path->keys())
        request.request += fmt::format(" {} {} {} {} {}", key.frame, key.look.yaw, key.look.pitch,
                                       key.look.roll, key.fov.value_or(0));
    }
  }
  if (!frames.empty()) request.frames = parse_option("--frames", [&] { return frame_range_from(frames); });
  // A camera that there can't be is told before any file is opened.
  parse_option("--camera", [&] { return frame_of(request.camera); });
  request.run();
}

}  // namespace

void add_view(Command app) {
  auto view = std::make_shared<View>();
  Command command = app.add_command(
      "view", "Make pictures of the world: what a camera at its centre sees, frame by frame where it moves");
  command.add_option("IN", view->in, "Map to read; with --frames it may be numbered: sky_%04d.exr")
      .required();
  command.add_option("OUT", view->out, "Picture to write; with --frames numbered: view_%04d.png").required();
  command
      .add_option("--camera", view->camera,
                  "Lens: perspective, pannini, stereographic, equidistant, equisolid, orthographic, "
                  "cylindrical, dome, little-planet, or any parameterization of one chart, each with its "
                  "parameters: pannini,d=0.5 (`welkin list parameters`)")
      .show_default();
  command.add_option("--size", view->size, "WIDTHxHEIGHT of the picture, pixels").show_default();
  command.add_option("--fov", view->fov, "Field of view, degrees. Default: the lens's, of perspective 90")
      .finite();
  command.add_option("--fov-axis", view->axis, "What --fov measures: horizontal, vertical, diagonal")
      .show_default();
  command.add_option("--look", view->look,
                     "YAW,PITCH,ROLL, degrees: to the right, up, and tilted to the right of 0,0,0, which is "
                     "the centre of a lat-long");
  command.add_option(
      "--shift", view->shift,
      "X,Y: shift of the picture before the lens to the right and up, in its widths and heights");
  command.add_option("--filter", view->filter, "auto (antialiased), nearest, bilinear, bicubic, lanczos")
      .show_default();
  command.add_option("--exposure", view->exposure, "Brighten by this many stops").finite();
  command.add_option("--scale", view->scale, "Multiply radiance").finite();
  command.add_option("--fill", view->fill,
                     "Value, one per channel, where there is nothing to see: outside a dome's disc, or the "
                     "part of the world that the input shows. Default: 0");
  command.add_flag("--allow-ringing", view->allow_ringing,
                   "Leave the overshoot of bicubic and lanczos beside bright lights unclamped");
  command.add_option(
      "--pair", view->pair,
      "Of an input with two eyes' pictures, both views in one picture: left-right, top-bottom");
  command.add_option("--frames", view->frames, "Frames to make of an animation: A-B, or one");
  command.add_option("--path", view->path,
                     "Key frames of the camera, a table (CSV) or JSON: frame and yaw, pitch, roll, fov");
  view->read.add(command);
  view->read.add_level(command, "Level of the input to take. Default: 0");
  view->write.add(command);
  add_format(command, view->format);
  command.add_option(
      "--shutter", view->shutter,
      "OPEN,CLOSE in frames, as 0,0.5: blur the motion of --path between these times from each frame on");
  command
      .add_option("--samples", view->samples,
                  "With --shutter: positions of the camera that are averaged. Default: 1.5 for each pixel "
                  "that is swept")
      .within(1, 1 << 16);
  command.add_option(
      "--over", view->over,
      "Picture with alpha to lay over each frame, near objects over the far world; may be numbered: "
      "near_%04d.exr");
  command.add_flag(
      "--resume", view->resume,
      "Leave frames alone whose files are complete, were made by the same request, and are newer than "
      "what they are made from");
  view->stream.add(command);
  command.callback([view, command] {
    const bool streamed = view->stream.asked();
    if (!(streamed && view->out == "-")) view->out = output_path(view->out, view->format);
    if (streamed && view->out == "-" && !view->format.empty())
      throw UsageError("--format: --stream names what is written to standard output");
    if (streamed && view->out == "-" && io::standard_output_is_terminal())
      throw UsageError("-: standard output is a terminal: redirect it to a file or another program");
    if (!(streamed && view->in == "-")) view->in = input_path(view->in);
    view->run(command);
  });
}

}  // namespace welkin::cli
