#include "welkin/render/hybrid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/render/path/path_tracer.h"
#include "welkin/render/render_cases.h"

namespace welkin::scene {
namespace {

Material smooth_glass() {
  Material glass;
  glass.transmission = 1;
  glass.roughness = 0;
  return glass;
}

// A body that sees nothing but the map is what look-ups show.
TEST(Hybrid, LoneMirrorBallIsWhatLookUpsShow) {
  const World world(synth_map("studio"));
  const TracedScene scene(ball_of(smooth_metal()));
  const auto mirror = make_shading("mirror", {world});
  const Image looked_up = render(scene, ball_camera(48), world, *mirror, {.samples = 2});
  const Image traced = render_hybrid(scene, ball_camera(48), {world}, *mirror, {.samples = 2});
  EXPECT_LT(relative_error_within(traced, looked_up, 2), 1e-4);
}

/// A glowing ball above where a mirror floor may be, or its mirror image.
Scene glowing_ball(bool mirrored, bool floor) {
  Scene scene = ball(128);
  scene.materials[0].emission = {3, 2, 1};
  scene.instances[0].to_world.origin = {0, mirrored ? -1.2 : 1.2, 0};
  if (floor) {
    scene.materials.push_back(smooth_metal());
    scene.materials[1].base_color = {0.5f, 1, 1};
    scene.meshes.push_back(square_mesh(4));
    scene.meshes[1].material = 1;
    Transform large;
    large.linear = Matrix3{{{{100, 0, 0}, {0, 1, 0}, {0, 0, 100}}}};
    scene.instances.push_back({"floor", 1, large, -1});
  }
  return scene;
}

// Outlines may differ by one of a pixel's 16 rays. What a plane mirror shows is what stands behind it, times
// its colour (Schlick's F is near F₀ but at grazing angles).
TEST(Hybrid, MirrorFloorShowsWhatStandsOnIt) {
  const World dark = even_world(0);
  PlacedCamera camera = ball_camera(64);
  camera.position = {0, 0.1, -4};
  camera.camera.fov = 80;
  const auto shading = make_shading("material", {dark});
  const Image floor = render_hybrid(TracedScene(glowing_ball(false, true)), camera, {dark}, *shading);
  const Image behind = render_hybrid(TracedScene(glowing_ball(true, false)), camera, {dark}, *shading);
  double seen = 0;
  for (int y = 33; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      EXPECT_NEAR(floor.at(x, y)[1], behind.at(x, y)[1], 0.13) << x << ' ' << y;
      EXPECT_GE(floor.at(x, y)[0], 0.5f * behind.at(x, y)[0] - 0.1f);
      seen += behind.at(x, y)[1];
    }
  }
  EXPECT_GT(seen, 200);
  // Look-ups alone show nothing there.
  const Image looked_up = render(TracedScene(glowing_ball(false, true)), camera, dark, *shading);
  EXPECT_EQ(looked_up.at(32, 60)[1], 0);
}

// Rays go through a glass ball as paths do. Its middle is compared: elsewhere a pixel's cone is wide behind
// it.
TEST(Hybrid, GlassBallIsWhatPathsShow) {
  const World world(synth_map("sky"));
  const TracedScene scene(ball_of(smooth_glass()));
  const auto shading = make_shading("material", {world});
  const Image hybrid = render_hybrid(scene, ball_camera(32), {world}, *shading, {.samples = 8});
  const PathPicture paths = path_trace(scene, ball_camera(32), world, {.samples = 512});
  EXPECT_LT(relative_error_within(hybrid, paths.picture, 0.8), 0.01);
}

// Rough surfaces stay what `shading` says, whatever stands around them.
TEST(Hybrid, RoughSurfacesAreShadedByLookUps) {
  const World world(synth_map("studio"));
  Scene scene = glowing_ball(false, true);
  for (Material& material : scene.materials) material.roughness = 0.5f;
  const TracedScene traced(std::move(scene));
  const auto shading = make_shading("material", {world});
  const Image hybrid = render_hybrid(traced, ball_camera(24), {world}, *shading);
  const Image looked_up = render(traced, ball_camera(24), world, *shading);
  EXPECT_LT(relative_error_within(hybrid, looked_up, 2), 1e-6);
}

TEST(Hybrid, TheSamePictureForAnyNumberOfThreads) {
  const World world(synth_map("studio"));
  const TracedScene scene(glowing_ball(false, true));
  const auto shading = make_shading("material", {world});
  const auto made = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return render_hybrid(scene, ball_camera(40), {world}, *shading);
  };
  const Image one = made(1), four = made(4);
  EXPECT_EQ(std::memcmp(one.at(0, 0), four.at(0, 0), sizeof(float) * 4 * 40 * 40), 0);
}

TEST(Hybrid, RefusesWhatMakesNoSense) {
  const World world = even_world(1);
  const TracedScene scene(ball(8));
  const auto shading = make_shading("normals", {world});
  EXPECT_THROW(render_hybrid(scene, ball_camera(4), {world}, *shading, {.samples = 65}), Error);
  EXPECT_THROW(render_hybrid(scene, ball_camera(4), {world}, *shading, {.depth = -1}), Error);
  EXPECT_THROW(render_hybrid(scene, ball_camera(4), {world}, *shading, {.smooth = 2}), Error);
}

}  // namespace
}  // namespace welkin::scene
