#include "welkin/brdf/view_lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/angles.h"

namespace welkin::brdf {
namespace {

/// BRDF · cosine is a von Mises–Fisher lobe about a direction of the plane of incidence, at this part of the
/// angle from the reflected direction to the normal: 1 the normal, 2 the viewer.
AnyBrdf lobe_at(double lift, double kappa) {
  return AnyBrdf::from_function("lobe", 1 / std::sqrt(kappa), [=](const Vec3d& view, const Vec3d& light) {
    const double along = std::hypot(view.x, view.y);
    const Vec3d level = along > 0 ? Vec3d{view.x / along, view.y / along, 0} : Vec3d{1, 0, 0};
    const double from_normal = -(1 - lift) * std::acos(std::min(1.0, view.z));
    const Vec3d axis = std::sin(from_normal) * level + std::cos(from_normal) * Vec3d{0, 0, 1};
    const Vec3d away = light - axis;
    return std::exp(-0.5 * kappa * dot(away, away)) / light.z;
  });
}

double total(const LobePoints& points) {
  double sum = 0;
  for (const double weight : points.weights) sum += weight;
  return sum;
}

TEST(ViewLobe, AlbedosThatAreKnown) {
  const AnyBrdf matte =
      AnyBrdf::from_function("matte", 1, [](const Vec3d&, const Vec3d&) { return 1 / kPi; });
  // ∫ exp(κ (cos θ − 1)) dω = 2π (1 − e^−2κ)/κ; what is below the surface is lost, 1e-9 of it here.
  const AnyBrdf narrow = lobe_at(1, 40);
  for (const double cosine : {0.01, 0.3, 1.0}) {
    EXPECT_NEAR(directional_albedo(matte, cosine), 1, 1e-9);
    EXPECT_NEAR(directional_albedo(narrow, cosine), 2 * kPi / 40, 1e-8);
  }
}

TEST(ViewLobe, QuadratureConverges) {
  for (const double roughness : {0.1, 0.25, 0.5, 1.0}) {
    for (const double cosine : {0.002, 0.1, 0.5, 0.95}) {
      const AnyBrdf brdf = AnyBrdf::make("ggx").with_roughness(roughness);
      const double fine = total(lobe_points(brdf, cosine, 14));
      EXPECT_NEAR(total(lobe_points(brdf, cosine)), fine, 5e-6 * fine) << roughness << " " << cosine;
      EXPECT_LE(fine, 1);  // no microfacet reflects more than it gets
    }
  }
}

/// An average about an axis keeps the lobe's zonal coefficients about it: Σ f P_l(l · axis).
TEST(ViewLobe, AveragesKeepZonalCoefficients) {
  for (const char* name : {"ggx", "ward"}) {
    for (const double roughness : {0.2, 0.5, 0.8}) {
      for (const double cosine : {0.05, 0.2, 0.6, 1.0}) {
        const AnyBrdf brdf = AnyBrdf::make(name).with_roughness(roughness);
        const LobePoints points = lobe_points(brdf, cosine);
        for (const double tilt : {0.0, 0.3, fitted_tilt(brdf, cosine)}) {
          const AveragedLobe averaged = average_lobe(brdf, cosine, tilt);
          const double albedo = total(points);
          EXPECT_NEAR(averaged.albedo, albedo, 1e-9 * albedo);
          const Vec3d axis = tilted_direction(cosine, tilt);
          constexpr int kDegree = 40;
          const std::vector<double> zonal = lobe::zonal_coefficients(averaged.lobe, kDegree);
          std::vector<double> sums(kDegree + 1, 0.0);
          for (std::size_t i = 0; i < points.weights.size(); ++i) {
            const double x = dot(points.directions[i], axis);
            double before = 1, now = x;
            sums[0] += points.weights[i];
            for (int l = 1; l <= kDegree; ++l) {
              sums[static_cast<std::size_t>(l)] += points.weights[i] * now;
              const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
              before = now;
              now = next;
            }
          }
          for (std::size_t l = 0; l <= kDegree; ++l)
            EXPECT_NEAR(zonal[l], sums[l] / albedo, 3e-4)
                << name << " " << roughness << " " << cosine << " " << tilt << " " << l;
        }
      }
    }
  }
}

TEST(ViewLobe, FittedAxisIsThatOfASymmetricLobe) {
  for (const double cosine : {0.2, 0.5, 0.9}) {
    const double from_normal = std::acos(cosine);
    // Off-specular, about the normal, and back to the viewer; those that the surface doesn't cut.
    for (const double lift : {0.3, 1.0, 1.6}) {
      EXPECT_NEAR(fitted_tilt(lobe_at(lift, 120), cosine), lift * from_normal, 0.01) << cosine << " " << lift;
    }
  }
  EXPECT_NEAR(fitted_tilt(lobe_at(2, 120), 0.7), 2 * std::acos(0.7), 0.01);
  EXPECT_NEAR(fitted_tilt(AnyBrdf::make("ggx,roughness=0.6"), 1.0), 0, 0.01);
}

/// Off-specular peaks: towards the normal for GGX; Ward's lobe keeps to the reflected direction longer.
TEST(ViewLobe, FittedAxisOfMicrofacetsRisesWithRoughness) {
  for (const char* name : {"ggx", "ward"}) {
    double before = -0.02;
    for (const double roughness : {0.1, 0.3, 0.5, 0.7}) {
      const double tilt = fitted_tilt(AnyBrdf::make(name).with_roughness(roughness), 0.2);
      EXPECT_GT(tilt, before) << name << " " << roughness;
      EXPECT_LT(tilt, kPi / 2 - std::asin(0.2)) << name;
      before = tilt;
    }
  }
}

/// An average about the fitted axis is closer to the lobe than about r: it keeps more of its power.
TEST(ViewLobe, FittedAxisKeepsMore) {
  const AnyBrdf brdf = AnyBrdf::make("ggx,roughness=0.5");
  const auto power = [&](LobeAxis axis) {
    const std::vector<double> zonal = lobe::zonal_coefficients(average_lobe(brdf, 0.15, axis).lobe, 30);
    double sum = 0;
    for (std::size_t l = 1; l < zonal.size(); ++l) sum += zonal[l] * zonal[l];
    return sum;
  };
  EXPECT_GT(power(LobeAxis::fitted), 1.5 * power(LobeAxis::reflected));
  EXPECT_EQ(average_lobe(brdf, 0.15, LobeAxis::reflected).tilt, 0);
}

TEST(ViewLobe, WhatIsNone) {
  const AnyBrdf ggx = AnyBrdf::make("ggx");
  EXPECT_THROW(average_lobe(ggx.with_roughness(0), 0.5, 0.0), Error);
  EXPECT_THROW(average_lobe(ggx, 0, 0.0), Error);
  EXPECT_THROW(average_lobe(ggx, 1.5, 0.0), Error);
  const auto constant = [](double value) {
    return AnyBrdf::from_function("constant", 1, [=](const Vec3d&, const Vec3d&) { return value; });
  };
  EXPECT_THROW(average_lobe(constant(0), 0.5, 0.0), Error);
  EXPECT_THROW(average_lobe(constant(-1), 0.5, 0.0), Error);
  EXPECT_THROW(lobe_points(constant(std::numeric_limits<double>::quiet_NaN()), 0.5), Error);
}

}  // namespace
}  // namespace welkin::brdf
