#include "welkin/render/path/bsdf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace welkin::scene {
namespace {

/// A place whose normal is +Y, seen at a cosine and an azimuth; the material must outlive it.
Surface place_of(const Material& material, double cosine, double azimuth = 0.7) {
  const double sine = std::sqrt(1 - cosine * cosine);
  Surface at{};
  at.normal = at.flat_normal = {0, 1, 0};
  at.tangent = {1, 0, 0};
  at.bitangent = {0, 0, -1};
  at.view = {sine * std::cos(azimuth), cosine, sine * std::sin(azimuth)};
  at.material = point_of(material);
  return at;
}

/// The same place seen along `view`, from whichever side that is.
Surface seen_along(Surface at, const Vec3d& view) {
  at.view = view;
  if (view.y < 0) {
    at.from_behind = true;
    at.normal = at.flat_normal = {0, -1, 0};
    at.bitangent = -1.0 * at.bitangent;
  }
  return at;
}

Material metal(float roughness, float anisotropy = 0) {
  Material material;
  material.metallic = 1;
  material.roughness = roughness;
  material.anisotropy = anisotropy;
  return material;
}
Material dielectric(float roughness) {
  Material material;
  material.roughness = roughness;
  return material;
}
Material glass(float roughness, float ior = 1.5f) {
  Material material = dielectric(roughness);
  material.transmission = 1;
  material.ior = ior;
  return material;
}
/// All layers at once.
Material everything(float roughness) {
  Material material = dielectric(roughness);
  material.base_color = {0.9f, 0.5f, 0.2f};
  material.metallic = 0.3f;
  material.transmission = 0.4f;
  material.clearcoat = 0.7f;
  material.clearcoat_roughness = 0.4f;
  material.anisotropy = 0.5f;
  material.sheen_color = {0.3f, 0.6f, 0.4f};
  material.sheen_roughness = 0.3f;
  return material;
}

/// White cloth over a white surface.
Material velvet(float roughness, float sheen_roughness) {
  Material material = dielectric(roughness);
  material.sheen_color = {1, 1, 1};
  material.sheen_roughness = sheen_roughness;
  return material;
}

constexpr double kCosines[] = {1, 0.8, 0.5, 0.2, 0.05};

/// Three numbers of [0, 1), drawn in their order: compilers evaluate arguments in any.
std::array<double, 3> three(std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(0, 1);
  const double first = u(random), second = u(random), third = u(random);
  return {first, second, third};
}

/// Wilson & Hilferty 1931: χ² as a standard normal number.
double normal_of_chi_square(double x, double freedom) {
  const double spread = 2 / (9 * freedom);
  return (std::cbrt(x / freedom) - (1 - spread)) / std::sqrt(spread);
}

/// Directions in cells of equal solid angle.
constexpr int kRows = 24, kColumns = 16;
Vec3d in_cell(double row, double column) {
  const double y = 1 - 2 * row / kRows, s = std::sqrt(std::max(0.0, 1 - y * y)),
               phi = 2 * kPi * column / kColumns;
  return {s * std::cos(phi), y, s * std::sin(phi)};
}
int cell_of(const Vec3d& d) {
  const int row = std::min(static_cast<int>((1 - d.y) / 2 * kRows), kRows - 1);
  const double turn = std::atan2(d.z, d.x) / (2 * kPi);
  return row * kColumns + std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * kColumns), kColumns - 1);
}

