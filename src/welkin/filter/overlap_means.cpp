#include "welkin/filter/overlap_means.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

/// Which rows of a lat-long grow towards their bottom, and by how much: PolygonOverlap's bend.
std::vector<float> bends_of(const sphere::AnyParameterization& p, int height) {
  std::vector<float> bend(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const double top = std::max(0.0, p.solid_angle_density(0, 0.5, static_cast<double>(y) / height)),
                 bottom = std::max(0.0, p.solid_angle_density(0, 0.5, static_cast<double>(y + 1) / height));
    bend[static_cast<std::size_t>(y)] = static_cast<float>((bottom - top) / (bottom + top));
  }
  return bend;
}

/// Eight times the mean of each channel, by a grid of valid texels.
std::vector<float> bright_of(const sphere::AnyParameterization& p, const Level& level) {
  const bool full = p.full_charts();
  const std::size_t channels = static_cast<std::size_t>(level.channels());
  std::vector<double> sum(channels), count(channels);
  const int step_x = std::max(1, level.width() / 256), step_y = std::max(1, level.height() / 256);
  for (int chart = 0; chart < level.charts(); ++chart) {
    for (int y = step_y / 2; y < level.height(); y += step_y) {
      for (int x = step_x / 2; x < level.width(); x += step_x) {
        if (!full && !p.valid(chart, (x + 0.5) / level.width(), (y + 0.5) / level.height())) continue;
        const float* texel = level.chart(chart).at(x, y);
        for (std::size_t c = 0; c < channels; ++c) {
          const double value = std::fabs(static_cast<double>(texel[c]));
          if (!std::isfinite(value)) continue;
          sum[c] += value;
          count[c] += 1;
        }
      }
    }
  }
  std::vector<float> bright(channels);
  for (std::size_t c = 0; c < channels; ++c)
    bright[c] = static_cast<float>(count[c] > 0 ? 8 * sum[c] / count[c] : 0);
  return bright;
}

}  // namespace

OverlapMeans::OverlapMeans(const sphere::AnyParameterization& source, const Level& level, bool reconstructed,
                           bool limited, int parts)
    : source_(source),
      view_(view_of(level)),
      kernels_(reconstruction_kernels(level.channels())),
      parts_(parts),
      size_{view_.width * parts, view_.height * parts},
      reconstructed_(reconstructed),
      full_(source.full_charts()),
      by_row_(source.density_by_row() && full_),
      bright_(bright_of(source, level)) {
  how_.limited = limited;
  how_.bright = bright_.data();
  if (by_row_) {
    bend_ = bends_of(source, size_.height);
    row_angle_.resize(static_cast<std::size_t>(size_.height));
    for (int y = 0; y < size_.height; ++y)
      texel_solid_angles(source, 1, size_.height, 0, y, &row_angle_[static_cast<std::size_t>(y)]);
  }
  if (parts > 1)
    refinement_.emplace(view_, PartsOfTexels{source, parts, by_row_ ? &row_angle_ : nullptr}, how_, kernels_);
}

void OverlapMeans::reconstruct(ReconstructedTexels& texels, Work& work) const {
  if (refinement_.has_value()) {
    refinement_->reconstruct(work.refinement, texels);
  } else {
    kernels_.reconstruct(view_, how_, texels);
  }
}

