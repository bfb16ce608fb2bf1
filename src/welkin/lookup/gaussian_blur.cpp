#include "welkin/lookup/gaussian_blur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "welkin/base/parallel.h"
#include "welkin/lookup/cone_reference.h"
#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/lookup/gaussian_levels.h"

namespace welkin {
namespace {

struct Symmetric {
  double xx, xy, yy;

  Symmetric inverse() const {
    const double determinant = xx * yy - xy * xy;
    return {yy / determinant, -xy / determinant, xx / determinant};
  }
  Symmetric times(double factor) const { return {factor * xx, factor * xy, factor * yy}; }
};

/// Which texels of a grid a blurred one is made of, and how.
struct Window {
  BlurWeights weights;
  std::size_t row = 0, rows = 0;  ///< the first and the number of them
};

/// Windows of neighbours, their rows and weights one after the other.
struct Block {
  std::vector<BlurRow> rows;
  std::size_t total = 0;  ///< weights, padding included
  std::vector<float> first, second;
};

class Windows {
 public:
  /// `bright`: null for windows of the farthest reach.
  Windows(const GaussianBlur& blur, int size, int margin, const BrightTiles* bright)
      : blur_(blur), bright_(bright), farthest_(blur.reach(blur.brightest)), per_angle_(size / (kPi / 2)) {
    for (std::size_t i = 0; i < 2; ++i) kappa_[i] = vmf_concentration(std::sqrt(blur.variances[i]));
    for (int k = 0; k < blur.size + 2 * blur.margin; ++k) {
      const double angle = ((k - blur.margin + 0.5) / blur.size - 0.5) * (kPi / 2);
      places_.push_back({std::tan(angle), angle * per_angle_ + 0.5 * size + margin - 0.5});
    }
  }

  /// Adds the rows of the texel (x, y) of the results, counted from their margin's first.
  Window append(int x, int y, Block& block) const {
    const auto [s, at_x] = places_[static_cast<std::size_t>(x)];
    const auto [t, at_y] = places_[static_cast<std::size_t>(y)];

    // The metric, in texels of the grid.
    const double r2 = 1 + s * s + t * t, across = (1 + s * s) / per_angle_, down = (1 + t * t) / per_angle_;
    const Symmetric metric{across * across * (1 + t * t) / (r2 * r2), -across * down * s * t / (r2 * r2),
                           down * down * (1 + s * s) / (r2 * r2)};
    Window window{{static_cast<float>(s),
                   static_cast<float>(t),
                   static_cast<float>(at_x),
                   static_cast<float>(at_y),
                   {}},
                  block.rows.size()};
    Symmetric shape{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double variance = blur_.variances[i];
      Symmetric covariance = metric.inverse().times(variance);
      covariance.xx -= 0.25;
      covariance.yy -= 0.25;
      shape = covariance.inverse();
      window.weights.gaussians[i] = {static_cast<float>(kappa_[i]),
                                     static_cast<float>(-0.5 * (shape.xx - metric.xx / variance)),
                                     static_cast<float>(-(shape.xy - metric.xy / variance)),
                                     static_cast<float>(-0.5 * (shape.yy - metric.yy / variance))};
    }

    // The ellipse gᵀ shape g = reach² of the wider one, row by row.
    const Symmetric covariance = shape.inverse();
    const double wide = std::sqrt(covariance.xx), tall = std::sqrt(covariance.yy);
    double reach = farthest_;
    if (bright_ != nullptr) {
      const auto first = [&](double at, double half) { return static_cast<int>(at - reach * half); };
      const auto last = [&](double at, double half) { return static_cast<int>(at + reach * half) + 1; };
      reach = std::min(reach, blur_.reach(double{bright_->most(first(at_x, wide), last(at_x, wide),
                                                               first(at_y, tall), last(at_y, tall))}));
    }
    const double reach2 = reach * reach, high = reach * tall;
    for (int row = static_cast<int>(std::ceil(at_y - high)); row <= static_cast<int>(std::floor(at_y + high));
         ++row) {
      const double off = row - at_y, centre = -shape.xy * off / shape.xx;
      const double half2 = centre * centre - (shape.yy * off * off - reach2) / shape.xx;
      if (half2 < 0) continue;
      const double half = std::sqrt(half2);
      const int first = static_cast<int>(std::ceil(at_x + centre - half));
      const int last = static_cast<int>(std::floor(at_x + centre + half));
      if (last < first) continue;
      block.rows.push_back({first, row, last - first + 1, block.total});
      block.total += static_cast<std::size_t>(last - first + 1 + 15) / 16 * 16;
    }
    window.rows = block.rows.size() - window.row;
    return window;
  }

 private:
  struct Place {
    double tangent, texel;  ///< in the face's plane, in the grid
  };

