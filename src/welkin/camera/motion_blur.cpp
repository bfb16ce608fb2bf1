#include "welkin/camera/motion_blur.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/pyramid.h"
#include "welkin/sphere/kernels.h"

namespace welkin {
namespace {

using CameraAt = std::function<Camera(double frame)>;

constexpr int kLeastSamples = 16, kMostSamples = 1024, kMostAsked = 1 << 16;
/// Pixels that are looked up together.
constexpr std::size_t kRun = 256;
/// Points along each side of the picture at which its motion is measured, and times at which it is.
constexpr int kProbes = 9, kTimes = 17;
/// Of a pixel that is covered by one sample a pixel, the width that is read from the pyramid: positions in
/// pixels differ, so that neighbouring samples cover more than one does.
constexpr double kSharpness = 0.7;

void check(const Shutter& shutter) {
  require(std::isfinite(shutter.open) && std::isfinite(shutter.close) && shutter.open <= shutter.close,
          "a shutter opens before it closes");
}

/// A camera at one of the times that are averaged.
struct Exposure {
  MapFrame frame;
  Matrix3 to_world;
  float right, down;  ///< place in the pixel, 0 … 1
};

/// The sequence of Roberts (2018), whose points cover the square evenly at every length: the reciprocals of
/// the plastic number and of its square.
std::array<double, 2> place_in_pixel(int index) {
  const double x = 0.5 + 0.7548776662466927 * index, y = 0.5 + 0.5698402909980532 * index;
  return {x - std::floor(x), y - std::floor(y)};
}

/// How many positions of the camera are averaged. Over a long way a pixel's mean has settled before every
/// texel on it is read.
int samples_for(double way) {
  return std::clamp(static_cast<int>(std::ceil(std::min(1.5 * way, 36 + way / 4))), kLeastSamples,
                    kMostSamples);
}

std::vector<Exposure> exposures_of(const CameraAt& camera, const Shutter& shutter, int count) {
  std::vector<Exposure> all;
  for (int i = 0; i < count; ++i) {
    const double time = shutter.open + (shutter.close - shutter.open) * (i + 0.5) / count;
    MapFrame frame = frame_of(camera(time));
    const Matrix3 to_world = transpose(frame.orientation);
    const auto [x, y] = place_in_pixel(i);
    all.push_back({std::move(frame), to_world, static_cast<float>(x), static_cast<float>(y)});
    const MapFrame& first = all.front().frame;
    const MapFrame& last = all.back().frame;
    require(last.size.width == first.size.width && last.size.height == first.size.height &&
                last.parameterization.charts() == 1,
            "a camera that moves keeps the size of its picture, which is one chart");
  }
  return all;
}

/// The world's texels along a pixel's side, at a place of the picture: the root of the ratio of their solid
/// angles.
double texels_per_pixel(const Map& world, const Exposure& middle, double u, double v) {
  const sphere::AnyParameterization& lens = middle.frame.parameterization;
  if (!lens.valid(0, u, v)) return 0;
  const ChartSize size = middle.frame.size;
  const double pixel = lens.solid_angle_density(0, u, v) / (1.0 * size.width * size.height);
  const Vec3d d = world.orientation * (middle.to_world * lens.to_sphere(0, u, v));
  if (!world.parameterization.covers(d)) return 0;
  const auto at = world.parameterization.from_sphere(d);
  const double texel = world.parameterization.solid_angle_density(static_cast<int>(at.chart), at.u, at.v) /
                       (1.0 * world.width() * world.height());
  return texel > 0 ? std::sqrt(pixel / texel) : 0;
}

/// A run of pixels of one row.
class Run {
 public:
  Run(const Sampler& sampler, const MapFrame& frame) : sampler_(sampler), frame_(frame) {
    values_.resize(kRun * static_cast<std::size_t>(sampler.channels()));
  }

  /// The mean over all exposures to `out`, which is 0 where the picture shows nothing.
  void expose(const std::vector<Exposure>& exposures, std::size_t first, std::size_t count, int y,
              double level, float* out);

