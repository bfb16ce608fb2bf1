#include "welkin/filter/sampler.h"

#include <algorithm>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/sampler_job.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::bad_request, "look-up: " + why);
}

[[noreturn]] void refuse_level(double level, int levels) {
  refuse("there is no level " + std::to_string(level) + ": there are 0 to " + std::to_string(levels - 1));
}

[[noreturn]] void refuse_room(std::size_t room, std::size_t directions, int channels) {
  refuse("there is room for " + std::to_string(room) + " values of " + std::to_string(channels) +
         " channels along " + std::to_string(directions) + " directions");
}

void check_room(std::size_t room, const Sampler::State& state) {
  if (room < static_cast<std::size_t>(state.channels())) refuse_room(room, 1, state.channels());
}

void check_room(std::size_t room, std::size_t directions, const Sampler::State& state) {
  if (room / static_cast<std::size_t>(state.channels()) < directions) {
    refuse_room(room, directions, state.channels());
  }
}

void check_rgb(const Sampler::State& state) {
  if (state.channels() < 3) {
    refuse("a map of " + std::to_string(state.channels()) + " channels has no R, G and B");
  }
}

void check_levels(std::span<const float> levels, std::size_t directions, int count) {
  if (levels.size() != directions) {
    refuse(std::to_string(directions) + " directions, but " + std::to_string(levels.size()) + " levels");
  }
  const float last = static_cast<float>(count - 1);
  bool all = true;
  for (const float level : levels) all &= level >= 0 && level <= last;
  if (all) return;
  refuse_level(
      static_cast<double>(*std::find_if(levels.begin(), levels.end(),
                                        [&](float level) { return !(level >= 0 && level <= last); })),
      count);
}

std::size_t checked_count(const DirectionArrays& directions) {
  const std::size_t count = directions.x.size();
  if (directions.y.size() != count || directions.z.size() != count) refuse("x, y and z differ in length");
  return count;
}

StridedDirections part_of(std::span<const Vec3<float>> directions, std::size_t from) {
  static_assert(sizeof(Vec3<float>) == 3 * sizeof(float));
  const Vec3<float>* first = directions.data() + from;
  return {&first->x, &first->y, &first->z, 3};
}
const Vec3d* part_of(std::span<const Vec3d> directions, std::size_t from) {
  return directions.data() + from;
}
StridedDirections part_of(const DirectionArrays& directions, std::size_t from) {
  return {directions.x.data() + from, directions.y.data() + from, directions.z.data() + from, 1};
}

/// Tile after tile, all at one level.
template <class Directions>
void look_up_tiles(const Sampler::State& state, const Directions& directions, std::size_t count,
                   std::span<float> radiance, double level) {
  check_room(radiance.size(), count, state);
  const LevelBlend blend = state.blend_at(level);
  const std::size_t channels = static_cast<std::size_t>(state.channels());
  const std::size_t values = count * channels;
  for (std::size_t from = 0; from < count; from += state.tile_size()) {
    const std::size_t here = std::min(state.tile_size(), count - from);
    state.look_up(part_of(directions, from), here, blend, radiance.data() + from * channels,
                  values - from * channels);
  }
}

/// Tile after tile, each direction at its level.
template <class Directions>
void look_up_tiles(const Sampler::State& state, const Directions& directions, std::size_t count,
                   std::span<float> radiance, std::span<const float> levels) {
  check_room(radiance.size(), count, state);
  check_levels(levels, count, state.levels());
  const std::size_t channels = static_cast<std::size_t>(state.channels());
  for (std::size_t from = 0; from < count; from += state.tile_size()) {
    const std::size_t here = std::min(state.tile_size(), count - from);
    state.look_up(part_of(directions, from), here, levels.data() + from, radiance.data() + from * channels);
  }
}

/// A non-owning pointer.
template <class T>
std::shared_ptr<const T> borrowed(const T& object) {
  return {std::shared_ptr<void>(), &object};
}

std::shared_ptr<const Sampler::State> state_of(std::shared_ptr<const Map> map,
                                               const SamplerOptions& options) {
  if (!map) refuse("there is no map");
  if (options.levels < 0) refuse("a pyramid of " + std::to_string(options.levels) + " levels");
  auto state = std::make_shared<Sampler::State>(map, *map, options);
  state->add(map->parameterization, map->level);
  const int last_level = levels_below(map->width(), map->height());
  state->add_pyramid(*map, options.levels == 0 ? last_level : std::min(options.levels - 1, last_level));
  return state;
}