// Draws are counted in cells and compared with the integral of the density, those that give nothing with what
// is left. 4.5 σ: one such test in 300,000 would fail by chance, and the numbers are always the same.
TEST(Bsdf, DrawsHaveTheirDensity) {
  const Material materials[] = {metal(0.5f),       metal(0.6f, 0.8f), dielectric(0.4f),  glass(0.45f),
                                glass(0.6f, 1.1f), everything(0.5f),  velvet(0.5f, 0.2f)};
  std::mt19937_64 random(3);
  constexpr int kDraws = 40000, kFine = 12;
  for (const Material& material : materials) {
    for (const double cosine : {0.9, 0.3}) {
      for (const bool behind : {false, true}) {
        Surface at = place_of(material, cosine);
        if (behind) at = seen_along(at, -1.0 * at.view);
        const Bsdf bsdf(at);
        std::vector<double> expected(kRows * kColumns + 1), found(expected.size());
        double all = 0;
        for (int row = 0; row < kRows; ++row) {
          for (int column = 0; column < kColumns; ++column) {
            double sum = 0;
            for (int k = 0; k < kFine * kFine; ++k)
              sum += bsdf.pdf(in_cell(row + (k / kFine + 0.5) / kFine, column + (k % kFine + 0.5) / kFine));
            sum *= 4 * kPi / (kRows * kColumns * kFine * kFine);
            expected[static_cast<std::size_t>(row * kColumns + column)] = kDraws * sum;
            all += sum;
          }
        }
        EXPECT_LT(all, 1 + 2e-3);
        expected.back() = kDraws * std::max(0.0, 1 - all);
        for (int i = 0; i < kDraws; ++i) {
          const auto [lobe, u1, u2] = three(random);
          const auto sample = bsdf.sample(lobe, u1, u2);
          ++found[sample ? static_cast<std::size_t>(cell_of(sample->direction)) : expected.size() - 1];
        }
        double statistic = 0, rest_expected = 0, rest_found = 0;
        int cells = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          if (expected[i] < 10) {
            rest_expected += expected[i];
            rest_found += found[i];
            continue;
          }
          statistic += std::pow(found[i] - expected[i], 2) / expected[i];
          ++cells;
        }
        if (rest_expected > 10) statistic += std::pow(rest_found - rest_expected, 2) / rest_expected;
        EXPECT_LT(normal_of_chi_square(statistic, cells), 4.5)
            << "material " << &material - materials << " cosine " << cosine << " behind " << behind;
      }
    }
  }
}

// What a draw says of itself is what the functions say, at every roughness.
TEST(Bsdf, DrawsAgreeWithTheFunctions) {
  std::mt19937_64 random(5);
  for (const float roughness : {0.01f, 0.1f, 0.5f, 1.0f}) {
    const Material material = everything(roughness);
    for (const double cosine : kCosines) {
      const Bsdf bsdf(place_of(material, cosine));
      for (int i = 0; i < 500; ++i) {
        const auto [lobe, u1, u2] = three(random);
        const auto sample = bsdf.sample(lobe, u1, u2);
        if (!sample) continue;
        ASSERT_FALSE(sample->mirror);
        EXPECT_NEAR(length(sample->direction), 1, 1e-12);
        const double p = bsdf.pdf(sample->direction);
        EXPECT_NEAR(sample->pdf, p, 1e-9 * p);
        const Radiance f = bsdf.evaluate(sample->direction);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(sample->weight[c] * p, f[c] * std::abs(sample->direction.y), 1e-9 * p);
      }
    }
  }
}

/// The share of even light that goes to the viewer: the mean of the weights over numbers one of which lies in
/// each cell of a cube.
Radiance albedo(const Surface& at, int side) {
  const Bsdf bsdf(at);
  const double eta = at.from_behind ? 1.0 / at.material.material->ior : at.material.material->ior;
  std::mt19937_64 random(11);
  Radiance sum{};
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const auto [lobe, u1, u2] = three(random);
        const auto sample = bsdf.sample((i + lobe) / side, (j + u1) / side, (k + u2) / side);
        if (sample) sum = sum + (sample->through ? eta * eta : 1.0) * sample->weight;
      }
    }
  }
  return (1.0 / (side * side * side)) * sum;
}

