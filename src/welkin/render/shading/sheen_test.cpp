#include "welkin/render/shading/sheen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/brdf/dfg.h"
#include "welkin/lobe/zonal.h"
#include "welkin/render/shading/look_up_cases.h"

namespace welkin::scene {
namespace {

constexpr double kCosines[] = {1, 0.8, 0.5, 0.2, 0.05};
constexpr double kRoughness[] = {0.07, 0.1, 0.2, 0.35, 0.5, 0.7, 1};

Material cloth(float color, float roughness) {
  Material material;
  material.base_color = {0, 0, 0};
  material.ior = 1;
  material.sheen_color = {color, color, color};
  material.sheen_roughness = roughness;
  return material;
}

Vec3d at_cosine(double cosine) {
  return {std::sqrt(1 - cosine * cosine), 0, cosine};
}

/// ∫ f n·l g(l) dω by the midpoint rule in √n·l and the azimuth.
template <class Weight>
double integral(const Sheen& sheen, double nv, const Weight& weight) {
  constexpr int kCosineSteps = 200, kAzimuthSteps = 200;
  const Vec3d view = at_cosine(nv);
  double sum = 0;
  for (int i = 0; i < kCosineSteps; ++i) {
    const double x = (i + 0.5) / kCosineSteps, z = x * x, s = std::sqrt(1 - z * z);
    for (int k = 0; k < kAzimuthSteps; ++k) {
      const double phi = kPi * (k + 0.5) / kAzimuthSteps;
      const Vec3d light{s * std::cos(phi), s * std::sin(phi), z};
      sum += 2 * x * z * sheen.value(view, light)[0] * weight(light);
    }
  }
  return sum * 2 * kPi / (kCosineSteps * kAzimuthSteps);
}

TEST(SheenSums, AgreeWithTheAlbedoOfCharlie) {
  for (const double roughness : kRoughness) {
    for (const double cosine : kCosines) {
      const double albedo = brdf::charlie_albedo(cosine, roughness);
      const SheenSum sum = sheen_sums().at(cosine, roughness);
      const double bound = (cosine < 0.3 ? 5e-3 : 1e-3) * std::max(1.0, albedo);
      EXPECT_NEAR(sum.unbounded, albedo, bound) << roughness << ' ' << cosine;
      EXPECT_LE(sum.albedo, std::min(1.0, albedo) + bound);
      EXPECT_GE(sum.largest, sum.albedo - 1e-12);
    }
  }
}

TEST(SheenSums, AreTheIntegralsOfTheValues) {
  for (const double roughness : kRoughness) {
    const Material material = cloth(1, static_cast<float>(roughness));
    for (const double cosine : kCosines) {
      const Sheen sheen(point_of(material), cosine);
      const SheenSum sum = sheen_sums().at(cosine, roughness);
      const double albedo = integral(sheen, cosine, [](const Vec3d&) { return 1.0; });
      const double bound = cosine < 0.3 ? 5e-3 : 1e-3;
      EXPECT_NEAR(sum.albedo, albedo, bound) << roughness << ' ' << cosine;
      EXPECT_NEAR(sheen.albedo()[0], sum.albedo, 1e-6);
      const double z = integral(sheen, cosine, [](const Vec3d&l) { return l.z; }),
                   x = integral(sheen, cosine, [](const Vec3d&l) { return l.x; });
      EXPECT_NEAR(sum.along_normal * sum.albedo, z, bound) << roughness << ' ' << cosine;
      EXPECT_NEAR(sum.along_view * sum.albedo, x, bound) << roughness << ' ' << cosine;
    }
  }
}

TEST(Sheen, IsAlikeInBothDirections) {
  const Material material = cloth(0.8f, 0.3f);
  for (const double a : kCosines) {
    for (const double b : kCosines) {
      const Vec3d one = at_cosine(a), other = {0, at_cosine(b).x, b};
      EXPECT_NEAR(Sheen(point_of(material), a).value(one, other)[0],
                  Sheen(point_of(material), b).value(other, one)[0], 1e-12);
      EXPECT_NEAR(Sheen(point_of(material), a).passed(b), Sheen(point_of(material), b).passed(a), 1e-12);
    }
  }
}

// The mean direction of the filtered lobe is the sheen's, but where that is longer than any of Charlie's.
TEST(Sheen, IsLookedUpByItsMeanDirection) {
  for (const double roughness : kRoughness) {
    const Material material = cloth(1, static_cast<float>(roughness));
    for (const double cosine : kCosines) {
      Surface at{};
      at.normal = {0, 0, 1};
      at.view = at_cosine(cosine);
      at.material = point_of(material);
      const SheenSum sum = sheen_sums().at(cosine, roughness);
      const Sheen::LookUp look = Sheen(at.material, cosine).look_up(at);
      const double size = std::hypot(sum.along_normal, sum.along_view);
      EXPECT_NEAR(look.direction.z, sum.along_normal / size, 1e-6);
      EXPECT_NEAR(look.direction.x, sum.along_view / size, 1e-6);
      const auto lobe = lobe::AnyLobe::make("charlie").with_roughness(look.roughness);
      const double length = lobe::zonal_coefficients(lobe, 1)[1];
      if (look.roughness < 1 && look.roughness > kLeastSheenRoughness) {
        EXPECT_NEAR(length, size, 1e-6);
      }
    }
  }
}

Material velvet(float base, float roughness) {
  Material material = cloth(1, roughness);
  material.base_color = {base, base, base};
  material.ior = 1.5f;
  return material;
}

TEST(Sheen, LookUpsAreWhatPathsShow) {
  const World world = smooth_world();
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const Material& material : {cloth(1, roughness), velvet(0.5f, roughness)}) {
      // Alone it is nearly black where the surface faces the viewer.
      EXPECT_LT(error_of_look_ups(material, world), material.base_color[0] > 0 ? 0.03 : 0.07)
          << roughness << " over " << material.base_color[0];
    }
  }
}

// White cloth over a white surface, in a world of 1.
TEST(Sheen, NothingComesOutOfNothing) {
  const World world = even_world(1);
  const auto shading = make_shading("material", {world}, {.sheen = true});
  for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const float metallic : {0.0f, 1.0f}) {
      Material material = velvet(1, roughness);
      material.metallic = metallic;
      material.roughness = 0.6f;
      for (const double cosine : kCosines) {
        Surface at{};
        at.normal = at.flat_normal = {0, 0, 1};
        at.view = at_cosine(cosine);
        at.tangent = {1, 0, 0};
        at.bitangent = {0, 1, 0};
        at.material = point_of(material);
        Rgb seen{};
        shading->shade({&at, 1}, {&seen, 1});
        EXPECT_LT(seen[0], 1 + 2e-3) << roughness << ' ' << cosine;
        const Sheen sheen(at.material, cosine);
        EXPECT_GT(seen[0],
                  0.99 * (sheen.albedo()[0] + std::min(sheen.passed(cosine), sheen.passed_diffuse())))
            << roughness << ' ' << cosine;
      }
    }
  }
}

}  // namespace
}  // namespace welkin::scene
