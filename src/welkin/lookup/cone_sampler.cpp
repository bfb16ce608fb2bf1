#include "welkin/lookup/cone_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/lookup/square_octahedron.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

/// A filter's name, and what makes it.
struct FilterEntry {
  std::string_view name;
  ConeFilter filter;
  ConeLookUpPtr (*make)(const SharedMap& map, const ConeSamplerOptions& options);
};

constexpr std::array<FilterEntry, 11> kFilters{{
    {"nearest", ConeFilter::nearest, make_point_look_up},
    {"bilinear", ConeFilter::bilinear, make_point_look_up},
    {"trilinear", ConeFilter::trilinear, make_trilinear},
    {"differential", ConeFilter::differential, make_differential},
    {"mirrored", ConeFilter::mirrored, make_mirrored},
    {"box", ConeFilter::box, make_box},
    {"sat", ConeFilter::sat, make_summed_area},
    {"probes", ConeFilter::probes, make_probes},
    {"ewa", ConeFilter::ewa, make_ewa},
    {"hybrid", ConeFilter::hybrid, make_hybrid},
    {"gaussian", ConeFilter::gaussian, make_gaussian},
}};

const FilterEntry& entry_of(ConeFilter filter) {
  const auto found = std::find_if(kFilters.begin(), kFilters.end(),
                                  [&](const FilterEntry& each) { return each.filter == filter; });
  require(found != kFilters.end(), "look-up: there is no such filter");
  return *found;
}

bool is_shown(const Map& map, int chart, int x, int y) {
  return map.parameterization.valid(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height());
}

/// Throws for a value that would spread over all that is averaged with it.
void require_finite(const Map& map) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const float* row = map.level.chart(chart).row(y);
      for (int i = 0; i < map.width() * map.channels(); ++i) {
        if (std::isfinite(row[i]) || !is_shown(map, chart, i / map.channels(), y)) continue;
        throw Error(ErrorKind::bad_value, "look-up: the texel at column " +
                                              std::to_string(i / map.channels()) + ", row " +
                                              std::to_string(y) + " of chart " + std::to_string(chart) +
                                              " is not finite; sanitize the map first");
      }
    }
  }
}

[[noreturn]] void refuse_cone(std::size_t index, const std::string& fault) {
  throw Error(ErrorKind::bad_request, "look-up: cone " + std::to_string(index) + ": " + fault);
}

/// Throws where a cone has a fault.
template <class Cone>
void check(std::span<const Cone> cones) {
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const std::string fault = fault_of(cones[i]);
    if (!fault.empty()) refuse_cone(i, fault);
  }
}

const EllipticalCone& elliptical(const EllipticalCone& cone) {
  return cone;
}
EllipticalCone elliptical(const QuadCone& cone) {
  return cone_of(cone);
}

}  // namespace

ConeFilter cone_filter_from_name(std::string_view name) {
  for (const FilterEntry& each : kFilters) {
    if (each.name == name) return each.filter;
  }
  throw Error(ErrorKind::bad_request, unknown_name("filter of cones", name, cone_filter_names()));
}

std::string_view name_of(ConeFilter filter) {
  return entry_of(filter).name;
}

bool is_usable(ConeFilter filter, const sphere::AnyParameterization& p) {
  if (filter == ConeFilter::mirrored) return is_square_octahedron(p);
  if (filter == ConeFilter::gaussian) return p.whole_world();
  if (filter == ConeFilter::sat) {
    return is_square_octahedron(p) || p.traits().cube_faces || p.traits().latlong_grid;
  }
  return true;
}

const std::vector<std::string>& cone_filter_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const FilterEntry& each : kFilters) all.emplace_back(each.name);
    return all;
  }();
  return names;
}

