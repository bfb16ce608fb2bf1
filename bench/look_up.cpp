// What a look-up along one direction costs, alone and among many, beside the loop that Sampler replaced.

#include <cstdio>
#include <random>
#include <thread>

#include "harness.h"
#include "welkin/filter/fetch.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/borders.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr std::size_t kDirections = 65536;
/// A run takes so many of them, the next run the next ones: it ends before other programs get the processor.
constexpr std::size_t kRun = 4096;
constexpr int kRounds = 64;

struct Directions {
  std::vector<Vec3<float>> narrow;
  std::vector<Vec3d> wide;
  std::vector<float> levels;

  Directions() : narrow(kDirections), wide(kDirections), levels(kDirections) {
    std::mt19937 random(1);
    std::normal_distribution<float> along;
    std::uniform_real_distribution<float> level(0, 4);
    for (std::size_t i = 0; i < kDirections; ++i) {
      narrow[i] = {along(random), along(random), along(random)};
      wide[i] = {narrow[i].x, narrow[i].y, narrow[i].z};
      levels[i] = level(random);
    }
  }
};

struct Case {
  const char* name;
  int width, height;
};
constexpr Case kCases[] = {{"cube", 256, 256}, {"latlong", 1024, 512}, {"octahedral", 640, 640}};

Map noise_map(const Case& which, int channels) {
  Map map(sphere::AnyParameterization::make(which.name), which.width, which.height, channels);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0, 2);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int i = 0; i < map.width() * channels; ++i) map.level.chart(chart).row(y)[i] = value(random);
    }
  }
  fill_borders(map);
  return map;
}

/// The floor that is compared with: every position in float64, sixteen for a pack, and memory for each call.
void float64_loop(const Map& map, std::span<const Vec3d> directions, std::span<float> out) {
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  const Fetch fetch = fetch_for(Filter::bilinear, false, map.channels());
  const LevelView view = view_of(map.level);
  constexpr std::size_t kBatch = 64;
  float chart[kBatch], u[kBatch], v[kBatch];
  std::vector<float> values(kBatch * channels + 8);
  for (std::size_t from = 0; from < directions.size(); from += kBatch) {
    const std::size_t count = std::min(kBatch, directions.size() - from);
    bool covered[kBatch];
    for (std::size_t i = 0; i < sphere::padded(count); ++i) {
      const Vec3d d = map.orientation * normalize(directions[from + std::min(i, count - 1)]);
      const auto position = map.parameterization.from_sphere(d);
      covered[i] = map.parameterization.covers(d);
      chart[i] = static_cast<float>(position.chart);
      u[i] = static_cast<float>(position.u);
      v[i] = static_cast<float>(position.v);
    }
    fetch(view, chart, u, v, values.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < channels; ++c) {
        out[(from + i) * channels + c] = covered[i] ? values[i * channels + c] : 0.0f;
      }
    }
  }
}

double nanoseconds(const Timing& timing) {
  return timing.best().cpu / static_cast<double>(kRun) * 1e9;
}

std::string title(const Case& which) {
  return std::string(which.name) + " " + std::to_string(which.width) + "×" + std::to_string(which.height);
}

using Job = std::function<void()>;

/// work(from) looks directions from … from+kRun−1 up, others in each run and in each job of a round.
template <class Work>
void add_job(std::vector<Job>& jobs, const Work& work) {
  jobs.push_back([work, from = jobs.size() * 5 * kRun]() mutable {
    from = (from + kRun) % kDirections;
    work(from);
  });
}

/// One call for each direction.
template <class Direction>
void add_alone(std::vector<Job>& jobs, const Sampler& sampler, const std::vector<Direction>& directions,
               std::vector<float>& out) {
  add_job(jobs, [&](std::size_t from) {
    const auto channels = static_cast<std::size_t>(sampler.channels());
    for (std::size_t i = from; i < from + kRun; ++i) {
      sampler.look_up(directions[i], {&out[i * channels], channels});
    }
  });
}

/// One call for all.
template <class Direction>
void add_many(std::vector<Job>& jobs, const Sampler& sampler, const std::vector<Direction>& directions,
              std::vector<float>& out) {
  add_job(jobs, [&](std::size_t from) {
    const auto channels = static_cast<std::size_t>(sampler.channels());
    sampler.look_up(std::span(directions).subspan(from, kRun), {&out[from * channels], kRun * channels});
  });
}

