#include "welkin/assemble/ball_photograph.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "welkin/assemble/assemble.h"
#include "welkin/assemble/ball_photograph_cases.h"
#include "welkin/base/error.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

MapFrame latlong(int width) {
  return {sphere::AnyParameterization::make("latlong"), {width, width / 2}};
}

/// The largest difference from the world in R, G and B, where `caps` leave `depth` radians.
double difference(const Map& map, const synth::Radiance& world, const std::vector<Cap>& caps, double depth,
                  const Matrix3& to_caps) {
  double largest = 0;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Vec3d d = map.parameterization.to_sphere(0, (x + 0.5) / map.width(), (y + 0.5) / map.height());
      bool inside = true;
      for (const Cap& cap : caps) inside = inside && cap.depth(to_caps * d) > depth;
      if (!inside) continue;
      for (int c = 0; c < 3; ++c)
        largest = std::max(largest, std::fabs(static_cast<double>(map.level.chart(0).at(x, y)[c]) -
                                              static_cast<double>(world(d)[static_cast<std::size_t>(c)])));
    }
  }
  return largest;
}

// Far from the rim a texel of 200 measures less than a degree; bands of 2π/5 curve by 2e-3 in it. A wrong
// distance, centre or sign moves directions by several degrees, and values by tenths.
TEST(BallPhotograph, IsUnwrapped) {
  for (const BallShot& shot : {BallShot{.distance = 20}, BallShot{.distance = 3}, BallShot{.distance = 1.5},
                               BallShot{240, 210, {118.3, 101.6, 97.2}, 6, {40, 25, 70}, 0, 3}}) {
    const BallPiece ball = piece_of(ball_world, shot);
    const Assembly made = assemble(std::span(&ball.piece, 1), latlong(180));
    EXPECT_LT(difference(made.map, ball_world, ball.piece.edges, 30 * kDegree, ball.piece.map.orientation),
              0.012)
        << shot.distance;
    // Up to where texels are left out: they are stretched, but show the right directions.
    EXPECT_LT(difference(made.map, ball_world, ball.piece.edges, 4 * kDegree, ball.piece.map.orientation),
              0.1)
        << shot.distance;
  }
}

TEST(BallPhotograph, TellsItsBlindCone) {
  const BallPiece ball = piece_of(ball_world, {.distance = 2});
  EXPECT_NEAR(ball.blind, 30 * kDegree, 1e-12);
  EXPECT_GT(ball.left_out, ball.blind);
  const Assembly made = assemble(std::span(&ball.piece, 1), latlong(360));
  EXPECT_NEAR(made.shown, (1 + std::cos(ball.left_out)) / 2, 1e-3);
}

// A camera of 40° that sees the ball across half of its picture: tan 20° / 2 = tan asin(1/distance).
TEST(BallPhotograph, TakesTheFieldOfViewForTheDistance) {
  BallPhotographOptions options;
  options.fov = 40;
  options.circle = PictureCircle{100, 80, 50};
  const BallPiece ball =
      make_ball_piece("ball", Map(sphere::AnyParameterization::make("latlong"), 200, 160, 3), options);
  EXPECT_NEAR(std::tan(std::asin(1 / ball.distance)), std::tan(20 * kDegree) / 2, 1e-12);
}

// Two photographs show all of the world: what lies behind the ball, and where the camera is seen, the other
// one has. The first keeps nothing of the camera it shows, black within 10°.
TEST(BallPhotograph, TwoMakeTheWorld) {
  for (const double apart : {90.0, 120.0, 180.0}) {
    std::vector<Piece> pieces;
    for (const double yaw : {0.0, apart}) {
      BallShot shot{.distance = 8, .look = {yaw, 0, 0}, .camera = 10};
      pieces.push_back(piece_of(ball_world, shot, 12).piece);
    }
    const Assembly made = assemble(pieces, latlong(180));
    // Half a turn apart, each hides what the other's camera is in front of.
    if (apart == 180) {
      EXPECT_LT(made.shown, 0.995);
      continue;
    }
    EXPECT_NEAR(made.shown, 1, 1e-6) << apart;
    EXPECT_LT(difference(made.map, ball_world, {}, 0, {}), 0.02) << apart;
  }
}

// Near the rim texels are long and thin, and show bands of 12° as their mean. The photograph that has them in
// its middle counts more there, so they are kept better than by an even mixture.
TEST(BallPhotograph, TheOneThatShowsADirectionWellPrevails) {
  const auto bands = [](const Vec3d& d) {
    const auto wave = [](double x) { return static_cast<float>(1 + 0.9 * std::sin(30 * x)); };
    return std::array<float, 3>{wave(d.x), wave(d.y), wave(d.z)};
  };
  std::vector<Piece> pieces;
  for (const double yaw : {0.0, 120.0})
    pieces.push_back(
        piece_of(bands, {.width = 120, .height = 120, .circle = {60, 60, 60}, .look = {yaw, 0, 0}}).piece);
  const Map truth = render(bands, sphere::AnyParameterization::make("latlong"), 180, 90);
  const auto squares = [&](bool by_fineness) {
    const Map made = assemble(pieces, latlong(180), {.by_fineness = by_fineness}).map;
    double sum = 0;
    for (int y = 0; y < 90; ++y) {
      const double area = std::sin(kPi * (y + 0.5) / 90);
      for (int x = 0; x < 180; ++x) {
        for (int c = 0; c < 3; ++c)
          sum +=
              area *
              std::pow(
                  static_cast<double>(made.level.chart(0).at(x, y)[c] - truth.level.chart(0).at(x, y)[c]), 2);
      }
    }
    return sum;
  };
  EXPECT_LT(squares(true), 0.6 * squares(false));
}

TEST(BallPhotograph, RefusesWhatMakesNoSense) {
  const auto refuses = [](const BallPhotographOptions& options) {
    Map picture(sphere::AnyParameterization::make("latlong"), 100, 80, 3);
    EXPECT_THROW(make_ball_piece("ball", std::move(picture), options), Error);
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double distance : {0.0, 1.0, -3.0, kNaN}) refuses({.distance = distance});
  for (const double fov : {0.0, 180.0, kNaN}) refuses({.fov = fov});
  for (const PictureCircle& circle :
       {PictureCircle{50, 40, 41}, PictureCircle{20, 40, 30}, PictureCircle{500, 40, 30},
        PictureCircle{50, 40, 0}, PictureCircle{50, 40, kNaN}, PictureCircle{kNaN, 40, 20}})
    refuses({.circle = circle});
  for (const double camera : {-1.0, 90.0, kNaN}) refuses({.camera = camera});
  for (const double rim : {-1.0, 40.0, kNaN}) refuses({.rim = rim});
  refuses({.feather = kNaN});
  refuses({.gain = 0});
  refuses({.look = {kNaN, 0, 0}});
}

}  // namespace
}  // namespace welkin