 private:
  using Row = std::array<float, sphere::padded(kRun)>;
  static constexpr std::size_t kPadded = sphere::padded(kRun);

  const Sampler& sampler_;
  const MapFrame& frame_;
  Row u_, v_, x_, y_, z_, mask_;
  std::vector<float> values_;
};

void Run::expose(const std::vector<Exposure>& exposures, std::size_t first, std::size_t count, int y,
                 double level, float* out) {
  const auto channels = static_cast<std::size_t>(sampler_.channels());
  const auto share = 1 / static_cast<float>(exposures.size());
  const float width = static_cast<float>(frame_.size.width), height = static_cast<float>(frame_.size.height);
  std::fill_n(out, count * channels, 0.0f);
  const auto rotated = [](const std::array<double, 3>& row, float dx, float dy, float dz) {
    return static_cast<float>(row[0]) * dx + static_cast<float>(row[1]) * dy +
           static_cast<float>(row[2]) * dz;
  };
  for (const Exposure& each : exposures) {
    for (std::size_t i = 0; i < kPadded; ++i) {
      u_[i] = (static_cast<float>(first + std::min(i, count - 1)) + each.right) / width;
      v_[i] = (static_cast<float>(y) + each.down) / height;
    }
    const sphere::AnyParameterization& lens = each.frame.parameterization;
    lens.kernels().to_sphere(lens.self(), 0, u_.data(), v_.data(), x_.data(), y_.data(), z_.data(), count);
    const auto& rows = each.to_world.rows;
    for (std::size_t i = 0; i < count; ++i) {
      const float dx = x_[i], dy = y_[i], dz = z_[i];
      x_[i] = rotated(rows[0], dx, dy, dz);
      y_[i] = rotated(rows[1], dx, dy, dz);
      z_[i] = rotated(rows[2], dx, dy, dz);
    }
    const DirectionArrays directions{{x_.data(), count}, {y_.data(), count}, {z_.data(), count}};
    sampler_.look_up(directions, values_, level);
    for (std::size_t i = 0; i < count * channels; ++i) out[i] += share * values_[i];
  }
  for (std::size_t i = 0; i < kPadded; ++i) {
    u_[i] = (static_cast<float>(first + std::min(i, count - 1)) + 0.5f) / width;
    v_[i] = (static_cast<float>(y) + 0.5f) / height;
  }
  frame_.parameterization.kernels().valid(frame_.parameterization.self(), 0, u_.data(), v_.data(),
                                          mask_.data(), count);
  for (std::size_t i = 0; i < count; ++i) {
    if (mask_[i] == 0) std::fill_n(out + i * channels, channels, 0.0f);
  }
}

}  // namespace

double swept_pixels(const std::function<Camera(double frame)>& camera, const Shutter& shutter) {
  check(shutter);
  if (shutter.open == shutter.close) return 0;
  const std::vector<Exposure> times = exposures_of(camera, shutter, kTimes);
  const MapFrame& middle = times[kTimes / 2].frame;
  double farthest = 0;
  for (int j = 0; j < kProbes; ++j) {
    for (int i = 0; i < kProbes; ++i) {
      const double u = (i + 0.5) / kProbes, v = (j + 0.5) / kProbes;
      if (!middle.parameterization.valid(0, u, v)) continue;
      // The smaller of a pixel's sides is at most the root of its solid angle.
      const double pixel = std::sqrt(middle.parameterization.solid_angle_density(0, u, v) /
                                     (1.0 * middle.size.width * middle.size.height));
      double way = 0;
      Vec3d before{};
      for (int k = 0; k < kTimes; ++k) {
        const Exposure& each = times[static_cast<std::size_t>(k)];
        const Vec3d now = each.to_world * each.frame.parameterization.to_sphere(0, u, v);
        if (k > 0) way += std::atan2(length(cross(before, now)), dot(before, now));
        before = now;
      }
      farthest = std::max(farthest, way * kTimes / (kTimes - 1) / pixel);
    }
  }
  return farthest;
}

namespace {

/// A world's look-ups down to a level.
using SamplerFor = std::function<Sampler(int levels)>;

Map blurred(const Map& world, const SamplerFor& sampler_for, const CameraAt& camera, const Shutter& shutter,
            const MotionBlurOptions& options) {
  check(shutter);
  require(!options.samples || (*options.samples >= 1 && *options.samples <= kMostAsked),
          "motion is blurred by 1 to 65536 samples");
  const double way = swept_pixels(camera, shutter);
  const int count = options.samples ? *options.samples : samples_for(way);
  const std::vector<Exposure> exposures = exposures_of(camera, shutter, count);
  const Exposure middle = exposures_of(camera, shutter, 1).front();
  const ChartSize size = middle.frame.size;
  Map picture(middle.frame.parameterization, size.width, size.height, world.channels());
  picture.channel_names = world.channel_names;
  picture.orientation = middle.frame.orientation;

  // Samples lie this many pixels apart, in a region of a pixel times the way that it goes.
  const double apart = std::sqrt((1 + way) / count);
  const auto runs = static_cast<int>((static_cast<std::size_t>(size.width) + kRun - 1) / kRun);
  std::vector<double> levels(static_cast<std::size_t>(runs) * static_cast<std::size_t>(size.height));
  double coarsest = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int run = 0; run < runs; ++run) {
      const double u = (std::min((run + 0.5) * static_cast<double>(kRun), size.width - 0.5)) / size.width,
                   v = (y + 0.5) / size.height;
      const double texels = texels_per_pixel(world, middle, u, v) * kSharpness * std::max(apart, 0.5);
      const double level = texels > 1 ? std::log2(texels) : 0;
      levels[static_cast<std::size_t>(y) * static_cast<std::size_t>(runs) + static_cast<std::size_t>(run)] =
          level;
      coarsest = std::max(coarsest, level);
    }
  }
  const int most = levels_below(world.width(), world.height());
  const Sampler sampler = sampler_for(std::min(static_cast<int>(std::ceil(coarsest)), most) + 1);
  parallel_for(
      size.height,
      [&](int y) {
        Run line(sampler, middle.frame);
        for (int run = 0; run < runs; ++run) {
          const std::size_t first = static_cast<std::size_t>(run) * kRun;
          const std::size_t pixels = std::min(kRun, static_cast<std::size_t>(size.width) - first);
          const double level = levels[static_cast<std::size_t>(y) * static_cast<std::size_t>(runs) +
                                      static_cast<std::size_t>(run)];
          line.expose(exposures, first, pixels, y, std::min<double>(level, sampler.levels() - 1),
                      picture.level.chart(0).at(static_cast<int>(first), y));
        }
      },
      options.monitor);
  return picture;
}

}  // namespace