std::shared_ptr<const Sampler::State> state_of(std::shared_ptr<const Chain> chain,
                                               const SamplerOptions& options) {
  if (!chain || chain->levels.empty()) refuse("the chain has no levels");
  const Map& first = chain->levels[0];
  auto state = std::make_shared<Sampler::State>(chain, first, options);
  for (const Map& level : chain->levels) {
    if (level.channels() != first.channels()) refuse("the chain's levels differ in channels");
    if (!(level.parameterization == first.parameterization.at_size(level.width(), level.height())) ||
        !(level.orientation == first.orientation)) {
      refuse("the chain's levels differ in parameterization or orientation");
    }
    state->add(level.parameterization, level.level);
  }
  return state;
}

}  // namespace

void Sampler::State::add(const sphere::AnyParameterization& parameterization, const Level& level) {
  const bool same = !levels_.empty() && parameterization == levels_.back().parameterization;
  levels_.push_back(
      {view_of(level), parameterization, &parameterization.kernels(), parameterization.self(), same});
  last_level_ = levels() - 1;
}

void Sampler::State::add_pyramid(const Map& map, int levels) {
  if (levels > 0) pyramid_ = make_pyramid(map, levels);
  for (const Level& level : pyramid_) add(map.parameterization, level);
}

void Sampler::State::refuse_level(double level) const {
  welkin::refuse_level(level, levels());
}

Sampler::Sampler(Map map, const SamplerOptions& options)
    : Sampler(std::make_shared<const Map>(std::move(map)), options) {}

Sampler::Sampler(std::shared_ptr<const Map> map, const SamplerOptions& options)
    : state_(state_of(std::move(map), options)) {}

Sampler::Sampler(Chain chain, const SamplerOptions& options)
    : Sampler(std::make_shared<const Chain>(std::move(chain)), options) {}

Sampler::Sampler(std::shared_ptr<const Chain> chain, const SamplerOptions& options)
    : state_(state_of(std::move(chain), options)) {}

Sampler Sampler::borrow(const Map& map, const SamplerOptions& options) {
  return Sampler(borrowed(map), options);
}

int Sampler::channels() const {
  return state_->channels();
}

int Sampler::levels() const {
  return state_->levels();
}

void Sampler::look_up(const Vec3<float>& direction, std::span<float> radiance, double level) const {
  check_room(radiance.size(), *state_);
  state_->look_up_one(direction, state_->blend_at(level), radiance.data());
}

void Sampler::look_up(const Vec3d& direction, std::span<float> radiance, double level) const {
  check_room(radiance.size(), *state_);
  state_->look_up_one(direction, state_->blend_at(level), radiance.data());
}

std::array<float, 3> Sampler::rgb(const Vec3<float>& direction, double level) const {
  check_rgb(*state_);
  float radiance[kMaxChannels];
  state_->look_up_one(direction, state_->blend_at(level), radiance);
  return {radiance[0], radiance[1], radiance[2]};
}

std::array<float, 3> Sampler::rgb(const Vec3d& direction, double level) const {
  check_rgb(*state_);
  float radiance[kMaxChannels];
  state_->look_up_one(direction, state_->blend_at(level), radiance);
  return {radiance[0], radiance[1], radiance[2]};
}

void Sampler::look_up(std::span<const Vec3<float>> directions, std::span<float> radiance,
                      double level) const {
  look_up_tiles(*state_, directions, directions.size(), radiance, level);
}

void Sampler::look_up(std::span<const Vec3d> directions, std::span<float> radiance, double level) const {
  look_up_tiles(*state_, directions, directions.size(), radiance, level);
}

void Sampler::look_up(const DirectionArrays& directions, std::span<float> radiance, double level) const {
  look_up_tiles(*state_, directions, checked_count(directions), radiance, level);
}

void Sampler::look_up(std::span<const Vec3<float>> directions, std::span<float> radiance,
                      std::span<const float> levels) const {
  look_up_tiles(*state_, directions, directions.size(), radiance, levels);
}

void Sampler::look_up(std::span<const Vec3d> directions, std::span<float> radiance,
                      std::span<const float> levels) const {
  look_up_tiles(*state_, directions, directions.size(), radiance, levels);
}

void Sampler::look_up(const DirectionArrays& directions, std::span<float> radiance,
                      std::span<const float> levels) const {
  look_up_tiles(*state_, directions, checked_count(directions), radiance, levels);
}

bool Sampler::covers(const Vec3<float>& direction) const {
  return state_->covers(direction);
}

bool Sampler::covers(const Vec3d& direction) const {
  return state_->covers(direction);
}

}  // namespace welkin
