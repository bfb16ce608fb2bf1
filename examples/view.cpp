// Pictures of the world: a photograph of a panorama, a dome's master, and a pan with a zoom from key frames.
#include <welkin/camera/camera_path.h>
#include <welkin/camera/view.h>
#include <welkin/map_file/map_file.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>
#include <string>

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  const welkin::Map world = welkin::render(welkin::synth::make("studio"), latlong, 512, 256);

  welkin::Camera camera;  // a perspective one
  camera.size = {320, 180};
  camera.fov = 60;
  camera.rotation = welkin::rotation_of({.yaw = 30, .pitch = 5});  // to the right, and up a little
  const welkin::Map photograph = welkin::view(world, camera, {.borders = false});
  welkin::write_map("photograph.exr", photograph);

  // The file says what it shows: read as a map it is that part of the world.
  const welkin::Map part = welkin::read_map("photograph.exr").map;
  std::printf("%s shows %.3f sr\n", part.parameterization.spec().c_str(), part.parameterization.coverage());

  welkin::Camera dome;
  dome.lens = "dome,tilt=15";
  dome.size = {256, 256};
  welkin::write_map("dome.png", welkin::view(world, dome, {.borders = false}));

  const welkin::CameraPath path({{.frame = 1, .look = {0, 0, 0}, .fov = 80},
                                 {.frame = 4, .look = {120, 10, 0}, .fov = 40},
                                 {.frame = 7, .look = {360, 0, 0}, .fov = 80}});
  for (int frame = 1; frame <= 7; ++frame) {
    const welkin::CameraPath::Pose pose = path.at(frame);
    camera.rotation = pose.rotation;
    camera.fov = pose.fov;
    welkin::write_map("pan_" + std::to_string(frame) + ".png",
                      welkin::view(world, camera, {.borders = false}));
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "view: %s\n", error.what());
  return 1;
}
