#include "welkin/lookup/roughness_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/lobe/roughness_curve.h"

namespace welkin::test {
namespace {

ChainNotes notes_of(std::vector<double> roughness) {
  ChainNotes notes;
  notes.roughness = std::move(roughness);
  return notes;
}

TEST(LevelOfRoughness, IsTheInverseOfWhatLevelsHave) {
  const ChainNotes notes = notes_of({0, 0.1, 0.25, 0.5, 0.5, 1});
  for (const double level : {0.0, 0.3, 1.0, 2.5, 3.0, 4.25, 5.0}) {
    const std::size_t below = static_cast<std::size_t>(level);
    const double share = level - static_cast<double>(below);
    const double roughness = share > 0
                                 ? (1 - share) * notes.roughness[below] + share * notes.roughness[below + 1]
                                 : notes.roughness[below];
    EXPECT_NEAR(level_of_roughness(notes, roughness), level, 1e-12);
  }
  EXPECT_EQ(level_of_roughness(notes, 0.5), 3) << "the first of two";
  EXPECT_EQ(level_of_roughness(notes_of({0.2, 0.4}), 0.1), 0);
  EXPECT_EQ(level_of_roughness(notes_of({0.2, 0.4}), 0.9), 1);
}

TEST(LevelOfRoughness, IsNearWhatAnEnginesCurveSays) {
  const auto curve = lobe::RoughnessCurve::from_name("linear");
  const ChainNotes notes = notes_of(curve.roughness_of_levels(7));
  for (const double roughness : {0.0, 0.2, 0.77, 1.0}) {
    EXPECT_NEAR(level_of_roughness(notes, roughness), curve.level_of(roughness, 7), 1e-9);
  }
}

TEST(LevelsOfRoughness, AreThoseOfEach) {
  const ChainNotes notes = notes_of({0, 0.5, 1});
  const std::vector<float> roughness{1, 0.25f, 0.75f};
  std::vector<float> levels(4, -1);
  levels_of_roughness(notes, roughness, levels);
  EXPECT_EQ(levels, (std::vector<float>{2, 0.5f, 1.5f, -1}));
  EXPECT_THROW(levels_of_roughness(notes, roughness, std::span(levels).first(2)), Error);
  EXPECT_THROW(levels_of_roughness(notes, std::vector<float>{std::nanf("")}, levels), Error);
  EXPECT_THROW(level_of_roughness(notes, 1.5), Error);
  EXPECT_THROW(level_of_roughness(ChainNotes{}, 0.5), Error);
  EXPECT_THROW(level_of_roughness(notes_of({0.5, 0.2}), 0.3), Error);
}

}  // namespace
}  // namespace welkin::test