void print_one_and_many(const Directions& directions) {
  heading("Looking up single directions");
  paragraph(
      "Nanoseconds of processor time for a bilinear look-up along random directions of an RGB map, one "
      "thread, "
      "the best of 64 rounds of 4096 directions: alone (one call for each) and among many (one call for "
      "all). *Float64 "
      "loop* is what `Sampler` replaced. *Own levels*: each direction at a random level of the "
      "pyramid.");
  const Table table({"map", "float64 loop, alone", "many", "`Sampler`, alone", "many", "double, alone",
                     "many", "own levels, many", "target", "met"});
  std::vector<float> out(3 * kDirections);
  for (const Case& which : kCases) {
    const Map map = noise_map(which, 3);
    const Sampler sampler = Sampler::borrow(map, {.levels = 5});
    // Each by itself: they would take the caches from each other.
    std::vector<Job> loop, narrow, wide, own;
    add_job(loop, [&](std::size_t from) {
      for (std::size_t i = from; i < from + kRun; ++i) {
        float64_loop(map, {&directions.wide[i], 1}, {&out[3 * i], 3});
      }
    });
    add_job(loop, [&](std::size_t from) {
      float64_loop(map, {&directions.wide[from], kRun}, {&out[3 * from], 3 * kRun});
    });
    add_alone(narrow, sampler, directions.narrow, out);
    add_many(narrow, sampler, directions.narrow, out);
    add_alone(wide, sampler, directions.wide, out);
    add_many(wide, sampler, directions.wide, out);
    add_job(own, [&](std::size_t from) {
      sampler.look_up(std::span(directions.narrow).subspan(from, kRun), {&out[3 * from], 3 * kRun},
                      std::span(directions.levels).subspan(from, kRun));
    });
    std::vector<Timing> timings;
    for (const auto& jobs : {loop, narrow, wide, own}) {
      for (const Timing& timing : time_jobs(jobs, kRounds)) timings.push_back(timing);
    }
    std::vector<std::string> row{title(which)};
    for (const Timing& timing : timings) row.push_back(fixed(nanoseconds(timing), 1));
    row.push_back("alone ≤ 60, many ≤ 15");
    row.push_back(met(nanoseconds(timings[2]) <= 60 && nanoseconds(timings[3]) <= 15));
    table.row(row);
  }
}

void print_filters_and_channels(const Directions& directions) {
  paragraph(
      "\nThe same by filter and number of channels: float directions, alone / among many. *Two threads*: "
      "wall "
      "clock over the number of directions of both, bilinear, among many.");
  const Table table({"map", "channels", "nearest", "bilinear", "bicubic", "two threads"});
  for (const Case& which : kCases) {
    for (const int channels : {1, 3, 4}) {
      const Map map = noise_map(which, channels);
      const std::size_t values = kDirections * static_cast<std::size_t>(channels);
      std::vector<float> out(values), other(values);
      std::vector<Sampler> samplers;
      for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic}) {
        samplers.push_back(Sampler::borrow(map, {.filter = filter}));
      }
      std::vector<Job> jobs;
      for (const Sampler& sampler : samplers) {
        add_alone(jobs, sampler, directions.narrow, out);
        add_many(jobs, sampler, directions.narrow, out);
      }
      const auto timings = time_jobs(jobs, kRounds);
      const Sampler& bilinear = samplers[1];
      const auto together = time_jobs({[&] {
        std::thread second([&] { bilinear.look_up(directions.narrow, other); });
        bilinear.look_up(directions.narrow, out);
        second.join();
      }});
      std::vector<std::string> row{title(which), std::to_string(channels)};
      for (std::size_t i = 0; i < timings.size(); i += 2) {
        row.push_back(fixed(nanoseconds(timings[i]), 1) + " / " + fixed(nanoseconds(timings[i + 1]), 1));
      }
      row.push_back(fixed(together[0].best().wall / (2.0 * kDirections) * 1e9, 1));
      table.row(row);
    }
  }
}

}  // namespace

int main() {
  const Directions directions;
  print_one_and_many(directions);
  print_filters_and_channels(directions);
}
