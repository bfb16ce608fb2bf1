#include "welkin/render/render.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/render/render_cases.h"
#include "welkin/scene/shapes.h"
#include "welkin/synth/render_synth.h"

namespace welkin::scene {
namespace {

/// Root mean square difference over pixels that are covered wholly, relative to the RMS of `truth`.
double relative_error(const Image& picture, const Image& truth) {
  double squares = 0, differences = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (truth.at(x, y)[3] < 1) continue;
      for (int c = 0; c < 3; ++c) {
        const double t = truth.at(x, y)[c];
        squares += t * t;
        differences += (picture.at(x, y)[c] - t) * (picture.at(x, y)[c] - t);
      }
    }
  }
  return std::sqrt(differences / squares);
}

/// A mirror ball of radius 1 by its formula: many rays a pixel, each looked up between texels.
Image mirror_ball_reference(const PlacedCamera& camera, const Map& world, int samples) {
  const MapFrame frame = frame_of(camera.camera);
  const Sampler sampler = Sampler::borrow(world);
  const int width = frame.size.width, height = frame.size.height;
  Image picture(width, height, 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < samples * samples; ++k) {
        const double u = (x + (k % samples + 0.5) / samples) / width,
                     v = (y + (k / samples + 0.5) / samples) / height;
        const Vec3d d = transpose(frame.orientation) * frame.parameterization.to_sphere(0, u, v);
        const double b = dot(camera.position, d), c = dot(camera.position, camera.position) - 1;
        if (b * b - c < 0) continue;
        const Vec3d n = camera.position + (-b - std::sqrt(b * b - c)) * d;
        const auto rgb = sampler.rgb(d - 2 * dot(n, d) * n);
        for (std::size_t i = 0; i < 3; ++i)
          picture.at(x, y)[i] += rgb[i] / static_cast<float>(samples * samples);
        picture.at(x, y)[3] += 1 / static_cast<float>(samples * samples);
      }
    }
  }
  return picture;
}

TEST(Render, MirrorBallIsWhatItsFormulaSays) {
  const Map studio = synth_map("studio");
  const PlacedCamera camera = ball_camera(64);
  const TracedScene scene(ball(256));
  // Within 3° of the outline a pixel sees a quarter of the world, and its cone is no Gaussian any more.
  ConeSamplerOptions cones;
  cones.filter = ConeFilter::ewa;
  const World world(studio.clone(), {}, cones);
  const auto mirror = make_shading("mirror", {world});
  const Image picture = render(scene, camera, world, *mirror, {.samples = 4, .background = false});
  EXPECT_LT(relative_error(picture, mirror_ball_reference(camera, studio, 32)), 0.02);
}

// Whatever is shaded with one radiance from everywhere shows it: mirrors and white diffuse bodies to the
// error of look-ups, with the background and without.
TEST(Render, ConstantWorldsStayConstant) {
  Map grey(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int y = -kBorder; y < 32 + kBorder; ++y)
    for (int x = -kBorder; x < 64 + kBorder; ++x)
      for (int c = 0; c < 3; ++c) grey.level.chart(0).at(x, y)[c] = 0.5f;
  const World world(std::move(grey));
  const TracedScene scene(ball(48));
  for (const char* name : {"mirror", "refraction", "diffuse", "globe", "phong"}) {
    const auto shading = make_shading(name, {world});
    const Image picture = render(scene, ball_camera(24), world, *shading, {.samples = 2});
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(picture.at(x, y)[c], 0.5f, 1e-5f) << name << " " << x << "," << y;
  }
}

// What bends nothing cannot be seen.
TEST(Render, BodyOfIndexOneIsInvisible) {
  const World world(synth_map("studio"));
  const TracedScene scene(ball(128)), empty{Scene{}};
  ShadingOptions options;
  options.eta = 1;
  const auto clear = make_shading("refraction", {world}, options);
  const Image with = render(scene, ball_camera(48), world, *clear);
  const Image without = render(empty, ball_camera(48), world, *clear);
  EXPECT_LT(relative_error(with, without), 0.02);
}

TEST(Render, TheSamePictureForAnyNumberOfThreads) {
  const World world(synth_map("studio"));
  const TracedScene scene(ball(48));
  const auto mirror = make_shading("mirror", {world});
  const auto made = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return render(scene, ball_camera(40), world, *mirror);
  };
  const Image one = made(1), four = made(4);
  EXPECT_EQ(std::memcmp(one.at(0, 0), four.at(0, 0), sizeof(float) * 4 * 40 * 40), 0);
}

