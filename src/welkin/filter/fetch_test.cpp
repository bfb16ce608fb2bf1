#include "welkin/filter/fetch.h"

#include <array>

#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

constexpr std::size_t kCount = 512;

struct Positions {
  alignas(64) std::array<float, kCount> chart, u, v;
};

/// All over the charts and up to half a texel outside.
Positions random_positions(const Map& map) {
  std::mt19937 random(3);
  const float outside = 0.5f / static_cast<float>(map.width());
  std::uniform_real_distribution<float> along(-outside, 1 + outside);
  Positions positions;
  for (std::size_t i = 0; i < kCount; ++i) {
    positions.chart[i] = static_cast<float>(static_cast<int>(i) % map.charts());
    positions.u[i] = along(random);
    positions.v[i] = along(random);
  }
  return positions;
}

std::vector<float> fetched(Fetch fetch, const Map& map, const Positions& positions) {
  std::vector<float> out(kCount * static_cast<std::size_t>(map.channels()) + 8);
  fetch(view_of(map.level), positions.chart.data(), positions.u.data(), positions.v.data(), out.data(),
        kCount);
  out.resize(out.size() - 8);
  return out;
}

std::vector<Fetch> all_kernels(int channels, FetchKernels (*table)(int)) {
  const FetchKernels k = table(channels);
  return {
      k.nearest,          k.bilinear,           k.bicubic.unclamped, k.bicubic.clamped, k.lanczos3.unclamped,
      k.lanczos3.clamped, k.lanczos4.unclamped, k.lanczos4.clamped};
}

/// Kernels that interpolate give a texel's own value at its centre, and those with weights of sum 1 a plane
/// where the source is one: bilinear and Keys' cubic exactly.
TEST(FetchTest, CentresGiveTexelsAndPlanesStayPlanes) {
  Map map(sphere::AnyParameterization::make("latlong"), 32, 16, 3);
  for (int y = -kBorder; y < 16 + kBorder; ++y) {
    for (int x = -kBorder; x < 32 + kBorder; ++x) {
      float* texel = map.level.chart(0).at(x, y);
      for (int c = 0; c < 3; ++c)
        texel[c] = static_cast<float>(c + 1) *
                   (0.5f + 0.25f * static_cast<float>(x) - 0.125f * static_cast<float>(y));
    }
  }
  Positions centres = random_positions(map), anywhere = centres;
  for (std::size_t i = 0; i < kCount; ++i) {
    centres.u[i] = (std::floor(clamp(centres.u[i], 0.0f, 0.999f) * 32) + 0.5f) / 32;
    centres.v[i] = (std::floor(clamp(centres.v[i], 0.0f, 0.999f) * 16) + 0.5f) / 16;
  }
  const auto expect_plane = [&](Fetch fetch, const Positions& positions, double tolerance) {
    const std::vector<float> values = fetched(fetch, map, positions);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double x = 32.0 * static_cast<double>(positions.u[i]) - 0.5,
                   y = 16.0 * static_cast<double>(positions.v[i]) - 0.5;
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = (static_cast<double>(c) + 1) * (0.5 + 0.25 * x - 0.125 * y);
        ASSERT_NEAR(values[3 * i + c], expected, tolerance) << i;
      }
    }
  };
  for (const Fetch fetch : all_kernels(3, fetch_kernels)) expect_plane(fetch, centres, 1e-4);
  expect_plane(fetch_kernels(3).bilinear, anywhere, 2e-5);
  expect_plane(fetch_kernels(3).bicubic.unclamped, anywhere, 4e-5);
}

/// The bounds that fetch.h states, by brute force over the inner 4×4 texels.
TEST(FetchTest, ClampedValuesKeepToTheirBounds) {
  Map map = rendered("cube", 24, [](const Vec3d&) { return 0.0; });
  std::mt19937 random(9);
  for_each_valid_texel(map, [&](int chart, int x, int y) {
    *map.level.chart(chart).at(x, y) =
        random() % 5 == 0 ? 1000.0f : 0.01f * static_cast<float>(random() % 100);
  });
  fill_borders(map);
  const Positions positions = random_positions(map);
  bool any_changed = false;
  for (const RingingFetch& kernel :
       {fetch_kernels(1).bicubic, fetch_kernels(1).lanczos3, fetch_kernels(1).lanczos4}) {
    const std::vector<float> unclamped = fetched(kernel.unclamped, map, positions),
                             clamped = fetched(kernel.clamped, map, positions);
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto first = [&](float at) { return static_cast<int>(std::floor(at * 24.0f - 0.5f)) - 1; };
      float minimum = HUGE_VALF, maximum = -HUGE_VALF;
      for (int y = first(positions.v[i]); y < first(positions.v[i]) + 4; ++y) {
        for (int x = first(positions.u[i]); x < first(positions.u[i]) + 4; ++x) {
          minimum = std::min(minimum, *map.level.chart(static_cast<int>(positions.chart[i])).at(x, y));
          maximum = std::max(maximum, *map.level.chart(static_cast<int>(positions.chart[i])).at(x, y));
        }
      }
      const float margin = 0.5f * (maximum - minimum);
      const float floor = std::max(minimum - margin, std::min(minimum, 0.5f * minimum));
      const float expected = clamp(unclamped[i], floor, maximum + margin);
      ASSERT_NEAR(clamped[i], expected, 1e-4f) << positions.u[i] << "," << positions.v[i];
      any_changed = any_changed || clamped[i] != unclamped[i];
    }
  }
  EXPECT_TRUE(any_changed);
}

TEST(FetchTest, BadPositionsReadTexelsOfTheMapAndNoOtherMemory) {
  const Map map = rendered(
      "cube", 4, [](const Vec3d&) { return 2.0; }, 4);
  Positions positions = random_positions(map);
  const float bad[] = {NAN, INFINITY, -INFINITY, 1e30f, -1e30f, 7, -7};
  for (std::size_t i = 0; i < kCount; ++i) {
    positions.u[i] = bad[i % 7];
    positions.v[i] = bad[i / 7 % 7];
    positions.chart[i] = bad[i / 49 % 7];
  }
  for (const Fetch fetch : all_kernels(4, fetch_kernels)) {
    const std::vector<float> values = fetched(fetch, map, positions);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_NEAR(values[i], 2.0 * static_cast<double>(i % 4 + 1), 1e-4);
    }
  }
}

#ifdef WELKIN_HAS_AVX2
/// One formula, two instruction sets: they differ by rounding only.
TEST(FetchTest, InstructionSetsAgree) {
  for (const int channels : {1, 2, 3, 4, 5, 7}) {
    const Map map = rendered("cube", 24, waves(20, 20), channels);
    const Positions positions = random_positions(map);
    const auto baseline = all_kernels(channels, fetch_kernels_baseline);
    const auto avx2 = all_kernels(channels, fetch_kernels_avx2);
    for (std::size_t k = 0; k < baseline.size(); ++k) {
      const std::vector<float> a = fetched(baseline[k], map, positions), b = fetched(avx2[k], map, positions);
      for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(a[i], b[i], 1e-5 * channels) << channels << " kernel " << k;
    }
  }
}
#endif

}  // namespace
}  // namespace welkin
