#include "welkin/sequence/bake_frames.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/chain_file.h"
#include "welkin/measure/compare.h"
#include "welkin/sequence/failures.h"
#include "welkin/sequence/frame_checks.h"
#include "welkin/sequence/frame_plan.h"
#include "welkin/sequence/interpolate.h"
#include "welkin/sequence/made_note.h"
#include "welkin/sequence/stopwatch.h"

namespace welkin {

namespace fs = std::filesystem;
using namespace sequence;

namespace {

/// A frame on its way through the pipeline.
struct Travelling {
  BakedFrame what;
  std::vector<std::string> told;
  std::optional<Map> source;   ///< until it is filtered
  std::optional<Chain> chain;  ///< none: it failed
};
using Traveller = std::shared_ptr<Travelling>;

class FrameBaker {
 public:
  FrameBaker(const FrameNames& in, const FrameNames& out, const BakeFramesOptions& options)
      : in_(in), out_(out), options_(options), digest_(request_digest(in, options)) {}

  BakeFramesReport run();

 private:
  void plan_work();
  FramePlan plan_of(FrameRange range, const std::set<int>& there) const;
  void check_outputs(const Map& first);
  /// Reads and repairs a frame.
  void read(Travelling& traveller);
  void filter_and_write(Travelling& traveller);
  /// In the order of frames: writes those between the key frame before and this one.
  void join(const Traveller& traveller);
  void measure(const Travelling& truth, const Travelling& to);
  void write(int frame, const Chain& chain, const std::string& note, std::vector<int>& written);
  void tell(const Travelling& traveller);
  void count_one();
  void throw_if_cancelled() const {
    if (options_.monitor.cancelled && options_.monitor.cancelled()) throw Cancelled();
  }
  void run_pipeline(Traveller first);
  std::size_t frames_in_work(const Map& source) const;
  /// Throws what failed, if anything did.
  void rethrow_counting_finished() const;
  PrefilterShape shape_of(const Map& map) const {
    return {map.parameterization, {map.width(), map.height()}, map.channels()};
  }
  double share(int frame) const {
    return static_cast<double>(frame - before_->what.frame) / (after_ - before_->what.frame);
  }

