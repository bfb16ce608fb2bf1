// What a grid of probes costs, beside the rays alone.

#include <array>
#include <string>
#include <vector>

#include "harness.h"
#include "welkin/base/parallel.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/probes/probe_grid.h"
#include "welkin/render/project/texel_rays.h"
#include "welkin/scene/built_in.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;
using namespace welkin::scene;

constexpr std::array<int, 3> kCounts{16, 8, 16};

/// The grid's rays, and nothing else: closest hits that nobody reads.
void trace_alone(const TracedScene& scene, const ProbeBox& probes, const ProbeGridOptions& options) {
  const MapFrame frame(sphere::AnyParameterization::make("octahedral"), {options.size, options.size});
  std::vector<TexelRays> blocks;
  for (const TexelBlock& block : texel_blocks(1, frame.size, options.samples))
    blocks.push_back(texel_rays(frame, block, options.samples));
  parallel_for(probes.count(), [&](int index) {
    const Vec3d at =
        probes.position(index % kCounts[0], index / kCounts[0] / kCounts[2], index / kCounts[0] % kCounts[2]);
    const Vec3<float> origin = to_float(at);
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    for (const TexelRays& block : blocks) {
      rays.clear();
      for (const RaySpread& ray : block.rays) rays.push_back({origin, to_float(ray.direction)});
      hits.resize(rays.size());
      scene.closest(rays, hits, Coherence::close);
    }
  });
}

}  // namespace

int main() {
  const Threads threads;
  BuiltInOptions how;
  how.triangles = 100'000;
  const TracedScene scene(built_in("landscape", how));
  const World world(render(synth::make("sky"), sphere::AnyParameterization::make("latlong"), 512, 256));
  const ProbeBox probes = probes_in(scene.scene(), kCounts);
  heading("Grids of probes");
  paragraph(
      "16×8×16 probes of 32² texels in the landscape of " + std::to_string(triangle_count(scene.scene())) +
      " triangles, under the sky: millions of rays a second of processor time, and the share of Embree's own "
      "rate, of the same rays in the same round. *Light* is radiance and its shading; *all* has diffuse "
      "light, "
      "distances and two levels of roughness too.");
  const Table table(
      {"shading", "rays a texel", "rays alone, M/s", "light, M/s", "of it", "all, M/s", "of it"});
  for (const char* name : {"diffuse", "material"}) {
    const auto shading = make_shading(name, {world});
    const ShadedScene seen{scene, *shading, &world};
    for (const int samples : {1, 2, 4}) {
      ProbeGridOptions light;
      light.samples = samples;
      light.diffuse_size = light.depth_size = 0;
      ProbeGridOptions all;
      all.samples = samples;
      all.roughness = {0.3, 0.6};
      const auto times =
          time_jobs({[&] { trace_alone(scene, probes, light); }, [&] { project_grid(seen, probes, light); },
                     [&] { project_grid(seen, probes, all); }},
                    std::stoi(setting("WELKIN_BENCH_ROUNDS", "3")));
      const double rays = 1e-6 * probes.count() * light.size * light.size * samples * samples;
      const auto rate = [&](const Timing& timing) { return fixed(rays / timing.median().cpu, 2); };
      const auto share = [&](const Timing& timing) { return fixed(100 / ratio(timing, times[0]), 0) + " %"; };
      table.row({name, std::to_string(samples * samples), rate(times[0]), rate(times[1]), share(times[1]),
                 rate(times[2]), share(times[2])});
    }
  }
}
