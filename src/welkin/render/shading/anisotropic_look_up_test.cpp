#include "welkin/render/shading/anisotropic_look_up.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/render/shading/look_up_cases.h"

namespace welkin::scene {
namespace {

Material brushed(float roughness, float anisotropy) {
  Material material;
  material.metallic = 1;
  material.roughness = roughness;
  material.anisotropy = anisotropy;
  return material;
}

Surface seen_at(const Material& material, double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  Surface at{};
  at.normal = at.flat_normal = {0, 0, 1};
  at.tangent = {1, 0, 0};
  at.bitangent = {0, 1, 0};
  at.view = {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
  at.material = point_of(material);
  return at;
}

TEST(LobeTaps, WeighOneTogether) {
  for (const float roughness : {0.0f, 0.1f, 0.4f, 1.0f}) {
    for (const float anisotropy : {0.1f, 0.5f, 1.0f}) {
      for (const double cosine : {1.0, 0.5, 0.1, 1e-3}) {
        const Material material = brushed(roughness, anisotropy);
        const Surface at = seen_at(material, cosine, 0.4);
        std::vector<LobeTap> taps;
        append_lobe_taps(at, taps);
        EXPECT_LE(taps.size(), 1u * kMostLobeTaps);
        double sum = 0;
        for (const LobeTap& tap : taps) {
          sum += tap.weight;
          EXPECT_NEAR(length(tap.direction), 1, 1e-9);
          EXPECT_TRUE(tap.roughness >= 0 && tap.roughness <= 1);
        }
        EXPECT_NEAR(sum, 1, 1e-9);
      }
    }
  }
}

// As the anisotropy goes to 0 there is one look-up, along the mirror's direction.
TEST(LobeTaps, OfNearlyIsotropicFacetsAreOne) {
  const Material material = brushed(0.4f, 0.01f);
  const Surface at = seen_at(material, 0.6, 1.0);
  std::vector<LobeTap> taps;
  append_lobe_taps(at, taps);
  ASSERT_EQ(taps.size(), 1u);
  EXPECT_NEAR(length(taps[0].direction - reflected(at).direction), 0, 1e-9);
  EXPECT_NEAR(taps[0].roughness, 0.4, 1e-3);
}

// They lie in the plane of the view and the grain where the view is along the grain, and turn with the angle.
TEST(LobeTaps, LieAlongTheGrain) {
  Material material = brushed(0.2f, 0.7f);
  material.anisotropy_angle = static_cast<float>(kPi / 2);
  const Surface at = seen_at(material, 1, 0);
  std::vector<LobeTap> taps;
  append_lobe_taps(at, taps);
  ASSERT_GT(taps.size(), 3u);
  double across = 0;
  for (const LobeTap& tap : taps) {
    EXPECT_NEAR(tap.direction.x, 0, 1e-6);
    across = std::max(across, std::abs(tap.direction.y));
  }
  EXPECT_GT(across, 0.5);
}

TEST(LobeTaps, ShowWhatPathsDo) {
  const World world = smooth_world();
  for (const float roughness : {0.1f, 0.3f, 0.5f})
    for (const float anisotropy : {0.4f, 0.8f})
      EXPECT_LT(error_of_look_ups(brushed(roughness, anisotropy), world), 0.05)
          << roughness << ' ' << anisotropy;
}

}  // namespace
}  // namespace welkin::scene
