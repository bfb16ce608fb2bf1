#include "welkin/light/region_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/light/region_cells.h"
#include "welkin/light/symmetric_axes.h"
#include "welkin/map/row_bands.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

/// How far from half a median cut may lie, to find a dark place.
constexpr double kBand = 0.1;

/// Light spread by less than this, radians RMS, is one spot.
constexpr double kSpot = 0.5 * kDegree;

/// Positions along an axis where a region can be cut.
constexpr std::size_t kBins = 256;

/// Light as a distribution of mass on the sphere.
struct Mass {
  double light = 0, solid_angle = 0;
  Vec3d moment{0, 0, 0};  ///< Σ light · direction

  void add(const RegionCell& cell) {
    const double weight = static_cast<double>(cell.light);
    light += weight;
    solid_angle += static_cast<double>(cell.solid_angle);
    moment = moment + weight * Vec3d{static_cast<double>(cell.x), static_cast<double>(cell.y),
                                     static_cast<double>(cell.z)};
  }
  Mass& operator+=(const Mass& other) {
    light += other.light;
    solid_angle += other.solid_angle;
    moment = moment + other.moment;
    return *this;
  }
  /// Σ light · |direction − centroid|², directions being of unit length.
  double spread() const { return light > 0 ? std::max(light - dot(moment, moment) / light, 0.0) : 0; }
};

Mass operator-(const Mass& a, const Mass& b) {
  return {a.light - b.light, a.solid_angle - b.solid_angle, a.moment - b.moment};
}

/// Cells from … to − 1 of the order.
struct Region {
  std::size_t from = 0, to = 0;
  Mass mass;
  bool whole = false;  ///< not to be cut any more
};

