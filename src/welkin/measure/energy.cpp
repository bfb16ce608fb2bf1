#include "welkin/measure/energy.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/row_bands.h"
#include "welkin/math/angles.h"
#include "welkin/measure/common_channels.h"
#include "welkin/measure/energy_rows.h"
#include "welkin/measure/lights.h"

namespace welkin {
namespace {

/// The longest side of a frame's texels in and around a light, radians. `axis` is in the frame's directions.
double texel_side_near(const MapFrame& frame, const Light& light, const Vec3d& axis) {
  double longest = texel_side(frame, axis);
  const Vec3d across = normalize(cross(axis, std::fabs(axis.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  const Vec3d up = cross(across, axis);
  for (int k = 0; k < 8; ++k) {
    const double turn = k * kPi / 4;
    const Vec3d aside = std::cos(turn) * across + std::sin(turn) * up;
    longest =
        std::max(longest, texel_side(frame, std::cos(light.radius) * axis + std::sin(light.radius) * aside));
  }
  return longest;
}

/// A map in memory, measured in two steps: lights are found by what the first finds.
class MapRows {
 public:
  MapRows(const EnergyFrame& frame, const Map& map, const Monitor& monitor)
      : map_(map),
        segments_(segments_of(map.width())),
        rows_(static_cast<std::size_t>(map.charts() * map.height())),
        maxima_(rows_.size() * static_cast<std::size_t>(segments_)) {
    for_rows(monitor, [&](std::size_t i, int chart, int y) {
      rows_[i] = frame.whole(chart, y, map.level.chart(chart).row(y), map.channels(),
                             &maxima_[i * static_cast<std::size_t>(segments_)]);
    });
  }

  RowSums total() const { return total_of(rows_, map_.parameterization.coverage()); }
  /// Of each row's segments, as EnergyFrame::whole gives them.
  const std::vector<float>& maxima() const { return maxima_; }

  void add_cones(const EnergyFrame& frame, const Monitor& monitor) {
    for_rows(monitor, [&](std::size_t i, int chart, int y) {
      RowSums& row = rows_[i];
      row.in_cones.resize(frame.cones.size());
      for (EnergySum& each : row.in_cones) each.resize(frame.channels.size() + 1);
      frame.add_cones(chart, y, map_.level.chart(chart).row(y), map_.channels(), row);
    });
  }

 private:
  template <class Body>
  void for_rows(const Monitor& monitor, const Body& body) const {
    const RowBands bands(map_.charts() * map_.height());
    parallel_for(
        bands.count,
        [&](int band) {
          for (int row = bands.first(band); row < bands.first(band + 1); ++row)
            body(static_cast<std::size_t>(row), row / map_.height(), row % map_.height());
        },
        monitor);
  }

  const Map& map_;
  const int segments_;
  std::vector<RowSums> rows_;
  std::vector<float> maxima_;
};

EnergyFrame energy_frame(const MapFrame& frame, std::vector<int> channels,
                         const std::vector<std::string>& names) {
  return {frame, std::move(channels), TexelLuminance(names), {}, 0, std::nullopt};
}

/// Gives each frame the cones of the lights. `turns` takes directions of the lights' world to the frame's
/// own.
struct Aimed {
  EnergyFrame& frame;
  Matrix3 turn;
};
void add_cones(const std::vector<Light>& lights, std::initializer_list<Aimed> frames) {
  for (const Light& light : lights) {
    double texel = 0;
    for (const auto& [frame, turn] : frames)
      texel = std::max(texel, texel_side_near(frame.frame, light, turn * light.direction));
    for (const auto& [frame, turn] : frames) {
      frame.cones.push_back(cone_of(light, turn * light.direction, texel));
      frame.margin = std::max(frame.margin, texel);
    }
  }
}

Energy energy_of(const EnergySum& sum) {
  return {{sum.values.begin(), sum.values.end() - 1}, sum.values.back()};
}

double ratio_of(double before, double after, double magnitude) {
  const double difference = after - before;
  if (difference == 0) return 1;
  return magnitude > 0 ? 1 + difference / magnitude
                       : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

EnergyChange change_of(const EnergySum& before, const EnergySum& after) {
  EnergyChange change{energy_of(before), energy_of(after), {}, 1};
  for (std::size_t i = 0; i < before.values.size(); ++i)
    change.ratios.push_back(ratio_of(before.values[i], after.values[i], before.magnitudes[i]));
  change.ratio = change.ratios.back();
  change.ratios.pop_back();
  return change;
}

/// The directions that one map shows and another may not.
std::optional<EnergyFrame::Other> shown_by(const sphere::AnyParameterization& shown, const Matrix3& turn) {
  if (shown.whole_world()) return std::nullopt;
  return EnergyFrame::Other{shown, turn};
}

double mean_luminance(const RowSums& sums) {
  return sums.common > 0 ? sums.whole.values.back() / sums.common : 0;
}

}  // namespace

MapEnergy measure_energy(const Map& map, const EnergyOptions& options) {
  map.check();
  const std::vector<ChannelPair> pairs = common_channels(map.channel_names, map.channel_names);
  MapEnergy result;
  std::vector<int> channels;
  for (const ChannelPair& pair : pairs) {
    if (!pair.counts) continue;
    channels.push_back(pair.a);
    result.channels.push_back(pair.name);
  }
  EnergyFrame frame = energy_frame(map, channels, map.channel_names);
  MapRows rows(frame, map, options.monitor);
  const Monitor silent = without_progress(options.monitor);
  const std::vector<Light> lights =
      find_lights(map, rows.maxima(), mean_luminance(rows.total()), options.lights, silent);
  add_cones(lights, {{frame, map.orientation}});
  rows.add_cones(frame, silent);
  const RowSums sums = rows.total();
  result.skipped = sums.skipped;
  result.whole = energy_of(sums.whole);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const Energy energy = energy_of(sums.in_cones[k]);
    const double whole = result.whole.luminance;
    result.lights.push_back({lights[k], energy, whole > 0 ? energy.luminance / whole : 0});
  }
  return result;
}

double EnergyComparison::change_of_whole() const {
  double largest = std::fabs(whole.ratio - 1);
  for (const double ratio : whole.ratios) largest = std::max(largest, std::fabs(ratio - 1));
  return largest;
}

double EnergyComparison::change_of_lights() const {
  double largest = 0;
  for (const LightChange& each : lights) largest = std::max(largest, std::fabs(each.change.ratio - 1));
  return largest;
}

class EnergyMeter::Model {
 public:
  Model(const Map& before, const MapFrame& after, const std::vector<std::string>& names,
        const EnergyOptions& options)
      : after_(energy_frame(after, {}, names)),
        texel_channels_(static_cast<int>(names.size())),
        rows_(static_cast<std::size_t>(after.parameterization.charts() * after.size.height)),
        come_(rows_.size()) {
    std::vector<int> channels;
    for (const ChannelPair& pair : common_channels(before.channel_names, names)) {
      if (!pair.counts) continue;
      channels.push_back(pair.a);
      after_.channels.push_back(pair.b);
      channels_.push_back(pair.name);
    }
    const Matrix3 to_after = after.orientation * options.rotation,
                  between = to_after * transpose(before.orientation);
    EnergyFrame source = energy_frame(before, channels, before.channel_names);
    source.other = shown_by(after.parameterization, between);
    after_.other = shown_by(before.parameterization, transpose(between));
    MapRows rows(source, before, options.monitor);
    const Monitor silent = without_progress(options.monitor);
    lights_ = find_lights(before, rows.maxima(), mean_luminance(rows.total()), options.lights, silent);
    add_cones(lights_, {{source, before.orientation}, {after_, to_after}});
    rows.add_cones(source, silent);
    before_ = rows.total();
  }

  void add(int chart, int y, ImageView<const float> rows) {
    const auto [width, height] = after_.frame.size;
    require(chart >= 0 && chart < after_.frame.parameterization.charts() && y >= 0 &&
                y + rows.height <= height && rows.width == width && rows.channels == texel_channels_,
            "energy is measured of whole rows of the map");
    for (int i = 0; i < rows.height; ++i) {
      const std::size_t row = static_cast<std::size_t>(chart * height + y + i);
      if (come_[row].exchange(true)) continue;
      rows_[row] = after_.whole(chart, y + i, rows.row(i), texel_channels_);
      after_.add_cones(chart, y + i, rows.row(i), texel_channels_, rows_[row]);
    }
  }

  EnergyComparison comparison() const {
    require(
        std::all_of(come_.begin(), come_.end(), [](const std::atomic<bool>& come) { return come.load(); }),
        "energy is known when all rows of the map have been measured");
    const RowSums after = total_of(rows_, after_.frame.parameterization.coverage());
    EnergyComparison result;
    result.channels = channels_;
    result.whole = change_of(before_.whole, after.whole);
    for (std::size_t k = 0; k < lights_.size(); ++k)
      result.lights.push_back({lights_[k], change_of(before_.in_cones[k], after.in_cones[k])});
    result.solid_angle = before_.common;
    result.skipped = before_.skipped + after.skipped;
    return result;
  }

 private:
  std::vector<Light> lights_;
  EnergyFrame after_;
  const int texel_channels_;
  std::vector<std::string> channels_;
  RowSums before_;
  std::vector<RowSums> rows_;
  std::vector<std::atomic<bool>> come_;
};

EnergyMeter::EnergyMeter(const Map& before, const MapFrame& after, const std::vector<std::string>& channels,
                         const EnergyOptions& options) {
  before.check();
  require(is_orthonormal(options.rotation), "a world is turned by a rotation or a reflection");
  model_ = std::make_unique<Model>(before, after, channels, options);
}
EnergyMeter::~EnergyMeter() = default;
EnergyMeter::EnergyMeter(EnergyMeter&&) noexcept = default;
EnergyMeter& EnergyMeter::operator=(EnergyMeter&&) noexcept = default;

void EnergyMeter::add(int chart, int y, ImageView<const float> rows) {
  model_->add(chart, y, rows);
}

EnergyComparison EnergyMeter::comparison() const {
  return model_->comparison();
}

EnergyComparison compare_energy(const Map& before, const Map& after, const EnergyOptions& options) {
  before.check();
  after.check();
  require(is_orthonormal(options.rotation), "a world is turned by a rotation or a reflection");
  EnergyOptions first = options;
  first.monitor = part_of(options.monitor, 0, 0.5);
  EnergyMeter::Model model(before, after, after.channel_names, first);
  parallel_for(
      after.charts() * after.height(),
      [&](int i) {
        const int chart = i / after.height(), y = i % after.height();
        model.add(chart, y, after.level.chart(chart).part(0, y, after.width(), 1));
      },
      part_of(options.monitor, 0.5, 1));
  return model.comparison();
}

}  // namespace welkin
