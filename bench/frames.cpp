// 300 frames of 1024×512 baked to diffuse light, every one, against reading them alone.
//
// frames WORK_FOLDER
#include <fcntl.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness.h"
#include "pictures.h"
#include "welkin/map_file/map_file.h"
#include "welkin/sequence/bake_frames.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kFrames = 300;

struct Kind {
  std::string name, extension;
  io::WriteOptions write;
  bool cached = true;
};

FrameNames frames_in(const std::filesystem::path& folder, const Kind& kind) {
  return FrameNames(folder / ("frame_%04d." + kind.extension));
}

/// Files of their own, of a few pictures. `map` becomes brighter from one to the next.
void make_frames(Map& map, const FrameNames& names, const Kind& kind) {
  constexpr int kPictures = 10;
  WriteMapOptions options;
  options.image = kind.write;
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame < kPictures) {
      for (int y = 0; y < map.height(); ++y) {
        float* row = map.level.chart(0).row(y);
        for (int i = 0; i < 3 * map.width(); ++i) row[i] *= 1 + 0.01f * static_cast<float>(i % 7);
      }
      write_map(names.file(frame), map, options);
    } else {
      std::filesystem::copy_file(names.file(frame % kPictures), names.file(frame));
    }
  }
}

/// Out of the page cache, as far as the system allows.
void forget(const FrameNames& names) {
  for (int frame = 0; frame < kFrames; ++frame) {
    const int file = ::open(names.file(frame).c_str(), O_RDONLY);
    ::fdatasync(file);
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
  }
}

void read_one_by_one(const FrameNames& names) {
  for (int frame = 0; frame < kFrames; ++frame) read_map(names.file(frame));
}

/// As many at once as bake_frames has in work.
void read_at_once(const FrameNames& names) {
  int next = 0;
  tbb::parallel_pipeline(
      static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 2,
      tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) {
        if (next == kFrames) control.stop();
        return next++;
      }) & tbb::make_filter<int, void>(tbb::filter_mode::parallel, [&](int frame) {
        tbb::this_task_arena::isolate([&] { read_map(names.file(frame)); });
      }));
}

void bake_all(const FrameNames& in, int every) {
  BakeFramesOptions options;
  options.bake.lobe = lobe::AnyLobe::make("lambert");
  options.bake.target = sphere::AnyParameterization::make("latlong");
  options.every = every;
  const std::filesystem::path folder = in.name().parent_path();
  bake_frames(in, FrameNames(folder / "diffuse_%04d.exr"), options);
}

std::string rate(const Timing& timing) {
  return fixed(kFrames / timing.median().wall, 0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: frames WORK_FOLDER\n");
    return 2;
  }
  const Threads threads;
  heading("Sequences: 300 frames of 1024×512 to diffuse light");
  paragraph(
      "`bake_frames` to a lat-long of 40×20, EXR, of Lambert's lobe: reading, baking and writing; against "
      "reading alone, "
      "by the same reader: one frame after another, and as many at once as `bake_frames` has in work. Frames "
      "a second "
      "on the clock, median of 3 rounds, in each of which all take turns. *Not cached*: the files are "
      "dropped from the "
      "page cache before each.");
  Map picture = detailed_picture(1024);
  Table table({"frames", "threads", "reading, one by one", "at once", "every frame baked", "of one by one",
               "of at once", "every 10th", "CPU ms a frame, reading", "every frame baked", "target", "met"});
  for (const Kind& kind : {Kind{"HDR", "hdr", {}, true}, Kind{"EXR float, ZIP", "exr", {}, true},
                           Kind{"HDR, not cached", "hdr", {}, false}}) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / "frames";
    std::filesystem::create_directories(folder);
    const FrameNames in = frames_in(folder, kind);
    make_frames(picture, in, kind);
    const auto job = [&](auto work) -> std::function<void()> { return [&in, work] { work(in); }; };
    std::vector<Timing> timings(4);
    // Forgetting isn't timed, so rounds are made here.
    constexpr int kRounds = 3;
    const std::function<void()> jobs[] = {job(read_one_by_one), job(read_at_once),
                                          job([](const FrameNames& names) { bake_all(names, 1); }),
                                          job([](const FrameNames& names) { bake_all(names, 10); })};
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t k = 0; k < timings.size(); ++k) {
        if (!kind.cached) forget(in);
        timings[k].runs.push_back(time_once(jobs[k]));
      }
    }
    const double one = timings[2].median().wall;
    const double of_one_by_one = timings[0].median().wall / one, of_at_once = timings[1].median().wall / one;
    table.row({kind.name, std::to_string(threads.count()), rate(timings[0]), rate(timings[1]),
               rate(timings[2]), fixed(100 * of_one_by_one, 0) + " %", fixed(100 * of_at_once, 0) + " %",
               rate(timings[3]), fixed(1e3 * timings[1].median().cpu / kFrames, 2),
               fixed(1e3 * timings[2].median().cpu / kFrames, 2), "≥ 90 % of reading",
               met(of_one_by_one >= 0.9)});
    std::filesystem::remove_all(folder);
  }
}
