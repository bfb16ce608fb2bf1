#include "welkin/render/path/path_tracer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/render/render_cases.h"
#include "welkin/scene/built_in.h"

namespace welkin::scene {
namespace {

/// Diffuse alone: an index of 1 reflects nothing.
Material lambert(float reflectance) {
  Material material;
  material.base_color = {reflectance, reflectance, reflectance};
  material.ior = 1;
  return material;
}

/// The mean of a channel over wholly covered pixels, and its standard error.
struct Mean {
  double value = 0;
  double error = 0;
};
Mean mean_of(const PathPicture& made, int channel) {
  Mean mean;
  int count = 0;
  for (int y = 0; y < made.picture.height(); ++y) {
    for (int x = 0; x < made.picture.width(); ++x) {
      if (made.picture.at(x, y)[3] < 1) continue;
      mean.value += made.picture.at(x, y)[channel];
      mean.error += std::pow(made.standard_error.at(x, y)[channel], 2);
      ++count;
    }
  }
  return {mean.value / count, std::sqrt(mean.error) / count};
}

// White surfaces in an even world can't be seen: to the requirement's 0.1 %, and what so many paths leave.
TEST(PathTracer, WhiteBallInAnEvenWorldIsInvisible) {
  const World world = even_world(1);
  for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const float metallic : {0.0f, 1.0f}) {
      Material material;
      material.roughness = roughness;
      material.metallic = metallic;
      const TracedScene scene(ball_of(material));
      PlacedCamera camera = ball_camera(32);
      camera.camera.fov = 30;
      const PathPicture made = path_trace(
          scene, camera, world, {.samples = 128, .sampling = LightSampling::bsdf, .background = false});
      const Mean mean = mean_of(made, 0);
      EXPECT_NEAR(mean.value, 1, 1e-3 + 3 * mean.error) << roughness << ' ' << metallic;
      EXPECT_LT(mean.error, 4e-3);
    }
  }
}

// Inside a closed white body that glows, each of the surfaces of a path adds its glow, and nothing is lost.
TEST(PathTracer, ClosedWhiteRoomAddsUpItsGlow) {
  const World world = even_world(0);
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    for (const float metallic : {0.0f, 1.0f}) {
      Scene room;
      room.materials.emplace_back();
      room.materials[0].roughness = roughness;
      room.materials[0].metallic = metallic;
      room.materials[0].emission = {1, 1, 1};
      room.meshes.push_back(box_mesh());
      room.instances.push_back({"room", 0, {}, -1});
      PlacedCamera camera = ball_camera(16);
      camera.position = {0.3, -0.2, 0.1};
      const Mean mean =
          mean_of(path_trace(TracedScene(std::move(room)), camera, world, {.samples = 64, .depth = 5}), 0);
      EXPECT_LT(mean.error, 0.08);
      EXPECT_NEAR(mean.value, 6, 6e-3 + 3 * mean.error)
          << "roughness " << roughness << " metallic " << metallic;
    }
  }
}

/// A ball on a floor.
Scene ball_on_floor(float roughness, float metallic) {
  Scene scene = ball_of({});
  scene.materials[0].roughness = roughness;
  scene.materials[0].metallic = metallic;
  scene.materials[0].base_color = {0.9f, 0.6f, 0.3f};
  scene.materials.push_back(lambert(0.5f));
  scene.meshes.push_back(square_mesh());
  scene.meshes[1].material = 1;
  Transform lower;
  lower.linear = Matrix3{{{{3, 0, 0}, {0, 1, 0}, {0, 0, 3}}}};
  lower.origin = {0, -1, 0};
  scene.instances.push_back({"floor", 1, lower, -1});
  return scene;
}

TEST(PathTracer, AllSamplingsHaveOneMean) {
  const World world(synth_map("studio"));
  for (const float metallic : {0.0f, 1.0f}) {
    const TracedScene scene(ball_on_floor(0.4f, metallic));
    Mean means[3];
    for (const LightSampling sampling : {LightSampling::mis, LightSampling::bsdf, LightSampling::light})
      means[static_cast<std::size_t>(sampling)] = mean_of(
          path_trace(scene, ball_camera(24), world, {.samples = 128, .depth = 3, .sampling = sampling}), 0);
    for (int i = 1; i < 3; ++i)
      EXPECT_NEAR(means[i].value, means[0].value, 4 * std::hypot(means[i].error, means[0].error)) << i;
    // Both together are no worse than either.
    EXPECT_LT(means[0].error, 1.1 * std::min(means[1].error, means[2].error));
    EXPECT_LT(means[0].error, 0.02 * means[0].value);
  }
}

