#include "welkin/assemble/assemble.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// Smooth, so that pictures of different kinds agree in it: bands of a few tens of degrees.
std::array<float, 3> smooth_world(const Vec3d& d) {
  return {static_cast<float>(1 + 0.5 * std::sin(5 * d.x + 2 * d.y)), static_cast<float>(1.2 + d.y),
          static_cast<float>(0.8 + 0.4 * std::cos(4 * d.z))};
}

std::array<float, 3> white(const Vec3d&) {
  return {1, 1, 1};
}

Map flat(const synth::Radiance& world, double fov, const Look& look, int width = 96, int height = 96) {
  RenderOptions options;
  options.orientation = transpose(rotation_of(look));
  return render(world,
                sphere::AnyParameterization::make("perspective,fov=" + number_text(fov) + ",aspect=" +
                                                  number_text(static_cast<double>(width) / height)),
                width, height, options);
}

MapFrame latlong(int width) {
  return {AnyParameterization::make("latlong"), {width, width / 2}};
}

/// The largest difference in R, G and B, relative to 1.
double difference(const Map& a, const Map& b) {
  double largest = 0;
  for (int chart = 0; chart < a.charts(); ++chart) {
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        for (int c = 0; c < 3; ++c)
          largest = std::max(largest, std::fabs(static_cast<double>(a.level.chart(chart).at(x, y)[c]) -
                                                static_cast<double>(b.level.chart(chart).at(x, y)[c])));
      }
    }
  }
  return largest;
}

std::vector<Piece> faces(const synth::Radiance& world, double fov, double feather) {
  std::vector<Piece> pieces;
  for (const Look& look :
       {Look{0, 0, 0}, Look{90, 0, 0}, Look{180, 0, 0}, Look{270, 0, 0}, Look{0, 90, 0}, Look{0, -90, 0}}) {
    pieces.push_back(
        make_flat_panel("face", flat(world, fov, look), fov, {.look = look, .feather = feather}));
  }
  return pieces;
}

float at(const Map& map, const Vec3d& d, std::size_t channel = 0) {
  std::vector<float> values(static_cast<std::size_t>(map.channels()));
  Sampler::borrow(map, {.filter = Filter::nearest}).look_up(d, values);
  return values[channel];
}

// Six flat pictures of 110° show the world between them. Within a texel or two of a picture's edges the
// filter knows only one side, and is off by a half per cent.
TEST(Assemble, PicturesAllAroundMakeTheWorld) {
  const Map truth = render(smooth_world, AnyParameterization::make("latlong"), 128, 64);
  for (const double feather : {2.0, 10.0, 20.0}) {
    const Assembly made = assemble(faces(smooth_world, 110, feather), latlong(128));
    EXPECT_LT(difference(made.map, truth), 8e-3) << feather;
    EXPECT_NEAR(made.shown, 1, 1e-6) << feather;
  }
}

TEST(Assemble, FacesOfACubeJoinWithoutFeather) {
  const Assembly made = assemble(faces(white, 90, 0), latlong(64));
  const Map truth = render(white, AnyParameterization::make("latlong"), 64, 32);
  // At the edges each face has its share of a texel, by 32×32 points.
  EXPECT_LT(difference(made.map, truth), 0.05);
  EXPECT_NEAR(made.shown, 1, 0.01);
}

TEST(Assemble, AnyParameterizationIsMadeAlike) {
  const std::vector<Piece> pieces = faces(smooth_world, 110, 15);
  for (const char* name : {"cube", "octahedral", "half-cube", "fisheye-equidistant,fov=180"}) {
    const auto p = AnyParameterization::make(name);
    const Map truth = render(smooth_world, p, 48, 48);
    const Assembly made = assemble(pieces, MapFrame(p, {48, 48}));
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 48; ++x) {
        // At a rim, means are over parts of texels, by other points.
        bool whole = true;
        for (int corner = 0; corner < 4; ++corner)
          whole = whole && p.valid(0, (x + corner % 2) / 48.0, (y + corner / 2) / 48.0);
        if (!whole) continue;
        EXPECT_NEAR(made.map.level.chart(0).at(x, y)[0], truth.level.chart(0).at(x, y)[0], 8e-3)
            << name << " " << x << " " << y;
      }
    }
    EXPECT_NEAR(made.shown, 1, 1e-6) << name;
  }
}

