#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <tuple>

#include "progress.h"
#include "view_frames.h"
#include "welkin/base/error.h"
#include "welkin/io/process.h"
#include "welkin/sequence/frame_pipeline.h"
#include "welkin/sequence/made_note.h"

namespace welkin::cli {
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
    if (!world_stream_ && !inputs_) {
      still_ = request_.fit(request_.read_worlds(request_.in, true), example_file(), false);
      if (request_.shutter) still_->blurred.emplace(still_->left);
    }
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
    Worlds worlds = world_stream_ ? Worlds{.left = world_stream_->world(frame.taken)}
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
    losses_ = losses_ + frame.losses;
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

void ViewRequest::run_frames() const {
  Sequence(*this).run();
}

}  // namespace welkin::cli
