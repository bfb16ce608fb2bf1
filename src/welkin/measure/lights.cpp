#include "welkin/measure/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "welkin/base/parallel.h"
#include "welkin/map/luminance.h"
#include "welkin/map/row_bands.h"
#include "welkin/map/texel_points.h"
#include "welkin/math/angles.h"
#include "welkin/measure/energy_rows.h"
#include "welkin/measure/statistics.h"

namespace welkin {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Peaks are looked for in squares about so wide, radians: of a square only the brightest texel.
constexpr double kSquare = 1 * kDegree;

struct Peak {
  float luminance = -kInfinity;
  int chart = 0, x = 0, y = 0;
  Vec3d direction{0, 0, 1};  ///< in the map's frame
};

/// Directions by cells of space, so that near ones are found without going through all.
class Neighbourhood {
 public:
  explicit Neighbourhood(double reach) : side_(2 * std::sin(reach / 2)), cosine_(std::cos(reach)) {}

  /// Whether one of those added lies within reach.
  bool near(const Vec3d& d) const {
    const Cell middle = cell_of(d);
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells_.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
      if (found == cells_.end()) continue;
      for (const Vec3d& other : found->second) {
        if (dot(d, other) >= cosine_) return true;
      }
    }
    return false;
  }
  void add(const Vec3d& d) { cells_[cell_of(d)].push_back(d); }

 private:
  using Cell = std::array<int, 3>;
  Cell cell_of(const Vec3d& d) const {
    return {static_cast<int>(std::floor(d.x / side_)), static_cast<int>(std::floor(d.y / side_)),
            static_cast<int>(std::floor(d.z / side_))};
  }

  const double side_, cosine_;
  std::map<Cell, std::vector<Vec3d>> cells_;
};

/// The texels of a light that lie in one band of rows.
struct LightTexels {
  Vec3d sum{0, 0, 0};  ///< of directions, by luminance·solid angle
  double solid_angle = 0;
  std::vector<Vec3d> directions;
};

class LightFinder {
 public:
  LightFinder(const Map& map, const std::vector<float>& maxima, const Monitor& monitor)
      : map_(map),
        maxima_(maxima),
        monitor_(monitor),
        luminance_(map.channel_names),
        square_(std::max(
            1, static_cast<int>(kSquare / mean_texel(map.parameterization, {map.width(), map.height()})))),
        bands_(map.charts() * map.height()) {}

