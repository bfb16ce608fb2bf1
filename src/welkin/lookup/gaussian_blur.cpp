#include "welkin/lookup/gaussian_blur.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  std::vector<BlurRow> rows;
  std::size_t total = 0;  ///< weights, padding included
};

class Windows {
 public:
  Windows(const GaussianBlur& blur, int size, int margin) : blur_(blur), size_(size), margin_(margin) {
    for (std::size_t i = 0; i < 2; ++i) kappa_[i] = vmf_concentration(std::sqrt(blur.variances[i]));
  }

  /// Of the texel (x, y) of the results, counted from their margin's first.
  void make(int x, int y, Window& window) const {
    const auto angle = [&](int k) { return ((k - blur_.margin + 0.5) / blur_.size - 0.5) * (kPi / 2); };
    const double a = angle(x), b = angle(y), s = std::tan(a), t = std::tan(b);
    const double per_angle = size_ / (kPi / 2), middle = 0.5 * size_ + margin_ - 0.5;
    const double at_x = a * per_angle + middle, at_y = b * per_angle + middle;

    // The metric, in texels of the grid.
    const double r2 = 1 + s * s + t * t, across = (1 + s * s) / per_angle, down = (1 + t * t) / per_angle;
    const Symmetric metric{across * across * (1 + t * t) / (r2 * r2), -across * down * s * t / (r2 * r2),
                           down * down * (1 + s * s) / (r2 * r2)};
    window.weights = {
        static_cast<float>(s), static_cast<float>(t), static_cast<float>(at_x), static_cast<float>(at_y), {}};
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
    const double reach2 = blur_.reach * blur_.reach;
    const Symmetric covariance = shape.inverse();
    const double high = blur_.reach * std::sqrt(covariance.yy);
    window.rows.clear();
    window.total = 0;
    for (int row = static_cast<int>(std::ceil(at_y - high)); row <= static_cast<int>(std::floor(at_y + high));
         ++row) {
      const double off = row - at_y, centre = -shape.xy * off / shape.xx;
      const double half2 = centre * centre - (shape.yy * off * off - reach2) / shape.xx;
      if (half2 < 0) continue;
      const double half = std::sqrt(half2);
      const int first = static_cast<int>(std::ceil(at_x + centre - half));
      const int last = static_cast<int>(std::floor(at_x + centre + half));
      if (last < first) continue;
      window.rows.push_back({first, row, last - first + 1, window.total});
      window.total += static_cast<std::size_t>(last - first + 1 + 15) / 16 * 16;
    }
  }

 private:
  const GaussianBlur& blur_;
  int size_, margin_;
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

int margin_needed(const GaussianBlur& blur, int size) {
  const Windows windows(blur, size, 0);
  Window window;
  int least = 0;
  for (int x = 0; x <= blur.margin + blur.size / 2; ++x) {
    windows.make(x, 0, window);
    for (const BlurRow& row : window.rows) least = std::min({least, row.x, row.y});
  }
  return -least;
}

void run_blur(const FaceGrid& masses, const GaussianBlur& blur, FaceGrid& first_map, FaceGrid& second_map,
              const Monitor& monitor) {
  FaceGrid* const results[2] = {&first_map, &second_map};
  const int side = first_map.side(), source_side = masses.side();
  const Windows windows(blur, masses.size(), masses.margin());
  const std::array<MirrorImage, 8> from = images(source_side), to = images(side);

  // Tangents of the grid's columns; a pack may read past the last.
  std::vector<float> tangents(static_cast<std::size_t>(source_side) + 32);
  for (int i = 0; i < source_side; ++i)
    tangents[static_cast<std::size_t>(i)] =
        static_cast<float>(std::tan(((i - masses.margin() + 0.5) / masses.size() - 0.5) * (kPi / 2)));

  // An eighth of the square: x ≤ y ≤ half.
  const GaussianKernels& kernels = gaussian_kernels();
  parallel_for((side + 1) / 2,
               [&](int y) {
                 Window window;
                 std::vector<float> first, second;
                 for (int x = 0; x <= y; ++x) {
                   windows.make(x, y, window);
                   first.resize(window.total + 16);
                   second.resize(window.total + 16);
                   kernels.weigh(window.weights, tangents.data(), window.rows.data(), window.rows.size(),
                                 first.data(), second.data());
                   for (int pair = 0; pair < 3; ++pair) {
                     for (std::size_t four = 0; four < 8; four += 4) {
                       const float* begin[4];
                       std::ptrdiff_t across[4], down[4];
                       for (std::size_t k = 0; k < 4; ++k) {
                         begin[k] = masses.pair(pair) + from[four + k].first;
                         across[k] = from[four + k].across;
                         down[k] = from[four + k].down;
                       }
                       alignas(64) float sums[4 * 2 * FaceGrid::kPair];
                       kernels.apply(window.rows.data(), window.rows.size(), first.data(), second.data(),
                                     begin, across, down, sums);
                       for (std::size_t k = 0; k < 4; ++k) {
                         const MirrorImage& image = to[four + k];
                         const std::ptrdiff_t at = image.first + x * image.across + y * image.down;
                         for (std::size_t i = 0; i < 2; ++i) {
                           const float* sum = sums + (2 * k + i) * FaceGrid::kPair;
                           float* value = results[i]->pair(pair) + at;
                           for (std::size_t f = 0; f < FaceGrid::kPair; f += FaceGrid::kValues) {
                             const float inverse = sum[f + 3] > 0 ? 1 / sum[f + 3] : 0;
                             for (std::size_t c = 0; c < FaceGrid::kValues; ++c)
                               value[f + c] = sum[f + c] * inverse;
                           }
                         }
                       }
                     }
                   }
                 }
               },
               monitor);
}

}  // namespace welkin
