#include "welkin/assemble/exposure.h"

#include <algorithm>
#include <cmath>

#include "welkin/assemble/piece_texels.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

namespace welkin {
namespace {

constexpr int kSide = 96;  ///< of the map that pieces are compared in
/// Alpha of what is compared: the whole of a texel is seen.
constexpr float kOpaque = 0.999f;
/// Luminance that is too dark for a ratio, of the piece's mean.
constexpr double kDark = 1e-3;

/// A piece as the comparison sees it.
struct Seen {
  std::vector<float> colours;   ///< R G B A
  std::vector<double> weights;  ///< 0 where it is not, or not wholly
  double mean = 0;              ///< luminance

  double luminance(std::size_t i) const {
    const float* c = &colours[4 * i];
    return 0.2126 * static_cast<double>(c[0]) + 0.7152 * static_cast<double>(c[1]) +
           0.0722 * static_cast<double>(c[2]);
  }
};

Seen seen_of(const Piece& piece, const MapFrame& frame) {
  const std::size_t all = std::size_t{kSide} * kSide;
  Seen seen{std::vector<float>(4 * all), std::vector<double>(all), 0};
  const PieceTexels texels(piece, frame);
  const Tiles tiles(frame);
  parallel_for(tiles.count(), [&](int number) {
    const Tile tile = tiles.at(number);
    std::vector<float> colours(4 * static_cast<std::size_t>(tile.count()));
    std::vector<double> feathers(static_cast<std::size_t>(tile.count()));
    if (!texels.make(tile, colours.data(), feathers.data())) return;
    const std::vector<double> fineness = texels.fineness(tile);
    for (int i = 0; i < tile.count(); ++i) {
      const auto from = static_cast<std::size_t>(i);
      const auto to = static_cast<std::size_t>((tile.y + i / tile.width) * kSide + tile.x + i % tile.width);
      std::copy_n(&colours[4 * from], 4, &seen.colours[4 * to]);
      if (colours[4 * from + 3] < kOpaque || !(feathers[from] > 0)) continue;
      seen.weights[to] = feathers[from] * fineness[from];
    }
  });
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < all; ++i) {
    if (!(seen.weights[i] > 0)) continue;
    sum += seen.luminance(i);
    count += 1;
  }
  seen.mean = count > 0 ? sum / count : 0;
  return seen;
}

/// A value and what it weighs.
struct Weighted {
  double value, weight;
};

double median(std::vector<Weighted>& values) {
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double whole = 0, so_far = 0;
  for (const Weighted& each : values) whole += each.weight;
  for (const Weighted& each : values) {
    so_far += each.weight;
    if (2 * so_far >= whole) return each.value;
  }
  return 0;
}

Overlap compare(const Seen& a, const Seen& b) {
  Overlap overlap;
  std::vector<Weighted> ratios;
  double difference = 0, size = 0;
  int both = 0;
  for (std::size_t i = 0; i < a.weights.size(); ++i) {
    const double weight = std::min(a.weights[i], b.weights[i]);
    if (!(weight > 0)) continue;
    ++both;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = static_cast<double>(a.colours[4 * i + c]),
                   y = static_cast<double>(b.colours[4 * i + c]);
      difference += weight * (x - y) * (x - y);
      size += weight * 0.25 * (x + y) * (x + y);
    }
    const double la = a.luminance(i), lb = b.luminance(i);
    if (la > kDark * a.mean && lb > kDark * b.mean) ratios.push_back({std::log(lb / la), weight});
  }
  overlap.share = static_cast<double>(both) / static_cast<double>(a.weights.size());
  overlap.ratio = std::exp(median(ratios));
  overlap.error = size > 0 ? std::sqrt(difference / size) : 0;
  return overlap;
}

/// Solves the symmetric positive definite system by elimination.
std::vector<double> solve(std::vector<std::vector<double>> matrix, std::vector<double> right) {
  const std::size_t n = right.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t row = k + 1; row < n; ++row) {
      const double factor = matrix[row][k] / matrix[k][k];
      if (factor == 0) continue;
      for (std::size_t column = k; column < n; ++column) matrix[row][column] -= factor * matrix[k][column];
      right[row] -= factor * right[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t column = k + 1; column < n; ++column) right[k] -= matrix[k][column] * right[column];
    right[k] /= matrix[k][k];
  }
  return right;
}

/// The first piece of those that each hangs together with.
std::vector<std::size_t> firsts(std::size_t count, const std::vector<Overlap>& overlaps) {
  std::vector<std::size_t> first(count);
  for (std::size_t k = 0; k < count; ++k) first[k] = k;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Overlap& each : overlaps) {
      const std::size_t least = std::min(first[each.first], first[each.second]);
      changed = changed || first[each.first] != least || first[each.second] != least;
      first[each.first] = first[each.second] = least;
    }
  }
  return first;
}

}  // namespace

std::vector<Overlap> compare_overlaps(std::span<const Piece> pieces, const Monitor& monitor) {
  const MapFrame frame(sphere::AnyParameterization::make("octahedral-equal-area"), {kSide, kSide});
  std::vector<Seen> seen;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
    pieces[k].map.check();
    require(pieces[k].map.channels() == 4, "a piece has channels R G B A");
    seen.push_back(pieces[k].layer == kBackdrop ? Seen{} : seen_of(pieces[k], frame));
    if (monitor.progress) monitor.progress(static_cast<double>(k + 1) / static_cast<double>(pieces.size()));
  }
  std::vector<Overlap> overlaps;
  for (std::size_t a = 0; a < pieces.size(); ++a) {
    for (std::size_t b = a + 1; b < pieces.size(); ++b) {
      if (pieces[a].layer != pieces[b].layer || pieces[a].layer == kBackdrop) continue;
      Overlap overlap = compare(seen[a], seen[b]);
      overlap.first = a;
      overlap.second = b;
      if (overlap.share > 0) overlaps.push_back(overlap);
    }
  }
  return overlaps;
}

void match_exposures(std::span<Piece> pieces, const Monitor& monitor) {
  const std::vector<Overlap> overlaps = compare_overlaps(pieces, monitor);
  const std::vector<std::size_t> first = firsts(pieces.size(), overlaps);
  // Least squares of x_a − x_b = log ratio, x the logarithms of what gains are multiplied by; 0 for a first
  // one.
  std::vector<std::vector<double>> normal(pieces.size(), std::vector<double>(pieces.size()));
  std::vector<double> right(pieces.size());
  for (const Overlap& each : overlaps) {
    const double wanted = std::log(each.ratio);
    normal[each.first][each.first] += each.share;
    normal[each.second][each.second] += each.share;
    normal[each.first][each.second] -= each.share;
    normal[each.second][each.first] -= each.share;
    right[each.first] += each.share * wanted;
    right[each.second] -= each.share * wanted;
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (first[k] == k) normal[k][k] += 1;
  }
  const std::vector<double> logarithms = solve(std::move(normal), std::move(right));
  for (std::size_t k = 0; k < pieces.size(); ++k) pieces[k].gain *= std::exp(logarithms[k]);
}

}  // namespace welkin
