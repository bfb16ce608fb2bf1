#include "welkin/harmonics/bases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "welkin/base/error.h"
#include "welkin/harmonics/harmonics_cases.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/sphere/convention.h"

namespace welkin::harmonics {
namespace {

using cases::random_direction;
using cases::random_harmonics;

/// What an engine's shader makes of the coefficients of a channel, along a normal of its own world, as E/π.
using Shader = std::function<double(const std::vector<double>& k, const Vec3d& n)>;

/// Ramamoorthi & Hanrahan 2001, eq. 13, whose five constants shaders have with six digits.
double irradiance_of_radiance(const std::vector<double>& k, const Vec3d& n) {
  const double c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708;
  return c4 * k[0] + 2 * c2 * (k[3] * n.x + k[1] * n.y + k[2] * n.z) + c3 * k[6] * n.z * n.z - c5 * k[6] +
         c1 * k[8] * (n.x * n.x - n.y * n.y) +
         2 * c1 * (k[4] * n.x * n.y + k[7] * n.x * n.z + k[5] * n.y * n.z);
}

double polynomial(const std::vector<double>& k, const Vec3d& n) {
  return k[0] + k[1] * n.y + k[2] * n.z + k[3] * n.x + k[4] * n.x * n.y + k[5] * n.y * n.z +
         k[6] * (3 * n.z * n.z - 1) + k[7] * n.x * n.z + k[8] * (n.x * n.x - n.y * n.y);
}

/// Sloan's seven constants, of which a channel has A, B and its part of C.
double packed(const std::vector<double>& k, const Vec3d& n) {
  return k[0] * n.x + k[1] * n.y + k[2] * n.z + k[3] + k[4] * n.x * n.y + k[5] * n.y * n.z +
         k[6] * n.z * n.z + k[7] * n.z * n.x + k[8] * (n.x * n.x - n.y * n.y);
}

struct Case {
  const char* basis;
  Shader shader;
  /// The engine's X, Y, Z of ours: docs/conventions.md, third column.
  std::function<Vec3d(const Vec3d&)> world;
};

std::vector<Case> shader_cases() {
  const auto same = [](const Vec3d& d) { return d; };
  const auto mirrored = [](const Vec3d& d) { return Vec3d{-d.x, d.y, d.z}; };
  return {
      {"filament", polynomial, same},
      {"three.js", [](const auto& k, const Vec3d& n) { return irradiance_of_radiance(k, n) / kPi; }, same},
      {"unity", polynomial, mirrored},
      {"unreal",
       [](const auto& v, const Vec3d& n) {
         // FSHVector3's functions, then its constants.
         const double root = std::sqrt(kPi), c0 = 1 / (2 * root), c1 = std::sqrt(3.0) / (3 * root),
                      c2 = std::sqrt(15.0) / (8 * root), c3 = std::sqrt(5.0) / (16 * root);
         return packed({-c1 * v[3], -c1 * v[1], c1 * v[2], c0 * v[0] - c3 * v[6], c2 * v[4], -c2 * v[5],
                        3 * c3 * v[6], -c2 * v[7], 0.5 * c2 * v[8]},
                       n);
       },
       [](const Vec3d& d) {
         return Vec3d{d.x, d.z, d.y};
       }},
      {"babylon",
       [](const auto& k, const Vec3d& n) {
         // FromPolynomial's harmonics, then preScaleForRendering: both have the sign (−1)^m, which cancels.
         const double x = k[0], y = k[1], z = k[2], xx = k[3], yy = k[4], zz = k[5], yz = k[6], zx = k[7],
                      xy = k[8];
         const double h00 = kPi * 0.376127 * (xx + yy + zz), h1 = kPi * 0.977204, h2 = kPi * 1.16538;
         const double h20 = kPi * (1.34567 * zz - 0.672834 * (xx + yy));
         const double one = std::sqrt(3 / (4 * kPi)), two = std::sqrt(15 / (4 * kPi));
         return std::sqrt(1 / (4 * kPi)) * h00 + one * h1 * (y * n.y + z * n.z + x * n.x) +
                two * h2 * (xy * n.x * n.y + yz * n.y * n.z + zx * n.x * n.z) +
                std::sqrt(5 / (16 * kPi)) * h20 * (3 * n.z * n.z - 1) +
                two / 2 * h2 * (xx - yy) * (n.x * n.x - n.y * n.y);
       },
       mirrored},
      {"playcanvas",
       [](const auto& k, const Vec3d& n) {
         return k[0] + k[1] * n.x + k[2] * n.y + k[3] * n.z + k[4] * n.x * n.z + k[5] * n.z * n.y +
                k[6] * n.y * n.x + k[7] * (3 * n.z * n.z - 1) + k[8] * (n.x * n.x - n.y * n.y);
       },
       same},
      {"gltf",
       [](const auto& k, const Vec3d& n) {
         // convertIrradianceToLambertianRadiance, then preScaleForRendering, whose constants have the sign
         // (−1)^m.
         const int sign_of[9] = {1, -1, 1, -1, 1, -1, 1, -1, 1};
         double y[9], sum = 0;
         evaluate_functions(2, n, y);
         for (std::size_t i = 0; i < 9; ++i) sum += sign_of[i] * k[i] * y[i];
         return sum / kPi;
       },
       same},
  };
}

TEST(Bases, GiveEachEnginesShaderTheIrradianceOfTheNormal) {
  std::mt19937 random(1);
  SphericalHarmonics radiance = random_harmonics(4, 3, random);
  const SphericalHarmonics irradiance = convolved(with_degree(radiance, 2), irradiance_factors(2));
  std::size_t tested = 1;  // orthonormal has no shader
  for (const Case& each : shader_cases()) {
    const Basis& basis = basis_from_name(each.basis);
    const BasisCoefficients written = to_basis(radiance, basis, world_of(basis));
    ASSERT_EQ(written.values.size(), 27u) << each.basis;
    EXPECT_EQ(basis.rows.size(), 9u);
    ++tested;
    for (int i = 0; i < 20; ++i) {
      const Vec3d normal = random_direction(random);
      double expected[3];
      irradiance.evaluate(normal, expected);
      for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> k;
        for (std::size_t row = 0; row < 9; ++row) k.push_back(written.values[row * 3 + c]);
        // Engines' constants have six digits.
        EXPECT_NEAR(each.shader(k, each.world(normal)), expected[c] / kPi, 2e-5 * irradiance.norm())
            << each.basis;
      }
    }
  }
  EXPECT_EQ(tested, bases().size()) << "each basis has its shader here";
}

TEST(Bases, ReadBackWhatTheyWrite) {
  std::mt19937 random(2);
  for (const Basis& basis : bases()) {
    EXPECT_FALSE(basis.source.empty());
    EXPECT_EQ(&basis_from_name(basis.name), &basis_from_name(basis.name));
    for (const std::string& name : {basis.convention, std::string("left-handed")}) {
      const Matrix3 world = convention_from_name(name).lookup;
      const SphericalHarmonics radiance = random_harmonics(2, 3, random);
      const SphericalHarmonics back = from_basis(to_basis(radiance, basis, world), world);
      EXPECT_LT(cases::relative_error(back, radiance), 1e-14) << basis.name;
    }
  }
}

TEST(Bases, PackTheSameConstantsForUnityAndUnreal) {
  std::mt19937 random(3);
  const SphericalHarmonics radiance = random_harmonics(2, 3, random);
  const Matrix3 world = convention_from_name("unity").lookup;
  const std::vector<double> unity = packed_constants(to_basis(radiance, basis_from_name("unity"), world)),
                            unreal = packed_constants(to_basis(radiance, basis_from_name("unreal"), world));
  const SphericalHarmonics irradiance = convolved(radiance, irradiance_factors(2));
  ASSERT_EQ(unity.size(), 28u);
  for (std::size_t i = 0; i < 28; ++i) EXPECT_NEAR(unity[i], unreal[i], 1e-14);
  const Vec3d normal = random_direction(random), n{-normal.x, normal.y, normal.z};
  double expected[3];
  irradiance.evaluate(normal, expected);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> k(unity.begin() + static_cast<std::ptrdiff_t>(4 * c),
                          unity.begin() + static_cast<std::ptrdiff_t>(4 * c + 4));
    k.insert(k.end(), unity.begin() + static_cast<std::ptrdiff_t>(12 + 4 * c),
             unity.begin() + static_cast<std::ptrdiff_t>(16 + 4 * c));
    k.push_back(unity[24 + c]);
    EXPECT_NEAR(packed(k, n), expected[c] / kPi, 1e-13);
  }
}

TEST(Bases, RefuseOtherNamesAndCounts) {
  EXPECT_THROW(basis_from_name("filamant"), Error);
  BasisCoefficients few{"filament", 2, {"R", "G", "B"}, std::vector<double>(26)};
  EXPECT_THROW(from_basis(few, {}), Error);
  EXPECT_THROW(packed_constants(few), Error);
}

}  // namespace
}  // namespace welkin::harmonics
