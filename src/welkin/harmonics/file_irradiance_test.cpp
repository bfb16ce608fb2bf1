#include "welkin/harmonics/file_irradiance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/harmonics/project.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/map/borders.h"
#include "welkin/sphere/convention.h"

namespace welkin::harmonics {
namespace {

/// Light that is brighter toward +X, +Y and +Z by different amounts in R, G and B.
Map slope(int channels) {
  Map map(sphere::AnyParameterization::make("latlong"), 64, 32, channels);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Vec3d d = map.parameterization.to_sphere(0, (x + 0.5) / 64, (y + 0.5) / 32);
      const double values[3] = {1 + 0.5 * d.x, 2 + 0.5 * d.y, 3 + 0.5 * d.z};
      for (int c = 0; c < channels; ++c) map.level.chart(0).at(x, y)[c] = static_cast<float>(values[c]);
    }
  }
  fill_borders(map);
  return map;
}

/// Constant light c is c(x² + y² + z²). A slope of s is s·(2/3)² of it: π and 2π/3 over π, twice.
TEST(FileIrradiance, IsBabylonsPolynomial) {
  const Matrix3 look_up =
      orientation_for(convention_from_name("babylon"), sphere::AnyParameterization::make("cube"));
  const std::vector<double> p = file_irradiance(slope(3), "babylon", look_up);
  ASSERT_EQ(p.size(), 27u);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t row = 0; row < 3; ++row) {
      // x is reversed there.
      const double slope = row == c ? (c == 0 ? -0.5 : 0.5) * 4 / 9 : 0;
      EXPECT_NEAR(p[3 * row + c], slope, 2e-3) << row << c;
      EXPECT_NEAR(p[3 * (row + 3) + c], static_cast<double>(c + 1), 2e-3) << row << c;
      EXPECT_NEAR(p[3 * (row + 6) + c], 0, 2e-3) << row << c;
    }
  }
}

/// The same of a map that a lobe has filtered.
TEST(FileIrradiance, UndoesALobe) {
  const lobe::AnyLobe lobe = lobe::AnyLobe::make("ggx,roughness=0.4");
  const Map map = slope(3);
  const Map filtered =
      map_of(convolved(project(map, 2), lobe_factors(lobe, 2)), map.parameterization, {64, 32});
  const std::vector<double> wanted = file_irradiance(map, "babylon", {}),
                            found = file_irradiance(filtered, "babylon", {}, lobe);
  for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-5);
}

TEST(FileIrradiance, TakesGreyAndRefusesOthers) {
  const std::vector<double> grey = file_irradiance(slope(1), "babylon", {});
  ASSERT_EQ(grey.size(), 27u);
  EXPECT_EQ(grey[0], grey[1]);
  EXPECT_EQ(grey[0], grey[2]);
  Map other = slope(2);
  other.channel_names = {"U", "V"};
  EXPECT_THROW(file_irradiance(other, "babylon", {}), Error);
}

}  // namespace
}  // namespace welkin::harmonics