bool OverlapMeans::mean(const std::vector<OutlineLoop>& loops, const ReconstructedTexels& known, Work& work,
                        float* out) const {
  const std::size_t channels = static_cast<std::size_t>(view_.channels);
  work.sum.assign(channels, 0.0);
  double total = 0;
  for (const OutlineLoop& loop : loops) {
    double low_x = 1e30, low_y = 1e30, high_x = -1e30, high_y = -1e30;
    for (const OutlinePoint& p : loop.points) {
      low_x = std::min(low_x, p.x);
      high_x = std::max(high_x, p.x);
      low_y = std::min(low_y, p.y);
      high_y = std::max(high_y, p.y);
    }
    const int left = std::clamp(static_cast<int>(std::floor(low_x)), 0, size_.width - 1),
              right = std::clamp(static_cast<int>(std::floor(high_x)), 0, size_.width - 1);
    const int top = std::clamp(static_cast<int>(std::floor(low_y)), 0, size_.height - 1),
              bottom = std::clamp(static_cast<int>(std::floor(high_y)), 0, size_.height - 1);
    const int columns = right - left + 1, rows = bottom - top + 1;
    const bool covered = !known.coefficients.empty() && known.chart == loop.chart && left >= known.x &&
                         right < known.x + known.width && top >= known.y && bottom < known.y + known.height;
    const ReconstructedTexels* texels = covered ? &known : nullptr;
    if (!reconstructed_) {
      texels = nullptr;
    } else if (!covered) {
      work.few.reset(loop.chart, left, top, columns, rows, view_.channels);
      reconstruct(work.few, work);
      texels = &work.few;
    }
    work.overlap.start(left, top, columns, rows);
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const OutlinePoint &a = loop.points[i], &b = loop.points[(i + 1) % loop.points.size()];
      work.overlap.add_edge(a.x, a.y, b.x, b.y);
    }
    const auto add = [&](int x, int y, int count, const OverlapMoments& m) {
      constexpr double kWhole = 1 - 1e-6;
      if (parts_ == 1 && count > 1 && std::fabs(m.area) > kWhole) {
        add_whole(loop.chart, x, y, count, m.area, work, total);
        return;
      }
      for (int i = 0; i < count; ++i) {
        if (texels != nullptr) {
          add_part(*texels, x + i, y, m, work, total);
        } else {
          add_mean(loop.chart, x + i, y, m, work, total);
        }
      }
    };
    work.overlap.for_each(add);
  }
  if (!(std::fabs(total) > 0)) return false;
  for (std::size_t c = 0; c < channels; ++c) out[c] = static_cast<float>(work.sum[c] / total);
  if (how_.limited && std::any_of(out, out + channels, [](float value) { return value < 0; })) {
    for (const OutlineLoop& loop : loops) {
      float box[4] = {1e30f, 1e30f, -1e30f, -1e30f};
      for (const OutlinePoint& p : loop.points) {
        const float x = static_cast<float>(p.x), y = static_cast<float>(p.y);
        box[0] = std::min(box[0], x);
        box[1] = std::min(box[1], y);
        box[2] = std::max(box[2], x);
        box[3] = std::max(box[3], y);
      }
      lift(loop.chart, box[0], box[1], box[2], box[3], out);
    }
  }
  return true;
}

void OverlapMeans::lift(int chart, float left, float top, float right, float bottom, float* out) const {
  const auto cell = [this](float position, int size) {
    return std::clamp(static_cast<int>(std::floor(position / static_cast<float>(parts_))), 0, size - 1);
  };
  const int x0 = cell(left, view_.width) - 1, x1 = cell(right, view_.width) + 1;
  const int y0 = cell(top, view_.height) - 1, y1 = cell(bottom, view_.height) + 1;
  for (int c = 0; c < view_.channels; ++c) {
    if (!(out[c] < 0)) continue;
    float lowest = 0;
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) lowest = std::min(lowest, texel_at(chart, x * parts_, y * parts_)[c]);
    }
    out[c] = std::max(out[c], lowest);
  }
}

double OverlapMeans::density(int chart, double x, double y) const {
  return std::max(0.0, source_.solid_angle_density(chart, x / size_.width, y / size_.height));
}

