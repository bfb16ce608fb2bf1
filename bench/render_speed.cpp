// What pictures of scenes cost, split into rays, surfaces and look-ups.

#include <string>
#include <vector>

#include "harness.h"
#include "welkin/base/parallel.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/camera_rays.h"
#include "welkin/render/render.h"
#include "welkin/scene/built_in.h"
#include "welkin/synth/render_synth.h"

namespace {

using namespace welkin;
using namespace welkin::bench;
using namespace welkin::scene;

constexpr int kWidth = 1920, kHeight = 1080;

/// One row of the picture's rays traced, and where `surfaces` says so, turned into surfaces.
void trace_row(const TracedScene& scene, const CameraRays& camera, int y, bool surfaces) {
  std::vector<PicturePlace> places;
  for (int x = 0; x < kWidth; ++x)
    places.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  std::vector<RaySpread> spreads;
  std::vector<bool> valid;
  camera.rays(places, 1, spreads, valid);
  std::vector<Ray> rays;
  for (const RaySpread& each : spreads) rays.push_back({to_float(each.origin), to_float(each.direction)});
  std::vector<Hit> hits(rays.size());
  scene.closest(rays, hits, Coherence::close);
  if (!surfaces) return;
  double sum = 0;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i]) sum += scene.surface(spreads[i], hits[i]).position.x;
  // A sum that the compiler cannot leave out.
  if (sum == 0.12345) std::abort();
}

std::string rate(const Timing& timing) {
  return fixed(kWidth * kHeight / 1e6 / timing.best().wall, 2) + " (" +
         fixed(kWidth * kHeight / 1e6 / timing.best().cpu, 2) + ")";
}

}  // namespace

int main() {
  const Threads threads;
  BuiltInOptions how;
  how.triangles = 100'000;
  const TracedScene scene(built_in("sphere", how));
  PlacedCamera placed;
  placed.camera.size = {kWidth, kHeight};
  placed.camera.fov = 20;
  const auto box = bounds_of(scene.scene());
  const Vec3d middle = 0.5 * (box->least + box->most);
  placed.position = middle + Vec3d{0, 0, -2 * (box->most.z - box->least.z)};
  const CameraRays camera(frame_of(placed.camera), placed.position);
  const World world(
      welkin::render(synth::make("studio"), sphere::AnyParameterization::make("latlong"), 1024, 512));
  Worlds plain{world};

  heading("Pictures of scenes");
  paragraph("A ball of " + std::to_string(triangle_count(scene.scene())) +
            " triangles that fills a picture of 1920×1080, one ray a pixel, in the studio as a lat-long of "
            "1024×512; " +
            std::to_string(threads.count()) +
            " threads. Millions of pixels a second by the clock, in brackets of processor time; the best of "
            "the rounds.");
  std::vector<std::string> names{"rays alone", "rays and surfaces"};
  std::vector<std::function<void()>> jobs{
      [&] { parallel_for(kHeight, [&](int y) { trace_row(scene, camera, y, false); }); },
      [&] { parallel_for(kHeight, [&](int y) { trace_row(scene, camera, y, true); }); }};
  std::vector<std::unique_ptr<Shading>> shadings;
  const auto add = [&](const std::string& label, std::unique_ptr<Shading> shading) {
    shadings.push_back(std::move(shading));
    const Shading* made = shadings.back().get();
    names.push_back(label);
    jobs.push_back([&scene, &placed, &world, made] {
      render(scene, placed, world, *made, {.samples = 1, .background = false});
    });
  };
  ShadingOptions directions;
  directions.no_spread = true;
  add("mirror, elliptical cones, `auto` filter", make_shading("mirror", plain));
  add("mirror, directions alone", make_shading("mirror", plain, directions));
  for (const ConeFilter filter : {ConeFilter::bilinear, ConeFilter::trilinear, ConeFilter::probes}) {
    const World other(
        welkin::render(synth::make("studio"), sphere::AnyParameterization::make("latlong"), 1024, 512), {},
        ConeSamplerOptions{.filter = filter});
    add("mirror, elliptical cones, `" + std::string(name_of(filter)) + "`", make_shading("mirror", {other}));
  }
  for (const char* name : {"diffuse", "phong", "material", "globe", "chrome", "outline"})
    add(name, make_shading(name, plain));
  const std::vector<Timing> timings = time_jobs(jobs, 3);
  const Table table({"picture", "Mpixel/s"});
  for (std::size_t i = 0; i < names.size(); ++i) table.row({names[i], rate(timings[i])});
  return 0;
}