TEST(Render, CoverageIsAlpha) {
  const World world(synth_map("studio"));
  const TracedScene scene(ball(96));
  const auto normals = make_shading("normals", {world});
  const Image picture = render(scene, ball_camera(64), world, *normals, {.samples = 4, .background = false});
  double area = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) area += picture.at(x, y)[3];
  // A ball of radius 1 from 4 away is a disc of radius tan(asin ¼), in a picture of tan 30° to its sides.
  const double radius = std::tan(std::asin(0.25)) / std::tan(kPi / 6) * 32;
  EXPECT_NEAR(area, kPi * radius * radius, 0.01 * area);
  EXPECT_EQ(picture.at(0, 0)[3], 0);
  EXPECT_EQ(picture.at(32, 32)[3], 1);
}

TEST(Render, CameraThatSeesAllSeesAll) {
  Scene scene = ball(24);
  scene.instances[0].to_world.origin = {30, -5, 12};
  Camera like;
  like.size = {64, 40};
  like.rotation = rotation_of({40, -20, 10});
  const PlacedCamera camera = camera_that_sees(scene, like);
  const World world(synth_map("studio"));
  const auto normals = make_shading("normals", {world});
  const Image picture = render(TracedScene(std::move(scene)), camera, world, *normals, {.background = false});
  double inside = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (x == 0 || y == 0 || x == 63 || y == 39) {
        EXPECT_EQ(picture.at(x, y)[3], 0);
      }
      inside += picture.at(x, y)[3];
    }
  }
  EXPECT_GT(inside, 250);
}

// A ball turned about its own middle is the same ball; moved aside it is where it was moved.
TEST(TracedScene, InstancesStandWhereTheyAreMoved) {
  const TracedScene still(ball(64));
  const World world(synth_map("studio"));
  const auto normals = make_shading("normals", {world});
  const Image before = render(still, ball_camera(32), world, *normals, {.background = false});
  const Image turned = render(still.moved(turned_places(still.scene(), 90)), ball_camera(32), world, *normals,
                              {.background = false});
  EXPECT_LT(relative_error(turned, before), 1e-3);
  const TracedScene aside = still.moved({{{}, {10, 0, 0}}});
  EXPECT_TRUE(aside.closest(Ray{{10, 0, -4}, {0, 0, 1}}));
  EXPECT_FALSE(aside.closest(Ray{{0, 0, -4}, {0, 0, 1}}));
  EXPECT_TRUE(still.occluded(Ray{{0, 0, -4}, {0, 0, 1}}));
  EXPECT_THROW(still.moved({}), Error);
}

// The background lies on the proxy too: from the map's centre it is the map, and what lies two below a camera
// that has moved by three is where it was on the ground.
TEST(Render, BackgroundLiesOnItsProxy) {
  Proxy ground;
  ground.shape = Proxy::Shape::ground;
  ground.radius = 100;
  ground.height = 2;
  const World world(synth_map("axes"), ground), far(synth_map("axes"));
  const TracedScene empty{Scene{}};
  const auto normals = make_shading("normals", {world});
  PlacedCamera camera = ball_camera(33);
  camera.position = {0, 0, 0};
  camera.camera.rotation = rotation_of({0, -90, 0});
  const Image at_centre = render(empty, camera, world, *normals),
              plain = render(empty, camera, far, *normals);
  // The two filters differ at the edges of letters.
  EXPECT_LT(relative_error(at_centre, plain), 0.1);
  camera.position = {3, 0, 0};
  const Image moved = render(empty, camera, world, *normals);
  const auto rgb = world.bilinear().rgb(Vec3d{3, -2, 0});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(moved.at(16, 16)[c], rgb[static_cast<std::size_t>(c)], 0.02);
}

TEST(Render, RefusesWhatMakesNoSense) {
  const World world(synth_map("studio"));
  EXPECT_THROW(make_shading("miror", {world}), Error);
  ShadingOptions options;
  options.eta = 0;
  EXPECT_THROW(make_shading("mirror", {world}, options), Error);
  const TracedScene scene(ball(8));
  const auto normals = make_shading("normals", {world});
  EXPECT_THROW(render(scene, ball_camera(8), world, *normals, {.samples = 0}), Error);
}

}  // namespace
}  // namespace welkin::scene
