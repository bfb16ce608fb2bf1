#include "welkin/filter/refinement_reference.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// Texels past the border are its last ones.
double texel_at(const ImageView<const float>& chart, int x, int y, int channel) {
  return static_cast<double>(chart.at(std::clamp(x, -kBorder, chart.width + kBorder - 1),
                                      std::clamp(y, -kBorder, chart.height + kBorder - 1))[channel]);
}

double at(const std::array<double, 6>& a, double x, double y) {
  return a[0] + a[1] * x + a[2] * y + a[3] * (x * x - 1.0 / 12) + a[4] * x * y + a[5] * (y * y - 1.0 / 12);
}

struct Range {
  double low, high;
};

/// The limits of what is around texels of that range.
Range beyond(const Range& texels, float share) {
  const double range = texels.high - texels.low, more = static_cast<double>(share) * range;
  const double steep = range > 0 ? range / (static_cast<double>(kFlatFloor) * std::fabs(texels.low)) : 0;
  return {texels.low - more * std::max(0.0, 1 - steep), texels.high + more};
}

}  // namespace

std::array<double, 6> free_quadratic(const ImageView<const float>& chart, int x, int y, int channel) {
  const auto texel = [&](int right, int down) { return texel_at(chart, x + right, y + down, channel); };
  const auto odd = [](const auto& value) {
    double sum = 0;
    for (int j = 1; j <= kReconstructionReach; ++j)
      sum += static_cast<double>(kOddTaps[j - 1]) * (value(j) - value(-j));
    return sum;
  };
  const auto even = [](const auto& value) {
    double sum = 0;
    for (int j = 1; j <= kReconstructionReach; ++j)
      sum += static_cast<double>(kEvenTaps[j - 1]) * (value(j) + value(-j) - 2 * value(0));
    return sum;
  };
  return {texel(0, 0),
          odd([&](int j) { return texel(j, 0); }),
          odd([&](int j) { return texel(0, j); }),
          even([&](int j) { return texel(j, 0); }),
          odd([&](int k) { return odd([&](int j) { return texel(j, k); }); }),
          even([&](int j) { return texel(0, j); })};
}

RefinementReference::Parts RefinementReference::shares(int chart, int x, int y) const {
  Parts shares{};
  double sum = 0;
  constexpr double kGauss = 0.21132486540518713;
  const int width = level_.width() * parts_, height = level_.height() * parts_;
  for (int t = 0; t < parts_ * parts_; ++t) {
    const int column = part_inside(x * parts_ + t % parts_, width),
              row = part_inside(y * parts_ + t / parts_, height);
    for (int k = 0; k < 4; ++k) {
      const double right = column + (k % 2 == 0 ? kGauss : 1 - kGauss),
                   down = row + (k / 2 == 0 ? kGauss : 1 - kGauss);
      shares[static_cast<std::size_t>(t)] +=
          std::max(0.0, source_.solid_angle_density(chart, right / width, down / height));
    }
    sum += shares[static_cast<std::size_t>(t)];
  }
  for (double& share : shares) share /= sum;
  return shares;
}

RefinementReference::Parts RefinementReference::means(int chart, int x, int y, int channel) const {
  const ImageView<const float> texels = level_.chart(chart);
  const std::array<double, 6> a = free_quadratic(texels, x, y, channel);
  const Parts share = shares(chart, x, y);
  const std::size_t count = static_cast<std::size_t>(parts_ * parts_);
  Parts part{};
  std::array<Range, kMostParts * kMostParts> limits{};
  double excess = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const int column = static_cast<int>(t) % parts_, row = static_cast<int>(t) / parts_;
    // Two of Gauss's points along each side are exact for a quadratic.
    for (const double i : {-1, 1}) {
      for (const double j : {-1, 1}) {
        part[t] += 0.25 * at(a, (column + 0.5 + i / std::sqrt(12)) / parts_ - 0.5,
                             (row + 0.5 + j / std::sqrt(12)) / parts_ - 0.5);
      }
    }
    excess += share[t] * (part[t] - a[0]);
    const int right = 2 * column < parts_ ? -1 : 1, down = 2 * row < parts_ ? -1 : 1;
    const auto [low, high] =
        std::minmax({a[0], texel_at(texels, x + right, y, channel), texel_at(texels, x, y + down, channel),
                     texel_at(texels, x + right, y + down, channel)});
    limits[t] = beyond({low, high}, kBeyondTexels);
  }
  for (std::size_t t = 0; t < count; ++t) part[t] = clamp(part[t] - excess, limits[t].low, limits[t].high);
  const auto missing = [&] {
    double sum = 0;
    for (std::size_t t = 0; t < count; ++t) sum += share[t] * (a[0] - part[t]);
    return sum;
  };
  for (int round = 0; round < kClippedRounds; ++round) {
    const double lack = missing();
    const auto has_room = [&](std::size_t t) {
      return lack > 0 ? part[t] < limits[t].high : part[t] > limits[t].low;
    };
    double room = 0;
    for (std::size_t t = 0; t < count; ++t) room += has_room(t) ? share[t] : 0;
    for (std::size_t t = 0; t < count && room > 0; ++t) {
      if (has_room(t)) part[t] = clamp(part[t] + lack / room, limits[t].low, limits[t].high);
    }
  }
  const double rest = missing();
  for (std::size_t t = 0; t < count; ++t) part[t] += rest;
  return part;
}

std::array<double, 6> RefinementReference::within(int chart, int x, int y, int channel) const {
  double near[3][3];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      // Divisions round down: −1 is a part of texel −1.
      const int column = (x + i - 1 + parts_) / parts_ - 1, row = (y + j - 1 + parts_) / parts_ - 1;
      const int t = (y + j - 1 - row * parts_) * parts_ + (x + i - 1 - column * parts_);
      near[j][i] = means(chart, column, row, channel)[static_cast<std::size_t>(t)];
    }
  }
  const double m = near[1][1];
  std::array<double, 6> a{m,
                          0.5 * (near[1][2] - near[1][0]),
                          0.5 * (near[2][1] - near[0][1]),
                          0.5 * (near[1][0] + near[1][2]) - m,
                          0.25 * (near[0][0] + near[2][2] - near[0][2] - near[2][0]),
                          0.5 * (near[0][1] + near[2][1]) - m};
  Range around{m, m}, inside{m, m};
  for (int k = 0; k < 9; ++k) {
    const double texel = near[k / 3][k % 3], value = at(a, 0.5 * (k % 3 - 1), 0.5 * (k / 3 - 1));
    around = {std::min(around.low, texel), std::max(around.high, texel)};
    inside = {std::min(inside.low, value), std::max(inside.high, value)};
  }
  const Range limits = beyond(around, kBeyondParts);
  double share = 1;
  if (inside.low < limits.low) share = (m - limits.low) / (m - inside.low);
  if (inside.high > limits.high) share = std::min(share, (limits.high - m) / (inside.high - m));
  for (std::size_t k = 1; k < a.size(); ++k) a[k] *= share;
  return a;
}

}  // namespace welkin
