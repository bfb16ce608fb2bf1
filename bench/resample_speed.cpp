// How long it takes to resample a lat-long to a cube, beside the same texels fetched at positions that are
// known beforehand, and how exact those positions are.
//
// resample_speed                     prints the tables
// resample_speed gather WIDTH FACE   prints the CPU seconds of the latter alone, from a lat-long so wide

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "harness.h"
#include "pictures.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/fetch.h"
#include "welkin/filter/resample.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

constexpr int kTileWidth = 32, kTileHeight = 8;
constexpr std::size_t kTileTexels = kTileWidth * kTileHeight;

/// Where every texel of the target lies in the source, tile after tile, as the float kernels find it.
struct Positions {
  std::vector<float> chart, u, v;

  Positions(const Map& source, const Map& target) {
    const std::size_t texels = static_cast<std::size_t>(target.charts()) *
                               static_cast<std::size_t>(target.width()) *
                               static_cast<std::size_t>(target.height());
    for (auto* each : {&chart, &u, &v}) each->resize(texels);
    const auto &t = target.parameterization, &s = source.parameterization;
    parallel_for(static_cast<int>(texels / kTileTexels), [&](int tile) {
      float target_u[kTileTexels], target_v[kTileTexels], x[kTileTexels], y[kTileTexels], z[kTileTexels];
      const auto [face, x0, y0] = corner(target, tile);
      for (std::size_t i = 0; i < kTileTexels; ++i) {
        target_u[i] = (static_cast<float>(x0 + static_cast<int>(i) % kTileWidth) + 0.5f) /
                      static_cast<float>(target.width());
        target_v[i] = (static_cast<float>(y0 + static_cast<int>(i) / kTileWidth) + 0.5f) /
                      static_cast<float>(target.height());
      }
      const std::size_t from = static_cast<std::size_t>(tile) * kTileTexels;
      t.kernels().to_sphere(t.self(), face, target_u, target_v, x, y, z, kTileTexels);
      s.kernels().from_sphere(s.self(), x, y, z, &chart[from], &u[from], &v[from], kTileTexels);
    });
  }

  struct Corner {
    int face, x, y;
  };
  static Corner corner(const Map& target, int tile) {
    const int across = target.width() / kTileWidth, down = target.height() / kTileHeight;
    return {tile / (across * down), tile % across * kTileWidth, tile / across % down * kTileHeight};
  }
};

/// The floor: the library's own bilinear kernel at positions that lie ready in memory, and the result
/// written.
void gather(const Map& source, const Positions& positions, Map& target) {
  const Fetch fetch = fetch_kernels(3).bilinear;
  const LevelView view = view_of(source.level);
  const int across = target.width() / kTileWidth;
  parallel_for(static_cast<int>(positions.u.size() / kTileTexels) / across, [&](int band) {
    float pixels[kTileTexels * 3 + 8];
    for (int tile = band * across; tile < (band + 1) * across; ++tile) {
      const std::size_t from = static_cast<std::size_t>(tile) * kTileTexels;
      fetch(view, &positions.chart[from], &positions.u[from], &positions.v[from], pixels, kTileTexels);
      const auto [face, x, y] = Positions::corner(target, tile);
      for (int row = 0; row < kTileHeight; ++row) {
        std::memcpy(target.level.chart(face).at(x, y + row), pixels + row * kTileWidth * 3,
                    kTileWidth * 3 * sizeof(float));
      }
    }
  });
}

/// Source texels between where the float kernels find a texel and where float64 does.
struct PositionError {
  double rms = 0, maximum = 0;
};

