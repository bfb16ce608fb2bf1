#include "welkin/filter/refinement.h"

#include <gtest/gtest.h>

#include "welkin/filter/refinement_reference.h"
#include "welkin/filter/resample_cases.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

constexpr float kSurround = 0.5f, kLamp = 1000;

/// Noise, with a lamp in it.
Map noise_with_lamp(int channels) {
  Map map = make_map("cube", 20, channels);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(0.1f, 1.0f);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int i = 0; i < map.width() * channels; ++i) map.level.chart(chart).row(y)[i] = value(random);
    }
  }
  for (int c = 0; c < channels; ++c) map.level.chart(2).at(9, 8)[c] = kLamp;
  fill_borders(map);
  return map;
}

/// Parts (x, y) … of chart 2.
ReconstructedTexels refined(const Map& map, int parts, const ReconstructionKernels& kernels, int x, int y,
                            int side) {
  static const std::vector<float> never(kMaxChannels, 1e30f);
  Reconstruction how;
  how.bright = never.data();
  RefinementWork work;
  ReconstructedTexels out;
  out.reset(2, x, y, side, side, map.channels());
  Refinement(view_of(map.level), {map.parameterization, parts}, how, kernels).reconstruct(work, out);
  return out;
}
ReconstructedTexels refined(const Map& map, int parts, const ReconstructionKernels& kernels) {
  return refined(map, parts, kernels, 0, 0, map.width() * parts);
}

double coefficient(const ReconstructedTexels& texels, int k, int x, int y, int c) {
  return static_cast<double>(
      texels.coefficients[static_cast<std::size_t>(k * texels.plane()) +
                          texels.index(x, y) * static_cast<std::size_t>(texels.channels) +
                          static_cast<std::size_t>(c)]);
}

double mean_of(const ReconstructedTexels& texels, int x, int y, int c) {
  return coefficient(texels, 0, x, y, c) +
         (coefficient(texels, 3, x, y, c) + coefficient(texels, 5, x, y, c)) / 12;
}

