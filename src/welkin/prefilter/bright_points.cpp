#include "welkin/prefilter/bright_points.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

namespace welkin::prefilter {
namespace {

/// A point, or near a pole several side by side, no wider together than a quarter of a row is high.
struct Candidate {
  float size;
  int pack, column, lane;
  int count;
  /// Larger first; then by position, so that the choice doesn't depend on the threads.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(b.size, a.pack, a.column, a.lane) < std::tie(a.size, b.pack, b.column, b.lane);
  }
};

constexpr int kCells = 32;  ///< around; a pack high

struct PackSizes {
  double sum = 0;                                     ///< of |weight| over all channels
  float largest = 0;                                  ///< |weight|
  float dimmest = std::numeric_limits<float>::max();  ///< mean radiance of a cell, summed over channels
  double brightest = 0;                               ///< weight of a cell, summed over channels
};

PackSizes measure(const PointGrid& grid, int pack) {
  PackSizes sizes;
  const int width = grid.width, columns = (width + kCells - 1) / kCells;
  double solid_angle[16];
  const double step = kPi / grid.height;
  for (int lane = 0; lane < 16; ++lane) {
    const int north = pack * 8 + lane % 8;
    solid_angle[lane] = north < grid.height / 2 ? std::sin((north + 0.5) * step) * step * 2 * kPi / width : 0;
  }
  for (int first = 0; first < width; first += columns) {
    const int last = std::min(width, first + columns);
    float sum[16] = {}, largest[16] = {};
    for (int c = 0; c < grid.channels; ++c) {
      const float* weights = grid.at(pack, c);
      for (int x = first; x < last; ++x) {
        for (int lane = 0; lane < 16; ++lane) {
          const float size = std::fabs(weights[static_cast<std::ptrdiff_t>(x) * 16 + lane]);
          sum[lane] += size;
          largest[lane] = largest[lane] < size ? size : largest[lane];
        }
      }
    }
    for (int side = 0; side < 16; side += 8) {
      double weight = 0, cell = 0;
      for (int lane = side; lane < side + 8; ++lane) {
        weight += static_cast<double>(sum[lane]);
        cell += solid_angle[lane] * (last - first);
        sizes.largest = std::max(sizes.largest, largest[lane]);
      }
      sizes.sum += weight;
      sizes.brightest = std::max(sizes.brightest, weight);
      if (cell > 0) sizes.dimmest = std::min(sizes.dimmest, static_cast<float>(weight / cell));
    }
  }
  return sizes;
}

int row_of(const PointGrid& grid, int pack, int lane) {
  const int north = pack * 8 + lane % 8;
  return lane < 8 ? north : grid.height - 1 - north;
}

/// How many points of a row make one candidate.
int group_of(const PointGrid& grid, int pack, int lane) {
  const double theta = (row_of(grid, pack, lane) + 0.5) * kPi / grid.height;
  const double maximum = 0.125 * grid.width / grid.height / std::sin(theta);
  int count = 1;
  while (2 * count <= maximum && grid.width % (2 * count) == 0) count *= 2;
  return count;
}

float weight_of(const PointGrid& grid, const Candidate& candidate, int channel) {
  const float* at =
      grid.at(candidate.pack, channel) + static_cast<std::ptrdiff_t>(candidate.column) * 16 + candidate.lane;
  float sum = 0;
  for (int k = 0; k < candidate.count; ++k) sum += at[k * 16];
  return sum;
}

/// The points of one pack that have a channel above `threshold`.
void collect(const PointGrid& grid, int pack, float threshold, std::vector<Candidate>& found) {
  for (int lane = 0; lane < 16; ++lane) {
    if (pack * 8 + lane % 8 >= grid.height / 2) continue;
    const int count = group_of(grid, pack, lane);
    for (int column = 0; column < grid.width; column += count) {
      Candidate candidate{0, pack, column, lane, count};
      for (int c = 0; c < grid.channels; ++c) {
        candidate.size = std::max(candidate.size, std::fabs(weight_of(grid, candidate, c)));
      }
      if (candidate.size > threshold) found.push_back(candidate);
    }
  }
}

/// Removes these points from the grid.
void take(PointGrid& grid, std::span<const Candidate> candidates, BrightPoints& points) {
  // A box as wide as the column: Gauss's rule of three points.
  struct Part {
    double position, share;
  };
  static constexpr Part kPoint[] = {{0.5, 1}};
  static constexpr Part kBox[] = {
      {0.112701665379258, 5.0 / 18}, {0.5, 8.0 / 18}, {0.887298334620742, 5.0 / 18}};
  const std::span<const Part> parts =
      grid.boxes ? std::span<const Part>(kBox) : std::span<const Part>(kPoint);
  for (const Candidate& each : candidates) {
    const double theta = (row_of(grid, each.pack, each.lane) + 0.5) * kPi / grid.height;
    for (const Part& part : parts) {
      const double longitude = 2 * kPi * (0.5 - (each.column + part.position * each.count) / grid.width);
      points.x.push_back(static_cast<float>(std::sin(theta) * std::sin(longitude)));
      points.y.push_back(static_cast<float>(std::cos(theta)));
      points.z.push_back(static_cast<float>(std::sin(theta) * std::cos(longitude)));
      for (int c = 0; c < grid.channels; ++c) {
        points.weight.push_back(weight_of(grid, each, c) * static_cast<float>(part.share));
      }
    }
    for (int c = 0; c < grid.channels; ++c) {
      float* at = grid.at(each.pack, c) + static_cast<std::ptrdiff_t>(each.column) * 16 + each.lane;
      for (int k = 0; k < each.count; ++k) at[k * 16] = 0;
    }
  }
}

std::vector<PackSizes> measure_all(const PointGrid& grid, const Monitor& monitor) {
  std::vector<PackSizes> sizes(static_cast<std::size_t>(grid.packs));
  parallel_for(
      grid.packs, [&](int pack) { sizes[static_cast<std::size_t>(pack)] = measure(grid, pack); }, monitor);
  return sizes;
}

/// The root of the sum of the squared steps from each weight to the next in its row, of the channel that has
/// the most. Edges ring, wide bright areas don't.
double roughness(const PointGrid& grid, const Monitor& monitor) {
  std::vector<double> sums(static_cast<std::size_t>(grid.packs * grid.channels));
  parallel_for(
      grid.packs * grid.channels,
      [&](int i) {
        const float* weights = grid.at(i / grid.channels, i % grid.channels);
        float sum[16] = {};
        for (std::ptrdiff_t x = 16; x < static_cast<std::ptrdiff_t>(grid.width) * 16; x += 16) {
          for (int lane = 0; lane < 16; ++lane) {
            const float step = weights[x + lane] - weights[x + lane - 16];
            sum[lane] += step * step;
          }
        }
        for (float each : sum) sums[static_cast<std::size_t>(i)] += static_cast<double>(each);
      },
      monitor);
  double maximum = 0;
  for (int c = 0; c < grid.channels; ++c) {
    double sum = 0;
    for (int pack = 0; pack < grid.packs; ++pack)
      sum += sums[static_cast<std::size_t>(pack * grid.channels + c)];
    maximum = std::max(maximum, sum);
  }
  return std::sqrt(maximum);
}

}  // namespace

