#include "welkin/render/probes/probe_grid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/render/probes/probe_light.h"
#include "welkin/render/probes/rtxgi_probes.h"
#include "welkin/render/project/project_cases.h"

namespace welkin::scene {
namespace {

const Bounds kRoom{{-2, -1.5, -3}, {2, 1.5, 3}};

ProbeGridOptions small_probes() {
  ProbeGridOptions options;
  options.size = 16;
  options.samples = 2;
  options.roughness = {0.5};
  return options;
}

/// Diffuse light at a place from a projection of its own.
Rgb direct_diffuse(const ShadedScene& seen, const Vec3d& place, const Vec3d& normal) {
  const auto p = sphere::AnyParameterization::make("octahedral");
  const Map light = project(seen, place, MapFrame(p, {32, 32}), {.samples = 4});
  const auto levels = prefilter_map(light, p, {{{32, 32}, lobe::AnyLobe::make("lambert")}});
  return Sampler::borrow(levels[0]).rgb(normal);
}

double relative_difference(const Rgb& a, const Rgb& b) {
  double difference = 0, size = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    difference += (a[c] - b[c]) * (a[c] - b[c]);
    size += b[c] * b[c];
  }
  return std::sqrt(difference / size);
}

// A tile is the projection of its place, border and all.
TEST(ProbeGrid, TilesAreProjections) {
  const TracedScene scene(furnished_room());
  const EmissionShading glow;
  const World world(synth_map("studio", 64));
  const ProbeBox probes{{{-3, -2, -4}, {3, 2.5, 4}}, {3, 2, 2}};
  ProbeGridOptions options = small_probes();
  options.border = 2;
  const ProbeGrid grid = project_grid({scene, glow, &world}, probes, options);
  const ProbeAtlas& atlas = *grid.atlas("radiance");
  ASSERT_EQ(atlas.image.width(), 3 * 20);
  ASSERT_EQ(atlas.image.height(), 2 * 2 * 20);
  for (int y = 0; y < 2; ++y) {
    for (int z = 0; z < 2; ++z) {
      for (int x = 0; x < 3; ++x) {
        const Map one = project({scene, glow, &world}, probes.position(x, y, z),
                                MapFrame(sphere::AnyParameterization::make("octahedral"), {16, 16}),
                                {.samples = 2, .shade_once = true});
        for (int row = -2; row < 18; ++row)
          ASSERT_EQ(std::memcmp(one.level.chart(0).at(-2, row),
                                atlas.image.at(x * 20, (z + 2 * y) * 20 + row + 2), 20 * 3 * sizeof(float)),
                    0);
      }
    }
  }
}

TEST(ProbeGrid, AConstantWorldIsConstant) {
  Scene room;
  add_lamp(room, {0, 0, 0}, 20, 0.7f, 24);
  const TracedScene scene(std::move(room));
  const ProbeGrid grid = project_grid({scene, EmissionShading()}, {kRoom, {2, 2, 2}}, small_probes());
  for (const char* name : {"radiance", "diffuse", "specular-0.5"}) {
    const ProbeAtlas& atlas = *grid.atlas(name);
    for (int y = 0; y < atlas.image.height(); ++y)
      for (int i = 0; i < 3 * atlas.image.width(); ++i)
        ASSERT_NEAR(atlas.image.at(0, y)[i], 0.7f, 1e-4) << name;
  }
}

// At a probe a look-up is that probe, whose tile of 8² is read between texels: 2 %. Half-way between probes
// light that changes slowly is their mean.
TEST(ProbeGrid, LookUpsAgreeWithBakesOfTheirOwn) {
  const TracedScene scene(furnished_room());
  const EmissionShading glow;
  const ShadedScene seen{scene, glow};
  const ProbeBox probes{kRoom, {4, 4, 6}};
  const ProbeGrid grid = project_grid(seen, probes, small_probes());
  const ProbeLight light(grid, {.normal_bias = 0});
  for (const Vec3d& normal : {Vec3d{0, 1, 0}, Vec3d{0.6, 0, 0.8}, Vec3d{0, -0.8, -0.6}}) {
    const Vec3d at = probes.position(1, 2, 3), next = probes.position(2, 2, 3);
    EXPECT_LT(relative_difference(light.diffuse(at, normal), direct_diffuse(seen, at, normal)), 0.02);
    const Vec3d middle = 0.5 * (at + next);
    EXPECT_LT(relative_difference(light.diffuse(middle, normal), direct_diffuse(seen, middle, normal)), 0.05);
    // Rough reflections lie between sharp and rougher ones.
    const Rgb rough = light.specular(at, normal, normal, 0.5), sharp = light.specular(at, normal, normal, 0);
    const Rgb mixed = light.specular(at, normal, normal, 0.25);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(mixed[c], 0.5f * (rough[c] + sharp[c]), 1e-5);
  }
}

TEST(ProbeGrid, WeightsAddUpAndClampAtTheBox) {
  const TracedScene scene(furnished_room());
  const ProbeGrid grid = project_grid({scene, EmissionShading()}, {kRoom, {2, 1, 3}}, small_probes());
  const ProbeLight light(grid);
  for (const Vec3d& place : {Vec3d{0, 0, 0}, Vec3d{9, 9, 9}, Vec3d{-2, 1, 0.3}, Vec3d{-100, 0, 3}}) {
    double sum = 0;
    for (const ProbeWeight& each : light.weights(place, {0, 1, 0})) {
      EXPECT_GE(each.weight, 0);
      EXPECT_GE(each.index, 0);
      EXPECT_LT(each.index, 6);
      sum += each.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

/// Two rooms of 2×2×2 beside each other; one gives off 1, the other nothing. The wall between them is 0.2
/// thick.
Scene two_rooms() {
  Scene scene;
  for (const float light : {1.0f, 0.0f}) {
    scene.materials.emplace_back();
    scene.materials.back().emission = {light, light, light};
    Mesh room = inside_out(box_mesh());
    room.material = static_cast<int>(scene.materials.size()) - 1;
    scene.meshes.push_back(std::move(room));
  }
  scene.instances.push_back({"bright", 0, scaled({1, 1, 1}, {-1.1, 0, 0}), -1});
  scene.instances.push_back({"dark", 1, scaled({1, 1, 1}, {1.1, 0, 0}), -1});
  return scene;
}

// Behind a wall a probe isn't seen, and its light doesn't leak.
TEST(ProbeGrid, LightDoesNotLeakThroughWalls) {
  const TracedScene scene(two_rooms());
  const ProbeBox probes{{{-2.2, -1, -1}, {2.2, 1, 1}}, {4, 2, 2}};
  const ProbeGrid grid = project_grid({scene, EmissionShading()}, probes, small_probes());
  EXPECT_EQ(grid.inside_count(), 0);
  // On the dark side of the wall, facing into the dark room.
  const Vec3d place{0.12, 0.1, 0.1}, normal{1, 0, 0};
  const ProbeLight plain(grid, {.visibility = false, .facing = false});
  const ProbeLight careful(grid);
  EXPECT_GT(plain.diffuse(place, normal)[0], 0.2f);
  EXPECT_LT(careful.diffuse(place, normal)[0], 0.02f);
  // On the bright side it is not darkened.
  EXPECT_GT(careful.diffuse({-0.12, 0.1, 0.1}, {-1, 0, 0})[0], 0.98f);
}

TEST(ProbeGrid, ProbesInsideBodiesAreFound) {
  Scene scene = furnished_room();
  const TracedScene traced(std::move(scene));
  // The first stands in the red box, whose bottom lies in the floor, about (−1.2, −1, −1.5).
  const ProbeBox probes{{{-1.8, -1.3, -2.1}, {1.8, -0.7, -0.9}}, {3, 1, 1}};
  const ProbeGrid grid = project_grid({traced, EmissionShading()}, probes, small_probes());
  EXPECT_TRUE(grid.inside(0));
  // Of the rays downwards, which meet the floor and the box's bottom at one distance, either may be told.
  EXPECT_GT(grid.behind[0], 0.75f);
  EXPECT_FALSE(grid.inside(1));
  EXPECT_EQ(grid.inside_count(), 1);
  EXPECT_NE(probe_grid_json(grid, {"a", "b", "c", "d"}).find("\"inside\": [0]"), std::string::npos);
  const auto weights = ProbeLight(grid).weights(probes.position(0, 0, 0) + Vec3d{0.2, 0, 0}, {0, 1, 0});
  for (const ProbeWeight& each : weights) EXPECT_TRUE(each.index != 0 || each.weight == 0);
}

// Moments of a ball's inside: its radius, and no variance.
TEST(ProbeGrid, DepthsAreMoments) {
  Scene around;
  add_lamp(around, {0, 0, 0}, 5, 1, 96);
  ProbeGridOptions options = small_probes();
  options.farthest = 100;
  const ProbeGrid grid = project_grid({TracedScene(std::move(around)), EmissionShading()},
                                      {{{-1, -1, -1}, {1, 1, 1}}, {1, 1, 1}}, options);
  const ProbeAtlas& depth = *grid.atlas("depth");
  for (int y = 0; y < depth.image.height(); ++y) {
    for (int x = 0; x < depth.image.width(); ++x) {
      ASSERT_NEAR(depth.image.at(x, y)[0], 5, 0.01);
      ASSERT_GE(depth.image.at(x, y)[1], depth.image.at(x, y)[0] * depth.image.at(x, y)[0]);
      ASSERT_NEAR(depth.image.at(x, y)[1], 25, 0.05);
    }
  }
}

// Looked up by the formulas of RTXGI's shaders, its textures give our irradiance and distances.
TEST(ProbeGrid, RtxgiReadsItsTextures) {
  const TracedScene scene(furnished_room());
  const ProbeBox probes{kRoom, {3, 2, 4}};
  const ProbeGrid grid = project_grid({scene, EmissionShading()}, probes, rtxgi_options());
  const auto textures = rtxgi_textures(grid);
  ASSERT_EQ(textures.size(), 3u);
  const ProbeLight light(grid, {.visibility = false, .facing = false, .normal_bias = 0});
  const int counts[3] = {3, 2, 4};
  for (const Vec3d& d :
       {Vec3d{0.3, 0.9, -0.2}, Vec3d{-0.5, -0.1, 0.8}, Vec3d{0.2, -0.7, -0.6}, Vec3d{-1, 0, 0}}) {
    const Vec3d n = normalize(d);
    for (int probe = 0; probe < 24; ++probe) {
      // DDGIGetProbeCoords, DDGIGetProbeTexelCoords, DDGIGetOctahedralCoordinates, DDGIGetProbeUV.
      const int px = probe % counts[0], py = probe / (counts[0] * counts[2]),
                pz = probe / counts[0] % counts[2];
      const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
      double s = n.x / sum, t = n.y / sum;
      if (n.z < 0) {
        const double other = (1 - std::abs(t)) * (s < 0 ? -1 : 1);
        t = (1 - std::abs(s)) * (t < 0 ? -1 : 1);
        s = other;
      }
      const auto read = [&](const RtxgiTexture& texture, int interior, int channel) {
        const double texels = interior + 2;
        const double x = px * texels + texels / 2 + s * interior / 2 - 0.5,
                     y = pz * texels + texels / 2 + t * interior / 2 - 0.5;
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        const int slice = py * counts[2] * (interior + 2);
        const auto at = [&](int a, int b) {
          return static_cast<double>(texture.image.at(a, slice + b)[channel]);
        };
        return (1 - (y - j)) * ((1 - (x - i)) * at(i, j) + (x - i) * at(i + 1, j)) +
               (y - j) * ((1 - (x - i)) * at(i, j + 1) + (x - i) * at(i + 1, j + 1));
      };
      const Rgb wanted = light.diffuse(probes.position(px, py, pz), n);
      for (std::size_t c = 0; c < 3; ++c) {
        const double root = std::pow(read(textures[0], 6, static_cast<int>(c)), 2.5);
        // Interpolated in another curve: a few per cent where tiles of 6² change.
        EXPECT_NEAR(2 * kPi * root * root / (kPi * wanted[c]), 1, 0.04);
      }
      const ProbeWeight whole{grid.probes.index(px, py, pz), 1};
      float moments[2];
      light.look_up(*grid.atlas("depth"), {&whole, 1}, n, moments);
      EXPECT_NEAR(2 * read(textures[1], 14, 0), moments[0], 1e-4);
      EXPECT_NEAR(2 * read(textures[1], 14, 1), moments[1], 1e-3);
    }
  }
  EXPECT_EQ(textures[2].image.width(), 3);
  EXPECT_EQ(textures[2].image.height(), 8);
}

TEST(ProbeGrid, TheSameForAnyNumberOfThreads) {
  const TracedScene scene(furnished_room());
  const auto made = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return project_grid({scene, EmissionShading()}, {kRoom, {2, 2, 3}}, small_probes());
  };
  const ProbeGrid one = made(1), four = made(4);
  for (std::size_t i = 0; i < one.atlases.size(); ++i) {
    const Image &a = one.atlases[i].image, &b = four.atlases[i].image;
    for (int y = 0; y < a.height(); ++y)
      ASSERT_EQ(std::memcmp(a.at(0, y), b.at(0, y),
                            sizeof(float) * static_cast<std::size_t>(a.width() * a.channels())),
                0);
  }
}

TEST(ProbeGrid, RefusesWhatMakesNoSense) {
  const TracedScene scene(ball(8));
  const EmissionShading glow;
  const auto kind_of = [&](const ProbeBox& probes, const ProbeGridOptions& options) {
    try {
      project_grid({scene, glow}, probes, options);
    } catch (const Error& error) {
      return error.kind();
    }
    ADD_FAILURE() << "taken";
    return ErrorKind::system;
  };
  const Bounds unit{{-1, -1, -1}, {1, 1, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(kind_of({unit, {0, 1, 1}}, {}), ErrorKind::bad_request);
  EXPECT_EQ(kind_of({unit, {-1, -1, 1}}, {}), ErrorKind::bad_request);
  EXPECT_EQ(kind_of({unit, {100000, 100000, 100000}}, {}), ErrorKind::too_large);
  EXPECT_EQ(kind_of({unit, {1, 1000, 1000}}, {}), ErrorKind::too_large);
  EXPECT_EQ(kind_of({{{-1, 0, -1}, {1, 0, 1}}, {2, 2, 2}}, {}), ErrorKind::bad_request);
  EXPECT_EQ(kind_of({{{-1, nan, -1}, {1, 1, 1}}, {1, 1, 1}}, {}), ErrorKind::bad_request);
  for (const auto& change : std::initializer_list<void (*)(ProbeGridOptions&)>{
           [](ProbeGridOptions& o) { o.size = 2; }, [](ProbeGridOptions& o) { o.border = 5; },
           [](ProbeGridOptions& o) { o.border = 0; }, [](ProbeGridOptions& o) { o.samples = 0; },
           [](ProbeGridOptions& o) {
             o.roughness = {0.5, 0.5};
           },
           [](ProbeGridOptions& o) { o.roughness = {2}; }, [](ProbeGridOptions& o) { o.depth_exponent = 0; },
           [](ProbeGridOptions& o) { o.farthest = -1; }}) {
    ProbeGridOptions options;
    change(options);
    EXPECT_EQ(kind_of({unit, {1, 1, 1}}, options), ErrorKind::bad_request);
  }
  EXPECT_THROW(probes_in(Scene{}, {1, 1, 1}), Error);
  // Another octahedron is not RTXGI's.
  EXPECT_THROW(rtxgi_textures(project_grid({scene, glow}, {unit, {1, 1, 1}})), Error);
}

}  // namespace
}  // namespace welkin::scene
