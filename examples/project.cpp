// What a place in a room sees, as a cube with distances, and the light between the probes of a grid: project
// OUT
#include <welkin/map_file/map_file.h>
#include <welkin/render/probes/probe_light.h>
#include <welkin/render/project/project.h>
#include <welkin/scene/built_in.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>

int main(int argc, char** argv) try {
  using namespace welkin;
  if (argc != 2) return std::fprintf(stderr, "usage: project OUT\n"), 2;
  const scene::TracedScene room(scene::built_in("room"));

  // Surfaces are lit by a map of the world, and past them it is seen itself.
  const auto latlong = sphere::AnyParameterization::make("latlong");
  const scene::World world(render(synth::make("studio"), latlong, 256, 128));
  const auto shading = scene::make_shading("material", {world});
  const scene::ShadedScene seen{room, *shading, &world};

  scene::ProjectOptions options;
  options.depth = scene::DepthChannels::mean;
  const Vec3d place{0.3, 1.2, 0.4};
  const Map map =
      scene::project(seen, place, {sphere::AnyParameterization::make("cube"), {128, 128}}, options);
  write_map(argv[1], map);

  // 4×2×4 probes all over the room, and diffuse light at a place between them, on a surface that faces up.
  const scene::ProbeGrid grid = scene::project_grid(seen, scene::probes_in(room.scene(), {4, 2, 4}));
  const scene::Rgb light = scene::ProbeLight(grid).diffuse(place, {0, 1, 0});
  std::printf("%d of %d probes are inside bodies; diffuse light %.3f %.3f %.3f\n", grid.inside_count(),
              grid.probes.count(), static_cast<double>(light[0]), static_cast<double>(light[1]),
              static_cast<double>(light[2]));
} catch (const std::exception& error) {
  std::fprintf(stderr, "project: %s\n", error.what());
  return 1;
}
