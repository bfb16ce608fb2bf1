// How long it takes to filter a lat-long into a chain of GGX levels, in memory: with its plan and without,
// for inputs of several sizes, and with more lobes besides.

#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>

#include "harness.h"
#include "lighting.h"
#include "welkin/base/parallel.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kFace = 256, kLevels = 9;

const sphere::AnyParameterization& cube() {
  static const auto made = sphere::AnyParameterization::make("cube");
  return made;
}

/// As for a file, which has none.
PrefilterOptions without_borders() {
  PrefilterOptions options;
  options.borders = false;
  return options;
}

/// Plans and filters, as a caller does who has one map.
std::function<void()> whole_job(const Map& source, const std::vector<PrefilterLevel>& levels) {
  return [&source, levels] { prefilter_map(source, cube(), levels, without_borders()); };
}

std::size_t values_of(const Map& map) {
  return static_cast<std::size_t>(map.charts()) * static_cast<std::size_t>(map.width()) *
         static_cast<std::size_t>(map.height()) * static_cast<std::size_t>(map.channels());
}

/// One pass over a map: the sum of its values, which is not used.
void read_once(const Map& map, std::vector<float>& sums) {
  parallel_for(map.height(), [&](int y) {
    constexpr std::size_t kLanes = 16;
    std::array<float, kLanes> lanes{};
    const float* row = map.level.chart(0).row(y);
    const std::size_t count = static_cast<std::size_t>(map.width() * map.channels()) / kLanes * kLanes;
    for (std::size_t i = 0; i < count; i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += row[i + lane];
    }
    sums[static_cast<std::size_t>(y)] = std::accumulate(lanes.begin(), lanes.end(), 0.0f);
  });
}

void chain_row(const Map& source, int threads, const Table& table) {
  const Threads limit(threads);
  const auto levels = ggx_chain(kFace, kLevels);
  const PrefilterPlan kept(shape_of(source), cube(), levels, without_borders());
  const PrefilterPlan with_borders(shape_of(source), cube(), levels);
  std::size_t values = values_of(source);
  for (const Map& level : kept.run(source)) values += values_of(level);
  std::vector<float> from(values, 1.0f), to(values);
  const auto timings = time_jobs(
      {whole_job(source, levels), [&] { const PrefilterPlan plan(shape_of(source), cube(), levels); },
       [&] { kept.run(source); }, [&] { std::memcpy(to.data(), from.data(), values * sizeof(float)); },
       [&] { with_borders.run(source); }},
      21);
  const Seconds whole = timings[0].median();
  std::string target, reached;
  if (threads == 1) {
    target = "≤ 30 ms CPU";
    reached = met(whole.cpu <= 0.030);
  } else if (threads == 2) {
    target = "≤ 16 ms wall";
    reached = met(whole.wall <= 0.016);
  }
  table.row({std::to_string(threads), cpu_milliseconds(timings[0]), wall_milliseconds(timings[0]),
             cpu_milliseconds(timings[1]), cpu_milliseconds(timings[2]), wall_milliseconds(timings[2]),
             fixed(1e3 * difference(timings[4], timings[2]), 1), cpu_milliseconds(timings[3]),
             fixed(ratio(timings[0], timings[3]), 1), target, reached});
}

/// before: how many passes a row with a smaller source took. Returns how many this one did.
double size_row(const Map& small, int width, int threads, std::optional<double> before, const Table& table) {
  const Threads limit(threads);
  const Map source = lighting_picture(width);
  const auto levels = ggx_chain(kFace, kLevels);
  std::vector<float> sums(static_cast<std::size_t>(source.height()));
  const auto timings =
      time_jobs({whole_job(source, levels), whole_job(small, levels), [&] { read_once(source, sums); }},
                width > 4096 ? 7 : 15);
  const double more = difference(timings[0], timings[1]), passes = ratio(timings[0], timings[2]);
  std::string target, reached;
  if (width == 4096) {
    target = "≤ 18 ms more";
    reached = met(more <= 0.018);
  } else if (before) {
    target = "≤ " + fixed(*before, 1) + " passes";
    reached = met(passes <= *before);
  }
  const double megatexels = 1e-6 * (static_cast<double>(width) * width / 2 - 1024.0 * 512);
  table.row({std::to_string(width) + "×" + std::to_string(width / 2), std::to_string(threads),
             cpu_milliseconds(timings[0]), wall_milliseconds(timings[0]), fixed(1e3 * more, 1),
             fixed(1e3 * more / megatexels, 2), cpu_milliseconds(timings[2]), fixed(passes, 1), target,
             reached});
  return passes;
}

