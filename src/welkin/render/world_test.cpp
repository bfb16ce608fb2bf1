#include "welkin/render/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "welkin/prefilter/bake.h"
#include "welkin/synth/render_synth.h"

namespace welkin::scene {
namespace {

/// Directions all over the sphere (a spiral of the golden angle).
Vec3d direction(int i, int count) {
  const double y = 1 - (2 * i + 1.0) / count, s = std::sqrt(1 - y * y),
               phi = i * std::numbers::pi * (3 - std::sqrt(5.0));
  return {s * std::cos(phi), y, s * std::sin(phi)};
}

// A level's faces are fine enough for its lobe, the widest ones' too: what is looked up is within 1 % (RMS)
// of the map that is filtered with this lobe alone.
TEST(World, RoughLightIsItsLobesMean) {
  const auto map = [] {
    return welkin::render(synth::make("studio"), sphere::AnyParameterization::make("latlong"), 256, 128);
  };
  const World world(map());
  for (const double roughness : {0.2, 0.45, 0.6, 0.8, 1.0}) {
    BakeOptions alone;
    alone.chain = false;
    alone.lobe = lobe::AnyLobe::make("ggx").with_roughness(roughness);
    alone.size = ChartSize{512, 512};
    const Sampler right(bake(map(), alone));
    double error = 0, all = 0;
    constexpr int kCount = 1000;
    for (int i = 0; i < kCount; ++i) {
      const Vec3d d = direction(i, kCount);
      const double value = right.rgb(d)[1], found = world.rough().rgb(d, world.level_of(roughness))[1];
      error += (found - value) * (found - value);
      all += value * value;
    }
    EXPECT_LT(std::sqrt(error / all), 0.01) << roughness;
  }
}

}  // namespace
}  // namespace welkin::scene
