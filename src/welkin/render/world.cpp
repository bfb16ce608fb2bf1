#include "welkin/render/world.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "welkin/base/error.h"
#include "welkin/lookup/roughness_level.h"
#include "welkin/prefilter/bake.h"
#include "welkin/prefilter/prefilter.h"

namespace welkin::scene {
namespace {

/// A level of a chain: its roughness, and how many times smaller than the finest its faces are.
struct LevelPlan {
  double roughness;
  int smaller;
};
/// Closer where narrow lobes change. Faces halved from level to level would leave the widest lobes a texel.
constexpr LevelPlan kRough[] = {{0, 1},    {0.05, 1}, {0.1, 1}, {0.2, 1}, {0.3, 2},
                                {0.45, 4}, {0.6, 4},  {0.8, 8}, {1, 8}};
/// Of Charlie's chain, none of which is narrow throughout.
constexpr LevelPlan kSheen[] = {{0.07, 1}, {0.14, 1}, {0.28, 2}, {0.5, 2}, {1, 2}};

Chain chain_of(const Map& map, const char* lobe, std::span<const LevelPlan> plan, int side) {
  std::vector<PrefilterLevel> levels;
  for (const auto& [roughness, smaller] : plan)
    levels.push_back({{side / smaller, side / smaller}, lobe::AnyLobe::make(lobe).with_roughness(roughness)});
  return {prefilter_map(map, sphere::AnyParameterization::make("cube"), std::move(levels)), {}};
}

/// The level, a real number, that has a roughness; clamped.
double level_in(std::span<const LevelPlan> plan, double roughness) {
  roughness = std::clamp(roughness, plan.front().roughness, plan.back().roughness);
  std::size_t k = 1;
  while (k + 1 < plan.size() && plan[k].roughness < roughness) ++k;
  const double low = plan[k - 1].roughness, high = plan[k].roughness;
  return static_cast<double>(k - 1) + (roughness - low) / (high - low);
}

ConeSamplerOptions usual_cones(const Map& map) {
  constexpr std::int64_t kMostTexels = 1 << 21;
  const std::int64_t texels = std::int64_t{map.charts()} * map.width() * map.height();
  ConeSamplerOptions options;
  options.filter = texels <= kMostTexels && is_usable(ConeFilter::gaussian, map.parameterization)
                       ? ConeFilter::gaussian
                       : ConeFilter::probes;
  return options;
}

/// How far along a ray from inside of it a sphere is met; none from outside.
std::optional<double> sphere_distance(const Vec3d& from, const Vec3d& direction, double radius) {
  const double b = dot(from, direction), c = dot(from, from) - radius * radius,
               d2 = dot(direction, direction);
  if (c > 0) return std::nullopt;
  return (-b + std::sqrt(b * b - d2 * c)) / d2;
}

}  // namespace

Vec3d seen_from(const Proxy& proxy, const Vec3d& position, const Vec3d& direction) {
  const Vec3d from = position - proxy.centre;
  switch (proxy.shape) {
    case Proxy::Shape::far:
      return direction;
    case Proxy::Shape::sphere: {
      const auto distance = sphere_distance(from, direction, proxy.radius);
      return distance ? from + *distance * direction : direction;
    }
    case Proxy::Shape::ground: {
      const auto distance = sphere_distance(from, direction, proxy.radius);
      if (!distance) return direction;
      Vec3d met = from + *distance * direction;
      if (met.y < -proxy.height && direction.y < 0 && from.y > -proxy.height)
        met = from + ((-proxy.height - from.y) / direction.y) * direction;
      return met;
    }
    case Proxy::Shape::box: {
      double distance = std::numeric_limits<double>::infinity();
      const auto side = [&](double p, double d, double least, double most) {
        if (p < least || p > most) distance = -1;
        if (d > 0) distance = std::min(distance, (most - p) / d);
        if (d < 0) distance = std::min(distance, (least - p) / d);
      };
      side(position.x, direction.x, proxy.least.x, proxy.most.x);
      side(position.y, direction.y, proxy.least.y, proxy.most.y);
      side(position.z, direction.z, proxy.least.z, proxy.most.z);
      return distance >= 0 && std::isfinite(distance) ? from + distance * direction : direction;
    }
  }
  return direction;
}

class World::State {
 public:
  State(Map given, const Proxy& where, const ConeSamplerOptions& how)
      : map(std::make_shared<const Map>(std::move(given))), proxy(where), cone_options(how) {}