/// Lambert and six Phong lobes beside the chain.
void more_lobes(const Map& source, int threads) {
  const auto chain = ggx_chain(kFace, kLevels);
  auto more = chain;
  for (const char* spec : {"lambert", "phong,exponent=4", "phong,exponent=8", "phong,exponent=16",
                           "phong,exponent=32", "phong,exponent=64", "phong,exponent=128"}) {
    more.push_back({{64, 64}, lobe::AnyLobe::make(spec)});
  }
  heading("Lambert and six Phong lobes besides");
  paragraph(
      "The same chain, and from the same map Lambert's lobe and Phong's of exponents 4, 8, 16, 32, 64 and "
      "128 "
      "into cubes of 6×64. Errors, relative RMSE / maximum, are the largest of the seven, measured as in the "
      "next section.");
  const Table table({"threads", "chain, CPU ms", "with seven more", "more, CPU ms", "wall ms, all",
                     "errors, %", "target", "met"});
  const std::vector<Map> results = prefilter_map(source, cube(), more);
  const PrefilterReference reference(source);
  LevelErrors worst;
  for (std::size_t i = chain.size(); i < more.size(); ++i) {
    const LevelErrors errors = errors_of(reference, results[i], more[i].lobe);
    worst.relative_rmse = std::max(worst.relative_rmse, errors.relative_rmse);
    worst.maximum = std::max(worst.maximum, errors.maximum);
  }
  for (const int count : threads > 1 ? std::vector{1, threads} : std::vector{1}) {
    const Threads limit(count);
    const auto timings = time_jobs({whole_job(source, chain), whole_job(source, more)}, 21);
    const double extra = difference(timings[1], timings[0]);
    table.row({std::to_string(count), cpu_milliseconds(timings[0]), cpu_milliseconds(timings[1]),
               fixed(1e3 * extra, 1), wall_milliseconds(timings[1]), errors_cell(worst), "≤ 10 ms more",
               met(extra <= 0.010)});
  }
}

}  // namespace

int main() {
  const Threads threads;
  const Map source = lighting_picture(1024);
  heading("Pre-filtering: a chain of GGX levels, in memory");
  paragraph(
      "A lat-long of 1024×512, RGB float, into a cube of 6×256 and 8 smaller levels, roughness 0, ⅛ … 1. "
      "*Plan* is what depends on sizes and lobes alone and can be kept for any number of maps; *kept plan* "
      "is "
      "what a further map takes. *Borders* is what filling the levels' borders takes besides, for those who "
      "look them up. *Copy* is one copy "
      "of as many bytes as the source and all levels have.");
  {
    const Table table({"threads", "plan and filter, CPU ms", "wall ms", "plan, CPU ms", "kept plan, CPU ms",
                       "wall ms", "borders, CPU ms", "copy, CPU ms", "× copy", "target", "met"});
    chain_row(source, 1, table);
    if (threads.count() > 1) chain_row(source, threads.count(), table);
  }
  heading("Pre-filtering: larger sources");
  paragraph(
      "The same chain, its plan included. *Pass* is one pass over the source: the sum of its values, on as "
      "many "
      "threads. The time grows no faster than a pass when it is no more passes than for the source a quarter "
      "the size.");
  {
    const Table table({"source", "threads", "CPU ms", "wall ms", "more than 1024×512, CPU ms",
                       "more, per million texels", "pass, CPU ms", "passes", "target", "met"});
    if (threads.count() > 1) size_row(source, 4096, 1, {}, table);
    double passes = size_row(source, 4096, threads.count(), {}, table);
    for (const int width : {8192, 16384}) passes = size_row(source, width, threads.count(), passes, table);
  }
  more_lobes(source, threads.count());
}