  const FrameNames &in_, &out_;
  const BakeFramesOptions& options_;
  const std::string digest_;
  FramePlan work_;
  std::optional<Layout> layout_;
  std::optional<BakePlan> plan_;
  std::optional<PrefilterShape> shape_;
  Failures failures_;
  BakeFramesReport report_;
  std::mutex mutex_;  ///< of report_ while the pipeline runs
  std::set<std::string> told_;
  std::atomic<int> done_{0};
  std::atomic<double> read_seconds_{0}, filter_seconds_{0}, interpolate_seconds_{0}, write_seconds_{0};
  // Of join, one frame at a time.
  Traveller before_;                 ///< the last key frame
  std::vector<Traveller> held_out_;  ///< since then
  int after_ = 0;                    ///< the key frame that follows it
};

/// Which key frames a frame lies between; both are itself for a key frame.
std::pair<int, int> keys_around(const std::vector<int>& keys, int frame) {
  const auto to = std::lower_bound(keys.begin(), keys.end(), frame);
  return {*to == frame ? frame : *(to - 1), *to};
}

FramePlan FrameBaker::plan_of(FrameRange range, const std::set<int>& there) const {
  const std::vector<int> keys = key_frames(range, options_.every);
  const auto complete = [&](int frame) {
    if (!options_.resume) return false;
    const auto [from, to] = keys_around(keys, frame);
    const fs::path sources[] = {in_.file(from), in_.file(to)};
    const std::string note = from == to ? made_note(frame, digest_) : made_note(from, to, frame, digest_);
    return is_made(files_of(out_.file(frame), options_.bake.target), note, sources);
  };
  return plan_frames(
      range, {options_.every, options_.between, options_.held_out},
      [&](int frame) { return there.count(frame) > 0; }, complete);
}

void FrameBaker::plan_work() {
  require(options_.every >= 1 && options_.held_out >= 0,
          "a sequence has every 1 or more, held out 0 or more");
  const io::Capabilities& format = io::capabilities_for(out_.name());
  if (options_.resume && !format.attributes)
    throw Error(
        ErrorKind::unsupported, out_.name().string(),
        format.title + " holds no text that would tell which frames are complete: write EXR, KTX2 or HDR");
  const std::vector<int> there = in_.find();
  const FrameRange range = options_.frames.value_or(FrameRange{there.front(), there.back()});
  try {
    const std::vector<int> keys = key_frames(range, options_.every);
    check_sources_there(in_, keys, there);
    check_apart(in_, out_, there, options_.between ? key_frames(range, 1) : keys, options_.bake.target);
    work_ = plan_of(range, {there.begin(), there.end()});
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw in_file(in_.name().string(), error);
  }
  report_.frames = work_.frames;
  report_.complete = work_.complete;
}

void FrameBaker::check_outputs(const Map& first) {
  const ChartSize size = default_bake_size(options_.bake);
  const int levels = bake_level_count(options_.bake);
  const auto p = options_.bake.target.at_size(size.width, size.height);
  layout_ = options_.layout ? *options_.layout : default_layout(p, out_.name(), levels);
  const std::set<int> complete(work_.complete.begin(), work_.complete.end());
  for (const int frame : work_.frames) {
    if (complete.count(frame) == 0)
      check_write_map(out_.file(frame), {p, *layout_}, size, levels, first.channel_names, options_.write);
  }
}

void FrameBaker::read(Travelling& traveller) {
  const fs::path file = in_.file(traveller.what.frame);
  try {
    std::optional<Map> map;
    {
      const Stopwatch watch(read_seconds_);
      MapReader reader = open_frame(file, options_, true);
      traveller.told = reader.info().image.warnings;
      map = reader.read();
    }
    const Stopwatch watch(filter_seconds_);
    if (options_.prepare) options_.prepare(*map, file);
    if (!options_.bake.keep_alpha && map->channel_names == default_channel_names(4))
      map = without_alpha(*map);
    const auto notes = fit_channels(*map, out_.file(traveller.what.frame), options_.write.image);
    traveller.told.insert(traveller.told.end(), notes.begin(), notes.end());
    if (!map->parameterization.whole_world())
      traveller.told.push_back("doesn't show all of the sphere; the rest is black");
    if (shape_) check_shape(file, shape_of(*map), in_.file(work_.baked.front().frame), *shape_);
    traveller.source = std::move(map);
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw in_file(file.string(), error);
  }
}

void FrameBaker::write(int frame, const Chain& chain, const std::string& note, std::vector<int>& written) {
  throw_if_cancelled();
  const Stopwatch watch(write_seconds_);
  WriteMapOptions how = options_.write;
  if (io::capabilities_for(out_.name()).attributes) how.image.attributes[kFrameKey] = note;
  const io::WriteReport losses = write_chain(out_.file(frame), chain, *layout_, how);
  const std::scoped_lock lock(mutex_);
  report_.losses = report_.losses + losses;
  written.push_back(frame);
}

void FrameBaker::count_one() {
  const std::size_t held_out = static_cast<std::size_t>(std::count_if(
      work_.baked.begin(), work_.baked.end(), [](const BakedFrame& each) { return !each.key; }));
  const std::size_t all = work_.frames.size() - work_.complete.size() + held_out;
  const int done = ++done_;
  if (options_.monitor.progress)
    options_.monitor.progress(static_cast<double>(done) / static_cast<double>(all));
}

void FrameBaker::filter_and_write(Travelling& traveller) {
  const BakedFrame& what = traveller.what;
  {
    const Stopwatch watch(filter_seconds_);
    Chain chain = filter_frame(*plan_, *traveller.source, in_.file(what.frame), traveller.told,
                               {nullptr, options_.monitor.cancelled});
    traveller.source.reset();
    if (options_.factor != 1) {
      for (Map& level : chain.levels) scale(level, options_.factor);
    }
    traveller.chain = std::move(chain);
  }
  if (what.write) write(what.frame, *traveller.chain, made_note(what.frame, digest_), report_.baked);
  if (what.write || !what.key) count_one();
}

void FrameBaker::measure(const Travelling& truth, const Travelling& to) {
  HeldOutFrame measured{truth.what.frame};
  const Chain guess = interpolated(*before_->chain, *to.chain, share(measured.frame));
  CompareOptions options;
  options.lights = 0;
  for (std::size_t k = 0; k < guess.levels.size(); ++k) {
    const ErrorMeasures error = compare(truth.chain->levels[k], guess.levels[k], options).all;
    measured.relative_rmse = std::max(measured.relative_rmse, error.relative_rmse);
    measured.maximum = std::max(measured.maximum, error.maximum_relative);
  }
  report_.held_out.push_back(measured);
}

void FrameBaker::join(const Traveller& traveller) {
  tell(*traveller);
  if (!traveller->what.key) {
    held_out_.push_back(traveller);
    return;
  }
  const std::vector<Traveller> held_out = std::exchange(held_out_, {});
  if (traveller->what.joins && before_ && before_->chain && traveller->chain) {
    after_ = traveller->what.frame;
    for (const Traveller& truth : held_out) {
      if (!truth->chain) continue;
      const Stopwatch watch(interpolate_seconds_);
      failures_.guard(truth->what.frame, [&] { measure(*truth, *traveller); });
    }
    const auto from =
        std::upper_bound(work_.interpolated.begin(), work_.interpolated.end(), before_->what.frame);
    const auto to = std::lower_bound(from, work_.interpolated.end(), after_);
    tbb::parallel_for(from - work_.interpolated.begin(), to - work_.interpolated.begin(),
                      [&](std::ptrdiff_t i) {
                        const int frame = work_.interpolated[static_cast<std::size_t>(i)];
                        failures_.guard(frame, [&] {
                          throw_if_cancelled();
                          std::optional<Chain> chain;
                          {
                            const Stopwatch watch(interpolate_seconds_);
                            chain = interpolated(*before_->chain, *traveller->chain, share(frame));
                          }
                          write(frame, *chain, made_note(before_->what.frame, after_, frame, digest_),
                                report_.interpolated);
                          count_one();
                        });
                      });
  }
  before_ = traveller;
}

void FrameBaker::tell(const Travelling& traveller) {
  if (!options_.told) return;
  for (const std::string& text : traveller.told) {
    if (told_.insert(text).second)
      failures_.guard(traveller.what.frame, [&] { options_.told(in_.file(traveller.what.frame), text); });
  }
}

std::size_t FrameBaker::frames_in_work(const Map& source) const {
  const auto bytes = [](int charts, ChartSize size, int channels) {
    return static_cast<std::uint64_t>(charts) * static_cast<std::uint64_t>(size.width + 2 * kBorder) *
           static_cast<std::uint64_t>(size.height + 2 * kBorder) * static_cast<std::uint64_t>(channels) *
           sizeof(float);
  };
  // The source, about as much for filtering it, and the results.
  std::uint64_t each = 2 * bytes(source.charts(), {source.width(), source.height()}, source.channels());
  for (const PrefilterLevel& level : plan_->levels())
    each += bytes(options_.bake.target.charts(), level.size, source.channels());
  const auto most = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency()) + 2;
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(options_.max_bytes / each, 1, most));
}