BrightPoints take_bright_points(PointGrid& grid, const BrightRule& rule, const Monitor& monitor) {
  BrightPoints points;
  points.channels = grid.channels;
  std::vector<PackSizes> sizes = measure_all(grid, monitor);
  double sum = 0, dimmest = std::numeric_limits<float>::max();
  for (const PackSizes& each : sizes) {
    sum += each.sum;
    dimmest = std::min(dimmest, static_cast<double>(each.dimmest));
  }
  if (!(sum < 1e34))
    throw Error(ErrorKind::bad_value,
                "prefilter: the map has values that are NaN, infinite or too large to be added up");
  const double mean = sum / (static_cast<double>(grid.width) * grid.height * grid.channels);
  dimmest = std::max(dimmest, rule.darkest * sum / (4 * kPi));
  const float threshold = static_cast<float>(rule.contrast * mean);
  std::vector<Candidate> all;
  for (int pack = 0; pack < grid.packs; ++pack) {
    const float together = static_cast<float>(std::max(group_of(grid, pack, 0), group_of(grid, pack, 8)));
    if (sizes[static_cast<std::size_t>(pack)].largest * together > threshold)
      collect(grid, pack, threshold, all);
  }
  const std::size_t always = std::min(all.size(), static_cast<std::size_t>(rule.always));
  const std::size_t maximum = std::min(all.size(), static_cast<std::size_t>(rule.maximum));
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(maximum), all.end());
  take(grid, std::span(all).first(always), points);
  if (maximum > always) {
    double brightest = 0;
    for (const PackSizes& each : measure_all(grid, monitor)) brightest = std::max(brightest, each.brightest);
    if (brightest > rule.cell * dimmest ||
        roughness(grid, monitor) > rule.roughness * dimmest / grid.channels) {
      take(grid, std::span(all).first(maximum).subspan(always), points);
    }
  }
  return points;
}

}  // namespace welkin::prefilter
