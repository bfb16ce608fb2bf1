#include "welkin/assemble/exposure.h"

#include <gtest/gtest.h>

#include <vector>

#include "welkin/assemble/ball_photograph_cases.h"

namespace welkin {
namespace {

std::vector<Piece> balls(const std::vector<double>& gains) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < gains.size(); ++k) {
    const BallShot shot{.distance = 10, .look = {static_cast<double>(k) * 100, 0, 0}, .gain = gains[k]};
    pieces.push_back(piece_of(ball_world, shot).piece);
  }
  return pieces;
}

// What differs beside the gain is how a texel of the ball averages: the median is free of that to a few per
// mille.
TEST(Exposure, GainsAreFoundFromOverlaps) {
  std::vector<Piece> pieces = balls({1, 1.7, 0.4});
  match_exposures(pieces);
  EXPECT_NEAR(pieces[0].gain, 1, 1e-12);
  EXPECT_NEAR(pieces[1].gain * 1.7, 1, 5e-3);
  EXPECT_NEAR(pieces[2].gain * 0.4, 1, 5e-3);
  for (const Overlap& each : compare_overlaps(pieces)) {
    EXPECT_NEAR(each.ratio, 1, 5e-3);
    EXPECT_LT(each.error, 0.02);
    EXPECT_GT(each.share, 0.5);
  }
}

TEST(Exposure, TheErrorIsTold) {
  const std::vector<Overlap> overlaps = compare_overlaps(balls({1, 1.5}));
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_NEAR(overlaps[0].ratio, 1.5, 5e-3);
  EXPECT_NEAR(overlaps[0].error, 0.5 / 1.25, 0.02);
}

// What a camera hides, or a lamp that one photograph clips, is not the exposure.
TEST(Exposure, OutliersDontMove) {
  std::vector<Piece> pieces = balls({1});
  const auto with_lamp = [](const Vec3d& d) {
    std::array<float, 3> seen = ball_world(d);
    if (d.y > 0.8) seen = {50, 50, 50};
    return seen;
  };
  pieces.push_back(piece_of(with_lamp, {.distance = 10, .look = {100, 0, 0}, .gain = 2}).piece);
  match_exposures(pieces);
  EXPECT_NEAR(pieces[1].gain, 0.5, 0.02);
}

TEST(Exposure, PiecesWithoutOverlapKeepTheirGain) {
  std::vector<Piece> pieces = balls({1, 1.7});
  pieces[1].layer = 1;
  match_exposures(pieces);
  EXPECT_EQ(pieces[1].gain, 1);
  EXPECT_TRUE(compare_overlaps(pieces).empty());
}

}  // namespace
}  // namespace welkin
