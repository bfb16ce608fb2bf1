#include "welkin/prefilter/sampled_group.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/prefilter/kernels.h"

namespace welkin::prefilter {
namespace {

/// Sums of a group are those of its lobes one by one, whatever the numbers of lobes, points and channels.
TEST(SampledGroup, SumsAreThoseOfEachLobe) {
  std::mt19937 random(1);
  std::normal_distribution<float> component;
  const auto fill = [&](std::vector<float>& x, std::vector<float>& y, std::vector<float>& z,
                        std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const float a = component(random), b = component(random), c = component(random);
      const float size = std::sqrt(a * a + b * b + c * c);
      x.push_back(a / size), y.push_back(b / size), z.push_back(c / size);
    }
  };
  for (const int members : {1, 5, 16}) {
    for (const int count : {1, 64, 100}) {
      for (const int channels : {1, 3, 5}) {
        std::vector<lobe::AnyLobe> lobes;
        for (int k = 0; k < members; ++k)
          lobes.push_back(lobe::AnyLobe::make("ggx").with_roughness(0.3 + 0.04 * k));
        std::vector<const lobe::AnyLobe*> pointers;
        std::vector<double> scales;
        for (const lobe::AnyLobe& each : lobes) {
          pointers.push_back(&each);
          scales.push_back(1 / each.integral());
        }
        const SampledGroup group(pointers, 2 * lobes.front().width(), scales);
        EXPECT_EQ(group.members % SampledGroup::kPack, 0u);
        std::vector<float> px, py, pz, weights, x, y, z;
        fill(px, py, pz, static_cast<std::size_t>(count));
        for (int i = 0; i < count * channels; ++i) weights.push_back(static_cast<float>(i % 7));
        constexpr std::size_t kDirections = 11;
        fill(x, y, z, kDirections);
        const lobe::Points points{px.data(), py.data(), pz.data(), weights.data(), count, channels};
        std::vector<float> sums(kDirections * static_cast<std::size_t>(channels) * group.members);
        kernels().group_sums(group, points, x.data(), y.data(), z.data(), sums.data(), kDirections);
        for (std::size_t i = 0; i < kDirections; ++i) {
          for (int c = 0; c < channels; ++c) {
            for (std::size_t k = 0; k < lobes.size(); ++k) {
              double exact = 0;
              for (int p = 0; p < count; ++p) {
                const auto at = static_cast<std::size_t>(p);
                const double dx = static_cast<double>(x[i] - px[at]), dy = static_cast<double>(y[i] - py[at]),
                             dz = static_cast<double>(z[i] - pz[at]);
                exact += scales[k] * lobes[k].weight(0.5 * (dx * dx + dy * dy + dz * dz)) *
                         static_cast<double>(
                             weights[at * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)]);
              }
              const std::size_t index =
                  (i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)) * group.members + k;
              // Linear between 2048 samples: 1e-5 of the largest weight, of each point.
              const double largest = scales[k] * lobes[k].weight(0) * 6 * count;
              EXPECT_NEAR(static_cast<double>(sums[index]), exact, 2e-5 * largest)
                  << members << count << channels;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
