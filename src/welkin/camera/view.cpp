#include "welkin/camera/view.h"

#include "welkin/base/error.h"

namespace welkin {

Map view(const Map& world, const Camera& camera, const ResampleOptions& options) {
  const MapFrame frame = frame_of(camera);
  Map picture(frame.parameterization, frame.size.width, frame.size.height, world.channels());
  picture.channel_names = world.channel_names;
  picture.orientation = frame.orientation;
  resample(world, picture, options);
  return picture;
}

Image view_pair(const Map& left_world, const Map& right_world, const Camera& camera, Pair pair,
                const ResampleOptions& options) {
  if (left_world.channel_names != right_world.channel_names)
    throw Error(ErrorKind::mismatch, "the worlds of the two eyes have other channels");
  const auto [width, height] = camera.size;
  const bool beside = pair == Pair::left_right;
  Image both(beside ? 2 * width : width, beside ? height : 2 * height, left_world.channels());
  const Map* worlds[] = {&left_world, &right_world};
  for (int eye = 0; eye < 2; ++eye) {
    ResampleOptions of_eye = options;
    of_eye.borders = false;
    const Map picture = view(*worlds[eye], camera, of_eye);
    copy_pixels(picture.level.chart(0),
                both.view().part(beside ? eye * width : 0, beside ? 0 : eye * height, width, height));
  }
  return both;
}

}  // namespace welkin