  const GaussianBlur& blur_;
  const BrightTiles* bright_;
  double farthest_, per_angle_;
  std::vector<Place> places_;  ///< of the results' columns or rows
  double kappa_[2];
};

/// The eight mirror images of a square of `side` texels: where texel (x, y) of each lies.
struct MirrorImage {
  std::ptrdiff_t first, across, down;
};
std::array<MirrorImage, 8> images(int side) {
  const std::ptrdiff_t texel = FaceGrid::kPair, row = side * texel, end = side - 1;
  std::array<MirrorImage, 8> all;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::ptrdiff_t x = k & 1 ? -texel : texel, y = k & 2 ? -row : row;
    all[k] = {(k & 1 ? end * texel : 0) + (k & 2 ? end * row : 0), k & 4 ? y : x, k & 4 ? x : y};
  }
  return all;
}

}  // namespace

double GaussianBlur::reach(double brightness) const {
  // Compared with a tenth of the mean.
  return std::sqrt(2 * std::log(10 * std::clamp(brightness, 1.0, brightest) / tail));
}

int margin_needed(const GaussianBlur& blur, int size) {
  const Windows windows(blur, size, 0, nullptr);
  Block block;
  for (int x = 0; x <= blur.margin + blur.size / 2; ++x) windows.append(x, 0, block);
  int least = 0;
  for (const BlurRow& row : block.rows) least = std::min({least, row.x, row.y});
  return -least;
}

void run_blur(const FaceGrid& masses, const BrightTiles& bright, const GaussianBlur& blur,
              FaceGrid& first_map, FaceGrid& second_map, const Monitor& monitor) {
  FaceGrid* const results[2] = {&first_map, &second_map};
  const int side = first_map.side(), source_side = masses.side();
  const Windows windows(blur, masses.size(), masses.margin(), &bright);
  const std::array<MirrorImage, 8> from = images(source_side), to = images(side);

  // Tangents of the grid's columns; a pack may read past the last.
  std::vector<float> tangents(static_cast<std::size_t>(source_side) + 32);
  for (int i = 0; i < source_side; ++i)
    tangents[static_cast<std::size_t>(i)] =
        static_cast<float>(std::tan(((i - masses.margin() + 0.5) / masses.size() - 0.5) * (kPi / 2)));

  const GaussianKernels& kernels = gaussian_kernels();
  // The means over a window, in four images on a pair of faces.
  const auto average = [&](const Block& block, const Window& window, int x, int y, int pair,
                           std::size_t four) {
    const float* begin[4];
    std::ptrdiff_t across[4], down[4];
    for (std::size_t k = 0; k < 4; ++k) {
      begin[k] = masses.pair(pair) + from[four + k].first;
      across[k] = from[four + k].across;
      down[k] = from[four + k].down;
    }
    alignas(64) float means[4 * 2 * FaceGrid::kPair];
    kernels.apply(block.rows.data() + window.row, window.rows, block.first.data(), block.second.data(), begin,
                  across, down, means);
    for (std::size_t k = 0; k < 4; ++k) {
      const MirrorImage& image = to[four + k];
      const std::ptrdiff_t at = image.first + x * image.across + y * image.down;
      for (std::size_t i = 0; i < 2; ++i)
        std::memcpy(results[i]->pair(pair) + at, means + (2 * k + i) * FaceGrid::kPair,
                    FaceGrid::kPair * sizeof(float));
    }
  };

  // An eighth of the square: x ≤ y ≤ half. By blocks, in one image after the other: neighbours see nearly the
  // same texels, which stay in the nearest cache.
  constexpr int kBlock = 8;
  const int end = (side + 1) / 2, blocks = (end + kBlock - 1) / kBlock;
  parallel_for(
      blocks * (blocks + 1) / 2,
      [&](int job) {
        int row = 0;
        while (job > row) job -= ++row;
        struct Place {
          int x, y;
          Window window;
        };
        std::array<Place, kBlock * kBlock> places;
        std::size_t count = 0;
        Block block;
        for (int y = row * kBlock; y < std::min(end, (row + 1) * kBlock); ++y) {
          for (int x = job * kBlock; x < std::min(y + 1, (job + 1) * kBlock); ++x)
            places[count++] = {x, y, windows.append(x, y, block)};
        }
        block.first.resize(block.total + 16);
        block.second.resize(block.total + 16);
        for (std::size_t i = 0; i < count; ++i) {
          const Window& window = places[i].window;
          kernels.weigh(window.weights, tangents.data(), block.rows.data() + window.row, window.rows,
                        block.first.data(), block.second.data());
        }
        for (int pair = 0; pair < 3; ++pair) {
          for (std::size_t four = 0; four < 8; four += 4) {
            for (std::size_t i = 0; i < count; ++i)
              average(block, places[i].window, places[i].x, places[i].y, pair, four);
          }
        }
      },
      monitor);
}

}  // namespace welkin