// Neighbours whose edges overlap by their feather add up to 1, as 3t² − 2t³ does with itself turned around:
// on the horizon, where edges are meridians, there is no seam.
TEST(Assemble, FeathersThatOverlapAddUp) {
  std::vector<Piece> pieces;
  for (const double yaw : {-25.0, 25.0}) {
    const Look look{yaw, 0, 0};
    pieces.push_back(make_flat_panel("half", flat(white, 60, look), 60, {.look = look, .feather = 10}));
  }
  pieces.push_back(make_panel("behind", render(white, AnyParameterization::make("latlong"), 8, 4)));
  pieces.back().layer = kBackdrop;
  pieces.back().gain = 1e-3;
  const Assembly made = assemble(pieces, latlong(720));
  for (double azimuth = -40; azimuth <= 40; azimuth += 0.5)
    EXPECT_NEAR(at(made.map, direction_at(azimuth, 0.1)), 1, 2e-3) << azimuth;
  // Where there is no neighbour it fades as smooth_step says: halfway at 5°.
  EXPECT_NEAR(at(made.map, direction_at(50.25, 0.1)), smooth_step(0, 10, 4.75), 0.02);
  EXPECT_NEAR(at(made.map, direction_at(56, 0)), 1e-3, 1e-6);
}

// The part of the sphere that a flat picture shows is known.
TEST(Assemble, TellsHowMuchIsShown) {
  const Piece piece = make_flat_panel("one", flat(white, 70, {}, 90, 60), 70);
  const double share = piece.map.parameterization.coverage() / (4 * kPi);
  const Assembly made = assemble(std::span(&piece, 1), latlong(256), {.fill = std::array<float, 3>{5, 6, 7}});
  EXPECT_NEAR(made.shown, share, 2e-3 * share);
  EXPECT_NEAR(made.shown_by[0], share, 2e-3 * share);
  EXPECT_EQ(at(made.map, {0, 0, -1}, 0), 5);
  EXPECT_EQ(at(made.map, {0, 0, -1}, 2), 7);
  EXPECT_NEAR(at(made.map, {0, 0, 1}, 2), 1, 1e-6);
}

// Light that is reduced stays: a picture of finest checks becomes their mean.
TEST(Assemble, ReducedPicturesAreAveraged) {
  Map fine = flat(white, 90, {}, 512, 512);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x)
      std::fill_n(fine.level.chart(0).at(x, y), 3, (x + y) % 2 == 0 ? 2.0f : 0.0f);
  }
  fill_borders(fine);
  const Piece piece = make_flat_panel("checks", std::move(fine), 90);
  const Assembly made = assemble(std::span(&piece, 1), latlong(64));
  for (double azimuth = -30; azimuth <= 30; azimuth += 3)
    EXPECT_NEAR(at(made.map, direction_at(azimuth, 0)), 1, 0.02) << azimuth;
}

Map half_transparent() {
  Map map(AnyParameterization::make("latlong"), 64, 32, 4);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      float* texel = map.level.chart(0).at(x, y);
      texel[0] = 1;  // associated: a radiance of 2
      texel[3] = 0.5f;
    }
  }
  fill_borders(map);
  return map;
}

TEST(Assemble, HigherLayersLieOver) {
  std::vector<Piece> pieces;
  pieces.push_back(make_panel("over", half_transparent(), {.layer = 1}));
  pieces.push_back(make_panel("under", render(white, AnyParameterization::make("latlong"), 64, 32)));
  const Assembly made = assemble(pieces, latlong(64));
  EXPECT_NEAR(at(made.map, {0, 0, 1}, 0), 1 + 0.5, 1e-5);
  EXPECT_NEAR(at(made.map, {0, 0, 1}, 1), 0 + 0.5, 1e-5);
  // In one layer both are mixed by their opacity: (1·½·2 + 1·1)/1.5.
  pieces[0].layer = 0;
  const Assembly mixed = assemble(pieces, latlong(64), {.by_fineness = false});
  EXPECT_NEAR(at(mixed.map, {0, 0, 1}, 0), 2 / 1.5, 1e-5);
}

TEST(Assemble, BackdropsAreNotCountedAsShown) {
  std::vector<Piece> pieces;
  pieces.push_back(make_flat_panel("one", flat(white, 70, {}), 70));
  pieces.push_back(make_panel("behind", render(smooth_world, AnyParameterization::make("latlong"), 64, 32)));
  pieces[1].layer = kBackdrop;
  const Assembly made = assemble(pieces, latlong(64), {.alpha = true});
  EXPECT_NEAR(made.shown, pieces[0].map.parameterization.coverage() / (4 * kPi), 1e-3);
  EXPECT_NEAR(at(made.map, {0, 0, -1}, 3), 1, 1e-5);
  const Map truth = render(smooth_world, AnyParameterization::make("latlong"), 64, 32);
  EXPECT_NEAR(at(made.map, {0, 0, -1}, 0), at(truth, {0, 0, -1}), 1e-5);
}