  std::shared_ptr<const Map> map;
  Proxy proxy;
  ConeSamplerOptions cone_options;
  std::mutex mutex;
  std::optional<ConeSampler> cones;
  std::optional<Sampler> bilinear, diffuse, rough, sheen;
  std::optional<ChainNotes> notes;  // of a chain that was given
  std::map<double, Sampler> phong;

  /// `made`, made by `make` if it isn't yet.
  template <class T, class Make>
  const T& once(std::optional<T>& made, const Make& make) {
    const std::lock_guard lock(mutex);
    // A thread that waits inside must not take up work that asks for the lock again.
    if (!made) tbb::this_task_arena::isolate([&] { made.emplace(make()); });
    return *made;
  }
};

World::World(Map map, const Proxy& proxy, const std::optional<ConeSamplerOptions>& cones) {
  map.check();
  const ConeSamplerOptions how = cones ? *cones : usual_cones(map);
  state_ = std::make_shared<State>(std::move(map), proxy, how);
}

void World::use_chain(Chain chain) {
  require(!chain.levels.empty(), "a chain has levels");
  ChainNotes notes = chain.notes;
  // Checks that they are noted, and ascend.
  (void)level_of_roughness(notes, 0.5);
  const std::lock_guard lock(state_->mutex);
  state_->rough.emplace(std::move(chain));
  state_->notes = std::move(notes);
}

const Map& World::map() const {
  return *state_->map;
}

const Proxy& World::proxy() const {
  return state_->proxy;
}

const ConeSampler& World::cones() const {
  return state_->once(state_->cones, [&] { return ConeSampler(state_->map, state_->cone_options); });
}

const Sampler& World::bilinear() const {
  return state_->once(state_->bilinear, [&] { return Sampler(state_->map); });
}

const Sampler& World::diffuse() const {
  return state_->once(state_->diffuse, [&] {
    BakeOptions options;
    options.lobe = lobe::AnyLobe::make("lambert");
    options.size = ChartSize{64, 64};
    return Sampler(bake(*state_->map, options));
  });
}

const Sampler& World::rough() const {
  return state_->once(state_->rough, [&] {
    // A face has a quarter of a lat-long's width, as its texels do along the equator.
    const int side = std::clamp(static_cast<int>(std::sqrt(1.0 * state_->map->charts() *
                                                           state_->map->width() * state_->map->height() / 6)),
                                256, 1024);
    return Sampler(chain_of(*state_->map, "ggx", kRough, side));
  });
}

double World::level_of(double roughness) const {
  if (state_->notes) return level_of_roughness(*state_->notes, std::clamp(roughness, 0.0, 1.0));
  return level_in(kRough, roughness);
}

const Sampler& World::sheen() const {
  return state_->once(state_->sheen, [&] { return Sampler(chain_of(*state_->map, "charlie", kSheen, 128)); });
}

double World::sheen_level_of(double roughness) const {
  return level_in(kSheen, roughness);
}

const Sampler& World::phong(double exponent) const {
  const std::lock_guard lock(state_->mutex);
  auto& made = state_->phong;
  if (const auto found = made.find(exponent); found != made.end()) return found->second;
  BakeOptions options;
  options.lobe = lobe::AnyLobe::make("phong,exponent=" + std::to_string(exponent));
  options.chain = false;
  options.size = ChartSize{256, 256};
  tbb::this_task_arena::isolate([&] { made.emplace(exponent, bake(*state_->map, options)); });
  return made.at(exponent);
}

}  // namespace welkin::scene
