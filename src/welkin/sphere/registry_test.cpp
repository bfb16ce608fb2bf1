#include "welkin/sphere/registry.h"

#include <gtest/gtest.h>

#include <random>

#include "welkin/base/error.h"

namespace welkin::sphere {
namespace {

TEST(Registry, EveryNameMakesAParameterizationOfThatName) {
  for (const std::string& name : parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    EXPECT_EQ(p.name(), name);
    EXPECT_EQ(p.spec(), name);
  }
}

TEST(Registry, KeepsParametersInItsSpec) {
  const auto p = AnyParameterization::make("fisheye-equisolid,fov=200.5");
  EXPECT_EQ(p.spec(), "fisheye-equisolid,fov=200.5");
  EXPECT_TRUE(AnyParameterization::make(p.spec()) == p);
  EXPECT_FALSE(AnyParameterization::make("fisheye-equisolid") == p);
}

std::string message_of(const char* spec) {
  try {
    AnyParameterization::make(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "made";
}

TEST(Registry, RefusesBadSpecsAndSuggestsTheNearest) {
  EXPECT_NE(message_of("octahedrl").find("did you mean 'octahedral'"), std::string::npos);
  EXPECT_NE(message_of("latlong,fov=90").find("takes no parameters"), std::string::npos);
  EXPECT_NE(message_of("fisheye-equidistant,fvo=90").find("did you mean 'fov'"), std::string::npos);
  for (const char* value : {"fisheye-equidistant,fov=0", "fisheye-equidistant,fov=nan",
                            "fisheye-equidistant,fov=9x", "fisheye-equidistant,fov="}) {
    EXPECT_NE(message_of(value).find("is not a number in"), std::string::npos) << value;
  }
}

/// The kernels are the struct's own formulas in packs: within the float laws of
/// parameterization_precision_test.cpp, here only that each name got its own, by both instruction sets.
TEST(Registry, KernelsAgreeWithDoubles) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  constexpr std::size_t kCount = 64;
  float x[kCount], y[kCount], z[kCount], chart[kCount], u[kCount], v[kCount];
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3d d = normalize(Vec3d{normal(random), normal(random), normal(random)});
    x[i] = static_cast<float>(d.x);
    y[i] = static_cast<float>(d.y);
    z[i] = static_cast<float>(d.z);
  }
  const auto& names = parameterization_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto p = AnyParameterization::make(names[k]);
    std::vector<const Kernels*> sets{&kernels_baseline(k), &p.kernels()};
    for (const Kernels* kernels : sets) {
      kernels->from_sphere(p.self(), x, y, z, chart, u, v, kCount);
      for (std::size_t i = 0; i < kCount; ++i) {
        const Vec3d d{x[i], y[i], z[i]};
        if (!p.covers(d)) continue;
        const Vec3d back = p.to_sphere(static_cast<int>(chart[i]), u[i], v[i]);
        EXPECT_LT(length(back - normalize(d)), 1e-4) << names[k];
      }
    }
  }
}

}  // namespace
}  // namespace welkin::sphere
