#pragma once

#include <cstdint>
#include <vector>

#include "welkin/map/luminance.h"
#include "welkin/map/texel_grid.h"

/// Which texels a light consists of. Internal to light.
namespace welkin {

/// A light's part of texels' peak: below, they are its surroundings.
inline constexpr float kFaintest = 0.01f;

/// Luminance between two peaks that are two lights, as a part of the lower's.
inline constexpr float kSaddle = 0.5f;
/// The same where the lower is below kMinor of the higher, as the bright edge of a lamp's shade is.
inline constexpr float kMinor = 0.3f, kMinorSaddle = 0.2f;

/// Texels that are added all around.
inline constexpr int kRimTexels = 2;

struct BrightTexel {
  TexelGrid::Index texel;
  float luminance;
};

struct BrightRegion {
  std::vector<TexelGrid::Index> texels;  ///< the brightest first, then the rim
  std::size_t core = 0;                  ///< of these, those that are no rim
  std::vector<TexelGrid::Index> around;  ///< texels beside these, of no region
  float peak = 0;                        ///< largest luminance
  bool cut = false;                      ///< reaches the end of the map
};

/// The regions of `bright`, which are all texels of luminance ≥ some threshold: by falling peak, no texel in
/// two.
std::vector<BrightRegion> find_bright_regions(const Map& map, std::vector<BrightTexel> bright);

}  // namespace welkin
