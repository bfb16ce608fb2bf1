#include "welkin/render/trace/texture.h"

#include <algorithm>
#include <cmath>

namespace welkin::scene {
namespace {

constexpr double kMostProbes = 8;

/// Half as large, each texel the mean of those that it covers: up to three in each axis where a side is odd.
Image halved(ImageView<const float> from) {
  Image to(std::max(1, from.width / 2), std::max(1, from.height / 2), from.channels);
  struct Taps {
    int first, count;
    std::array<double, 3> weight;
  };
  const auto taps_of = [](int index, int source, int target) {
    const double step = static_cast<double>(source) / target, begin = index * step, end = begin + step;
    Taps taps{static_cast<int>(begin), 0, {}};
    for (int i = taps.first; i < source && i < end - 1e-9 && taps.count < 3; ++i)
      taps.weight[static_cast<std::size_t>(taps.count++)] =
          (std::min(end, i + 1.0) - std::max(begin, 1.0 * i)) / step;
    return taps;
  };
  for (int y = 0; y < to.height(); ++y) {
    const Taps rows = taps_of(y, from.height, to.height());
    for (int x = 0; x < to.width(); ++x) {
      const Taps columns = taps_of(x, from.width, to.width());
      for (int c = 0; c < from.channels; ++c) {
        double sum = 0;
        for (int j = 0; j < rows.count; ++j)
          for (int i = 0; i < columns.count; ++i)
            sum += rows.weight[static_cast<std::size_t>(j)] * columns.weight[static_cast<std::size_t>(i)] *
                   from.at(columns.first + i, rows.first + j)[c];
        to.at(x, y)[c] = static_cast<float>(sum);
      }
    }
  }
  return to;
}

int wrapped(int i, int size, Wrap how) {
  if (how == Wrap::clamp) return std::clamp(i, 0, size - 1);
  const int period = how == Wrap::mirror ? 2 * size : size;
  i %= period;
  if (i < 0) i += period;
  return i < size ? i : period - 1 - i;
}

}  // namespace

Texture::Texture(const Picture& picture) : across_(picture.across), down_(picture.down) {
  levels_.push_back(picture.image.view());
  make_levels();
}

Texture::Texture(std::vector<Image> levels)
    : across_(Wrap::clamp), down_(Wrap::clamp), smaller_(std::move(levels)) {
  for (const Image& level : smaller_) levels_.push_back(level.view());
  make_levels();
}

void Texture::make_levels() {
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    smaller_.push_back(halved(levels_.back()));
    levels_.push_back(smaller_.back().view());
  }
}

std::array<float, 4> Texture::bilinear(std::size_t level, double u, double v) const {
  const ImageView<const float>& image = levels_[level];
  // Far from the origin only the fraction counts; beyond 2⁵² there is none.
  const auto near_origin = [](double t, Wrap how) {
    return how == Wrap::clamp ? std::clamp(t, -1.0, 2.0) : t - 2 * std::floor(t / 2);
  };
  const double x = near_origin(u, across_) * image.width - 0.5,
               y = near_origin(v, down_) * image.height - 0.5;
  const double x_floor = std::floor(x), y_floor = std::floor(y);
  const auto fx = static_cast<float>(x - x_floor), fy = static_cast<float>(y - y_floor);
  const int xs[] = {wrapped(static_cast<int>(x_floor), image.width, across_),
                    wrapped(static_cast<int>(x_floor) + 1, image.width, across_)};
  const int ys[] = {wrapped(static_cast<int>(y_floor), image.height, down_),
                    wrapped(static_cast<int>(y_floor) + 1, image.height, down_)};
  std::array<float, 4> value{0, 0, 0, 1};
  for (int c = 0; c < image.channels; ++c) {
    const auto at = [&](int i, int j) { return image.at(xs[i], ys[j])[c]; };
    const float top = at(0, 0) + fx * (at(1, 0) - at(0, 0)), bottom = at(0, 1) + fx * (at(1, 1) - at(0, 1));
    value[static_cast<std::size_t>(c)] = top + fy * (bottom - top);
  }
  if (image.channels == 2) value[3] = value[1];
  if (image.channels <= 2) value[1] = value[2] = value[0];
  return value;
}

std::array<float, 4> Texture::mean(const std::array<double, 2>& uv, const std::array<double, 2>& right,
                                   const std::array<double, 2>& down) const {
  if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) return {0, 0, 0, 1};
  const double width = levels_[0].width, height = levels_[0].height;
  double major = std::hypot(right[0] * width, right[1] * height);
  double minor = std::hypot(down[0] * width, down[1] * height);
  std::array<double, 2> along = right;
  if (minor > major) {
    std::swap(major, minor);
    along = down;
  }
  if (!std::isfinite(major) || !std::isfinite(minor)) major = minor = 2 * std::max(width, height);
  const double probes = std::clamp(std::ceil(major / std::max(minor, 1.0)), 1.0, kMostProbes);
  const double last = static_cast<double>(levels_.size() - 1);
  const double level = std::clamp(std::log2(std::max(major / probes, 1.0)), 0.0, last);
  const auto fine = static_cast<std::size_t>(level);
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  const auto blend = static_cast<float>(level - static_cast<double>(fine));
  std::array<float, 4> sum{};
  for (double i = 0; i < probes; ++i) {
    const double t = (i + 0.5) / probes - 0.5;
    const double u = uv[0] + (probes > 1 ? t * along[0] : 0), v = uv[1] + (probes > 1 ? t * along[1] : 0);
    const auto sharp = bilinear(fine, u, v);
    const auto blurred = blend > 0 ? bilinear(coarse, u, v) : sharp;
    for (std::size_t c = 0; c < 4; ++c)
      sum[c] += (sharp[c] + blend * (blurred[c] - sharp[c])) / static_cast<float>(probes);
  }
  return sum;
}

}  // namespace welkin::scene
