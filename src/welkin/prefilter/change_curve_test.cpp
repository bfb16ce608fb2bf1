#include "welkin/prefilter/change_curve.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/measure/compare.h"
#include "welkin/prefilter/bake.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using lobe::RoughnessCurve;

Chain baked(const char* curve, int levels = 0) {
  static const Map room = render(synth::make("room"), sphere::AnyParameterization::make("latlong"), 256, 128);
  BakeOptions options;
  options.size = ChartSize{64, 64};
  options.curve = RoughnessCurve::from_name(curve);
  options.levels = levels;
  return BakePlan(room, options).run(room);
}

/// A chain for its own curve is what it was.
TEST(ChangeCurve, ItsOwnCurveChangesNothing) {
  const Chain chain = baked("filament", 5);
  const Chain same = change_roughness_curve(chain, RoughnessCurve::from_name("filament"), 5);
  EXPECT_EQ(same.notes, chain.notes);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(compare(same.levels[k], chain.levels[k]).all.rmse, 0) << k;
}

MapFrame faces_of_64() {
  return {sphere::AnyParameterization::make("cube"), ChartSize{64, 64}, {}};
}

/// Against a new bake. The room's light is in few lamps, so that the error is larger than of the light that
/// what is told is of; 0.02 is for a level that has a coarser one's place, and is averaged.
TEST(ChangeCurve, CostsAsMuchAsIsTold) {
  const Chain linear = baked("linear", 4);
  for (const char* name : {"filament", "babylon", "playcanvas", "0,0.1,0.3,1,1"}) {
    const RoughnessCurve curve = RoughnessCurve::from_name(name);
    const int levels = curve.listed_levels() > 0 ? 5 : 4;
    const Chain changed = change_roughness_curve(linear, curve, levels), fresh = baked(name, levels);
    EXPECT_EQ(changed.notes.roughness, fresh.notes.roughness) << name;
    EXPECT_EQ(changed.notes.curve, fresh.notes.curve) << name;
    const std::vector<LevelMix> mixes = mix_levels(linear.notes, faces_of_64(), curve, levels);
    for (std::size_t k = 0; k < changed.levels.size(); ++k) {
      const double error = compare(changed.levels[k], fresh.levels[k]).all.relative_rmse;
      EXPECT_LE(error, 2 * mixes[k].error + 0.02) << name << k;
      EXPECT_LE(mixes[k].error, 1.2 * error + 0.005) << name << k;
    }
  }
}

/// Between two levels the best share is nearer to the lobe than either of them and than equal shares.
TEST(ChangeCurve, SharesAreTheBest) {
  ChainNotes notes;
  notes.lobe = "ggx";
  notes.roughness = {0, 0.25, 0.5, 1, 1};
  const auto mixes = mix_levels(notes, faces_of_64(), RoughnessCurve::from_name("0.25,0.4,0.7,1,1"), 5);
  EXPECT_GT(mixes[0].error, 0);  // the source's texels are twice as large
  EXPECT_EQ(mixes[0].finer, 1);
  EXPECT_GT(mixes[1].share, 0.3);
  EXPECT_LT(mixes[1].share, 0.8);
  EXPECT_EQ(mixes[2].finer, 2);
  EXPECT_EQ(mixes[2].rougher, 3);
  EXPECT_EQ(mixes[4].finer, 3);  // the finer of two
  EXPECT_EQ(mixes[4].share, 0);
  notes.roughness = {0.3, 0.6};
  const auto beyond = mix_levels(notes, faces_of_64(), RoughnessCurve::from_name("0.1,0.9"), 2);
  EXPECT_EQ(beyond[0].rougher, 0);
  EXPECT_EQ(beyond[1].finer, 1);
  EXPECT_GT(beyond[1].error, 0.01);
}

TEST(ChangeCurve, RefusesWhatItCannotInterpolate) {
  const RoughnessCurve linear = RoughnessCurve::from_name("linear");
  ChainNotes notes;
  EXPECT_THROW(mix_levels(notes, faces_of_64(), linear, 3), Error);
  notes.lobe = "lambert";
  notes.roughness = {0, 1};
  EXPECT_THROW(mix_levels(notes, faces_of_64(), linear, 3), Error);
  notes.lobe = "ggx";
  EXPECT_NO_THROW(mix_levels(notes, faces_of_64(), linear, 3));
  EXPECT_THROW(mix_levels(notes, faces_of_64(), linear, 8), Error);
  EXPECT_THROW(mix_levels(notes, faces_of_64(), linear, 0), Error);
  notes.roughness = {1, 0};
  EXPECT_THROW(mix_levels(notes, faces_of_64(), linear, 3), Error);
  notes.roughness = {0, 1};
  notes.normalisation = "integral";
  EXPECT_THROW(mix_levels(notes, faces_of_64(), linear, 3), Error);
  Chain chain = baked("linear", 3);
  chain.notes.roughness.pop_back();
  EXPECT_THROW(change_roughness_curve(chain, linear, 3), Error);
}

}  // namespace
}  // namespace welkin