// Of two that show the same, the sharper counts by its texels per radian, squared: 16 times those of the
// other.
TEST(Assemble, TheSharperPrevails) {
  std::vector<Piece> pieces;
  pieces.push_back(make_flat_panel("sharp",
                                   flat(
                                       [](const Vec3d&) {
                                         return std::array<float, 3>{1, 1, 1};
                                       },
                                       60, {}, 64, 64),
                                   60));
  pieces.push_back(make_flat_panel("blurred",
                                   flat(
                                       [](const Vec3d&) {
                                         return std::array<float, 3>{0, 0, 0};
                                       },
                                       60, {}, 16, 16),
                                   60));
  EXPECT_NEAR(at(assemble(pieces, latlong(64)).map, {0, 0, 1}), 16.0 / 17, 1e-4);
  EXPECT_NEAR(at(assemble(pieces, latlong(64), {.by_fineness = false}).map, {0, 0, 1}), 0.5, 1e-4);
}

TEST(Assemble, AimsAsItSays) {
  const auto where = [](const Look& look, const Vec3d& camera) { return rotation_of(look) * camera; };
  EXPECT_NEAR(where({90, 0, 0}, {0, 0, 1}).x, -1, 1e-12);
  EXPECT_NEAR(where({0, 90, 0}, {0, 0, 1}).y, 1, 1e-12);
  // Rolled clockwise, the camera's right side (−X) goes down.
  EXPECT_NEAR(where({0, 0, 90}, {-1, 0, 0}).y, -1, 1e-12);
}

// A fish-eye photograph that isn't square: its disc lies in a circle.
TEST(Assemble, ADiscLiesInACircle) {
  const auto lens = AnyParameterization::make("fisheye-equisolid,fov=180");
  const Map disc = render(smooth_world, lens, 100, 100);
  Map photograph(AnyParameterization::make("latlong"), 160, 120, 3);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x)
      std::copy_n(disc.level.chart(0).at(x, y), 3, photograph.level.chart(0).at(x + 44, y + 13));
  }
  std::vector<Piece> pieces;
  pieces.push_back(make_disc_panel("photograph", std::move(photograph), lens, PictureCircle{94, 63, 50}));
  const Assembly made = assemble(pieces, latlong(128));
  EXPECT_NEAR(made.shown, 0.5, 1e-3);
  const Map truth = render(smooth_world, AnyParameterization::make("latlong"), 128, 64);
  for (double azimuth = -80; azimuth <= 80; azimuth += 10) {
    for (double elevation = -50; elevation <= 50; elevation += 25) {
      const Vec3d d = direction_at(azimuth, elevation);
      EXPECT_NEAR(at(made.map, d), at(truth, d), 0.01) << azimuth << " " << elevation;
    }
  }
}

TEST(Assemble, RefusesWhatMakesNoSense) {
  const auto picture = [] { return flat(white, 60, {}, 8, 8); };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double fov : {0.0, -10.0, 180.0, kNaN})
    EXPECT_THROW(make_flat_panel("x", picture(), fov), Error) << fov;
  EXPECT_THROW(make_flat_panel("x", picture(), 60, {.feather = 91}), Error);
  EXPECT_THROW(make_flat_panel("x", picture(), 60, {.feather = kNaN}), Error);
  EXPECT_THROW(make_flat_panel("x", picture(), 60, {.gain = 0}), Error);
  EXPECT_THROW(make_flat_panel("x", picture(), 60, {.look = {kNaN, 0, 0}}), Error);
  EXPECT_THROW(assemble({}, latlong(8)), Error);
  Map odd(AnyParameterization::make("latlong"), 8, 4, 5);
  EXPECT_THROW(make_panel("x", std::move(odd)), Error);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Map broken = picture();
    broken.level.chart(0).at(3, 3)[1] = bad;
    EXPECT_THROW(make_flat_panel("x", std::move(broken), 60), Error);
  }
  Map opaque = half_transparent();
  opaque.level.chart(0).at(3, 3)[3] = 1.5f;
  EXPECT_THROW(make_panel("x", std::move(opaque)), Error);
}

}  // namespace
}  // namespace welkin