// A small square that glows above a floor: its irradiance is a formula, and every sampling finds it.
TEST(PathTracer, SurfacesThatGlowShineByTheirFormula) {
  Scene scene;
  scene.materials.push_back(lambert(0.5f));
  scene.materials.push_back(lambert(0));
  scene.materials[1].emission = {8, 8, 8};
  scene.meshes.push_back(square_mesh());
  Transform above;
  above.linear = Matrix3{{{{0.2, 0, 0}, {0, -1, 0}, {0, 0, 0.2}}}};
  above.origin = {0, 1, 0};
  scene.instances.push_back({"floor", 0, {}, -1});
  scene.instances.push_back({"lamp", 0, above, 1});
  const TracedScene traced(std::move(scene));
  PlacedCamera camera;
  camera.camera.fov = 0.5;
  camera.camera.size = {8, 8};
  camera.camera.rotation = rotation_of({0, -90, 0});
  camera.position = {0, 0.5, 0};
  // Four quarters, each with a corner above the place (Siegel & Howell 1992, configuration C-11).
  const double a = 0.2, r = std::sqrt(1 + a * a), form = 4 / (2 * kPi) * 2 * a / r * std::atan(a / r);
  for (const LightSampling sampling : {LightSampling::mis, LightSampling::bsdf, LightSampling::light}) {
    const Mean mean = mean_of(
        path_trace(traced, camera, even_world(0), {.samples = 256, .depth = 1, .sampling = sampling}), 0);
    EXPECT_NEAR(mean.value, 8 * 0.5 * form, 4 * mean.error + 1e-4) << name_of(sampling);
    EXPECT_LT(mean.error, sampling == LightSampling::bsdf ? 0.02 : 0.002) << name_of(sampling);
  }
}

// By brightness alone, places beside the lamp would need many more paths: it is left out.
TEST(PathTracer, TheLampOfARoomIsFoundByChanceToo) {
  const TracedScene scene(built_in("room", {.triangles = 3000}));
  const World dark = even_world(0);
  PlacedCamera camera = ball_camera(16);
  const SceneCamera& own = scene.scene().cameras.at(0);
  camera.camera.rotation = own.rotation;
  camera.position = own.position;
  const auto made = [&](LightSampling sampling) {
    return mean_of(path_trace(scene, camera, dark, {.samples = 256, .depth = 2, .sampling = sampling}), 0);
  };
  const Mean both = made(LightSampling::mis), chance = made(LightSampling::bsdf);
  EXPECT_NEAR(chance.value, both.value, 4 * std::hypot(chance.error, both.error));
  EXPECT_LT(both.error, 0.75 * chance.error);
}

// Near the outline a pixel's cone is no small part of the world: four fifths of the radius are
// compared, beyond what the paths leave.
TEST(PathTracer, MirrorBallIsWhatLookUpsShow) {
  const World world(synth_map("studio", 512));
  const TracedScene scene(ball_of(smooth_metal()));
  const PlacedCamera camera = ball_camera(48);
  const auto mirror = make_shading("mirror", {world});
  const Image looked_up = render(scene, camera, world, *mirror, {.samples = 16});
  const PathPicture traced = path_trace(scene, camera, world, {.samples = 1024});
  Image apart(48, 48, 4);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x)
      for (int c = 0; c < 3; ++c)
        apart.at(x, y)[c] = traced.picture.at(x, y)[c] + traced.standard_error.at(x, y)[c];
  const double noise = relative_error_within(apart, traced.picture, 0.8);
  const double error = relative_error_within(looked_up, traced.picture, 0.8);
  EXPECT_LT(noise, 0.005);
  EXPECT_LT(std::sqrt(std::max(0.0, error * error - noise * noise)), 0.005);
}

