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

TEST(Registry, LatlongWithParametersIsAWindow) {
  const auto whole = AnyParameterization::make("latlong");
  EXPECT_TRUE(whole.traits().latlong_grid);
  EXPECT_EQ(whole.parameters().size(), 4U);
  const auto window = AnyParameterization::make("latlong,left=-90,right=90,top=45,bottom=-45");
  EXPECT_EQ(window.spec(), "latlong,left=-90,right=90,top=45,bottom=-45");
  EXPECT_FALSE(window.traits().latlong_grid);
  EXPECT_FALSE(window.whole_world());
  EXPECT_NEAR(window.aspect(), 2, 1e-15);
  EXPECT_FALSE(window == whole);
  // In any order, and with the defaults written out.
  EXPECT_TRUE(AnyParameterization::make("latlong,bottom=-45,top=45,right=90,left=-90") == window);
  const auto same = AnyParameterization::make("latlong,right=180,bottom=-90");
  EXPECT_TRUE(same == whole);
  EXPECT_TRUE(same.traits().latlong_grid);
  EXPECT_TRUE(AnyParameterization::make("latlong,left=0,right=360").whole_world());
  // Each has its own kernels, by both instruction sets.
  float u[kLanes], v[kLanes], x[kLanes], y[kLanes], z[kLanes];
  std::fill_n(u, kLanes, 0.25f);
  std::fill_n(v, kLanes, 0.5f);
  const Kernels* sets[] = {&window.kernels(), &kernels_baseline(parameterization_names().size())};
  for (const Kernels* kernels : sets) {
    kernels->to_sphere(window.self(), 0, u, v, x, y, z, kLanes);
    EXPECT_NEAR(x[0], std::sin(kPi / 4), 1e-6);
    EXPECT_NEAR(z[0], std::cos(kPi / 4), 1e-6);
  }
}

TEST(Registry, RefusesBadSpecsAndSuggestsTheNearest) {
  EXPECT_NE(message_of("octahedrl").find("did you mean 'octahedral'"), std::string::npos);
  EXPECT_NE(message_of("cube,fov=90").find("takes no parameters"), std::string::npos);
  EXPECT_NE(message_of("latlong,lef=90").find("did you mean 'left'"), std::string::npos);
  for (const char* spec : {"latlong,left=90,right=90", "latlong,left=100,right=50",
                           "latlong,left=-180,right=181", "latlong,left=10,right=10.01"}) {
    EXPECT_NE(message_of(spec).find("right must be 0.1° to 360° beyond left"), std::string::npos) << spec;
  }
  EXPECT_NE(message_of("latlong,top=10,bottom=10").find("top must be"), std::string::npos);
  EXPECT_NE(message_of("latlong,top=91").find("is not a number in"), std::string::npos);
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
