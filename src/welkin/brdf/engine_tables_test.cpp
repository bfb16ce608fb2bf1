#include "welkin/brdf/engine_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/brdf/dfg_reference.h"

namespace welkin::brdf {
namespace {

/// What a texture unit returns at (u, v), with linear filtering and clamping.
double look_up(const Image& image, double u, double v, int channel) {
  const auto at = [&](int x, int y) {
    return static_cast<double>(
        image.at(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1))[channel]);
  };
  const double x = u * image.width() - 0.5, y = v * image.height() - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double s = x - x0, t = y - y0;
  return (1 - t) * ((1 - s) * at(x0, y0) + s * at(x0 + 1, y0)) +
         t * ((1 - s) * at(x0, y0 + 1) + s * at(x0 + 1, y0 + 1));
}

SplitSum integral(double nv, double roughness) {
  const double alpha = roughness * roughness;
  return test::ggx_by_half_vectors(nv, alpha,
                                   [&](double nl) { return ggx_visibility_correlated(nl, nv, alpha); });
}

/// Each renderer's shader, with its own look-up, must find the integral: to what interpolation between texels
/// costs, which is less where there are more of them.
struct Shader {
  const char* engine;
  double tolerance;
  SplitSum (*read)(const Image& table, double nv, double roughness);
};

const Shader kShaders[] = {{"filament", 2e-4,
                            [](const Image& t, double nv, double r) {
                              return SplitSum{look_up(t, nv, r, 1), look_up(t, nv, r, 0)};
                            }},
                           {"babylon", 1e-4,
                            [](const Image& t, double nv, double r) {
                              return SplitSum{look_up(t, nv, r, 1), look_up(t, nv, r, 0)};
                            }},
                           {"bevy", 1e-3,
                            [](const Image& t, double nv, double r) {
                              const double bias = look_up(t, nv, r, 1);
                              return SplitSum{look_up(t, nv, r, 0) + bias, bias};
                            }},
                           {"three.js", 1e-2,
                            [](const Image& t, double nv, double r) {
                              const double bias = look_up(t, r, nv, 1);
                              return SplitSum{look_up(t, r, nv, 0) + bias, bias};
                            }},
                           {"unity-hdrp", 1e-3, [](const Image& t, double nv, double r) {
                              const auto remap = [&](double x) {
                                return (x * (t.width() - 1) + 0.5) / t.width();
                              };
                              return SplitSum{look_up(t, remap(std::sqrt(nv)), remap(r), 1),
                                              look_up(t, remap(std::sqrt(nv)), remap(r), 0)};
                            }}};

TEST(EngineTables, GiveEachShaderTheIntegral) {
  for (const Shader& shader : kShaders) {
    const Image table = make_dfg_table(engine_table(shader.engine).table);
    for (const double nv : {0.11, 0.37, 0.62, 0.93}) {
      for (const double roughness : {0.23, 0.48, 0.81}) {
        const SplitSum found = shader.read(table, nv, roughness), wanted = integral(nv, roughness);
        EXPECT_NEAR(found.one, wanted.one, shader.tolerance)
            << shader.engine << " " << nv << " " << roughness;
        EXPECT_NEAR(found.fc, wanted.fc, shader.tolerance) << shader.engine << " " << nv << " " << roughness;
      }
    }
  }
}

TEST(EngineTables, HoldTheIntegralsExactlyAtTheirTexels) {
  const Image filament = make_dfg_table(engine_table("filament").table);
  const SplitSum at = integral(20.5 / 128, 100.5 / 128);
  EXPECT_NEAR(filament.at(20, 100)[0], at.fc, 2e-6);
  EXPECT_NEAR(filament.at(20, 100)[1], at.one, 2e-6);
  const Image three = make_dfg_table(engine_table("three.js").table);
  const SplitSum there = integral(3.5 / 16, 9.5 / 16);
  EXPECT_NEAR(three.at(9, 3)[0], there.scale(), 2e-6);
  EXPECT_NEAR(three.at(9, 3)[1], there.bias(), 2e-6);
  const Image unity = make_dfg_table(engine_table("unity-hdrp").table);
  const Image unreal = make_dfg_table(engine_table("unreal").table);
  const double nv = 30.5 / 128, alpha = 0.390625 * 0.390625;  // row 12 of 32
  const SplitSum rootless = test::ggx_by_half_vectors(
      nv, alpha, [&](double nl) { return ggx_visibility_approximate(nl, nv, alpha); });
  EXPECT_NEAR(unreal.at(30, 12)[0], rootless.scale(), 2e-6);
  EXPECT_NEAR(unreal.at(30, 12)[1], rootless.bias(), 2e-6);
  const SplitSum corner = integral(1, 1);
  EXPECT_NEAR(unity.at(63, 63)[1], corner.one, 2e-6);
  EXPECT_NEAR(unity.at(63, 63)[2], disney_diffuse_albedo(1, 1) - 0.5, 1e-6);
}

/// A few texels of the table that three.js 0.187 ships, 4096 samples each in half floats, agree to their own
/// noise.
TEST(EngineTables, AgreeWithThreeJsOwn) {
  const Image table = make_dfg_table(engine_table("three.js").table);
  const struct {
    int x, y;
    double scale, bias;
  } own[] = {{8, 8, 0.82178, 0.01651}, {15, 0, 0.85986, 0.03903}, {3, 12, 0.99658, 0.00075}};
  for (const auto& texel : own) {
    EXPECT_NEAR(table.at(texel.x, texel.y)[0], texel.scale, 5e-3) << texel.x << " " << texel.y;
    EXPECT_NEAR(table.at(texel.x, texel.y)[1], texel.bias, 5e-3) << texel.x << " " << texel.y;
  }
}

TEST(EngineTables, AreSortedAndComplete) {
  const auto& all = engine_tables();
  EXPECT_TRUE(
      std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; }));
  for (const EngineTable& each : all) {
    EXPECT_EQ(engine_table(each.name).name, each.name);
    EXPECT_FALSE(each.description.empty() || each.source.empty() || each.type.empty());
    EXPECT_FALSE(each.table.channels.empty());
  }
  EXPECT_THROW(engine_table("filment"), Error);
}

}  // namespace
}  // namespace welkin::brdf
