#include "welkin/prefilter/view_bake.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/prefilter/view_reference.h"
#include "welkin/prefilter/view_stack.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

Map lat_long(const std::string& name, int width = 128) {
  return render(synth::make(name), sphere::AnyParameterization::make("latlong"), width, width / 2);
}

ViewBakeOptions small(int views, int levels) {
  ViewBakeOptions options;
  options.view_cosines = default_view_cosines(views);
  options.bake.size = {32, 32};
  options.bake.levels = levels;
  return options;
}

/// Every value of every level.
template <class Use>
void each_value(const ViewChains& stack, const Use& use) {
  for (const Chain& chain : stack.views) {
    for (const Map& map : chain.levels) {
      for (int chart = 0; chart < map.charts(); ++chart) {
        for (int y = 0; y < map.height(); ++y) {
          for (int i = 0; i < map.width() * map.channels(); ++i) use(map.level.chart(chart).row(y)[i]);
        }
      }
    }
  }
}

TEST(ViewBake, AConstantMapStaysConstant) {
  Map map(sphere::AnyParameterization::make("latlong"), 64, 32, 3);
  for (int y = 0; y < 32; ++y) std::fill_n(map.level.chart(0).row(y), 64 * 3, 0.75f);
  fill_borders(map);
  for (const brdf::LobeAxis axis : {brdf::LobeAxis::reflected, brdf::LobeAxis::fitted}) {
    ViewBakeOptions options = small(4, 5);
    options.axis = axis;
    int count = 0;
    float farthest = 0;
    // As PrefilterPlan keeps a constant: verify_test has that law.
    each_value(bake_views(map, options), [&](float value) {
      farthest = std::max(farthest, std::fabs(value - 0.75f));
      ++count;
    });
    EXPECT_LE(farthest, 2e-5f);
    EXPECT_GT(count, 4 * 6 * 32 * 32 * 3);
  }
}

/// One plan for all angles gives what each lobe gives alone.
TEST(ViewBake, SharedAnalysisChangesNothing) {
  const Map map = lat_long("studio");
  const ViewBakeOptions options = small(3, 4);
  const ViewBakePlan plan({map.parameterization, {map.width(), map.height()}, map.channels()}, options);
  const ViewChains stack = plan.run(map);
  for (std::size_t view = 0; view < 3; ++view) {
    for (std::size_t level = 0; level < 4; ++level) {
      const ChartSize size = chain_size({32, 32}, static_cast<int>(level));
      const Map alone =
          std::move(prefilter_map(map, options.bake.target, {{size, plan.lobe_of(view, level)}}).front());
      const Map& shared = stack.views[view].levels[level];
      double error = 0, whole = 0;
      for (int chart = 0; chart < 6; ++chart) {
        for (int y = 0; y < size.height; ++y) {
          for (int i = 0; i < size.width * 3; ++i) {
            const double a = alone.level.chart(chart).row(y)[i], b = shared.level.chart(chart).row(y)[i];
            error += (a - b) * (a - b);
            whole += a * a;
          }
        }
      }
      EXPECT_LE(std::sqrt(error / whole), 2e-3) << view << " " << level;  // twice the tolerance
    }
  }
}

/// A surface that is matte reflects the same from everywhere; its axis is the normal, and a look-up the exact
/// integral.
TEST(ViewBake, MatteIsLambert) {
  const Map map = lat_long("sky");
  ViewBakeOptions options = small(4, 1);
  options.brdf = brdf::AnyBrdf::from_function("matte", 1, [](const Vec3d&, const Vec3d&) { return 1 / kPi; });
  const ViewStack stack(bake_views(map, options));
  EXPECT_EQ(stack.levels(), 1);
  const ViewReference reference(map);
  for (const double cosine : {0.1, 0.4, 0.8}) {
    const Vec3d normal = normalize(Vec3d{0.3, 0.8, -0.5});
    const Vec3d level = normalize(cross(normal, Vec3d{0, 0, 1}));
    const Vec3d view = cosine * normal + std::sqrt(1 - cosine * cosine) * level;
    std::array<double, 3> exact;
    reference.evaluate(options.brdf, normal, view, exact);
    const auto found = stack.rgb(normal, view);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(found[c]), exact[c], 4e-3 * exact[c]);  // bilinear on faces of 32
    EXPECT_NEAR(stack.albedo(cosine), 1, 1e-5);
  }
}

TEST(ViewBake, NotesTellHowToLookUp) {
  const Map map = lat_long("sky", 64);
  ViewBakeOptions options = small(5, 4);
  options.brdf = brdf::AnyBrdf::make("ggx,f0=0.5");
  const ViewChains stack = bake_views(map, options);
  stack.check();
  EXPECT_EQ(stack.notes.brdf, "ggx,f0=0.5");
  EXPECT_EQ(stack.notes.axis, "fitted");
  EXPECT_EQ(stack.views.front().notes.roughness.size(), 4u);
  for (std::size_t view = 0; view < 5; ++view) {
    EXPECT_EQ(stack.notes.lift.at(view, 0), 0);  // a mirror's
    for (std::size_t level = 0; level < 4; ++level) {
      EXPECT_LT(stack.notes.albedo.at(view, level), 1);
      EXPECT_GT(stack.notes.albedo.at(view, level), 0.1);
    }
    EXPECT_GT(stack.notes.lift.at(view, 2), 0);
  }
  // Fresnel: grazing views reflect more of the mirror.
  EXPECT_GT(stack.notes.albedo.at(0, 0), stack.notes.albedo.at(4, 0) + 0.2);
  options.bake.chain = false;
  options.bake.levels = 0;
  const ViewChains one = bake_views(map, options);
  EXPECT_EQ(one.views.front().levels.size(), 1u);
}

TEST(ViewBake, TellsWhatReflectsTooMuch) {
  ViewBakeOptions options = small(2, 1);
  options.brdf = brdf::AnyBrdf::from_grid("bright", {{0, 90}, {0, 90}, {0}, {1, 1, 1, 1}});
  const sphere::AnyParameterization latlong = sphere::AnyParameterization::make("latlong");
  const ViewBakePlan plan({latlong, {64, 32}, 3}, options);
  ASSERT_EQ(plan.warnings().size(), 1u);
  EXPECT_NE(plan.warnings()[0].find("314.2 %"), std::string::npos) << plan.warnings()[0];  // π
}

TEST(ViewBake, WhatCannotBeBaked) {
  const Map map = lat_long("sky", 64);
  const auto kind = [&](const ViewBakeOptions& options) {
    try {
      bake_views(map, options);
    } catch (const Error& error) {
      return error.kind();
    }
    ADD_FAILURE() << "was baked";
    return ErrorKind::system;
  };
  ViewBakeOptions options = small(2, 3);
  options.view_cosines = {0.5, 0.5};
  EXPECT_EQ(kind(options), ErrorKind::bad_request);
  options.view_cosines = {0};
  EXPECT_EQ(kind(options), ErrorKind::bad_request);
  options.view_cosines = {};
  EXPECT_EQ(kind(options), ErrorKind::bad_request);
  options = small(2, 3);
  options.bake.prefilter.scale = LobeScale::integral;
  EXPECT_EQ(kind(options), ErrorKind::bad_request);
  options = small(2, 30);
  EXPECT_EQ(kind(options), ErrorKind::bad_request);
}

}  // namespace
}  // namespace welkin
