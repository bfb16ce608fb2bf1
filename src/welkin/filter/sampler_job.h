#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "welkin/filter/fetch.h"
#include "welkin/filter/sampler.h"
#include "welkin/filter/sampler_aim.h"

/// What a Sampler holds, and how it looks directions up: shared by sampler.cpp and sampler_tiles.cpp.
namespace welkin {

/// Directions looked up at once: few enough that all of their arrays stay in the innermost cache.
inline constexpr std::size_t kSamplerTile = 256;

/// The finer of two levels, and the weight of the coarser one.
struct LevelBlend {
  int finer;
  float weight;
};

class Sampler::State {
 public:
  /// Keeps `owner` alive, to which the levels belong.
  State(std::shared_ptr<const void> owner, const Map& map, const SamplerOptions& options);

  /// The next coarser level.
  void add(const sphere::AnyParameterization& parameterization, const Level& level);
  void add_pyramid(const Map& map, int levels);

  int channels() const { return channels_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  /// Throws Error when there is no such level.
  LevelBlend blend_at(double level) const {
    if (!(level >= 0 && level <= last_level_)) refuse_level(level);
    const int finer = static_cast<int>(level);
    return {finer, static_cast<float>(level - finer)};
  }

  /// radiance[i·channels…] of i < count, which is at most tile_size(). `room`: values that may be written.
  void look_up(const StridedDirections& directions, std::size_t count, const LevelBlend& level,
               float* radiance, std::size_t room) const;
  void look_up(const Vec3d* directions, std::size_t count, const LevelBlend& level, float* radiance,
               std::size_t room) const;
  void look_up_one(const Vec3<float>& direction, const LevelBlend& level, float* radiance) const;
  void look_up_one(const Vec3d& direction, const LevelBlend& level, float* radiance) const;
  /// Each at a level of its own, all of which are valid.
  void look_up(const StridedDirections& directions, std::size_t count, const float* levels,
               float* radiance) const;
  void look_up(const Vec3d* directions, std::size_t count, const float* levels, float* radiance) const;

  bool covers(const Vec3<float>& direction) const;
  bool covers(const Vec3d& direction) const;

  std::size_t tile_size() const { return tile_size_; }

 private:
  [[noreturn]] void refuse_level(double level) const;

  struct SampledLevel {
    LevelView view;
    sphere::AnyParameterization parameterization;
    const sphere::Kernels* kernels;
    const void* self;
    bool same_positions;  ///< as the level before: the parameterization does not depend on the size
  };
  template <std::size_t kSize>
  struct Tile;
  struct Group;

  template <std::size_t kSize>
  bool locate(int level, const StridedDirections& directions, std::size_t count, Tile<kSize>& tile) const;
  template <std::size_t kSize>
  bool locate(int level, const Vec3d* directions, std::size_t count, Tile<kSize>& tile) const;
  template <std::size_t kSize, class Directions>
  void look_up_tile(const Directions& directions, std::size_t count, const LevelBlend& level, float* radiance,
                    std::size_t room) const;
  template <class Directions>
  void look_up_levels(const Directions& directions, std::size_t count, const float* levels,
                      float* radiance) const;

  std::vector<SampledLevel> levels_;
  Fetch fetch_;
  AimKernels aim_;
  int channels_;
  double last_level_ = -1;
  bool whole_world_;
  std::size_t tile_size_;
  FloatOrientation float_orientation_;
  Matrix3 orientation_;
  std::shared_ptr<const void> owner_;
  std::vector<Level> pyramid_;
};

}  // namespace welkin