TEST(PathTracer, DiffuseBallIsWhatLookUpsShow) {
  const World world(synth_map("sky"));
  const TracedScene scene(ball_of(lambert(0.8f)));
  const PlacedCamera camera = ball_camera(24);
  const auto diffuse = make_shading("diffuse", {world});
  const Image looked_up = render(scene, camera, world, *diffuse, {.background = false});
  const PathPicture traced = path_trace(scene, camera, world, {.samples = 256, .background = false});
  double deviations = 0;
  int count = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      if (traced.picture.at(x, y)[3] < 1) continue;
      const double apart = looked_up.at(x, y)[0] - traced.picture.at(x, y)[0];
      deviations += std::pow(apart / traced.standard_error.at(x, y)[0], 2);
      ++count;
    }
  }
  // Of Student's distribution with 15 degrees of freedom the mean square is 15/13; over 150 pixels it spreads
  // by 0.16.
  EXPECT_LT(deviations / count, 15.0 / 13 + 0.5);
}

// The spread of the pictures of many seeds is what one of them says it is. 63 of 64 degrees of freedom a
// pixel, over 300 values.
TEST(PathTracer, StandardErrorsAreHonest) {
  const World world(synth_map("studio"));
  const TracedScene scene(ball_on_floor(0.4f, 0));
  constexpr int kSize = 12, kSeeds = 64;
  Image sum(kSize, kSize, 4), squares(kSize, kSize, 4), said(kSize, kSize, 4);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const PathPicture made =
        path_trace(scene, ball_camera(kSize), world,
                   {.samples = 16, .depth = 2, .seed = static_cast<std::uint64_t>(seed)});
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        sum.at(x, y)[1] += made.picture.at(x, y)[1];
        squares.at(x, y)[1] += made.picture.at(x, y)[1] * made.picture.at(x, y)[1];
        said.at(x, y)[1] += made.standard_error.at(x, y)[1] * made.standard_error.at(x, y)[1];
      }
    }
  }
  double ratio = 0;
  int count = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double mean = sum.at(x, y)[1] / kSeeds;
      const double variance = (squares.at(x, y)[1] / kSeeds - mean * mean) * kSeeds / (kSeeds - 1);
      if (said.at(x, y)[1] <= 1e-12) continue;
      ratio += variance / (said.at(x, y)[1] / kSeeds);
      ++count;
    }
  }
  ASSERT_GT(count, 50);
  EXPECT_NEAR(ratio / count, 1, 0.1);
}

TEST(PathTracer, GlassBallInAnEvenWorldIsInvisible) {
  const World world = even_world(1);
  Material glass;
  glass.transmission = 1;
  glass.roughness = 0;
  const PathPicture clear =
      path_trace(TracedScene(ball_of(glass)), ball_camera(16), world, {.samples = 128, .background = false});
  EXPECT_NEAR(mean_of(clear, 0).value, 1, 2e-3);
  // What rough boundaries scatter more than once is lost, and only that.
  glass.roughness = 0.5f;
  const PathPicture rough =
      path_trace(TracedScene(ball_of(glass)), ball_camera(16), world, {.samples = 128, .background = false});
  EXPECT_GT(mean_of(rough, 0).value, 0.75);
  EXPECT_LT(mean_of(rough, 0).value, 1);
}

// A pane of an index of 1 bends nothing, and takes its colour's root at each of two boundaries.
TEST(PathTracer, BodyOfIndexOneTakesItsColour) {
  const World world = even_world(1);
  Material pane;
  pane.transmission = 1;
  pane.ior = 1;
  pane.roughness = 0.3f;
  pane.base_color = {1, 0.5f, 0.25f};
  const PathPicture made =
      path_trace(TracedScene(ball_of(pane)), ball_camera(16), world, {.samples = 16, .background = false});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(mean_of(made, c).value, pane.base_color[static_cast<std::size_t>(c)], 1e-4);
}