class RegionCutter {
 public:
  RegionCutter(const std::vector<RegionCell>& cells, RegionMethod method) : cells_(cells), method_(method) {
    Region all;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!(cells[i].solid_angle > 0)) continue;
      order_.push_back(static_cast<std::uint32_t>(i));
      all.mass.add(cells[i]);
    }
    all.to = order_.size();
    regions_.push_back(all);
  }

  void cut(std::size_t count, const Monitor& monitor) {
    while (regions_.size() < count) {
      if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
      const std::optional<std::size_t> next = most_urgent();
      if (!next) return;
      cut_region(*next);
      if (monitor.progress)
        monitor.progress(static_cast<double>(regions_.size()) / static_cast<double>(count));
    }
  }

  const std::vector<Region>& regions() const { return regions_; }
  std::uint32_t cell(std::size_t place) const { return order_[place]; }

 private:
  std::optional<std::size_t> most_urgent() const {
    std::optional<std::size_t> most;
    double highest = 0;
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      const Region& region = regions_[i];
      const double urgency = method_ == RegionMethod::variance ? region.mass.spread() : region.mass.light;
      if (region.whole || urgency <= highest) continue;
      highest = urgency;
      most = i;
    }
    return most;
  }

  const RegionCell& at(std::size_t place) const { return cells_[order_[place]]; }
  static Vec3d direction(const RegionCell& cell) {
    return {static_cast<double>(cell.x), static_cast<double>(cell.y), static_cast<double>(cell.z)};
  }

  /// Along which a region is longest: by its light, or by its solid angle.
  Vec3d axis_of(const Region& region) const {
    SymmetricMatrix moments;
    Vec3d mean{0, 0, 0};
    double total = 0;
    for (std::size_t i = region.from; i < region.to; ++i) {
      const RegionCell& cell = at(i);
      const double weight =
          static_cast<double>(method_ == RegionMethod::variance ? cell.light : cell.solid_angle);
      total += weight;
      mean = mean + weight * direction(cell);
      moments.add(weight, direction(cell));
    }
    if (total > 0) moments.add(-1 / total, mean);
    return longest_axis(moments);
  }

  struct Bins {
    double from = 0, step = 0;
    std::array<Mass, kBins> mass;

    std::size_t bin(double along) const {
      const double place = (along - from) / step;
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(kBins - 1)));
    }
  };

  /// Of the part of the axis where there is light.
  Bins bins_of(const Region& region, const Vec3d& axis) const {
    Bins bins;
    double least = 2, most = -2;
    for (std::size_t i = region.from; i < region.to; ++i) {
      if (!(at(i).light > 0)) continue;
      const double along = dot(axis, direction(at(i)));
      least = std::min(least, along);
      most = std::max(most, along);
    }
    bins.from = least;
    bins.step = (most - least) / kBins;
    if (!(bins.step > 1e-12)) return bins;
    for (std::size_t i = region.from; i < region.to; ++i)
      bins.mass[bins.bin(dot(axis, direction(at(i))))].add(at(i));
    return bins;
  }

  /// After which bin to cut; none where there is light in one alone.
  std::optional<std::size_t> place_of(const Region& region, const Bins& bins) const {
    return method_ == RegionMethod::variance ? least_spread(region, bins) : darkest_near_half(region, bins);
  }

  static std::optional<std::size_t> least_spread(const Region& region, const Bins& bins) {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    Mass below;
    for (std::size_t k = 0; k + 1 < kBins; ++k) {
      below += bins.mass[k];
      const Mass above = region.mass - below;
      if (!(below.light > 0) || !(above.light > 1e-12 * region.mass.light)) continue;
      const double spread = below.spread() + above.spread();
      if (spread >= least) continue;
      least = spread;
      best = k;
    }
    return best;
  }

  static std::optional<std::size_t> darkest_near_half(const Region& region, const Bins& bins) {
    std::optional<std::size_t> darkest, nearest;
    double least = std::numeric_limits<double>::infinity(), gap = 1;
    double below = 0;
    for (std::size_t k = 0; k + 1 < kBins; ++k) {
      below += bins.mass[k].light;
      const double away = std::fabs(below / region.mass.light - 0.5);
      if (below > 0 && away < gap && below < (1 - 1e-12) * region.mass.light) {
        gap = away;
        nearest = k;
      }
      if (away > kBand) continue;
      const double angle = bins.mass[k].solid_angle + bins.mass[k + 1].solid_angle;
      const double radiance = angle > 0 ? (bins.mass[k].light + bins.mass[k + 1].light) / angle : 0;
      if (radiance >= least) continue;
      least = radiance;
      darkest = k;
    }
    return darkest ? darkest : nearest;
  }

  void cut_region(std::size_t number) {
    const Region region = regions_[number];
    if (region.mass.spread() <= kSpot * kSpot * region.mass.light || region.to - region.from < 2) {
      regions_[number].whole = true;
      return;
    }
    const Vec3d axis = axis_of(region);
    const Bins bins = bins_of(region, axis);
    const std::optional<std::size_t> place = bins.step > 1e-12 ? place_of(region, bins) : std::nullopt;
    if (!place) {
      regions_[number].whole = true;
      return;
    }
    const auto begin = order_.begin();
    const auto middle = std::stable_partition(
        begin + static_cast<std::ptrdiff_t>(region.from), begin + static_cast<std::ptrdiff_t>(region.to),
        [&](std::uint32_t cell) { return bins.bin(dot(axis, direction(cells_[cell]))) <= *place; });
    Region below = region, above = region;
    below.to = above.from = static_cast<std::size_t>(middle - begin);
    for (Region* each : {&below, &above}) {
      each->mass = {};
      for (std::size_t i = each->from; i < each->to; ++i) each->mass.add(at(i));
    }
    regions_[number] = below;
    regions_.push_back(above);
  }

  const std::vector<RegionCell>& cells_;
  const RegionMethod method_;
  std::vector<std::uint32_t> order_;
  std::vector<Region> regions_;
};