/// Up to a factor.
double OverlapMeans::solid_angle(int chart, int x, int y) const {
  if (by_row_) return static_cast<double>(row_angle_[static_cast<std::size_t>(y)]);
  constexpr int kFine = 256;
  if (size_.width >= kFine) return density(chart, x + 0.5, y + 0.5);
  constexpr double kGauss = 0.21132486540518713;
  return 0.25 * (density(chart, x + kGauss, y + kGauss) + density(chart, x + 1 - kGauss, y + kGauss) +
                 density(chart, x + kGauss, y + 1 - kGauss) + density(chart, x + 1 - kGauss, y + 1 - kGauss));
}

/// The same of a part of a texel.
double OverlapMeans::solid_angle_of_part(int chart, int x, int y, double of_texel,
                                         const OverlapMoments& m) const {
  if (by_row_ || m.area == 0) return of_texel * m.area;
  return m.area * density(chart, x + 0.5 + std::clamp(m.x / m.area, -0.5, 0.5),
                          y + 0.5 + std::clamp(m.y / m.area, -0.5, 0.5));
}

/// Whether the source's map ends in a texel: nothing says how it goes on there.
bool OverlapMeans::is_cut(int chart, int x, int y) const {
  if (full_) return false;
  for (int k = 0; k < 4; ++k) {
    if (!source_.valid(chart, static_cast<double>(x / parts_ + k % 2) / view_.width,
                       static_cast<double>(y / parts_ + k / 2) / view_.height))
      return true;
  }
  return false;
}

/// A part of a texel, by the texel's own value.
void OverlapMeans::add_mean(int chart, int x, int y, const OverlapMoments& m, Work& work,
                            double& total) const {
  const double part = solid_angle_of_part(chart, x, y, solid_angle(chart, x, y), m);
  const float* texel = texel_at(chart, x, y);
  for (int c = 0; c < view_.channels; ++c)
    work.sum[static_cast<std::size_t>(c)] += part * static_cast<double>(texel[c]);
  total += part;
}

void OverlapMeans::add_part(const ReconstructedTexels& texels, int x, int y, const OverlapMoments& m,
                            Work& work, double& total) const {
  if (is_cut(texels.chart, x, y)) return add_mean(texels.chart, x, y, m, work, total);
  const double omega = solid_angle(texels.chart, x, y);
  // What differs from the texel's mean adds up to nothing over it, so it is not weighted in turn.
  const double part = solid_angle_of_part(texels.chart, x, y, omega, m);
  total += part;
  const int channels = view_.channels;
  const float* k = texels.coefficients.data() + texels.index(x, y) * static_cast<std::size_t>(channels);
  const std::ptrdiff_t plane = texels.plane();
  for (int c = 0; c < channels; ++c, ++k) {
    const auto of = [&](int n) { return static_cast<double>(k[n * plane]); };
    const double mean = of(0) + (of(3) + of(5)) / 12;
    work.sum[static_cast<std::size_t>(c)] +=
        mean * part + omega * (of(1) * m.x + of(2) * m.y + of(3) * m.xx + of(4) * m.xy + of(5) * m.yy);
  }
}

const float* OverlapMeans::texel_at(int chart, int x, int y) const {
  // Of the border too: divisions round down.
  const auto texel = [this](int part) { return (part + kBorder * parts_) / parts_ - kBorder; };
  return view_.texels + chart * view_.chart_stride + texel(y) * view_.row_stride +
         static_cast<std::ptrdiff_t>(texel(x)) * view_.channels;
}

void OverlapMeans::add_whole(int chart, int x, int y, int count, double area, Work& work,
                             double& total) const {
  const int channels = view_.channels;
  const float* texel = texel_at(chart, x, y);
  const double shared = by_row_ ? area * solid_angle(chart, x, y) : 0;
  for (int i = 0; i < count; ++i, texel += channels) {
    const double weight = by_row_ ? shared : area * solid_angle(chart, x + i, y);
    for (int c = 0; c < channels; ++c)
      work.sum[static_cast<std::size_t>(c)] += weight * static_cast<double>(texel[c]);
    total += weight;
  }
}

}  // namespace welkin