  std::vector<Light> find(double mean, int count) const {
    std::vector<Light> lights;
    const std::vector<Peak> peaks =
        find_peaks(static_cast<float>(kLightContrast * std::max(mean, 0.0)), count);
    if (peaks.empty()) return lights;
    std::vector<std::vector<LightTexels>> bands(static_cast<std::size_t>(bands_.count));
    parallel_for(
        bands_.count,
        [&](int band) {
          bands[static_cast<std::size_t>(band)].resize(peaks.size());
          collect(band, peaks, bands[static_cast<std::size_t>(band)]);
        },
        monitor_);
    const MapFrame frame(map_);
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      Light light;
      light.peak = static_cast<double>(peaks[k].luminance);
      Vec3d sum{0, 0, 0};
      for (const auto& band : bands) {
        sum = sum + band[k].sum;
        light.solid_angle += band[k].solid_angle;
      }
      const Vec3d middle = normalize(sum);
      light.direction = transpose(map_.orientation) * middle;
      for (const auto& band : bands) {
        for (const Vec3d& texel : band[k].directions)
          light.radius = std::max(light.radius, angle_between(middle, texel));
      }
      light.radius += texel_side(frame, peaks[k].direction) / 2;
      lights.push_back(light);
    }
    return lights;
  }

 private:
  Vec3d direction_of(int chart, int x, int y) const {
    return map_.parameterization.to_sphere(chart, (x + 0.5) / map_.width(), (y + 0.5) / map_.height());
  }

  /// body(x, luminance) for the valid texels of a row of at least `least`, which is positive.
  template <class Body>
  void for_bright(int chart, int y, float least, const Body& body) const {
    const auto& p = map_.parameterization;
    const bool full = p.full_charts();
    const std::size_t row = static_cast<std::size_t>(chart * map_.height() + y);
    const int segments = segments_of(map_.width());
    for (int segment = 0; segment < segments; ++segment) {
      const std::size_t i = row * static_cast<std::size_t>(segments) + static_cast<std::size_t>(segment);
      if (!(maxima_[i] >= least)) continue;
      const int first = segment * kSegment;
      const float* texel = map_.level.chart(chart).at(first, y);
      for (int x = first; x < std::min(first + kSegment, map_.width()); ++x, texel += map_.channels()) {
        const float value = luminance_(texel);
        if (!(value >= least) || !(value < kInfinity)) continue;
        if (full || p.valid(chart, (x + 0.5) / map_.width(), (y + 0.5) / map_.height())) body(x, value);
      }
    }
  }

  /// Those that are brighter than all within kLightReach, and no dimmer than `least`.
  std::vector<Peak> find_peaks(float least, int count) const {
    std::vector<Peak> candidates = brightest_of_squares(std::max(least, std::numeric_limits<float>::min()));
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Peak& a, const Peak& b) { return a.luminance > b.luminance; });
    std::vector<Peak> peaks;
    Neighbourhood brighter(kLightReach);
    for (Peak& each : candidates) {
      if (peaks.size() >= static_cast<std::size_t>(std::max(count, 0))) break;
      each.direction = direction_of(each.chart, each.x, each.y);
      if (!brighter.near(each.direction)) peaks.push_back(each);
      brighter.add(each.direction);
    }
    return peaks;
  }

  /// The brightest texel of every square that has one of at least `least`, in order.
  std::vector<Peak> brightest_of_squares(float least) const {
    const int across = (map_.width() + square_ - 1) / square_, down = (map_.height() + square_ - 1) / square_;
    std::vector<std::vector<Peak>> strips(static_cast<std::size_t>(map_.charts() * down));
    parallel_for(
        map_.charts() * down,
        [&](int i) {
          std::vector<Peak> squares(static_cast<std::size_t>(across));
          const int chart = i / down, first = i % down * square_;
          for (int y = first; y < std::min(first + square_, map_.height()); ++y) {
            for_bright(chart, y, least, [&](int x, float value) {
              Peak& peak = squares[static_cast<std::size_t>(x / square_)];
              if (value > peak.luminance) peak = {value, chart, x, y};
            });
          }
          std::vector<Peak>& found = strips[static_cast<std::size_t>(i)];
          std::copy_if(squares.begin(), squares.end(), std::back_inserter(found),
                       [](const Peak& peak) { return peak.luminance > 0; });
        },
        monitor_);
    std::vector<Peak> peaks;
    for (const auto& strip : strips) peaks.insert(peaks.end(), strip.begin(), strip.end());
    return peaks;
  }

  /// The texels of a band that belong to lights.
  void collect(int band, const std::vector<Peak>& peaks, std::vector<LightTexels>& lights) const {
    const double reach = std::cos(kLightReach);
    std::vector<float> omega;
    for (int row = bands_.first(band); row < bands_.first(band + 1); ++row) {
      const int chart = row / map_.height(), y = row % map_.height();
      omega.clear();
      for_bright(chart, y, peaks.back().luminance / 2, [&](int x, float value) {
        const Vec3d d = direction_of(chart, x, y);
        for (std::size_t k = 0; k < peaks.size(); ++k) {
          if (value < peaks[k].luminance / 2 || dot(d, peaks[k].direction) < reach) continue;
          if (omega.empty()) {
            omega.resize(static_cast<std::size_t>(map_.width()));
            texel_solid_angles(map_.parameterization, map_.width(), map_.height(), chart, y, omega.data());
          }
          const double weight = static_cast<double>(omega[static_cast<std::size_t>(x)]);
          lights[k].sum = lights[k].sum + weight * static_cast<double>(value) * d;
          lights[k].solid_angle += weight;
          lights[k].directions.push_back(d);
        }
      });
    }
  }

  const Map& map_;
  const std::vector<float>& maxima_;
  const Monitor& monitor_;
  const TexelLuminance luminance_;
  const int square_;  ///< texels across
  const RowBands bands_;
};

}  // namespace

std::vector<Light> find_lights(const Map& map, const std::vector<float>& maxima, double mean, int count,
                               const Monitor& monitor) {
  return LightFinder(map, maxima, monitor).find(mean, count);
}

}  // namespace welkin
