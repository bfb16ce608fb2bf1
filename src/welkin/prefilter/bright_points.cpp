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

/// A mass, or near a pole several side by side, no wider together than a quarter of a row is high.
struct Candidate {
  float size;
  int pack, column, lane;
  int count;
  /// Larger first; then by place, so that the choice doesn't depend on the threads.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(b.size, a.pack, a.column, a.lane) < std::tie(a.size, b.pack, b.column, b.lane);
  }
};

constexpr int kCells = 32;  ///< around; a pack high

struct PackSizes {
  double sum = 0;                                     ///< of |mass| over all channels
  float largest = 0;                                  ///< |mass|
  float dimmest = std::numeric_limits<float>::max();  ///< mean radiance of a cell, summed over channels
  double brightest = 0;                               ///< mass of a cell, summed over channels
};

PackSizes measure(const Moments& moments, int pack) {
  PackSizes sizes;
  const int width = moments.width, columns = (width + kCells - 1) / kCells;
  double solid_angle[16];
  const double step = kPi / moments.height;
  for (int lane = 0; lane < 16; ++lane) {
    const int north = pack * 8 + lane % 8;
    solid_angle[lane] =
        north < moments.height / 2 ? std::sin((north + 0.5) * step) * step * 2 * kPi / width : 0;
  }
  for (int first = 0; first < width; first += columns) {
    const int last = std::min(width, first + columns);
    float sum[16] = {}, largest[16] = {};
    for (int c = 0; c < moments.channels; ++c) {
      const float* masses = moments.at(pack, c);
      for (int x = first; x < last; ++x) {
        for (int lane = 0; lane < 16; ++lane) {
          const float size = std::fabs(masses[static_cast<std::ptrdiff_t>(x) * 16 + lane]);
          sum[lane] += size;
          largest[lane] = largest[lane] < size ? size : largest[lane];
        }
      }
    }
    for (int side = 0; side < 16; side += 8) {
      double mass = 0, cell = 0;
      for (int lane = side; lane < side + 8; ++lane) {
        mass += static_cast<double>(sum[lane]);
        cell += solid_angle[lane] * (last - first);
        sizes.largest = std::max(sizes.largest, largest[lane]);
      }
      sizes.sum += mass;
      sizes.brightest = std::max(sizes.brightest, mass);
      if (cell > 0) sizes.dimmest = std::min(sizes.dimmest, static_cast<float>(mass / cell));
    }
  }
  return sizes;
}

int row_of(const Moments& moments, int pack, int lane) {
  const int north = pack * 8 + lane % 8;
  return lane < 8 ? north : moments.height - 1 - north;
}

/// How many masses of a row make one candidate.
int group_of(const Moments& moments, int pack, int lane) {
  const double theta = (row_of(moments, pack, lane) + 0.5) * kPi / moments.height;
  const double most = 0.125 * moments.width / moments.height / std::sin(theta);
  int count = 1;
  while (2 * count <= most && moments.width % (2 * count) == 0) count *= 2;
  return count;
}

float mass_of(const Moments& moments, const Candidate& candidate, int channel) {
  const float* at = moments.at(candidate.pack, channel) + static_cast<std::ptrdiff_t>(candidate.column) * 16 +
                    candidate.lane;
  float sum = 0;
  for (int k = 0; k < candidate.count; ++k) sum += at[k * 16];
  return sum;
}

/// The masses of one pack that have a channel above `least`.
void collect(const Moments& moments, int pack, float least, std::vector<Candidate>& found) {
  for (int lane = 0; lane < 16; ++lane) {
    if (pack * 8 + lane % 8 >= moments.height / 2) continue;
    const int count = group_of(moments, pack, lane);
    for (int column = 0; column < moments.width; column += count) {
      Candidate candidate{0, pack, column, lane, count};
      for (int c = 0; c < moments.channels; ++c) {
        candidate.size = std::max(candidate.size, std::fabs(mass_of(moments, candidate, c)));
      }
      if (candidate.size > least) found.push_back(candidate);
    }
  }
}

