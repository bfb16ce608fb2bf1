#include "welkin/lookup/cone.h"

#include <gtest/gtest.h>

#include <limits>

namespace welkin::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST(Cone, IsFaultyWhereItsNumbersMeanNothing) {
  const EllipticalCone good{{0, 2, 0}, {1, 5, 0}, 0.2f, 0.1f};
  EXPECT_EQ(fault_of(good), "");
  EXPECT_EQ(fault_of({{0, 1e-30f, 0}, {}, 0.1f, 0.1f}), "") << "a circle needs no axis";

  const auto with = [&](auto change) {
    EllipticalCone cone = good;
    change(cone);
    return fault_of(cone);
  };
  EXPECT_NE(with([](auto& c) { c.direction = {0, 0, 0}; }), "");
  EXPECT_NE(with([](auto& c) { c.direction.x = kNaN; }), "");
  EXPECT_NE(with([](auto& c) { c.axis = {0, -3, 0}; }), "") << "along the direction";
  EXPECT_NE(with([](auto& c) { c.axis = {kNaN, 0, 0}; }), "");
  EXPECT_NE(with([](auto& c) { c.wide = 0.05f; }), "");
  EXPECT_NE(with([](auto& c) { c.wide = kNaN; }), "");
  EXPECT_NE(with([](auto& c) { c.narrow = -0.1f; }), "");
}

}  // namespace
}  // namespace welkin::test
