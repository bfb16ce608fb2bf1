// Frames of a video, as programs pipe them (ffmpeg -i film.mp4 -f yuv4mpegpipe film.y4m): a panorama that
// turns is written, read again, and seen by a camera that stands still.
#include <welkin/camera/view.h>
#include <welkin/map/borders.h>
#include <welkin/map_file/map_file.h>
#include <welkin/synth/render_synth.h>
#include <welkin/video/frame_reader.h>
#include <welkin/video/frame_writer.h>

#include <cstdio>
#include <fstream>

namespace {

welkin::video::WriteBytes into(std::ofstream& file) {
  file.exceptions(std::ios::failbit | std::ios::badbit);
  return [&file](std::span<const std::byte> bytes) {
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
}

welkin::video::ReadBytes out_of(std::ifstream& file) {
  return [&file](std::span<std::byte> bytes) {
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return static_cast<std::size_t>(file.gcount());
  };
}

void write_panorama(const char* name) {
  welkin::video::StreamInfo info;  // y4m of 8 bits, 4:2:0
  info.width = 256;
  info.height = 128;
  info.rate_numerator = 25;
  std::ofstream file(name, std::ios::binary);
  welkin::video::FrameWriter writer(into(file), info);
  std::vector<std::byte> stored;
  for (int frame = 0; frame < 8; ++frame) {
    const welkin::synth::Radiance studio = welkin::synth::make("studio");
    const welkin::Matrix3 turn = welkin::rotation_of({.yaw = 10.0 * frame});
    const welkin::Map map = welkin::render([&](const welkin::Vec3d& d) { return studio(turn * d); },
                                           welkin::sphere::AnyParameterization::make("latlong"), info.width,
                                           info.height, {.samples = 1});
    writer.encode(map.level.chart(0), stored);
    writer.put(stored);
  }
}

}  // namespace

int main() try {
  write_panorama("panorama.y4m");

  std::ifstream in("panorama.y4m", std::ios::binary);
  welkin::video::FrameReader reader(out_of(in), "panorama.y4m");
  const welkin::video::StreamInfo& panorama = reader.info();
  // What a picture of this size and these channels is.
  const welkin::MapFileInfo shape = welkin::inspect_picture(
      {panorama.width, panorama.height}, welkin::default_channel_names(panorama.channels), "panorama.y4m");
  std::printf("%d×%d: %s, %s\n", panorama.width, panorama.height, shape.shape.value().text().c_str(),
              shape.reason.c_str());
  welkin::Map world(shape.shape->parameterization, panorama.width, panorama.height, panorama.channels);

  welkin::Camera camera;
  camera.size = {320, 180};
  camera.rotation = welkin::rotation_of({.yaw = 20, .pitch = 10});
  // The camera stands still, so its positions in the world are found once.
  welkin::ResampleOptions options{.filter = welkin::Filter::bilinear, .borders = false};
  options.positions = std::make_shared<const welkin::TexelPositions>(world, welkin::frame_of(camera));

  welkin::video::StreamInfo seen = panorama;
  seen.width = camera.size.width;
  seen.height = camera.size.height;
  std::ofstream out("view.y4m", std::ios::binary);
  welkin::video::FrameWriter writer(into(out), seen);
  std::vector<std::byte> stored, made;
  int frames = 0;
  while (reader.take(stored)) {
    reader.decode(stored, world.level.chart(0));
    welkin::fill_borders(world);
    const welkin::Map picture = welkin::view(world, camera, options);
    writer.encode(picture.level.chart(0), made);
    writer.put(made);
    ++frames;
  }
  std::printf("%d frames of %d×%d in view.y4m\n", frames, seen.width, seen.height);
} catch (const std::exception& error) {
  std::fprintf(stderr, "video: %s\n", error.what());
  return 1;
}