PositionError position_error(const Map& source, const Map& target, const Positions& positions) {
  const auto &t = target.parameterization, &s = source.parameterization;
  const int tiles = static_cast<int>(positions.u.size() / kTileTexels);
  std::vector<double> sums(static_cast<std::size_t>(tiles)), maximum(sums.size());
  parallel_for(tiles, [&](int tile) {
    const auto [face, x0, y0] = Positions::corner(target, tile);
    for (std::size_t i = 0; i < kTileTexels; ++i) {
      const double u = (x0 + static_cast<int>(i) % kTileWidth + 0.5) / target.width();
      const double v = (y0 + static_cast<int>(i) / kTileWidth + 0.5) / target.height();
      const auto exact = s.from_sphere(t.to_sphere(face, u, v));
      const std::size_t at = static_cast<std::size_t>(tile) * kTileTexels + i;
      double du = std::fabs(static_cast<double>(positions.u[at]) - exact.u);
      du = std::min(du, 1 - du);  // the left edge is the right edge
      const double dv = std::fabs(static_cast<double>(positions.v[at]) - exact.v);
      const double error = std::hypot(du * source.width(), dv * source.height());
      sums[static_cast<std::size_t>(tile)] += error * error;
      maximum[static_cast<std::size_t>(tile)] = std::max(maximum[static_cast<std::size_t>(tile)], error);
    }
  });
  double sum = 0;
  for (const double each : sums) sum += each;
  return {std::sqrt(sum / static_cast<double>(positions.u.size())),
          *std::max_element(maximum.begin(), maximum.end())};
}

using Row = std::vector<std::string>;

/// Prints the row of times, and returns the row about positions. max_cpu: seconds, or 0 for a size that is
/// not judged by itself.
Row run_size(int width, int face, double max_cpu, const Table& times) {
  const Map source = noise_picture(width, width / 2);
  const auto cube = sphere::AnyParameterization::make("cube");
  Map target(cube, face, face, 3), fetched(cube, face, face, 3);
  const Positions positions(source, target);
  ResampleOptions options;
  options.filter = Filter::bilinear;
  std::vector<float> from(static_cast<std::size_t>(width) * static_cast<std::size_t>(width / 2) * 3, 1.0f),
      to(from);
  const auto timings =
      time_jobs({[&] { resample(source, target, options); }, [&] { gather(source, positions, fetched); },
                 [&] { std::memcpy(to.data(), from.data(), from.size() * sizeof(float)); }},
                11);
  const double over_floor = ratio(timings[0], timings[1]);
  const std::string work =
      std::to_string(width) + "×" + std::to_string(width / 2) + " → cube 6×" + std::to_string(face);
  const bool judged = max_cpu > 0;
  const bool fast = over_floor <= 1.5 && (!judged || timings[0].median().cpu <= max_cpu);
  times.row({work, cpu_cell(timings[0]), wall_cell(timings[0]), cpu_cell(timings[1]), wall_cell(timings[1]),
             fixed(over_floor, 2), cpu_cell(timings[2]),
             (judged ? "≤ " + fixed(max_cpu, 2) + " s, " : std::string()) + "ratio ≤ 1.5", met(fast)});
  const PositionError error = position_error(source, target, positions);
  return {work, fixed(error.rms, 5), fixed(error.maximum, 5), judged ? "0.000" : "",
          judged ? met(error.maximum < 0.0005) : ""};
}

/// CPU seconds of the floor.
double gather_cost(int width, int face) {
  const Map source = noise_picture(width, width / 2);
  Map target(sphere::AnyParameterization::make("cube"), face, face, 3);
  const Positions positions(source, target);
  return time_jobs({[&] { gather(source, positions, target); }}, 5)[0].median().cpu;
}

}  // namespace

int main(int argc, char** argv) {
  const Threads threads;
  if (argc == 4 && std::strcmp(argv[1], "gather") == 0) {
    std::printf("%.5f\n", gather_cost(std::atoi(argv[2]), std::atoi(argv[3])));
    return 0;
  }
  heading("Bilinear, lat-long to cube, in memory");
  paragraph(
      "RGB float. *Gather* is the floor: the same bilinear kernel on the same threads, reading the positions "
      "of "
      "all texels from "
      "memory instead of computing them, and writing the same result. *Copy* is one copy of the source.");
  std::vector<Row> rows;
  {
    const Table times({"work", "Welkin, CPU s", "wall s", "gather, CPU s", "wall s", "ratio", "copy, CPU s",
                       "target", "met"});
    rows.push_back(run_size(4096, 1024, 0.15, times));
    rows.push_back(run_size(8192, 2048, 0, times));
  }
  paragraph(
      "\nHow far the positions at which the source is read lie from those that float64 finds, in source "
      "texels:");
  const Table errors({"work", "rms", "max", "target", "met"});
  for (const Row& row : rows) errors.row(row);
}