// What 48³ draws and the table of split sums leave.
TEST(Bsdf, WhiteOpaqueMaterialsReflectAllLight) {
  for (const float roughness : {0.0f, 0.02f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    for (const Material& material : {metal(roughness), dielectric(roughness)}) {
      for (const double cosine : kCosines) {
        const Radiance share = albedo(place_of(material, cosine), 48);
        EXPECT_NEAR(share[0], 1, 1e-3)
            << "metallic " << material.metallic << " roughness " << roughness << " cosine " << cosine;
      }
    }
  }
}

// From outside and from inside. With 8e6 draws it is 2e-3, and 5e-3 at a cosine of .05 (the table's steps);
// 40³ leave that much again.
TEST(Bsdf, WhiteGlassSplitsAllLight) {
  for (const float roughness : {0.0f, 0.1f, 0.25f, 0.37f, 0.5f, 0.8f, 1.0f}) {
    for (const float ior : {1.1f, 1.5f, 2.4f}) {
      const Material material = glass(roughness, ior);
      for (const double cosine : kCosines) {
        const Surface at = place_of(material, cosine);
        const double bound = cosine < 0.1 ? 1e-2 : 4e-3;
        EXPECT_NEAR(albedo(at, 40)[0], 1, bound) << roughness << ' ' << ior << ' ' << cosine;
        EXPECT_NEAR(albedo(seen_along(at, -1.0 * at.view), 40)[0], 1, bound)
            << roughness << ' ' << ior << ' ' << cosine << " from inside";
      }
    }
  }
}

// In the mean over azimuths, to what isotropic facets stand for the others.
TEST(Bsdf, WhiteBrushedMetalReflectsAllLight) {
  for (const float roughness : {0.1f, 0.3f, 0.5f}) {
    for (const float anisotropy : {0.4f, 0.8f}) {
      const Material material = metal(roughness, anisotropy);
      for (const double cosine : kCosines) {
        double sum = 0;
        for (int k = 0; k < 8; ++k)
          sum += albedo(place_of(material, cosine, kPi * (k + 0.5) / 16), 16)[0] / 8;
        EXPECT_NEAR(sum, 1, 0.03) << roughness << ' ' << anisotropy << ' ' << cosine;
      }
    }
  }
}

// With 2e6 draws it is 5e-3; 8000 leave as much again.
TEST(Bsdf, NothingReflectsMoreThanItGets) {
  for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    Material coated = metal(roughness);
    coated.clearcoat = 1;
    coated.clearcoat_roughness = 0.3f;
    for (const Material& material : {everything(roughness), coated, glass(roughness), metal(roughness, 1),
                                     velvet(0.6f, roughness), velvet(roughness, 0.3f)}) {
      // Facets of one axis show more along some azimuths than the isotropic ones that stand for them.
      const double bound = material.anisotropy == 1 ? 0.06 : 1e-2;
      for (const double cosine : kCosines) {
        for (const bool behind : {false, true}) {
          Surface at = place_of(material, cosine);
          if (behind) at = seen_along(at, -1.0 * at.view);
          for (const double share : albedo(at, 20)) {
            EXPECT_LT(share, 1 + bound) << roughness << ' ' << cosine << ' ' << behind;
            EXPECT_GE(share, 0);
          }
        }
      }
    }
  }
}

// Light goes both ways alike; across a boundary radiance is compressed by η².
TEST(Bsdf, LightGoesBothWaysAlike) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> g;
  for (const float roughness : {0.2f, 0.5f, 1.0f}) {
    const Material material = everything(roughness);
    int across = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d a = normalize(Vec3d{g(random), std::abs(g(random)) + 0.05, g(random)});
      const Vec3d b = normalize(Vec3d{g(random), g(random), g(random)});
      const Surface front = seen_along(place_of(material, 0.5), a),
                    back = seen_along(place_of(material, 0.5), b);
      const Radiance one = Bsdf(front).evaluate(b), other = Bsdf(back).evaluate(a);
      const double eta = b.y < 0 ? material.ior : 1;
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(one[c] * eta * eta, other[c], 1e-6 * (std::abs(other[c]) + 1e-3));
      across += b.y < 0 && one[0] > 0;
    }
    EXPECT_GT(across, 100);
  }
}

}  // namespace
}  // namespace welkin::scene