class ConeSampler::State {
 public:
  State(SharedMap map, const ConeSamplerOptions& options) : map_(std::move(map)) {
    require(map_ != nullptr, "look-up: there is no map");
    map_->check();
    require_finite(*map_);
    look_up_ = entry_of(options.filter).make(map_, options);
    whole_world_ = map_->parameterization.whole_world();
    turned_ = !(map_->orientation == Matrix3{});
  }

  int channels() const { return map_->channels(); }

  AimedCone aim(const EllipticalCone& cone) const {
    AimedCone aimed;
    const Vec3d direction = normalize(to_double(cone.direction));
    Vec3d axis = to_double(cone.axis);
    axis = axis - dot(axis, direction) * direction;
    const double across = length(axis);
    if (cone.wide > cone.narrow || (across > 1e-3 && std::isfinite(across))) {
      axis = (1 / across) * axis;
    } else {
      const Vec3d other = std::fabs(direction.y) < 0.7 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
      axis = normalize(cross(other, direction));
    }
    aimed.world = to_float(direction);
    aimed.world_axis = to_float(axis);
    const Vec3d turned = turned_ ? map_->orientation * direction : direction;
    const Vec3d turned_axis = turned_ ? map_->orientation * axis : axis;
    aimed.direction = to_float(turned);
    aimed.axis = to_float(turned_axis);
    aimed.across = to_float(cross(turned, turned_axis));
    // Beyond this all filters give the mean, and squares stay finite.
    constexpr float kWidest = 1e3f;
    aimed.wide = std::min(cone.wide, kWidest);
    aimed.narrow = std::min(cone.narrow, kWidest);
    return aimed;
  }

  void look_up(std::span<const AimedCone> cones, float* radiance) const {
    look_up_->look_up(cones, radiance);
    if (whole_world_) return;
    const std::size_t channels = static_cast<std::size_t>(map_->channels());
    for (std::size_t i = 0; i < cones.size(); ++i) {
      if (!map_->parameterization.covers(to_double(cones[i].direction))) {
        std::fill_n(radiance + i * channels, channels, 0.0f);
      }
    }
  }

 private:
  SharedMap map_;
  ConeLookUpPtr look_up_;
  bool whole_world_, turned_;
};

namespace {

template <class Cone>
void look_up_tiles(const ConeSampler::State& state, std::span<const Cone> cones, std::span<float> radiance) {
  const std::size_t channels = static_cast<std::size_t>(state.channels());
  if (radiance.size() / channels < cones.size()) {
    throw Error(ErrorKind::bad_request, "look-up: there is room for " + std::to_string(radiance.size()) +
                                            " values of " + std::to_string(channels) + " channels over " +
                                            std::to_string(cones.size()) + " cones");
  }
  check(cones);
  for (std::size_t from = 0; from < cones.size(); from += kConeTile) {
    const std::size_t here = std::min(kConeTile, cones.size() - from);
    std::array<AimedCone, kConeTile> tile;
    for (std::size_t i = 0; i < here; ++i) tile[i] = state.aim(elliptical(cones[from + i]));
    state.look_up({tile.data(), here}, radiance.data() + from * channels);
  }
}

SharedMap borrowed(const Map& map) {
  return {std::shared_ptr<void>(), &map};
}

}  // namespace

ConeSampler::ConeSampler(Map map, const ConeSamplerOptions& options)
    : ConeSampler(std::make_shared<const Map>(std::move(map)), options) {}

ConeSampler::ConeSampler(std::shared_ptr<const Map> map, const ConeSamplerOptions& options)
    : state_(std::make_shared<const State>(std::move(map), options)) {}

ConeSampler ConeSampler::borrow(const Map& map, const ConeSamplerOptions& options) {
  return ConeSampler(borrowed(map), options);
}

int ConeSampler::channels() const {
  return state_->channels();
}

void ConeSampler::look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const {
  look_up_tiles(*state_, cones, radiance);
}

void ConeSampler::look_up(std::span<const QuadCone> cones, std::span<float> radiance) const {
  look_up_tiles(*state_, cones, radiance);
}

}  // namespace welkin
