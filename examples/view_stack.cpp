// Reflections that change with the angle of view: a stack of pre-filtered maps, and the same from one chain.
#include <welkin/map_file/view_chains_file.h>
#include <welkin/prefilter/lobe_sum_bake.h>
#include <welkin/prefilter/view_bake.h>
#include <welkin/prefilter/view_stack.h>
#include <welkin/synth/render_synth.h>

#include <cmath>
#include <cstdio>

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  const welkin::Map sky = welkin::render(welkin::synth::make("sky"), latlong, 256, 128);

  // A stack: eight angles of view, each a chain over roughness, in the layers of one texture.
  welkin::ViewBakeOptions options;
  options.brdf = welkin::brdf::AnyBrdf::make("ggx,f0=0.04");
  options.view_cosines = welkin::default_view_cosines(8);
  options.bake.size = {64, 64};
  welkin::write_view_chains("stack.ktx2", welkin::bake_views(sky, options));
  const welkin::ViewStack stack(welkin::read_view_chains("stack.ktx2"));

  // One chain, and a table that says which four of its texels to add.
  welkin::LobeSumOptions sums;
  sums.brdf = options.brdf;
  sums.view_cosines = options.view_cosines;
  sums.roughness = {0, 0.25, 0.5, 1};
  sums.bake.size = {64, 64};
  const welkin::LobeSumSampler added(welkin::bake_lobe_sums(sky, sums));

  const welkin::Vec3d up{0, 1, 0};
  for (const double degrees : {0.0, 45.0, 80.0}) {
    const double angle = degrees * std::acos(-1) / 180;
    const welkin::Vec3d view{std::sin(angle), std::cos(angle), 0};
    // Half rough; what is seen is the mean radiance times the share of light that is reflected.
    const double level = stack.level_of(0.5), albedo = stack.albedo(view.y, level);
    const auto a = stack.rgb(up, view, level), b = added.rgb(up, view, 0.5);
    std::printf("%2.0f degrees: stack %.3f %.3f %.3f, four look-ups %.3f %.3f %.3f, times %.3f\n", degrees,
                static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2]),
                static_cast<double>(b[0]), static_cast<double>(b[1]), static_cast<double>(b[2]), albedo);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "view_stack: %s\n", error.what());
  return 1;
}
