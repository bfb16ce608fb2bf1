// A scene by look-ups, by mirrors that trace, and by paths of light, and how far the former are from the
// latter: render_truth MAP OUT
#include <welkin/image/image.h>
#include <welkin/io/image_file.h>
#include <welkin/map_file/map_file.h>
#include <welkin/measure/picture_errors.h>
#include <welkin/render/hybrid.h>
#include <welkin/render/path/path_tracer.h>
#include <welkin/scene/built_in.h>

#include <cstdio>
#include <memory>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: render_truth MAP OUT\n");
    return 2;
  }
  using namespace welkin;
  const scene::World world(MapReader(argv[1]).read());
  scene::Scene floor = scene::built_in("floor");
  Camera like;
  like.size = {96, 54};
  const scene::PlacedCamera camera = scene::camera_that_sees(floor, like);
  const scene::TracedScene traced(std::move(floor));

  // The scene alone: what shows the world behind is the same in all of them.
  const auto shading = scene::make_shading("material", {world});
  const Image by_look_ups = scene::render(traced, camera, world, *shading, {.background = false});
  const Image by_both = scene::render_hybrid(traced, camera, {world}, *shading, {.background = false});
  const scene::PathPicture truth =
      scene::path_trace(traced, camera, world, {.samples = 16, .background = false});

  for (const auto& [name, picture] : {std::pair{"look-up", &by_look_ups}, std::pair{"hybrid", &by_both}}) {
    const PictureErrors errors =
        picture_errors({picture->view(), truth.picture.view(), truth.standard_error.view()});
    std::printf("%s: rel. RMSE %.3f, of which %.3f is noise\n", name, errors.relative_rmse,
                errors.truth_noise);
  }
  const Image sides = side_by_side({by_look_ups.view(), truth.picture.view()});
  const io::WritePart part{.name = {}, .image = sides.view(), .channels = {"R", "G", "B"}};
  io::write(argv[2], {&part, 1});
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
