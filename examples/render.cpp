// Pictures of a scene whose surfaces reflect a world: as a mirror, as its materials say, by paths of light,
// and with a part of it that reflects a world of its own.
#include <welkin/io/image_file.h>
#include <welkin/render/path/path_tracer.h>
#include <welkin/render/render.h>
#include <welkin/scene/built_in.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>

namespace {

void write(const char* file, const welkin::Image& picture) {
  const welkin::io::WritePart part{.name = {}, .image = picture.view(), .channels = {"R", "G", "B", "A"}};
  welkin::io::write(file, {&part, 1});
}

welkin::Map synth(const char* name) {
  return welkin::render(welkin::synth::make(name), welkin::sphere::AnyParameterization::make("latlong"), 256,
                        128);
}

}  // namespace

int main() try {
  namespace scene = welkin::scene;
  scene::Scene built = scene::built_in("torus");
  welkin::Camera camera;
  camera.size = {96, 72};
  camera.fov = 40;
  camera.rotation = welkin::rotation_of({.yaw = 20, .pitch = -30});
  const scene::PlacedCamera placed = scene::camera_that_sees(built, camera);

  const scene::TracedScene traced(std::move(built));
  const scene::World studio(synth("studio"));

  // Looked up: fast, and nothing near is reflected.
  const auto mirror = scene::make_shading("mirror", {studio});
  write("mirror.exr", scene::render(traced, placed, studio, *mirror));
  const auto material = scene::make_shading("material", {studio});
  write("material.exr", scene::render(traced, placed, studio, *material));

  // Followed: the torus sees itself.
  const scene::PathPicture truth = scene::path_trace(traced, placed, studio, {.samples = 16});
  write("paths.exr", truth.picture);

  // The first object reflects another world, taken elsewhere.
  scene::Worlds worlds{studio};
  worlds.own.emplace_back(synth("sky"));
  worlds.of_instance = {0};
  write("own-world.exr", scene::render(traced, placed, studio, *scene::make_shading("mirror", worlds)));
  std::printf("four pictures of %llu triangles\n",
              static_cast<unsigned long long>(scene::triangle_count(traced.scene())));
} catch (const std::exception& error) {
  std::fprintf(stderr, "render: %s\n", error.what());
  return 1;
}
