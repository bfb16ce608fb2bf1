#include "welkin/light/extract.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/light/bright_regions.h"
#include "welkin/light/light_form.h"
#include "welkin/light/map_scan.h"
#include "welkin/light/surroundings.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

using Index = TexelGrid::Index;

/// Of the candidates, so many times as many as are wanted are measured: those that have the most light,
/// surroundings included.
constexpr std::size_t kMeasured = 4, kMeasuredBesides = 64;

/// The values of a texel.
template <class AnyMap>
auto at(AnyMap& map, Index texel) {
  const Index row = texel / map.width();
  return map.level.chart(static_cast<int>(row / map.height()))
      .at(static_cast<int>(texel % map.width()), static_cast<int>(row % map.height()));
}

/// A region with what lies above its surroundings.
struct MeasuredRegion {
  const BrightRegion* region = nullptr;
  std::vector<float> rest;  ///< what stays, of each texel and channel
  std::vector<double> irradiance;
  double luminance = 0;
};

class Extractor {
 public:
  Extractor(const Map& map, const ExtractOptions& options)
      : map_(map),
        options_(options),
        grid_(map),
        luminance_(map.channel_names),
        channels_(light_channels(map.channel_names)),
        scan_(map, part_of(options.monitor, 0, 0.5)) {}

  Extraction run() const {
    Extraction result{{}, map_.clone(), scan_.mean(), scan_.shown(), {}, {}};
    for (const int c : channels_) {
      result.found.channels.push_back(map_.channel_names[static_cast<std::size_t>(c)]);
      result.energy.push_back(scan_.sums()[static_cast<std::size_t>(c)]);
    }
    result.residual_energy = result.energy;
    const std::vector<BrightRegion> regions = find_regions();
    std::vector<MeasuredRegion> lights = strongest(regions);
    const Monitor monitor = part_of(options_.monitor, 0.5, 1);
    result.found.lights.resize(lights.size());
    parallel_for(
        static_cast<int>(lights.size()),
        [&](int i) {
          const std::size_t k = static_cast<std::size_t>(i);
          result.found.lights[k] = describe(lights[k]);
        },
        monitor);
    for (const MeasuredRegion& each : lights) {
      for (std::size_t c = 0; c < channels_.size(); ++c) result.residual_energy[c] -= each.irradiance[c];
      take_out(each, result.residual);
    }
    if (!lights.empty()) fill_borders(result.residual);
    restore(result.found);
    return result;
  }

 private:
  std::vector<BrightRegion> find_regions() const {
    if (options_.most == 0 || !(scan_.mean() > 0)) return {};
    const double least = options_.above * scan_.mean();
    if (!(least < static_cast<double>(std::numeric_limits<float>::max()))) return {};
    std::vector<BrightTexel> bright;
    scan_.for_bright(std::max(static_cast<float>(least), std::numeric_limits<float>::min()),
                     [&](Index texel, float value) {
                       bright.push_back({texel, value});
                     });
    std::vector<BrightRegion> regions = find_bright_regions(map_, std::move(bright));
    // More than are wanted, since it isn't known yet how bright their surroundings are.
    const std::size_t measured = kMeasured * static_cast<std::size_t>(options_.most) + kMeasuredBesides;
    if (regions.size() > measured) {
      std::vector<std::pair<double, std::size_t>> order;
      for (std::size_t k = 0; k < regions.size(); ++k) order.push_back({-gross(regions[k]), k});
      std::sort(order.begin(), order.end());
      std::vector<BrightRegion> most;
      for (std::size_t k = 0; k < measured; ++k) most.push_back(std::move(regions[order[k].second]));
      regions = std::move(most);
    }
    return regions;
  }

  double gross(const BrightRegion& region) const {
    double sum = 0;
    for (std::size_t k = 0; k < region.core; ++k)
      sum +=
          scan_.solid_angle(region.texels[k]) * static_cast<double>(luminance_(at(map_, region.texels[k])));
    return sum;
  }

  /// In the map's frame.
  Vec3d direction_of(Index texel) const {
    const auto [chart, x, y] = grid_.place(texel);
    return map_.parameterization.to_sphere(chart, (x + 0.5) / map_.width(), (y + 0.5) / map_.height());
  }

  std::vector<MeasuredRegion> strongest(const std::vector<BrightRegion>& regions) const {
    std::vector<MeasuredRegion> lights(regions.size());
    parallel_for(
        static_cast<int>(regions.size()),
        [&](int i) { lights[static_cast<std::size_t>(i)] = measure(regions[static_cast<std::size_t>(i)]); },
        without_progress(options_.monitor));
    std::erase_if(lights, [](const MeasuredRegion& light) { return !(light.luminance > 0); });
    std::stable_sort(lights.begin(), lights.end(), [](const MeasuredRegion& a, const MeasuredRegion& b) {
      return a.luminance > b.luminance;
    });
    lights.resize(std::min(lights.size(), static_cast<std::size_t>(options_.most)));
    return lights;
  }

  Surroundings surroundings_of(const BrightRegion& region) const {
    std::vector<RimPoint> points;
    std::vector<float> values;
    for (const Index texel : region.around) {
      const double omega = scan_.solid_angle(texel);
      if (!(omega > 0)) continue;
      points.push_back({direction_of(texel), std::sqrt(omega)});
      for (const int c : channels_) values.push_back(at(map_, texel)[c]);
    }
    return {points, values, channels_.size(), direction_of(region.texels.front())};
  }