Map blurred_view(const Map& world, const std::function<Camera(double frame)>& camera, const Shutter& shutter,
                 const MotionBlurOptions& options) {
  const auto sampler_for = [&](int levels) { return Sampler::borrow(world, {.levels = levels}); };
  return blurred(world, sampler_for, camera, shutter, options);
}

class BlurredWorld::State {
 public:
  explicit State(const Map& world) : world_(world), finest_(Sampler::borrow(world)) {}

  const Map& world() const { return world_; }

  Sampler sampler_for(int levels) const {
    if (levels <= 1) return finest_;
    const std::scoped_lock lock(mutex_);
    // A thread that waits for the pyramid's loops takes no other frame's work, which would wait for itself.
    if (!pyramid_)
      tbb::this_task_arena::isolate([this] { pyramid_ = Sampler::borrow(world_, {.levels = 0}); });
    return *pyramid_;
  }

 private:
  const Map& world_;
  const Sampler finest_;
  mutable std::mutex mutex_;
  mutable std::optional<Sampler> pyramid_;
};

BlurredWorld::BlurredWorld(const Map& world) : state_(std::make_shared<State>(world)) {}

Map BlurredWorld::view(const std::function<Camera(double frame)>& camera, const Shutter& shutter,
                       const MotionBlurOptions& options) const {
  const auto sampler_for = [this](int levels) { return state_->sampler_for(levels); };
  return blurred(state_->world(), sampler_for, camera, shutter, options);
}

}  // namespace welkin