/// Of every region, each channel's ∫ L dω and how many texels it has, from the texels themselves.
std::vector<double> energies_of(const Map& map, const MapScan& scan, const RegionCells& cells,
                                const std::vector<std::uint32_t>& region_of, std::size_t regions) {
  const std::size_t channels = static_cast<std::size_t>(map.channels()), stride = channels + 1;
  const TexelGrid grid(map);
  const RowBands bands(std::min(map.charts() * map.height(), 8));
  std::vector<std::vector<double>> parts(static_cast<std::size_t>(bands.count));
  const int rows = map.charts() * map.height();
  parallel_for(bands.count, [&](int band) {
    std::vector<double>& sums = parts[static_cast<std::size_t>(band)];
    sums.resize(regions * stride);
    const auto first = [&](int i) { return static_cast<int>(std::int64_t{rows} * i / bands.count); };
    for (int row = first(band); row < first(band + 1); ++row) {
      const int chart = row / map.height(), y = row % map.height();
      const float* texel = map.level.chart(chart).row(y);
      const std::size_t cell = cells.square_of_row(chart, y);
      for (int x = 0; x < map.width(); ++x, texel += map.channels()) {
        const double omega = scan.solid_angle(grid.number(chart, x, y));
        if (!(omega > 0)) continue;
        double* sum = sums.data() + region_of[cell + static_cast<std::size_t>(x / cells.side())] * stride;
        for (std::size_t c = 0; c < channels; ++c) sum[c] += omega * static_cast<double>(texel[c]);
        sum[channels] += 1;
      }
    }
  });
  std::vector<double> all(regions * stride);
  for (const auto& part : parts) {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += part[i];
  }
  return all;
}

}  // namespace

std::string_view name_of(RegionMethod method) {
  return method == RegionMethod::variance ? "variance" : "median-cut";
}

LightSet region_lights(const Map& map, const RegionOptions& options) {
  map.check();
  require(options.count >= 1 && options.count <= 65536, "a map becomes 1 to 65536 lights");
  const MapScan scan(map, part_of(options.monitor, 0, 0.2));
  const RegionCells cells(map, scan, part_of(options.monitor, 0.2, 0.4));
  RegionCutter cutter(cells.cells(), options.method);
  cutter.cut(static_cast<std::size_t>(options.count), part_of(options.monitor, 0.4, 1));

  const std::vector<Region>& regions = cutter.regions();
  std::vector<std::uint32_t> region_of_cell(cells.cells().size()), region_of(region_of_cell.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (std::size_t i = regions[r].from; i < regions[r].to; ++i)
      region_of_cell[cutter.cell(i)] = static_cast<std::uint32_t>(r);
  }
  for (std::size_t square = 0; square < region_of.size(); ++square)
    region_of[square] = region_of_cell[cells.cell_of_square(square)];
  const std::vector<double> energies = energies_of(map, scan, cells, region_of, regions.size());
  const TexelLuminance luminance(map.channel_names);
  const std::vector<int> channels = light_channels(map.channel_names);
  LightSet set;
  for (const int c : channels) set.channels.push_back(map.channel_names[static_cast<std::size_t>(c)]);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const double* energy = energies.data() + r * (static_cast<std::size_t>(map.channels()) + 1);
    ExtractedLight light;
    light.shape = LightShape::region;
    light.luminance = luminance.of_sums(energy);
    light.solid_angle = regions[r].mass.solid_angle;
    const Vec3d& moment = regions[r].mass.moment;
    const bool aimed = length(moment) > 1e-9 * regions[r].mass.light;
    light.direction = aimed ? transpose(map.orientation) * normalize(moment) : Vec3d{0, 1, 0};
    light.axis = normalize(
        cross(light.direction, std::fabs(light.direction.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1}));
    light.texels = static_cast<std::size_t>(energy[map.channels()]);
    bool any = false;
    for (const int c : channels) {
      light.irradiance.push_back(energy[c]);
      light.peak.push_back(light.solid_angle > 0 ? energy[c] / light.solid_angle : 0);
      any = any || energy[c] != 0;
    }
    if (any) set.lights.push_back(std::move(light));
  }
  std::stable_sort(
      set.lights.begin(), set.lights.end(),
      [](const ExtractedLight& a, const ExtractedLight& b) { return a.luminance > b.luminance; });
  return set;
}

}  // namespace welkin