void FrameBaker::run_pipeline(Traveller first) {
  std::size_t next = 0;
  const std::size_t in_work = frames_in_work(*first->source);
  const auto take = [&](tbb::flow_control& control) -> Traveller {
    if (next == work_.baked.size() || failures_.any()) {
      control.stop();
      return nullptr;
    }
    if (next++ == 0) return std::exchange(first, nullptr);
    auto traveller = std::make_shared<Travelling>();
    traveller->what = work_.baked[next - 1];
    return traveller;
  };
  const auto make = [&](Traveller traveller) {
    failures_.guard(traveller->what.frame, [&] {
      throw_if_cancelled();
      // A thread that waits for the loops of this frame doesn't begin another.
      tbb::this_task_arena::isolate([&] {
        if (!traveller->source) read(*traveller);
        filter_and_write(*traveller);
      });
    });
    return traveller;
  };
  // Isolated: not cancelled with a caller's tasks, see Failures.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  tbb::parallel_pipeline(
      in_work,
      tbb::make_filter<void, Traveller>(tbb::filter_mode::serial_in_order, take) &
          tbb::make_filter<Traveller, Traveller>(tbb::filter_mode::parallel, make) &
          tbb::make_filter<Traveller, void>(tbb::filter_mode::serial_in_order,
                                            [&](const Traveller& traveller) { join(traveller); }),
      context);
}

void FrameBaker::rethrow_counting_finished() const {
  const std::size_t finished = report_.baked.size() + report_.interpolated.size() + report_.complete.size();
  try {
    failures_.rethrow();
  } catch (const Error& error) {
    if (finished == 0) throw;
    throw Error(error.kind(), error.file(),
                error.cause() + "; " + std::to_string(finished) + " of " +
                    std::to_string(work_.frames.size()) + " frames are finished");
  }
}

BakeFramesReport FrameBaker::run() {
  const auto start = std::chrono::steady_clock::now();
  plan_work();
  if (!work_.baked.empty()) {
    check_source_shapes(in_, work_.baked, options_);
    auto first = std::make_shared<Travelling>();
    first->what = work_.baked.front();
    read(*first);
    check_outputs(*first->source);
    shape_ = shape_of(*first->source);
    std::atomic<double> plan_seconds{0};
    {
      const Stopwatch watch(plan_seconds);
      plan_.emplace(*shape_, options_.bake);
    }
    report_.seconds.plan = plan_seconds;
    report_.levels = plan_->levels();
    report_.methods = plan_->methods();
    run_pipeline(std::move(first));
    rethrow_counting_finished();
  }
  for (std::vector<int>* frames : {&report_.baked, &report_.interpolated})
    std::sort(frames->begin(), frames->end());
  BakeFramesSeconds& seconds = report_.seconds;
  seconds.read = read_seconds_;
  seconds.filter = filter_seconds_;
  seconds.interpolate = interpolate_seconds_;
  seconds.write = write_seconds_;
  seconds.all = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::move(report_);
}

}  // namespace

const HeldOutFrame* BakeFramesReport::worst() const {
  const auto found = std::max_element(
      held_out.begin(), held_out.end(),
      [](const HeldOutFrame& a, const HeldOutFrame& b) { return a.relative_rmse < b.relative_rmse; });
  return found == held_out.end() ? nullptr : &*found;
}

BakeFramesReport bake_frames(const FrameNames& in, const FrameNames& out, const BakeFramesOptions& options) {
  return FrameBaker(in, out, options).run();
}

}  // namespace welkin
