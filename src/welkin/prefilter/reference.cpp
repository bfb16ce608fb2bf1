#include "welkin/prefilter/reference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/base/parallel.h"
#include "welkin/prefilter/sampled_lobe.h"

namespace welkin {
namespace {

/// Gauss's two points in 0 … 1.
const double kGauss[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};

/// A piece is small enough when its size squared is this part of width² + distance².
constexpr double kSmall = 0.01;

/// And this, radians², where the lobe has a kink at the horizon.
constexpr double kSmallKink = 4e-4;

}  // namespace

/// A lobe does less and less away from where it is largest: its axis, or a ring about it.
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

  /// Whether a piece of that squared size at s = 1 − cos θ is to be cut up.
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

PrefilterReference::PrefilterReference(const Map& source)
    : parameterization_(source.parameterization),
      orientation_(source.orientation),
      width_(source.width()),
      height_(source.height()),
      channels_(source.channels()),
      integral_(static_cast<std::size_t>(source.channels())) {
  const bool full = parameterization_.full_charts();
  const double area = 1.0 / (static_cast<double>(width_) * height_);
  for (int chart = 0; chart < source.charts(); ++chart) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const float* texel = source.level.chart(chart).at(x, y);
        Vec3d corner[4];
        double total = 0;
        for (int k = 0; k < 4; ++k) {
          const double u = (x + kGauss[k % 2]) / width_, v = (y + kGauss[k / 2]) / height_;
          const Vec3d d = parameterization_.to_sphere(chart, u, v);
          const bool valid = full || parameterization_.valid(chart, u, v);
          const double omega = valid ? parameterization_.solid_angle_density(chart, u, v) * area / 4 : 0;
          corner[k] = d;
          total += omega;
          x_.push_back(d.x);
          y_.push_back(d.y);
          z_.push_back(d.z);
          solid_angle_.push_back(omega);
        }
        const Vec3d a = corner[3] - corner[0], b = corner[2] - corner[1];
        size_.push_back(1.5 * std::max(dot(a, a), dot(b, b)));
        texel_.push_back(static_cast<std::size_t>((chart * height_ + y) * width_ + x));
        for (int c = 0; c < channels_; ++c) {
          radiance_.push_back(texel[c]);
          integral_[static_cast<std::size_t>(c)] += total * static_cast<double>(texel[c]);
        }
      }
    }
  }
}

double PrefilterReference::near_texel(const lobe::AnyLobe& lobe, const Vec3d& direction, const Scale& scale,
                                      int chart, double u, double v, double du, double dv) const {
  const Vec3d middle = parameterization_.to_sphere(chart, u + du / 2, v + dv / 2);
  const Vec3d right = parameterization_.to_sphere(chart, u + du, v + dv / 2) - middle;
  const Vec3d down = parameterization_.to_sphere(chart, u + du / 2, v + dv) - middle;
  const Vec3d away = middle - direction;
  const double size = 4 * std::max(dot(right, right), dot(down, down));
  if (size > 1e-20 && scale.coarse(size, dot(away, away) / 2)) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      sum += near_texel(lobe, direction, scale, chart, u + (k % 2) * du / 2, v + (k / 2) * dv / 2, du / 2,
                        dv / 2);
    }
    return sum;
  }
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double pu = u + kGauss[k % 2] * du, pv = v + kGauss[k / 2] * dv;
    if (!parameterization_.valid(chart, pu, pv)) continue;
    const Vec3d d = parameterization_.to_sphere(chart, pu, pv) - direction;
    sum += lobe.weight(dot(d, d) / 2) * parameterization_.solid_angle_density(chart, pu, pv) * du * dv / 4;
  }
  return sum;
}

namespace {

/// A lobe's weights for arrays of s. Tables are slow to look up: they are sampled again, 2¹⁶ times, which
/// changes them by less than 1e-7 of their largest value where they are smooth.
class Weights64 {
 public:
  explicit Weights64(const lobe::AnyLobe& lobe) : lobe_(lobe) {
    if (lobe.name() == "table") samples_.emplace(lobe, lobe.width(), 1 << 16);
  }
  void operator()(const double* s, double* weights, std::size_t count) const {
    if (!samples_) return lobe_.weights64(s, weights, count);
    for (std::size_t i = 0; i < count; ++i) weights[i] = samples_->at_chord(std::sqrt(2 * s[i]));
  }

 private:
  const lobe::AnyLobe& lobe_;
  std::optional<prefilter::ChordSamples> samples_;
};

}  // namespace

void PrefilterReference::evaluate(const lobe::AnyLobe& lobe, std::span<const Vec3d> directions,
                                  std::span<double> out, const Monitor& monitor) const {
  const Scale fineness(lobe);
  const double scale = 1 / lobe.integral();
  const Weights64 weights(lobe);
  const std::size_t texels = texel_.size(), channels = static_cast<std::size_t>(channels_);
  parallel_for(
      static_cast<int>(directions.size()),
      [&](int which) {
        const Vec3d r = orientation_ * normalize(directions[static_cast<std::size_t>(which)]);
        std::vector<double> sum(channels);
        constexpr std::size_t kBlock = 512;
        double s[4 * kBlock], weight[4 * kBlock];
        for (std::size_t first = 0; first < texels; first += kBlock) {
          const std::size_t count = std::min(kBlock, texels - first);
          for (std::size_t i = 0; i < 4 * count; ++i) {
            const std::size_t k = 4 * first + i;
            const double dx = x_[k] - r.x, dy = y_[k] - r.y, dz = z_[k] - r.z;
            s[i] = 0.5 * (dx * dx + dy * dy + dz * dz);
          }
          weights(s, weight, 4 * count);
          for (std::size_t i = 0; i < count; ++i) {
            const std::size_t k = first + i;
            double integral = 0;
            if (fineness.coarse(size_[k], s[4 * i])) {
              const int x = static_cast<int>(texel_[k] % static_cast<std::size_t>(width_));
              const int row = static_cast<int>(texel_[k] / static_cast<std::size_t>(width_));
              integral =
                  near_texel(lobe, r, fineness, row / height_, static_cast<double>(x) / width_,
                             static_cast<double>(row % height_) / height_, 1.0 / width_, 1.0 / height_);
            } else {
              for (std::size_t j = 0; j < 4; ++j) integral += weight[4 * i + j] * solid_angle_[4 * k + j];
            }
            for (std::size_t c = 0; c < channels; ++c) {
              sum[c] += integral * static_cast<double>(radiance_[k * channels + c]);
            }
          }
        }
        for (std::size_t c = 0; c < channels; ++c) {
          out[static_cast<std::size_t>(which) * channels + c] = sum[c] * scale;
        }
      },
      monitor);
}

}  // namespace welkin
