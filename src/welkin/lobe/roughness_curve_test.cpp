#include "welkin/lobe/roughness_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin::lobe {
namespace {

std::vector<RoughnessCurve> all_curves() {
  std::vector<RoughnessCurve> list;
  for (const std::string& name : roughness_curve_names()) list.push_back(RoughnessCurve::from_name(name));
  return list;
}

TEST(RoughnessCurve, ReportsItsName) {
  for (const RoughnessCurve& curve : all_curves()) {
    EXPECT_EQ(RoughnessCurve::from_name(curve.text()).text(), curve.text());
    EXPECT_FALSE(curve.description().empty());
    EXPECT_FALSE(curve.source().empty());
    EXPECT_EQ(curve.listed_levels(), 0);
  }
  EXPECT_EQ(RoughnessCurve::from_name("0,0.25,1").text(), "0,0.25,1");
}

TEST(RoughnessCurve, NeverFallsAndStaysWithinOne) {
  for (const RoughnessCurve& curve : all_curves()) {
    for (const int levels : {1, 2, 3, 5, 9, 14}) {
      double before = 0;
      for (double level = -0.5; level < levels; level += 0.01) {
        const double roughness = curve.roughness(level, levels);
        EXPECT_GE(roughness, before) << curve.text() << level;
        EXPECT_LE(roughness, 1) << curve.text() << level;
        before = roughness;
      }
      const bool ends_early = curve.text() == "playcanvas" && levels < 6;
      EXPECT_TRUE(before == 1 || levels == 1 || ends_early) << curve.text() << levels;
    }
  }
}

/// Wherever the roughness rises, within 1e-12.
TEST(RoughnessCurve, LevelIsTheInverseOfRoughness) {
  std::vector<RoughnessCurve> curves = all_curves();
  curves.push_back(RoughnessCurve::from_name("0.05,0.1,0.3,0.35,0.7,0.71,0.72,0.9,1"));
  for (const RoughnessCurve& curve : curves) {
    int compared = 0;
    for (double level = 0; level <= 8; level += 0.01) {
      const double roughness = curve.roughness(level, 9);
      if (roughness == curve.roughness(level - 0.02, 9) || roughness == curve.roughness(level + 0.02, 9))
        continue;
      EXPECT_NEAR(curve.level_of(roughness, 9), level, 1e-12) << curve.text();
      ++compared;
    }
    EXPECT_GT(compared, 490) << curve.text();
  }
}

/// Figures of the engines themselves.
TEST(RoughnessCurve, HasTheEnginesFigures) {
  const auto roughness = [](const char* name, double level, int levels) {
    return RoughnessCurve::from_name(name).roughness(level, levels);
  };
  // Filament's filter for five levels.
  EXPECT_NEAR(roughness("filament", 1, 5), 0.133975, 1e-6);
  EXPECT_NEAR(roughness("filament", 2, 5), 0.292893, 1e-6);
  EXPECT_NEAR(roughness("filament", 3, 5), 0.5, 1e-6);
  // Unity's MipmapLevelToPerceptualRoughness of level 3: 1.7/1.4 − √(2.89/1.96 − 2.8/1.96 · 3/6).
  EXPECT_NEAR(roughness("unity", 3, 7), 1.7 / 1.4 - std::sqrt(2.89 / 1.96 - 1.4 / 1.96), 1e-12);
  // Unreal's captures of 128, eight levels: roughness 1 at 4×4, halved every 1.2 levels.
  EXPECT_EQ(roughness("unreal", 5, 8), 1);
  EXPECT_NEAR(roughness("unreal", 5 - 1.2, 8), 0.5, 1e-12);
  EXPECT_EQ(roughness("unreal", 7, 8), 1);
  // three.js up to r186 documents the least roughness of faces of 256 as 0.054 and of 16 as 0.21.
  EXPECT_NEAR(roughness("three.js-r186", 0, 11), 0.054, 5e-4);
  EXPECT_EQ(roughness("three.js-r186", 4, 11), 0.21);
  EXPECT_NEAR(roughness("three.js-r186", 7, 11), 0.4 + 0.4 / 3, 1e-12);
  EXPECT_EQ(roughness("three.js-r186", 10, 11), 1);
  // Since r187: its filter's levels of 256 … 8, 1 − √(1 − x).
  for (int level = 0; level < 6; ++level)
    EXPECT_NEAR(roughness("three.js", level, 6), 1 - std::sqrt(1 - level / 5.0), 1e-15);
  // Babylon.js reads faces of N at 0.8 log2(N α), α = r².
  for (const double r : {0.2, 0.5, 0.9})
    EXPECT_NEAR(RoughnessCurve::from_name("babylon").level_of(r, 8), 0.8 * std::log2(128 * r * r), 1e-12);
  EXPECT_EQ(roughness("babylon", 6, 8), 1);
  EXPECT_NEAR(roughness("playcanvas", 2, 6), 0.4, 1e-15);
  EXPECT_EQ(roughness("playcanvas", 7, 8), 1);
  EXPECT_EQ(roughness("cesium", 2, 9), 0.25);
  EXPECT_EQ(roughness("bevy", 2, 9), 0.25);
  // Godot reads a roughness of 0.25 in the middle.
  EXPECT_EQ(RoughnessCurve::from_name("godot").level_of(0.25, 9), 4);
  EXPECT_EQ(roughness("linear", 2, 9), 0.25);
}

TEST(RoughnessCurve, GivesAListsOwnLevels) {
  const RoughnessCurve list = RoughnessCurve::from_name("0.1,0.2,0.6");
  EXPECT_EQ(list.listed_levels(), 3);
  EXPECT_EQ(list.roughness_of_levels(3), (std::vector<double>{0.1, 0.2, 0.6}));
  EXPECT_NEAR(list.level_of(0.4, 3), 1.5, 1e-12);
  EXPECT_EQ(list.level_of(0, 3), 0);
  EXPECT_EQ(list.level_of(1, 3), 2);
  // Levels that end at a surface's roughness several times, as engines pad them: the first is read.
  const RoughnessCurve padded = RoughnessCurve::from_name("0,0.5,1,1,1");
  EXPECT_EQ(padded.roughness_of_levels(5), (std::vector<double>{0, 0.5, 1, 1, 1}));
  EXPECT_EQ(padded.level_of(1, 5), 2);
  EXPECT_EQ(RoughnessCurve::from_name("0,0,1").level_of(0, 3), 0);
  EXPECT_EQ(RoughnessCurve::from_name("0,0.5,0.5,1").level_of(0.75, 4), 2.5);
  EXPECT_EQ(RoughnessCurve::from_name("0.5").roughness_of_levels(1), (std::vector<double>{0.5}));
}

TEST(RoughnessCurve, RefusesWhatIsNoCurve) {
  const auto message = [](const char* text) -> std::string {
    try {
      RoughnessCurve::from_name(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "made";
  };
  EXPECT_NE(message("filamen").find("did you mean 'filament'"), std::string::npos);
  for (const char* text : {"", "0,", ",1", "0,x", "0,nan,1"}) EXPECT_NE(message(text), "made") << text;
  EXPECT_NE(message("0,1.5").find("'1.5' is not a number in 0…1"), std::string::npos);
  EXPECT_NE(message("-0.1,1").find("is not a number in 0…1"), std::string::npos);
  EXPECT_NE(message("0,0.5,0.4").find("is below the one before"), std::string::npos);
  const RoughnessCurve list = RoughnessCurve::from_name("0,1");
  EXPECT_THROW(list.roughness_of_levels(3), Error);
  EXPECT_THROW(list.level_of(0.5, 1), Error);
  for (const double roughness : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(list.level_of(roughness, 2), Error);
    EXPECT_THROW(RoughnessCurve::from_name("unreal").level_of(roughness, 2), Error);
  }
}

}  // namespace
}  // namespace welkin::lobe