  MeasuredRegion measure(const BrightRegion& region) const {
    const std::size_t channels = channels_.size();
    MeasuredRegion light{&region, std::vector<float>(region.texels.size() * channels),
                         std::vector<double>(channels), 0};
    const Surroundings surroundings = surroundings_of(region);
    std::vector<double> around(channels);
    if (surroundings.empty()) {
      // Other lights on all sides: its own faintest texel.
      std::fill(around.begin(), around.end(), std::numeric_limits<double>::infinity());
      for (const Index texel : region.texels) {
        for (std::size_t c = 0; c < channels; ++c)
          around[c] = std::min(around[c], static_cast<double>(at(map_, texel)[channels_[c]]));
      }
    }
    std::vector<double> sums(static_cast<std::size_t>(map_.channels()));
    for (std::size_t k = 0; k < region.texels.size(); ++k) {
      const Index texel = region.texels[k];
      if (!surroundings.empty()) surroundings.evaluate(direction_of(texel), around.data());
      const float* values = at(map_, texel);
      for (std::size_t c = 0; c < channels; ++c) {
        const float value = values[channels_[c]], rest = std::min(value, static_cast<float>(around[c]));
        light.rest[k * channels + c] = rest;
        sums[static_cast<std::size_t>(channels_[c])] +=
            scan_.solid_angle(texel) * (static_cast<double>(value) - static_cast<double>(rest));
      }
    }
    for (std::size_t c = 0; c < channels; ++c)
      light.irradiance[c] = sums[static_cast<std::size_t>(channels_[c])];
    light.luminance = luminance_.of_sums(sums.data());
    return light;
  }

  ExtractedLight describe(const MeasuredRegion& measured) const {
    const BrightRegion& region = *measured.region;
    ExtractedLight light;
    light.irradiance = measured.irradiance;
    light.luminance = measured.luminance;
    light.texels = region.core;
    light.cut = region.cut;
    for (const int c : channels_) {
      const auto value = [&](Index texel) { return at(map_, texel)[c]; };
      light.peak.push_back(static_cast<double>(value(region.texels.front())));
      float maximum = 0;
      for (const Index texel : region.texels) maximum = std::max(maximum, value(texel));
      const auto flat = static_cast<std::size_t>(
          std::count_if(region.texels.begin(), region.texels.end(),
                        [&](Index texel) { return value(texel) == maximum && maximum > 0; }));
      light.flat_texels = std::max(light.flat_texels, flat);
    }
    std::vector<LitTexel> texels;
    std::vector<float> difference(static_cast<std::size_t>(map_.channels()));
    for (std::size_t k = 0; k < region.texels.size(); ++k) {
      const Index texel = region.texels[k];
      for (std::size_t c = 0; c < channels_.size(); ++c) {
        difference[static_cast<std::size_t>(channels_[c])] =
            at(map_, texel)[channels_[c]] - measured.rest[k * channels_.size() + c];
      }
      texels.push_back({texel, static_cast<double>(luminance_(difference.data())), scan_.solid_angle(texel),
                        direction_of(texel)});
    }
    const LightForm form = find_form(map_, texels);
    const Matrix3 to_world = transpose(map_.orientation);
    light.direction = to_world * form.direction;
    light.axis = to_world * form.axis;
    light.shape = form.shape;
    light.solid_angle = form.solid_angle;
    light.half_axes = form.half_axes;
    return light;
  }

  void take_out(const MeasuredRegion& light, Map& residual) const {
    for (std::size_t k = 0; k < light.region->texels.size(); ++k) {
      float* values = at(residual, light.region->texels[k]);
      for (std::size_t c = 0; c < channels_.size(); ++c)
        values[channels_[c]] = light.rest[k * channels_.size() + c];
    }
  }

  void restore(LightSet& found) const {
    if (!options_.sun_irradiance || found.lights.empty()) return;
    ExtractedLight& sun = found.lights.front();
    sun.restored = *options_.sun_irradiance / sun.luminance;
    for (double& each : sun.irradiance) each *= sun.restored;
    sun.luminance = *options_.sun_irradiance;
    std::stable_sort(
        found.lights.begin(), found.lights.end(),
        [](const ExtractedLight& a, const ExtractedLight& b) { return a.luminance > b.luminance; });
  }

  const Map& map_;
  const ExtractOptions& options_;
  const TexelGrid grid_;
  const TexelLuminance luminance_;
  const std::vector<int> channels_;
  const MapScan scan_;
};

void check(const ExtractOptions& options) {
  require(options.most >= 0, "a number of lights is at least 0");
  require(options.above > 1 && std::isfinite(options.above),
          "lights are a finite number of times as bright as the mean, above 1");
  require(!options.sun_irradiance || (*options.sun_irradiance > 0 && std::isfinite(*options.sun_irradiance)),
          "the irradiance of a sun is finite and above 0");
}

}  // namespace

Extraction extract_lights(const Map& map, const ExtractOptions& options) {
  map.check();
  check(options);
  return Extractor(map, options).run();
}

}  // namespace welkin
