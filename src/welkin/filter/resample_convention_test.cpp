#include <gtest/gtest.h>

#include <algorithm>

#include "welkin/filter/resample.h"
#include "welkin/map/borders.h"
#include "welkin/sphere/convention_cases.h"

namespace welkin {
namespace {

using namespace cases;

/// Turns a native world of colours into the preset's cube, and looks it up as the program does. A colour is
/// the direction itself; half a texel of the source and of the cube apart is at most 0.06.
TEST(Convention, CubesReturnTheRadianceOfTheDirectionThatIsLookedUp) {
  Map world(latlong(), 128, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const Vec3d d = latlong().to_sphere(0, (x + 0.5) / 128, (y + 0.5) / 64);
      float* texel = world.level.chart(0).at(x, y);
      texel[0] = static_cast<float>(d.x);
      texel[1] = static_cast<float>(d.y);
      texel[2] = static_cast<float>(d.z);
    }
  }
  fill_borders(world);
  constexpr int kSize = 32;
  ResampleOptions options;
  options.filter = Filter::bilinear;
  for (const Program& program : kPrograms) {
    SCOPED_TRACE(program.name);
    Map map(cube(), kSize, kSize, 3);
    map.orientation = orientation_for(convention_from_name(program.name), cube());
    resample(world, map, options);
    for (const Vec3d& d : directions(300)) {
      const auto position = cube().from_sphere(program.cube(program.from_native(d)));
      const auto texel_of = [](double u) { return std::min(static_cast<int>(u * kSize), kSize - 1); };
      const auto face = map.level.chart(static_cast<int>(position.chart));
      const float* texel = face.at(texel_of(position.u), texel_of(position.v));
      EXPECT_LT(length(Vec3d{texel[0], texel[1], texel[2]} - d), 0.06);
    }
  }
}

}  // namespace
}  // namespace welkin
