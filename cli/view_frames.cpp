#include "view_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "progress.h"
#include "welkin/assemble/composite_over.h"
#include "welkin/base/error.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/write_resampled.h"
#include "welkin/sequence/made_note.h"

namespace welkin::cli {

Pair pair_from_name(std::string_view name) {
  const std::vector<std::string> names{"left-right", "top-bottom"};
  if (name == names[0]) return Pair::left_right;
  if (name == names[1]) return Pair::top_bottom;
  throw Error(ErrorKind::bad_request, unknown_name("arrangement", name, names));
}

namespace {

/// R G B A of a picture, colours multiplied by alpha.
Image read_near(const std::string& file) {
  const std::unique_ptr<io::Reader> reader = io::open(std::filesystem::path(file));
  const io::PartInfo& part = reader->info().parts.at(0);
  std::vector<int> channels;
  for (const char* name : {"R", "G", "B", "A"}) {
    const auto found = std::find(part.channels.begin(), part.channels.end(), name);
    if (found == part.channels.end())
      throw Error(ErrorKind::mismatch, file,
                  "a picture to lay over another has R, G, B and A; it lacks " + std::string(name));
    channels.push_back(static_cast<int>(found - part.channels.begin()));
  }
  Image near(part.width, part.height, 4);
  reader->read(0, channels, near.view());
  // A sharp filter overshoots at the edge of what is opaque.
  constexpr float kOvershoot = 0.5f;
  for (int y = 0; y < near.height(); ++y) {
    for (int x = 0; x < near.width(); ++x) {
      float& alpha = near.at(x, y)[3];
      if (alpha >= -kOvershoot && alpha <= 1 + kOvershoot) alpha = std::clamp(alpha, 0.0f, 1.0f);
    }
  }
  return near;
}

}  // namespace

std::shared_ptr<const TexelPositions> KeptPositions::of(const MapFrame& world, const MapFrame& seen) {
  const std::scoped_lock lock(mutex_);
  if (!kept_ || !kept_->fit(world, seen)) kept_ = std::make_shared<const TexelPositions>(world, seen);
  return kept_;
}

std::shared_ptr<const TexelPositions> ViewRequest::positions_for(const Map& world,
                                                                 const MapFrame& seen) const {
  return kept ? kept->of(world, seen) : nullptr;
}

Camera ViewRequest::camera_at(double frame) const {
  Camera at = camera;
  if (!path) return at;
  const CameraPath::Pose pose = path->at(frame);
  // The camera of the request is what the key frames turn.
  at.rotation = pose.rotation * camera.rotation;
  if (pose.fov) at.fov = pose.fov;
  return at;
}

ViewRequest::Worlds ViewRequest::read_worlds(const std::string& file, bool warn) const {
  ReadFlags flags = *read;
  flags.warn = warn;
  if (!pair) return {.left = flags.open(file).read()};
  flags.eye = "left";
  MapReader reader = flags.open(file);
  if (reader.info().stereo != io::Stereo::top_bottom && reader.info().stereo != io::Stereo::left_right)
    throw Error(ErrorKind::mismatch, file, "holds one eye's picture: there are none for a pair");
  Map left = reader.read();
  flags.eye = "right";
  flags.warn = false;
  return {.left = std::move(left), .right = flags.open(file).read()};
}

ViewRequest::Worlds ViewRequest::fit(Worlds worlds, const std::string& file, bool told) const {
  if (options.fill.size() > static_cast<std::size_t>(worlds.left.channels()))
    throw UsageError(fmt::format("--fill: {} values, but {} has {} channels", options.fill.size(), in,
                                 worlds.left.channels()));
  const WriteMapOptions how = write->parse();
  for (Map* world : {&worlds.left, worlds.right ? &*worlds.right : nullptr}) {
    if (world == nullptr) continue;
    if (!file.empty()) fit_channels_to(*world, file, how, told || world != &worlds.left);
    if (factor != 1) scale(*world, factor);
  }
  return worlds;
}

ViewRequest::Picture ViewRequest::picture_of(const Worlds& worlds, int frame) const {
  Picture picture{.map = std::nullopt, .both = {}, .channels = worlds.left.channel_names};
  ResampleOptions shown = options;
  shown.borders = false;
  if (worlds.right) {
    picture.both = view_pair(worlds.left, *worlds.right, camera_at(frame), *pair, shown);
  } else if (shutter) {
    const Shutter open{frame + shutter->open, frame + shutter->close};
    const auto at = [&](double time) { return camera_at(time); };
    const MotionBlurOptions how{.samples = samples, .monitor = shown.monitor};
    picture.map =
        worlds.blurred ? worlds.blurred->view(at, open, how) : blurred_view(worlds.left, at, open, how);
  } else {
    shown.positions = positions_for(worlds.left, frame_of(camera_at(frame)));
    picture.map = view(worlds.left, camera_at(frame), shown);
  }
  if (!over.empty()) lay_over(picture, frame);
  return picture;
}

std::string ViewRequest::near_file(int frame) const {
  return FrameNames::has_place(over) ? FrameNames(over).file(frame).string() : over;
}

void ViewRequest::lay_over(Picture& picture, int frame) const {
  const std::string file = near_file(frame);
  try {
    composite_over(read_near(file).view(), picture.view());
  } catch (const Error& error) {
    throw error.file().empty() ? in_file(file, error) : error;
  }
}

io::WriteReport ViewRequest::make(const Worlds& worlds, int frame, const std::string& file,
                                  const std::string& note) const {
  WriteMapOptions how = write->parse();
  if (!note.empty()) how.image.attributes[sequence::kFrameKey] = note;
  const MapFrame seen = frame_of(camera_at(frame));
  const MapShape shape{seen.parameterization, layouts_of(seen.parameterization).front()};
  if (!worlds.right && !shutter && over.empty()) {
    WriteResampledOptions writing;
    writing.resample = options;
    writing.resample.positions = positions_for(worlds.left, seen);
    writing.orientation = seen.orientation;
    writing.write = std::move(how);
    return write_resampled(file, worlds.left, shape, seen.size, writing);
  }
  const Picture picture = picture_of(worlds, frame);
  if (picture.map) return write_map(file, *picture.map, shape.layout, how);
  const io::WritePart part{.name = {}, .image = picture.both.view(), .channels = picture.channels};
  return io::write(file, {&part, 1}, how.image);
}

void ViewRequest::check_file(int frame, const std::string& file) const {
  try {
    const MapFrame seen = frame_of(camera_at(frame));
    check_output(file, {seen.parameterization, layouts_of(seen.parameterization).front()}, *write);
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw Error(error.kind(), fmt::format("frame {}: {}", frame, error.cause()));
  }
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

void ViewRequest::run() {
  const bool many = stream->asked() || FrameNames::has_place(out);
  if (many) {
    if (stream->asked() && in != "-" && out != "-")
      throw UsageError("--stream: is for standard input or output: name one of IN and OUT -");
    if (resume && stream->asked()) throw UsageError("--resume: is for numbered files, not for streams");
    if (reads_stream() && !writes_stream() && !FrameNames::has_place(out))
      throw UsageError("--stream: needs a place for the frame's number in OUT: view_%04d.png");
    if (read->level && reads_stream()) throw UsageError("--level: a stream's frames have one level");
    if (pair && reads_stream())
      throw UsageError("--pair: is for files; of a stream, take one eye with --eye");
    if (!path && options.filter != Filter::automatic) kept = std::make_shared<KeptPositions>();
    return run_frames();
  }
  for (const auto& [given, option] :
       {std::pair{frames.has_value(), "--frames"}, {path.has_value(), "--path"}, {resume, "--resume"}}) {
    if (given)
      throw UsageError(fmt::format("{}: needs a place for the frame's number in OUT: view_%04d.png", option));
  }
  check_file(0, out);
  const Worlds worlds = fit(read_worlds(in, true), out, false);
  options.monitor = progress_monitor("view");
  const io::WriteReport losses = make(worlds, 0, out, "");
  end_progress();
  report_losses(out, losses);
}

}  // namespace welkin::cli