TEST(PathTracer, LampsShineByTheirDistanceAndAngle) {
  const World dark = even_world(0);
  const auto seen = [&](const PointLight& lamp, bool hidden) {
    Scene scene;
    scene.materials.push_back(lambert(0.5f));
    scene.meshes.push_back(square_mesh());
    scene.instances.push_back({"floor", 0, {}, -1});
    if (hidden) {
      Transform above;
      above.origin = {0, 0.5, 0};
      scene.instances.push_back({"lid", 0, above, -1});
    }
    scene.lights.push_back(lamp);
    PlacedCamera camera;
    camera.camera.fov = 0.1;
    camera.camera.size = {1, 1};
    camera.camera.rotation = rotation_of({0, -90, 0});
    camera.position = {0, 0.4, 0};
    return path_trace(TracedScene(std::move(scene)), camera, dark, {.samples = 4, .depth = 1})
        .picture.at(0, 0)[0];
  };
  PointLight lamp;
  lamp.position = {1, 2, 0};
  lamp.intensity = {10, 10, 10};
  const double cosine = 2 / std::sqrt(5.0), radiance = 10 * cosine / 5 * 0.5 / kPi;
  EXPECT_NEAR(seen(lamp, false), radiance, 1e-4);
  EXPECT_EQ(seen(lamp, true), 0);
  lamp.kind = PointLight::Kind::directional;
  lamp.direction = normalize(Vec3d{-1, -2, 0});
  EXPECT_NEAR(seen(lamp, false), 10 * cosine * 0.5 / kPi, 1e-4);
  EXPECT_EQ(seen(lamp, true), 0);
  lamp.kind = PointLight::Kind::spot;
  lamp.inner_cone = 0.1;
  lamp.outer_cone = 0.2;
  EXPECT_NEAR(seen(lamp, false), radiance, 1e-4);
  lamp.direction = {0, -1, 0};
  EXPECT_EQ(seen(lamp, false), 0);
}

TEST(PathTracer, CoverageIsAlpha) {
  Material veil = lambert(0);
  veil.emission = {1, 1, 1};
  veil.alpha = 0.25f;
  veil.blended = true;
  Scene scene;
  scene.materials.push_back(veil);
  scene.meshes.push_back(square_mesh());
  Transform upright;
  upright.linear = rotation_from_yaw_pitch_roll(0, 90, 0);
  scene.instances.push_back({"veil", 0, upright, -1});
  PlacedCamera camera = ball_camera(4);
  camera.camera.fov = 10;
  const TracedScene traced(std::move(scene));
  const Image alone =
      path_trace(traced, camera, even_world(3), {.samples = 1024, .background = false}).picture;
  const Image shown = path_trace(traced, camera, even_world(3), {.samples = 1024}).picture;
  EXPECT_NEAR(alone.at(1, 1)[3], 0.25, 0.01);
  EXPECT_NEAR(alone.at(1, 1)[0], 0.25, 0.01);
  EXPECT_NEAR(shown.at(1, 1)[0], 0.25 + 0.75 * 3, 0.03);
  EXPECT_EQ(shown.at(1, 1)[3], 1);
}

TEST(PathTracer, TheSamePictureForAnyNumberOfThreads) {
  const World world(synth_map("studio"));
  const TracedScene scene(ball_on_floor(0.3f, 0));
  const auto made = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return path_trace(scene, ball_camera(20), world, {.samples = 6});
  };
  const PathPicture one = made(1), four = made(4);
  EXPECT_EQ(std::memcmp(one.picture.at(0, 0), four.picture.at(0, 0), sizeof(float) * 4 * 20 * 20), 0);
  EXPECT_EQ(
      std::memcmp(one.standard_error.at(0, 0), four.standard_error.at(0, 0), sizeof(float) * 4 * 20 * 20), 0);
}

TEST(PathTracer, RefusesWhatMakesNoSense) {
  const World world = even_world(1);
  const TracedScene scene(ball(8));
  EXPECT_THROW(path_trace(scene, ball_camera(4), world, {.samples = 0}), Error);
  EXPECT_THROW(path_trace(scene, ball_camera(4), world, {.depth = -1}), Error);
  EXPECT_THROW(path_trace(scene, ball_camera(4), world, {.clamp = -1}), Error);
  EXPECT_THROW(light_sampling_from_name("mist"), Error);
  EXPECT_EQ(light_sampling_from_name("light"), LightSampling::light);
  EXPECT_EQ(name_of(LightSampling::bsdf), "bsdf");
  Proxy near;
  near.shape = Proxy::Shape::sphere;
  const World close(synth_map("studio"), near);
  EXPECT_THROW(path_trace(scene, ball_camera(4), close, {.samples = 1, .sampling = LightSampling::light}),
               Error);
  EXPECT_NO_THROW(path_trace(scene, ball_camera(4), close, {.samples = 1}));
}

}  // namespace
}  // namespace welkin::scene
