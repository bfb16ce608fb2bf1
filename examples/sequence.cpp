// The frames of an animation: rendered here, their diffuse light baked every four frames and interpolated
// between.
#include <welkin/map/adjust.h>
#include <welkin/map_file/map_file.h>
#include <welkin/sequence/bake_frames.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  const welkin::FrameNames sky("sky-%04d.exr"), diffuse("diffuse-%04d.exr");
  // A studio that turns. The file says how the world lies, so the pixels stay what they are.
  welkin::Map studio = welkin::render(welkin::synth::make("studio"), latlong, 128, 64);
  for (int frame = 1; frame <= 9; ++frame) {
    welkin::turn_world(studio, welkin::rotation_from_yaw_pitch_roll(5, 0, 0));
    welkin::write_map(sky.file(frame), studio);
  }

  welkin::BakeFramesOptions options;
  options.bake.lobe = welkin::lobe::AnyLobe::make("lambert");
  options.bake.target = latlong;  // of 40×20
  options.every = 4;
  const welkin::BakeFramesReport done = welkin::bake_frames(sky, diffuse, options);
  std::printf("%zu frames baked, %zu interpolated\n", done.baked.size(), done.interpolated.size());
  for (const welkin::HeldOutFrame& each : done.held_out)
    std::printf("frame %d: off by %.3g %%\n", each.frame, 100 * each.relative_rmse);

  // What is too long for files goes by hand: a plan never changes, and threads may share it.
  const welkin::BakePlan plan({latlong, {128, 64}, 3}, options.bake);
  const welkin::Chain first = plan.run(welkin::read_map(sky.file(1)).map);
  std::printf("%d×%d texels\n", first.levels.front().width(), first.levels.front().height());
} catch (const std::exception& error) {
  std::fprintf(stderr, "sequence: %s\n", error.what());
  return 1;
}
