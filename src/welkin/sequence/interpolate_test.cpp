#include "welkin/sequence/interpolate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/measure/compare.h"
#include "welkin/prefilter/bake.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

Map sky(double azimuth) {
  synth::SynthOptions sun;
  sun.azimuth = azimuth;
  return render(synth::make("sky", sun), sphere::AnyParameterization::make("latlong"), 64, 32);
}

Chain chain_of(const Map& map, double tolerance = 1e-3) {
  BakeOptions options;
  options.size = {16, 16};
  options.prefilter.tolerance = tolerance;
  return bake(map, options);
}

template <class Check>
void for_texels(const Chain& chain, const Check& check) {
  for (std::size_t k = 0; k < chain.levels.size(); ++k) {
    const Map& map = chain.levels[k];
    for (int c = 0; c < map.charts(); ++c) {
      for (int y = -kBorder; y < map.height() + kBorder; ++y) {
        for (int i = -kBorder * map.channels(); i < (map.width() + kBorder) * map.channels(); ++i)
          check(k, c, y, i, map.level.chart(c).row(y)[i]);
      }
    }
  }
}

TEST(Interpolated, IsExactAtBothEndsAndWhereBothAgree) {
  const Chain a = chain_of(sky(0)), b = chain_of(sky(40));
  const Chain first = interpolated(a, b, 0), last = interpolated(a, b, 1), same = interpolated(a, a, 0.3);
  for_texels(a, [&](std::size_t k, int c, int y, int i, float value) {
    ASSERT_EQ(first.levels[k].level.chart(c).row(y)[i], value);
    ASSERT_EQ(same.levels[k].level.chart(c).row(y)[i], value);
    ASSERT_EQ(last.levels[k].level.chart(c).row(y)[i], b.levels[k].level.chart(c).row(y)[i]);
  });
  EXPECT_EQ(first.notes, a.notes);
}

// Filtering is linear but for its tolerance, which what is left out of lobes comes to: here 1e-5 in the mean
// square. Levels of a few texels are no mean, so ten times that. A mirror's level is a mean of a
// reconstruction that is limited where it would go below 0, which isn't linear.
TEST(Interpolated, IsTheChainOfTheInterpolatedSource) {
  Map a = sky(0);
  const Map b = sky(90);
  const Chain chain = interpolated(chain_of(a, 1e-5), chain_of(b, 1e-5), 0.25);
  for (int y = -kBorder; y < a.height() + kBorder; ++y) {
    float* row = a.level.chart(0).row(y);
    const float* other = b.level.chart(0).row(y);
    for (int i = -kBorder * 3; i < (a.width() + kBorder) * 3; ++i) row[i] = 0.75f * row[i] + 0.25f * other[i];
  }
  const Chain direct = chain_of(a, 1e-5);
  for (std::size_t k = 0; k < direct.levels.size(); ++k) {
    EXPECT_LT(compare(direct.levels[k], chain.levels[k]).all.relative_rmse, k == 0 ? 1e-3 : 1e-4) << k;
  }
}

TEST(Interpolated, RefusesWhatDoesNotBelongTogether) {
  const Chain a = chain_of(sky(0));
  BakeOptions options;
  options.size = {8, 8};
  const Chain small = bake(sky(0), options);
  EXPECT_THROW(interpolated(a, small, 0.5), Error);
  Chain turned = chain_of(sky(0));
  turned.levels.back().orientation = rotation_from_yaw_pitch_roll(90, 0, 0);
  EXPECT_THROW(interpolated(a, turned, 0.5), Error);
  for (const double t : {-0.1, 1.1, std::nan("")}) EXPECT_THROW(interpolated(a, a, t), Error);
}

}  // namespace
}  // namespace welkin
