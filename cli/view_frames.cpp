#include "view_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "progress.h"
#include "welkin/base/error.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/write_resampled.h"

namespace welkin::cli {

Pair pair_from_name(std::string_view name) {
  const std::vector<std::string> names{"left-right", "top-bottom"};
  if (name == names[0]) return Pair::left_right;
  if (name == names[1]) return Pair::top_bottom;
  throw Error(ErrorKind::bad_request, unknown_name("arrangement", name, names));
}

Camera ViewRequest::camera_at(int frame) const {
  Camera at = camera;
  if (!path) return at;
  const CameraPath::Pose pose = path->at(frame);
  // The camera of the request is what the key frames turn.
  at.rotation = pose.rotation * camera.rotation;
  if (pose.fov) at.fov = pose.fov;
  return at;
}

ViewRequest::Worlds ViewRequest::read_worlds(const std::string& file) const {
  ReadFlags flags = *read;
  if (!pair) {
    MapReader reader = flags.open(file);
    Map world = reader.read();
    return {std::move(world), std::nullopt, reader.info()};
  }
  flags.eye = "left";
  MapReader reader = flags.open(file);
  if (reader.info().stereo != io::Stereo::top_bottom && reader.info().stereo != io::Stereo::left_right)
    throw Error(ErrorKind::mismatch, file, "holds one eye's picture: there are none for a pair");
  Map left = reader.read();
  flags.eye = "right";
  flags.warn = false;
  return {std::move(left), flags.open(file).read(), reader.info()};
}

ViewRequest::Worlds ViewRequest::fit(Worlds worlds, const std::string& file, bool told) const {
  if (options.fill.size() > static_cast<std::size_t>(worlds.left.channels()))
    throw UsageError(fmt::format("--fill: {} values, but {} has {} channels", options.fill.size(), in,
                                 worlds.left.channels()));
  const WriteMapOptions how = write->parse();
  for (Map* world : {&worlds.left, worlds.right ? &*worlds.right : nullptr}) {
    if (world == nullptr) continue;
    fit_channels_to(*world, file, how, told || world != &worlds.left);
    if (factor != 1) scale(*world, factor);
  }
  return worlds;
}

void ViewRequest::make(const Worlds& worlds, const Camera& at, const std::string& file,
                       io::WriteReport& losses) const {
  WriteMapOptions how = write->parse();
  io::WriteReport report;
  if (worlds.right) {
    const Image both = view_pair(worlds.left, *worlds.right, at, *pair, options);
    const io::WritePart part{.name = {}, .image = both.view(), .channels = worlds.left.channel_names};
    report = io::write(file, {&part, 1}, how.image);
  } else {
    const MapFrame frame = frame_of(at);
    const MapShape shape{frame.parameterization, layouts_of(frame.parameterization).front()};
    WriteResampledOptions writing;
    writing.resample = options;
    writing.orientation = frame.orientation;
    writing.write = std::move(how);
    report = write_resampled(file, worlds.left, shape, frame.size, writing);
  }
  losses.above += report.above;
  losses.below += report.below;
  losses.not_finite += report.not_finite;
}

void ViewRequest::run() {
  if (FrameNames::has_place(out)) return run_frames();
  if (frames) throw UsageError("--frames: needs a place for the number in OUT: view_%04d.png");
  if (path) throw UsageError("--path: needs a place for the frame's number in OUT: view_%04d.png");
  const MapFrame frame = frame_of(camera);
  check_output(out, {frame.parameterization, layouts_of(frame.parameterization).front()}, *write);
  const Worlds worlds = fit(read_worlds(in), out, false);
  options.monitor = progress_monitor("view");
  io::WriteReport losses;
  make(worlds, camera, out, losses);
  end_progress();
  report_losses(out, losses);
}

std::vector<int> ViewRequest::frames_to_make() const {
  if (!frames && FrameNames::has_place(in)) return FrameNames(in).find();
  if (!frames && !path)
    throw UsageError("--frames: say which frames to make, or --path where the camera is at them");
  const FrameRange range =
      frames ? *frames
             : FrameRange{static_cast<int>(std::ceil(std::max(path->keys().front().frame, 0.0))),
                          static_cast<int>(
                              std::floor(std::min(path->keys().back().frame, 1.0 * FrameNames::kLargest)))};
  constexpr int kMost = 1000000;
  if (range.last - range.first >= kMost)
    throw UsageError(
        fmt::format("--frames: {} to {} are over {} frames at once", range.first, range.last, kMost));
  std::vector<int> list;
  for (int frame = range.first; frame <= range.last; ++frame) list.push_back(frame);
  return list;
}

void ViewRequest::run_frames() {
  const FrameNames names(out);
  const std::vector<int> list = frames_to_make();
  if (list.empty()) throw UsageError("--path: has no whole frame of 0 or more; say which with --frames");
  std::optional<FrameNames> inputs;
  if (FrameNames::has_place(in)) {
    inputs.emplace(in);
    const std::vector<int> there = inputs->find();
    std::vector<int> missing;
    std::set_difference(list.begin(), list.end(), there.begin(), there.end(), std::back_inserter(missing));
    if (!missing.empty())
      throw Error(ErrorKind::not_found, in, "there are no files of frames " + frames_text(missing));
  }
  for (const int frame : list) {
    try {
      const MapFrame seen = frame_of(camera_at(frame));
      check_output(names.file(frame).string(),
                   {seen.parameterization, layouts_of(seen.parameterization).front()}, *write);
    } catch (const Error& error) {
      if (!error.file().empty()) throw;
      throw Error(error.kind(), fmt::format("frame {}: {}", frame, error.cause()));
    }
  }
  std::optional<Worlds> worlds;
  io::WriteReport losses;
  const Monitor monitor = progress_monitor("view");
  options.monitor.cancelled = monitor.cancelled;
  ReadFlags quiet = *read;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string file = names.file(list[i]).string();
    try {
      if (!worlds || inputs)
        worlds = fit(read_worlds(inputs ? inputs->file(list[i]).string() : in), file, i > 0);
      make(*worlds, camera_at(list[i]), file, losses);
    } catch (const Error& error) {
      if (i == 0) throw;
      throw Error(
          error.kind(), error.file(),
          fmt::format("{}; frames {} are finished", error.cause(), frames_text(std::span(list).first(i))));
    }
    quiet.warn = false;
    read = &quiet;
    if (monitor.progress) monitor.progress(static_cast<double>(i + 1) / static_cast<double>(list.size()));
  }
  end_progress();
  report_losses(out, losses);
}

}  // namespace welkin::cli
