#include "welkin/prefilter/reference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/base/parallel.h"
#include "welkin/prefilter/sampled_lobe.h"

namespace welkin {

namespace {

/// A piece is small enough when its size squared is this part of width² + distance².
constexpr double kSmall = 0.01;

/// And this, radians², where the lobe has a kink at the horizon.
constexpr double kSmallKink = 4e-4;

}  // namespace

/// A lobe varies less and less away from where it is largest: its axis, or a ring about it.
struct PrefilterReference::Scale {
  explicit Scale(const lobe::AnyLobe& lobe) : core(lobe.width()) {
    constexpr int kSteps = 2000;
    double largest = lobe.weight(0);
    for (int i = 1; i <= kSteps; ++i) {
      const double angle = kPi * i / kSteps, sine = std::sin(angle / 2), value = lobe.weight(2 * sine * sine);
      if (value > largest * (1 + 1e-9)) {
        largest = value;
        peak = angle;
      }
    }
    for (const double s : lobe.breakpoints()) kink = kink || s == 1;
  }

  /// Whether a piece of that squared size at s = 1 − cos θ is to be subdivided.
  bool coarse(double size, double s) const {
    double away = 2 * s;
    if (peak > 0) {
      // To the near side of the piece.
      away =
          std::max(0.0, std::fabs(2 * std::asin(std::sqrt(std::min(1.0, s / 2))) - peak) - std::sqrt(size));
      away *= away;
    }
    if (size > kSmall * (core * core + away)) return true;
    return kink && size > kSmallKink && (s - 1) * (s - 1) < size;
  }

  double core, peak = 0;
  bool kink = false;
};

/// A lobe's weights for arrays of s. Tables are slow to look up: they are sampled again, 2¹⁶ times, which
/// changes them by less than 1e-7 of their largest value where they are smooth.
class PrefilterReference::Weights {
 public:
  explicit Weights(const lobe::AnyLobe& lobe) : lobe_(lobe) {
    if (lobe.name() == "table") samples_.emplace(lobe, lobe.width(), 1 << 16);
  }
  void operator()(const double* s, double* weights, std::size_t count) const {
    if (!samples_) return lobe_.weights64(s, weights, count);
    for (std::size_t i = 0; i < count; ++i) weights[i] = samples_->at_chord(std::sqrt(2 * s[i]));
  }
  const lobe::AnyLobe& lobe() const { return lobe_; }

