#include "welkin/filter/texel_positions.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/filter/resample.h"
#include "welkin/filter/texel_maker.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

Map world_of(const std::string& parameterization, int size) {
  return cases::rendered(parameterization, size, cases::zone_plate(5), 3);
}

std::vector<float> values_of(const Map& map) {
  std::vector<float> values;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const float* row = map.level.chart(chart).row(y);
      values.insert(values.end(), row, row + map.width() * map.channels());
    }
  }
  return values;
}

struct Shape {
  const char* parameterization;
  int width, height;
};

/// Of every filter, between shapes with one chart and several, whole and in part, wider and narrower than the
/// tiles that are worked on: bit for bit.
TEST(TexelPositions, GiveTheSameMaps) {
  const Matrix3 turn = rotation_from_yaw_pitch_roll(40, 20, -15);
  for (const char* from : {"latlong", "cube", "vr180"}) {
    const Map source = world_of(from, 45);
    for (const Shape& to :
         {Shape{"perspective", 301, 37}, {"cube", 19, 19}, {"equidistant", 45, 45}, {"latlong", 64, 32}}) {
      Map plain(sphere::AnyParameterization::make(to.parameterization), to.width, to.height, 3);
      plain.orientation = rotation_from_yaw_pitch_roll(-100, 5, 9);
      Map kept = plain.clone();
      ResampleOptions options;
      options.rotation = turn;
      options.fill = {0.25f, 0.5f, 0.75f};
      for (const Filter filter :
           {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos, Filter::automatic}) {
        options.filter = filter;
        options.positions = nullptr;
        resample(source, plain, options);
        options.positions = std::make_shared<const TexelPositions>(source, kept, turn);
        resample(source, kept, options);
        EXPECT_EQ(values_of(plain), values_of(kept))
            << from << " to " << to.parameterization << ", " << name_of(filter);
      }
    }
  }
}

/// A picture that shows the chart turned by a quarter and mirrored.
TEST(TexelPositions, OfChartsThatLieOnTheirSide) {
  const Map source = world_of("latlong", 45);
  const MapFrame target(sphere::AnyParameterization::make("cube"), {21, 21});
  ResampleOptions options;
  options.filter = Filter::bilinear;
  const ChartPart part{2, {20, 20, 0, -1, -1, 0}};
  Image plain(21, 21, 3), kept(21, 21, 3);
  make_texels(source, target, options)->make(part, plain.view());
  options.positions = std::make_shared<const TexelPositions>(source, target);
  make_texels(source, target, options)->make(part, kept.view());
  for (int y = 0; y < 21; ++y) {
    for (int k = 0; k < 3 * 21; ++k) ASSERT_EQ(plain.at(0, y)[k], kept.at(0, y)[k]) << y;
  }
}

TEST(TexelPositions, OfOtherMapsAreRefused) {
  const Map source = world_of("latlong", 45);
  Map target(sphere::AnyParameterization::make("perspective"), 32, 18, 3);
  const auto positions = std::make_shared<const TexelPositions>(source, target);
  EXPECT_TRUE(positions->fit(source, target));
  for (const Filter filter : {Filter::bilinear, Filter::automatic}) {
    const ResampleOptions options{.filter = filter, .positions = positions};
    EXPECT_NO_THROW(resample(source, target, options));
    EXPECT_THROW(resample(world_of("latlong", 30), target, options), Error);
    Map turned = target.clone();
    turned.orientation = rotation_from_yaw_pitch_roll(1, 0, 0);
    EXPECT_THROW(resample(source, turned, options), Error);
    ResampleOptions other = options;
    other.rotation = rotation_from_yaw_pitch_roll(1, 0, 0);
    EXPECT_THROW(resample(source, target, other), Error);
  }
  Matrix3 squeezed;
  squeezed.rows[0][0] = 0.5;
  EXPECT_THROW(TexelPositions(source, target, squeezed), Error);
}

}  // namespace
}  // namespace welkin
