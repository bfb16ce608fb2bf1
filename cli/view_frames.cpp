#include "view_frames.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <span>
#include <tuple>

#include "progress.h"
#include "welkin/assemble/composite_over.h"
#include "welkin/base/error.h"
#include "welkin/io/process.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/write_resampled.h"
#include "welkin/sequence/frame_pipeline.h"
#include "welkin/sequence/made_note.h"

namespace welkin::cli {

Pair pair_from_name(std::string_view name) {
  const std::vector<std::string> names{"left-right", "top-bottom"};
  if (name == names[0]) return Pair::left_right;
  if (name == names[1]) return Pair::top_bottom;
  throw Error(ErrorKind::bad_request, unknown_name("arrangement", name, names));
}

namespace {

io::WriteReport& operator+=(io::WriteReport& sum, const io::WriteReport& report) {
  sum.above += report.above;
  sum.below += report.below;
  sum.not_finite += report.not_finite;
  return sum;
}

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
  constexpr float kOvershoot = 0.25f;
  for (int y = 0; y < near.height(); ++y) {
    for (int x = 0; x < near.width(); ++x) {
      float& alpha = near.at(x, y)[3];
      if (alpha >= -kOvershoot && alpha <= 1 + kOvershoot) alpha = std::clamp(alpha, 0.0f, 1.0f);
    }
  }
  return near;
}

}  // namespace

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
  if (!pair) return {flags.open(file).read(), std::nullopt};
  flags.eye = "left";
  MapReader reader = flags.open(file);
  if (reader.info().stereo != io::Stereo::top_bottom && reader.info().stereo != io::Stereo::left_right)
    throw Error(ErrorKind::mismatch, file, "holds one eye's picture: there are none for a pair");
  Map left = reader.read();
  flags.eye = "right";
  flags.warn = false;
  return {std::move(left), flags.open(file).read()};
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
    picture.map = blurred_view(worlds.left, [&](double time) { return camera_at(time); }, open,
                               {.samples = samples, .monitor = shown.monitor});
  } else {
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

/// The frames of a request, read, made and written at the same time.
class ViewRequest::Sequence {
 public:
  explicit Sequence(const ViewRequest& request) : request_(request) {}

  void run() {
    prepare();
    const auto start = std::chrono::steady_clock::now();
    sequence::FrameStages<Frame> stages;
    stages.take = [this](Frame& frame) { return take(frame); };
    stages.make = [this](Frame& frame) { make(frame); };
    stages.put = [this](Frame& frame) { put(frame); };
    int finished = 0;
    try {
      sequence::run_frames<Frame>(frames_in_work(), stages, finished);
    } catch (const Error& error) {
      end_progress();
      if (finished == 0) throw;
      throw Error(error.kind(), error.file(),
                  fmt::format("{}; {} {} finished before", error.cause(), finished,
                              finished == 1 ? "frame was" : "frames were"));
    }
    end_progress();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    report_losses(request_.out, losses_);
    if (!progress_.progress) return;
    if (complete_ > 0)
      print_message(fmt::format("{}: {} frames were complete\n", printable(request_.out), complete_));
    if (finished > 1)
      print_message(fmt::format("{}: {} frames in {:.2f} s, {:.1f} a second\n", printable(request_.out),
                                finished, time.count(), finished / time.count()));
  }

 private:
  struct Frame {
    int number = 0;
    std::vector<std::byte> taken, made;
    io::WriteReport losses;
  };

  void prepare() {
    progress_ = progress_monitor("view");
    if (request_.reads_stream()) {
      world_stream_.emplace(*request_.read, *request_.stream);
      next_ = request_.frames ? request_.frames->first : 0;
      prepare_stored_frames();
    } else {
      list_ = request_.frames_to_make();
      if (list_.empty()) throw UsageError("--path: has no whole frame of 0 or more; say which with --frames");
      find_inputs();
    }
    if (!request_.writes_stream()) prepare_files();
    if (!world_stream_ && !inputs_)
      still_ = request_.fit(request_.read_worlds(request_.in, true), example_file(), false);
  }

  /// A name whose format is that of all files; of a stream none.
  std::string example_file() const {
    return request_.writes_stream() ? "" : outputs_->file(list_.empty() ? next_ : list_.front()).string();
  }

  void find_inputs() {
    if (!request_.over.empty() && FrameNames::has_place(request_.over))
      require_files(FrameNames(request_.over));
    if (!FrameNames::has_place(request_.in)) return;
    inputs_.emplace(request_.in);
    require_files(*inputs_);
  }

  void require_files(const FrameNames& names) const {
    const std::vector<int> there = names.find();
    std::vector<int> missing;
    std::set_difference(list_.begin(), list_.end(), there.begin(), there.end(), std::back_inserter(missing));
    if (!missing.empty())
      throw Error(ErrorKind::not_found, names.name().string(),
                  "there are no files of frames " + frames_text(missing));
  }

  /// Where stored values can stay as they are.
  void prepare_stored_frames() {
    const ViewRequest& r = request_;
    const bool alone = !r.path && !r.shutter && r.over.empty() && r.factor == 1 && r.options.fill.empty();
    if (!world_stream_ || !r.writes_stream() || !alone || r.options.filter != Filter::bilinear) return;
    const MapFrame seen = frame_of(r.camera);
    const video::StreamInfo info = info_of(seen.size, world_stream_->info().channels);
    stored_ = StoredFrames::make(*world_stream_, seen, info);
    if (stored_) writer_.emplace(&io::write_standard_output, info, r.stream->colour());
  }

  void prepare_files() {
    outputs_.emplace(request_.out);
    for (const int frame : list_) request_.check_file(frame, outputs_->file(frame).string());
    if (!request_.resume) return;
    const io::Capabilities& format = io::capabilities_for(request_.out);
    if (!format.attributes)
      throw Error(ErrorKind::unsupported, request_.out,
                  format.title + " has no text metadata, which would say what a frame was made from");
    digest_ = sequence::digest_of(request_.request);
    std::vector<int> left;
    for (const int frame : list_) {
      const std::filesystem::path files[] = {outputs_->file(frame)};
      std::vector<std::filesystem::path> sources;
      sources.emplace_back(inputs_ ? inputs_->file(frame) : std::filesystem::path(request_.in));
      if (!request_.over.empty()) sources.emplace_back(request_.near_file(frame));
      if (!sequence::is_made(files, sequence::made_note(frame, digest_), sources)) left.push_back(frame);
    }
    complete_ = list_.size() - left.size();
    list_ = std::move(left);
  }

  std::size_t frames_in_work() const {
    constexpr double kMostBytes = 4e9;
    const ChartSize size = request_.camera.size;
    double bytes = 4.0 * 4 * size.width * size.height;
    if (world_stream_) bytes += 4.0 * 3 * world_stream_->info().width * world_stream_->info().height;
    if (inputs_ && !list_.empty()) {
      MapReader reader(inputs_->file(list_.front()));
      const io::PartInfo& part = reader.info().image.parts.at(0);
      bytes += 4.0 * 4 * part.width * part.height;
    }
    return std::clamp<std::size_t>(static_cast<std::size_t>(kMostBytes / bytes), 1,
                                   sequence::usual_frames_at_once());
  }

  bool take(Frame& frame) {
    if (progress_.cancelled && progress_.cancelled()) throw Cancelled();
    if (world_stream_) {
      if (request_.frames && next_ > request_.frames->last) return false;
      frame.number = next_;
      if (!world_stream_->take(frame.taken)) return false;
      ++next_;
      return true;
    }
    if (taken_ == list_.size()) return false;
    frame.number = list_[taken_++];
    return true;
  }

  void make(Frame& frame) const {
    if (stored_) return stored_->apply(frame.taken, writer_->frame_header(), frame.made);
    std::string file, note;
    if (outputs_) {
      file = outputs_->file(frame.number).string();
      if (request_.resume) note = sequence::made_note(frame.number, digest_);
    }
    if (still_) return write(*still_, file, note, frame);
    const bool first = frame.number == (list_.empty() ? 0 : list_.front());
    Worlds worlds = world_stream_ ? Worlds{world_stream_->world(frame.taken), std::nullopt}
                                  : request_.read_worlds(inputs_->file(frame.number).string(), first);
    frame.taken = {};
    write(request_.fit(std::move(worlds), file, !first), file, note, frame);
  }

  void write(const Worlds& worlds, const std::string& file, const std::string& note, Frame& frame) const {
    if (outputs_) {
      frame.losses = request_.make(worlds, frame.number, file, note);
      return;
    }
    Picture picture = request_.picture_of(worlds, frame.number);
    const ImageView<float> shown = picture.view();
    // The first frame says what all are.
    std::call_once(opened_, [&] {
      writer_.emplace(&io::write_standard_output, info_of({shown.width, shown.height}, shown.channels),
                      request_.stream->colour());
    });
    const ImageView<float> colours = colours_of(shown, picture);
    frame.losses = writer_->encode(colours, frame.made);
  }

  /// R G B or Y; a picture's alpha has no place in a stream.
  static ImageView<float> colours_of(const ImageView<float>& shown, Picture& picture) {
    if (shown.channels == 1 || shown.channels == 3) return shown;
    const bool grey = shown.channels == 2;
    Image colours(shown.width, shown.height, grey ? 1 : 3);
    for (int y = 0; y < shown.height; ++y) {
      for (int x = 0; x < shown.width; ++x) std::copy_n(shown.at(x, y), colours.channels(), colours.at(x, y));
    }
    picture.map.reset();
    picture.both = std::move(colours);
    return picture.both.view();
  }

  video::StreamInfo info_of(ChartSize size, int channels) const {
    video::StreamInfo info;
    info.kind = request_.stream->parse_kind();
    if (world_stream_ && world_stream_->info().kind == info.kind) info = world_stream_->info();
    info.width = size.width;
    info.height = size.height;
    info.channels = channels < 3 ? 1 : 3;
    if (info.kind == video::StreamKind::pfm) info.bits = 32;
    if (info.kind == video::StreamKind::y4m && (info.channels == 1) != (info.chroma == video::Chroma::mono))
      info.chroma = info.channels == 1 ? video::Chroma::mono : video::Chroma::c420jpeg;
    info.aspect_numerator = info.aspect_denominator = 1;
    if (world_stream_ && info.rate_numerator == 0) {
      info.rate_numerator = world_stream_->info().rate_numerator;
      info.rate_denominator = world_stream_->info().rate_denominator;
    }
    if (const auto rate = request_.stream->parse_rate())
      std::tie(info.rate_numerator, info.rate_denominator) = *rate;
    return info;
  }

  void put(Frame& frame) {
    if (!outputs_) writer_->put(frame.made);
    losses_ += frame.losses;
    ++done_;
    if (progress_.progress && !list_.empty())
      progress_.progress(static_cast<double>(done_) / static_cast<double>(list_.size()));
  }

  const ViewRequest& request_;
  std::vector<int> list_;  ///< of frames; empty: as many as the stream has
  std::size_t taken_ = 0, done_ = 0, complete_ = 0;
  int next_ = 0;  ///< of a stream
  std::optional<WorldStream> world_stream_;
  std::optional<StoredFrames> stored_;
  std::optional<FrameNames> inputs_, outputs_;
  std::optional<Worlds> still_;
  mutable std::once_flag opened_;
  mutable std::optional<video::FrameWriter> writer_;
  std::string digest_;
  Monitor progress_;
  io::WriteReport losses_;
};

void ViewRequest::run() {
  const bool many = stream->asked() || FrameNames::has_place(out);
  if (many) {
    if (stream->asked() && in != "-" && out != "-")
      throw UsageError("--stream: is for standard input or output: name one of IN and OUT -");
    if (resume && stream->asked()) throw UsageError("--resume: is for numbered files, not for streams");
    if (reads_stream() && !writes_stream() && !FrameNames::has_place(out))
      throw UsageError("--stream: needs a place for the frame's number in OUT: view_%04d.png");
    if (pair && reads_stream())
      throw UsageError("--pair: is for files; of a stream, take one eye with --eye");
    return Sequence(*this).run();
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