 private:
  const lobe::AnyLobe& lobe_;
  std::optional<prefilter::ChordSamples> samples_;
};

PrefilterReference::PrefilterReference(const Map& source)
    : parameterization_(source.parameterization),
      orientation_(source.orientation),
      size_{source.width(), source.height()},
      channels_(static_cast<std::size_t>(source.channels())),
      limits_(texel_limits(parameterization_, size_)),
      mean_texel_(mean_texel(parameterization_, size_)),
      integral_(channels_) {
  std::size_t texel = 0;
  for (int chart = 0; chart < source.charts(); ++chart) {
    for (int y = 0; y < size_.height; ++y) {
      const std::vector<TexelKind> kinds = texel_kinds(parameterization_, size_, chart, y);
      const float* radiance = source.level.chart(chart).row(y);
      for (const TexelKind kind : kinds) {
        if (kind != TexelKind::outside) add_texel(texel, radiance, kind == TexelKind::plain);
        ++texel;
        radiance += channels_;
      }
    }
  }
}

ChartCell PrefilterReference::cell_of(std::size_t texel) const {
  const int x = static_cast<int>(texel % static_cast<std::size_t>(size_.width));
  const int row = static_cast<int>(texel / static_cast<std::size_t>(size_.width));
  return texel_cell(size_, row / size_.height, x, row % size_.height);
}

void PrefilterReference::add_texel(std::size_t texel, const float* radiance, bool plain) {
  const ChartCell cell = cell_of(texel);
  std::vector<TexelPoint> points;
  append_gauss_points(parameterization_, cell, points);
  const Vec3d a = points[3].direction - points[0].direction, b = points[2].direction - points[1].direction;
  double size = 1.5 * std::max(dot(a, a), dot(b, b));
  if (!plain) {
    // As close together as the points of an average texel.
    CellLimits limits = limits_;
    limits.side = mean_texel_;
    size = mean_texel_ * mean_texel_;
    points.clear();
    append_points(parameterization_, cell, limits, points);
  }
  double total = 0;
  for (const TexelPoint& point : points) total += point.solid_angle;
  for (std::size_t c = 0; c < channels_; ++c) integral_[c] += total * static_cast<double>(radiance[c]);
  if (points.empty()) return;
  if (!plain) {
    irregular_.push_back({std::move(points), size, {radiance, radiance + channels_}, texel});
    return;
  }
  for (const TexelPoint& point : points) {
    plain_.x.push_back(point.direction.x);
    plain_.y.push_back(point.direction.y);
    plain_.z.push_back(point.direction.z);
    plain_.solid_angle.push_back(point.solid_angle);
  }
  plain_.size.push_back(size);
  plain_.texel.push_back(texel);
  plain_.radiance.insert(plain_.radiance.end(), radiance, radiance + channels_);
}

double PrefilterReference::near_texel(const lobe::AnyLobe& lobe, const Vec3d& direction, const Scale& scale,
                                      const ChartCell& cell, bool plain,
                                      std::vector<TexelPoint>& points) const {
  const auto at = [&](double across, double down) {
    return parameterization_.to_sphere(cell.chart, cell.u + across * cell.width, cell.v + down * cell.height);
  };
  const Vec3d middle = at(0.5, 0.5), right = at(1, 0.5) - middle, down = at(0.5, 1) - middle;
  const Vec3d away = middle - direction;
  const double size = 4 * std::max(dot(right, right), dot(down, down));
  double sum = 0;
  if (size > 1e-20 && scale.coarse(size, dot(away, away) / 2)) {
    for (int k = 0; k < 4; ++k) {
      sum += near_texel(lobe, direction, scale, cell.part(k % 2, 2, k / 2, 2), plain, points);
    }
    return sum;
  }
  points.clear();
  if (plain) {
    append_gauss_points(parameterization_, cell, points);
  } else {
    CellLimits limits = limits_;
    limits.rim_depth = 0;
    append_points(parameterization_, cell, limits, points);
  }
  for (const TexelPoint& point : points) {
    const Vec3d d = point.direction - direction;
    sum += lobe.weight(dot(d, d) / 2) * point.solid_angle;
  }
  return sum;
}

void PrefilterReference::sum_plain(const Weights& weights, const Scale& scale, const Vec3d& r,
                                   double* sum) const {
  constexpr std::size_t kBlock = 512;
  double s[4 * kBlock], weight[4 * kBlock];
  std::vector<TexelPoint> near;
  const std::size_t texels = plain_.texel.size();
  for (std::size_t first = 0; first < texels; first += kBlock) {
    const std::size_t count = std::min(kBlock, texels - first);
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const std::size_t k = 4 * first + i;
      const double dx = plain_.x[k] - r.x, dy = plain_.y[k] - r.y, dz = plain_.z[k] - r.z;
      s[i] = 0.5 * (dx * dx + dy * dy + dz * dz);
    }
    weights(s, weight, 4 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = first + i;
      double integral = 0;
      if (scale.coarse(plain_.size[k], s[4 * i])) {
        integral = near_texel(weights.lobe(), r, scale, cell_of(plain_.texel[k]), true, near);
      } else {
        for (std::size_t j = 0; j < 4; ++j) integral += weight[4 * i + j] * plain_.solid_angle[4 * k + j];
      }
      for (std::size_t c = 0; c < channels_; ++c) {
        sum[c] += integral * static_cast<double>(plain_.radiance[k * channels_ + c]);
      }
    }
  }
}

void PrefilterReference::sum_irregular(const Weights& weights, const Scale& scale, const Vec3d& r,
                                       double* sum) const {
  std::vector<double> s, weight;
  std::vector<TexelPoint> near;
  for (const Irregular& texel : irregular_) {
    const std::size_t count = texel.points.size();
    s.resize(count);
    weight.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d d = texel.points[i].direction - r;
      s[i] = 0.5 * dot(d, d);
    }
    double integral = 0;
    if (scale.coarse(texel.size, *std::min_element(s.begin(), s.end()))) {
      integral = near_texel(weights.lobe(), r, scale, cell_of(texel.texel), false, near);
    } else {
      weights(s.data(), weight.data(), count);
      for (std::size_t i = 0; i < count; ++i) integral += weight[i] * texel.points[i].solid_angle;
    }
    for (std::size_t c = 0; c < channels_; ++c) sum[c] += integral * static_cast<double>(texel.radiance[c]);
  }
}

void PrefilterReference::evaluate(const lobe::AnyLobe& lobe, std::span<const Vec3d> directions,
                                  std::span<double> out, const Monitor& monitor) const {
  const Scale scale(lobe);
  const Weights weights(lobe);
  const double norm = 1 / lobe.integral();
  parallel_for(
      static_cast<int>(directions.size()),
      [&](int which) {
        const Vec3d r = orientation_ * normalize(directions[static_cast<std::size_t>(which)]);
        std::vector<double> sum(channels_);
        sum_plain(weights, scale, r, sum.data());
        sum_irregular(weights, scale, r, sum.data());
        for (std::size_t c = 0; c < channels_; ++c) {
          out[static_cast<std::size_t>(which) * channels_ + c] = sum[c] * norm;
        }
      },
      monitor);
}

}  // namespace welkin