/// Takes these masses out of the grid.
void take(Moments& moments, std::span<const Candidate> candidates, BrightPoints& points) {
  // A box as wide as the column: Gauss's rule of three points.
  struct Part {
    double place, share;
  };
  static constexpr Part kPoint[] = {{0.5, 1}};
  static constexpr Part kBox[] = {
      {0.112701665379258, 5.0 / 18}, {0.5, 8.0 / 18}, {0.887298334620742, 5.0 / 18}};
  const std::span<const Part> parts =
      moments.boxes ? std::span<const Part>(kBox) : std::span<const Part>(kPoint);
  for (const Candidate& each : candidates) {
    const double theta = (row_of(moments, each.pack, each.lane) + 0.5) * kPi / moments.height;
    for (const Part& part : parts) {
      const double longitude = 2 * kPi * (0.5 - (each.column + part.place * each.count) / moments.width);
      points.x.push_back(static_cast<float>(std::sin(theta) * std::sin(longitude)));
      points.y.push_back(static_cast<float>(std::cos(theta)));
      points.z.push_back(static_cast<float>(std::sin(theta) * std::cos(longitude)));
      for (int c = 0; c < moments.channels; ++c) {
        points.mass.push_back(mass_of(moments, each, c) * static_cast<float>(part.share));
      }
    }
    for (int c = 0; c < moments.channels; ++c) {
      float* at = moments.at(each.pack, c) + static_cast<std::ptrdiff_t>(each.column) * 16 + each.lane;
      for (int k = 0; k < each.count; ++k) at[k * 16] = 0;
    }
  }
}

std::vector<PackSizes> measure_all(const Moments& moments, const Monitor& monitor) {
  std::vector<PackSizes> sizes(static_cast<std::size_t>(moments.packs));
  parallel_for(
      moments.packs, [&](int pack) { sizes[static_cast<std::size_t>(pack)] = measure(moments, pack); },
      monitor);
  return sizes;
}

/// The root of the sum of the squared steps from each mass to the next in its row, of the channel that has
/// the most. Edges ring, wide bright areas don't.
double roughness(const Moments& moments, const Monitor& monitor) {
  std::vector<double> sums(static_cast<std::size_t>(moments.packs * moments.channels));
  parallel_for(
      moments.packs * moments.channels,
      [&](int i) {
        const float* masses = moments.at(i / moments.channels, i % moments.channels);
        float sum[16] = {};
        for (std::ptrdiff_t x = 16; x < static_cast<std::ptrdiff_t>(moments.width) * 16; x += 16) {
          for (int lane = 0; lane < 16; ++lane) {
            const float step = masses[x + lane] - masses[x + lane - 16];
            sum[lane] += step * step;
          }
        }
        for (float each : sum) sums[static_cast<std::size_t>(i)] += static_cast<double>(each);
      },
      monitor);
  double most = 0;
  for (int c = 0; c < moments.channels; ++c) {
    double sum = 0;
    for (int pack = 0; pack < moments.packs; ++pack)
      sum += sums[static_cast<std::size_t>(pack * moments.channels + c)];
    most = std::max(most, sum);
  }
  return std::sqrt(most);
}

}  // namespace

BrightPoints take_bright_points(Moments& moments, const BrightRule& rule, const Monitor& monitor) {
  BrightPoints points;
  points.channels = moments.channels;
  std::vector<PackSizes> sizes = measure_all(moments, monitor);
  double sum = 0, dimmest = std::numeric_limits<float>::max();
  for (const PackSizes& each : sizes) {
    sum += each.sum;
    dimmest = std::min(dimmest, static_cast<double>(each.dimmest));
  }
  if (!(sum < 1e34))
    throw Error(ErrorKind::bad_value,
                "prefilter: the map has values that are NaN, infinite or too large to be added up");
  const double mean = sum / (static_cast<double>(moments.width) * moments.height * moments.channels);
  dimmest = std::max(dimmest, rule.darkest * sum / (4 * kPi));
  const float least = static_cast<float>(rule.contrast * mean);
  std::vector<Candidate> all;
  for (int pack = 0; pack < moments.packs; ++pack) {
    const float together =
        static_cast<float>(std::max(group_of(moments, pack, 0), group_of(moments, pack, 8)));
    if (sizes[static_cast<std::size_t>(pack)].largest * together > least) collect(moments, pack, least, all);
  }
  const std::size_t always = std::min(all.size(), static_cast<std::size_t>(rule.always));
  const std::size_t most = std::min(all.size(), static_cast<std::size_t>(rule.most));
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most), all.end());
  take(moments, std::span(all).first(always), points);
  if (most > always) {
    double brightest = 0;
    for (const PackSizes& each : measure_all(moments, monitor))
      brightest = std::max(brightest, each.brightest);
    if (brightest > rule.cell * dimmest ||
        roughness(moments, monitor) > rule.roughness * dimmest / moments.channels) {
      take(moments, std::span(all).first(most).subspan(always), points);
    }
  }
  return points;
}

}  // namespace welkin::prefilter
