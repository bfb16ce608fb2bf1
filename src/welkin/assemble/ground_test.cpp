#include "welkin/assemble/ground.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "welkin/assemble/assemble.h"
#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/math/angles.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

/// Smooth, and green below the horizon, which no ground is to show.
std::array<float, 3> sky(const Vec3d& d) {
  const double around = std::atan2(d.x, d.z);
  return {static_cast<float>(1 + 0.5 * std::sin(2 * around) * std::sqrt(1 - d.y * d.y)),
          d.y < 0 ? 5.0f : 0.0f, static_cast<float>(0.5 + std::fabs(d.y))};
}

std::vector<Piece> pieces_of(const std::string& shape, int size, const Look& look = {}) {
  RenderOptions options;
  options.orientation = transpose(rotation_of(look));
  const auto p = sphere::AnyParameterization::make(shape);
  std::vector<Piece> pieces;
  pieces.push_back(make_panel(shape,
                              render(sky, p, size, std::max(1, static_cast<int>(size / p.aspect())), options),
                              {.look = look}));
  return pieces;
}

std::array<float, 3> at(const Map& map, double azimuth, double elevation) {
  return Sampler::borrow(map).rgb(direction_at(azimuth, elevation));
}

Assembly world_of(const std::vector<Piece>& pieces) {
  return assemble(pieces, MapFrame(sphere::AnyParameterization::make("latlong"), {256, 128}));
}

// Of half worlds, and of a fish-eye picture that looks up: what is seen below is what is seen above.
TEST(Ground, MirroredIsTheSkyUpsideDown) {
  for (auto& [shape, look] : {std::pair{"sky-latlong", Look{}},
                              {"half-cube", Look{}},
                              {"hemi-octahedral", Look{}},
                              {"fisheye-equidistant,fov=180", Look{0, 90, 0}}}) {
    std::vector<Piece> pieces = pieces_of(shape, 256, look);
    add_ground(pieces, Ground::mirrored);
    const Assembly made = world_of(pieces);
    EXPECT_NEAR(made.shown, 1, 2e-3) << shape;
    for (double azimuth = 1; azimuth < 360; azimuth += 40) {
      for (const double elevation : {10.0, 40.0, 80.0}) {
        const auto above = at(made.map, azimuth, elevation), below = at(made.map, azimuth, -elevation);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(above[c], below[c], 0.01) << shape << azimuth;
      }
      // No seam on the horizon: the rows beside it are as bright as those farther off.
      EXPECT_NEAR(at(made.map, azimuth, 0)[0], at(made.map, azimuth, 3)[0], 0.02) << shape << azimuth;
    }
  }
}

TEST(Ground, StretchedIsTheHorizon) {
  std::vector<Piece> pieces = pieces_of("sky-latlong", 256);
  add_ground(pieces, Ground::stretched);
  const Assembly made = world_of(pieces);
  EXPECT_NEAR(made.shown, 1, 1e-3);
  for (double azimuth = 1; azimuth < 360; azimuth += 40) {
    const auto horizon = at(made.map, azimuth, 1);
    for (const double elevation : {-5.0, -30.0, -60.0})
      EXPECT_NEAR(at(made.map, azimuth, elevation)[0], horizon[0], 0.02) << azimuth;
    EXPECT_NEAR(at(made.map, azimuth, -30)[2], 0.5, 0.02);
  }
}

// A picture that reaches below the horizon keeps what it shows there.
TEST(Ground, LiesBelowWhatIsShown) {
  std::vector<Piece> pieces = pieces_of("fisheye-equidistant,fov=220", 256, {0, 90, 0});
  add_ground(pieces, Ground::mirrored);
  const Assembly made = world_of(pieces);
  EXPECT_NEAR(at(made.map, 50, -12)[1], 5, 1e-3);
  EXPECT_NEAR(at(made.map, 50, -40)[1], 0, 1e-3);
  EXPECT_NEAR(made.shown, 1, 2e-3);
}

TEST(Ground, IsNotStretchedWithoutHorizon) {
  std::vector<Piece> pieces = pieces_of("fisheye-equidistant,fov=160", 64, {0, 90, 0});
  EXPECT_THROW(add_ground(pieces, Ground::stretched), Error);
  std::vector<Piece> none;
  EXPECT_THROW(add_ground(none, Ground::mirrored), Error);
}

}  // namespace
}  // namespace welkin
