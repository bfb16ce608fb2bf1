#pragma once

#include <optional>
#include <span>
#include <vector>

#include "welkin/render/camera_rays.h"
#include "welkin/render/project/project.h"

/// Texels of a world projection, gathered by rays.
namespace welkin::scene {

/// Some texels of a chart.
struct TexelBlock {
  int chart = 0;
  int x = 0, y = 0;           ///< the first
  int width = 0, height = 0;  ///< how many
};

/// The blocks of all charts, each of as many rays as suit a processor's cache.
std::vector<TexelBlock> texel_blocks(int charts, ChartSize size, int samples);

/// The rays of a block's texels, row by row, samples² of each. They depend on no position.
struct TexelRays {
  TexelBlock block;                     ///< which
  int samples = 0;                      ///< rays of a texel along each axis
  std::uint32_t per_texel = 0;          ///< samples²
  std::vector<RaySpread> rays;          ///< from the origin
  std::vector<Vec3<float>> directions;  ///< theirs
  std::vector<float> weights;           ///< those of a texel add up to 1
  std::vector<bool> valid;  ///< of each texel: false where its centre is no position, its weights 0
};
TexelRays texel_rays(const MapFrame& frame, const TexelBlock& block, int samples);

/// What a texel sees.
struct SeenTexel {
  Rgb radiance = {};
  float coverage = 0;      ///< of surfaces
  float depth = 0;         ///< mean distance
  float depth_square = 0;  ///< mean of its square
  float behind = 0;        ///< share of rays that first meet a one-sided triangle's back
  bool all_sky = false;    ///< no surface: the background isn't in `radiance`
};

/// A background that is infinitely far, as texels and as rays see it.
struct FineSky {
  Map texels;               ///< means over the texels of a frame
  std::optional<Map> rays;  ///< and over the cells of each texel's rays, `samples` of them a side; none where
                            ///< there would be over 2²² of them
};
/// None where there is no background, or it isn't infinitely far.
std::optional<FineSky> sky_of(const World* background, const MapFrame& frame, int samples,
                              const Monitor& monitor = {});

/// Sees texels, those of one thread at a time.
class TexelEye {
 public:
  /// `sky` is null or outlives it.
  TexelEye(const ShadedScene& seen, const FineSky* sky, double farthest, bool shade_once);

  /// One of each texel, from a place.
  void see(const TexelRays& texels, const Vec3d& position, std::span<SeenTexel> out);

 private:
  /// A ray on its way.
  struct Way {
    std::uint32_t ray;
    float through;  ///< what is left of the light behind
    float near;
  };

  /// What rays of a texel meet that is shaded once.
  struct Group {
    std::uint32_t instance;
    Vec3<float> across;  ///< of unit length
    float distance;
    std::size_t surface;
  };

  void trace(const TexelRays& texels, const Vec3d& position, bool first, std::span<SeenTexel> out);
  bool joins_group(const Hit& hit, const Vec3<float>& across, float weight);
  void shade(std::span<SeenTexel> out);
  void add_background(const TexelRays& texels, const Vec3d& position, std::span<SeenTexel> out);

  ShadedScene seen_;
  const FineSky* sky_;
  double farthest_;
  bool shade_once_;
  std::vector<bool> opaque_, two_sided_;  // of each instance
  std::vector<Group> groups_;             // of the texel
  std::vector<Way> ways_, missed_;
  std::vector<Ray> traced_;
  std::vector<Hit> hits_;
  std::vector<Surface> surfaces_;
  std::vector<float> weights_;
  std::vector<std::uint32_t> texels_;  // of each surface
  std::vector<Rgb> radiance_;
};

}  // namespace welkin::scene
