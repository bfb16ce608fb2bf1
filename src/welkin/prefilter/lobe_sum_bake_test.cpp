#include "welkin/prefilter/lobe_sum_bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/prefilter/view_reference.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

LobeSumOptions small(int count) {
  LobeSumOptions options;
  options.view_cosines = {0.1, 0.3, 0.7};
  options.roughness = {0, 0.5, 0.8};
  options.count = count;
  options.bake.size = {32, 32};
  return options;
}

TEST(LobeSums, AConstantMapStaysConstant) {
  Map map(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int y = 0; y < 32; ++y) std::fill_n(map.level.chart(0).row(y), 64 * 3, 2.0f);
  fill_borders(map);
  const LobeSumSampler sampler(bake_lobe_sums(map, small(4)));
  const Vec3d normal{0, 0, 1};
  for (const double cosine : {0.02, 0.2, 0.5, 1.0}) {
    for (const double roughness : {0.0, 0.3, 0.8}) {
      const auto rgb = sampler.rgb(normal, {std::sqrt(1 - cosine * cosine), 0, cosine}, roughness);
      for (const float value : rgb) EXPECT_NEAR(value, 2.0f, 4e-5f);
    }
  }
  EXPECT_THROW(sampler.rgb(normal, normal, 0.9), Error);
  EXPECT_NEAR(sampler.albedo(0.3, 0.0), 1, 0.01);
  EXPECT_LT(sampler.albedo(0.3, 0.8), 0.8);
}

/// More look-ups are closer to the whole integral, and even one is closer than along the reflected direction.
TEST(LobeSums, MoreLookUpsAreCloser) {
  const Map map = render(synth::make("room"), sphere::AnyParameterization::make("latlong"), 128, 64);
  const ViewReference reference(map);
  const brdf::AnyBrdf brdf = brdf::AnyBrdf::make("ggx,roughness=0.5");
  std::vector<double> errors;
  for (const int count : {0, 1, 3}) {
    LobeSumChain chain = bake_lobe_sums(map, small(std::max(1, count)));
    if (count == 0) {
      // What engines do: the level of the roughness, along the reflected direction.
      for (LobeLookUp& each : chain.sums.look_ups)
        each = {1, 0.5 * (static_cast<double>(chain.chain.levels.size()) - 1), 0};
    }
    const LobeSumSampler sampler(std::move(chain));
    std::mt19937 random(7);
    std::normal_distribution<double> component;
    double error = 0;
    for (int i = 0; i < 40; ++i) {
      const Vec3d normal = normalize(Vec3d{component(random), component(random), component(random)});
      const Vec3d level =
          normalize(cross(normal, Vec3d{component(random), component(random), component(random)}));
      const Vec3d view = 0.1 * normal + std::sqrt(0.99) * level;
      std::array<double, 3> exact;
      reference.evaluate(brdf, normal, view, exact, 1e-5);
      const auto found = sampler.rgb(normal, view, 0.5);
      for (std::size_t c = 0; c < 3; ++c) {
        const double off = static_cast<double>(found[c]) - exact[c];
        error += off * off;
      }
    }
    errors.push_back(std::sqrt(error));
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
  EXPECT_LT(errors[2], 0.5 * errors[1]);
}

TEST(LobeSums, AreTheSameOnAnyNumberOfThreadsAndOfAnyMap) {
  LobeSumOptions options = small(3);
  EXPECT_EQ(fit_lobe_sums(options), fit_lobe_sums(options));
  options.roughness.clear();
  EXPECT_EQ(fit_lobe_sums(options).roughness.size(), 6u);  // of the levels of faces of 32
}

TEST(LobeSums, WhatCannotBeFitted) {
  LobeSumOptions options = small(0);
  EXPECT_THROW(fit_lobe_sums(options), Error);
  options = small(3);
  options.bake.lobe = lobe::AnyLobe::make("lambert");
  EXPECT_THROW(fit_lobe_sums(options), Error);
  options = small(3);
  options.view_cosines = {0};
  EXPECT_THROW(fit_lobe_sums(options), Error);
}

}  // namespace
}  // namespace welkin