TEST(RefinementTest, PartsKeepTheirTexelsMeanAndAreNotNegative) {
  const Map map = noise_with_lamp(3);
  for (const int parts : {2, 4}) {
    const ReconstructedTexels texels = refined(map, parts, reconstruction_kernels(3));
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        for (int c = 0; c < 3; ++c) {
          double sum = 0, weight = 0;
          for (int t = 0; t < parts * parts; ++t) {
            const int i = x * parts + t % parts, j = y * parts + t / parts;
            const double density = map.parameterization.solid_angle_density(
                2, (i + 0.5) / (map.width() * parts), (j + 0.5) / (map.height() * parts));
            EXPECT_GE(mean_of(texels, i, j, c), 0.05);
            sum += density * mean_of(texels, i, j, c);
            weight += density;
          }
          const double mean = static_cast<double>(map.level.chart(2).at(x, y)[c]);
          ASSERT_NEAR(sum / weight, mean, 1e-5 * mean + 1e-6) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(RefinementTest, IsWhatTheReferenceSays) {
  const Map map = noise_with_lamp(1);
  for (const int parts : {2, 4}) {
    const RefinementReference reference(map.parameterization, map.level, parts);
    const ReconstructedTexels texels = refined(map, parts, reconstruction_kernels(1));
    for (int y = 0; y < map.height() * parts; ++y) {
      for (int x = 0; x < map.width() * parts; ++x) {
        const auto exact = reference.within(2, x, y, 0);
        const double tolerance = 1e-4 * (1 + std::fabs(exact[0]));
        ASSERT_NEAR(mean_of(texels, x, y, 0), exact[0], tolerance) << x << ' ' << y;
        for (int k = 1; k < kCoefficients; ++k)
          ASSERT_NEAR(coefficient(texels, k, x, y, 0), exact[static_cast<std::size_t>(k)], tolerance) << k;
      }
    }
  }
}

/// Nor on where tiles end.
TEST(RefinementTest, PartsDoNotDependOnWhatElseIsAskedFor) {
  const Map map = noise_with_lamp(3);
  for (const int parts : {2, 4}) {
    const ReconstructedTexels all = refined(map, parts, reconstruction_kernels(3));
    for (const int side : {1, 3, 8 * parts}) {
      const int first = 15 * parts - 1 - side / 2;
      const ReconstructedTexels some = refined(map, parts, reconstruction_kernels(3), first, first, side);
      for (int y = first; y < first + side; ++y) {
        for (int x = first; x < first + side; ++x) {
          ASSERT_EQ(some.hard[some.index(x, y)], all.hard[all.index(x, y)]);
          for (int k = 0; k < kCoefficients; ++k)
            ASSERT_NEAR(coefficient(some, k, x, y, 1), coefficient(all, k, x, y, 1), 1e-6) << k;
        }
      }
    }
  }
}

/// A picture of a small part of the sphere, whose pixels are a tenth of the source's texels or less.
Map magnified(const Map& source, int size, double fov) {
  Map picture(sphere::AnyParameterization::make("perspective,fov=" + std::to_string(fov)), size, size, 1);
  ResampleOptions options;
  options.borders = false;
  resample(source, picture, options);
  return picture;
}

/// Across a slanted edge between 0.05 and 0.8 radiance rises and doesn't go far beyond either, and the place
/// where it passes the middle lies near a line.
TEST(RefinementTest, ASlantedEdgeMagnifiedIsAnEdge) {
  constexpr double kDark = 0.05, kBright = 0.8;
  for (const double slope : {0.2, 0.37, 0.61, 1.0}) {
    const double angle = std::atan(slope), step = kPi / 64;  // a texel's
    const auto across = [&](const Vec3d& d) {                // of what lies along −Z
      return d.z < 0 ? (std::cos(angle) * d.y - std::sin(angle) * d.x) / -d.z : -1.0;
    };
    const Map source =
        rendered("latlong", 128, [&](const Vec3d& d) { return across(d) > 0.3 * step ? kBright : kDark; });
    const Map picture = magnified(source, 256, 22);
    const double pixel = 2 * std::tan(11 * kPi / 180) / 256;
    double worst = 0, low = 1, high = 0;
    for (int x = 0; x < 256; ++x) {
      bool passed = false;
      float last = -1;
      for (int y = 255; y >= 0; --y) {  // upwards
        const float value = *picture.level.chart(0).at(x, y);
        low = std::min(low, static_cast<double>(value));
        high = std::max(high, static_cast<double>(value));
        EXPECT_GE(value, last - 0.08f) << slope;
        last = std::max(last, value);
        if (passed || value < 0.5 * (kDark + kBright)) continue;
        passed = true;
        const double right = (x + 0.5 - 128) * pixel, up = (128 - y - 0.5) * pixel;
        worst =
            std::max(worst, std::fabs(std::cos(angle) * up - std::sin(angle) * right - 0.3 * step) / step);
      }
    }
    EXPECT_LT(worst, 0.3) << slope;
    EXPECT_GE(low, kDark - 0.02 * (kBright - kDark)) << slope;
    EXPECT_LE(high, kBright + 0.09 * (kBright - kDark)) << slope;
  }
}

/// Nothing beside a lamp is darker than what is around it.
TEST(RefinementTest, ALampMagnifiedHasNoDarkRing) {
  const auto lamp = [](const Vec3d& d) {
    return std::hypot(d.x - 0.012, d.y + 0.017) < 0.11 && d.z < 0 ? static_cast<double>(kLamp)
                                                                  : static_cast<double>(kSurround);
  };
  const Map picture = magnified(rendered("latlong", 128, lamp), 256, 30);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x)
      ASSERT_GE(*picture.level.chart(0).at(x, y), 0.95f * kSurround) << x << ' ' << y;
  }
}

#ifdef WELKIN_HAS_AVX2
TEST(RefinementTest, InstructionSetsAgree) {
  for (const int channels : {1, 3, 4, 5}) {
    const Map map = noise_with_lamp(channels);
    for (const int parts : {2, 4}) {
      const ReconstructedTexels a = refined(map, parts, reconstruction_kernels_baseline(channels)),
                                b = refined(map, parts, reconstruction_kernels_avx2(channels));
      for (std::size_t i = 0; i < static_cast<std::size_t>(kCoefficients * a.plane()); ++i)
        ASSERT_NEAR(a.coefficients[i], b.coefficients[i], 1e-3f * (1 + std::fabs(a.coefficients[i]))) << i;
    }
  }
}
#endif

}  // namespace
}  // namespace welkin
