#include "welkin/map_file/eyes.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin::map_file {

ChartSize eye_size(io::Stereo stereo, int width, int height) {
  const bool across = stereo == io::Stereo::left_right, down = stereo == io::Stereo::top_bottom;
  if ((across && width % 2 != 0) || (down && height % 2 != 0)) {
    throw Error(ErrorKind::mismatch,
                std::to_string(width) + "×" + std::to_string(height) + " cannot be two eyes' pictures " +
                    (across ? "beside each other: its width" : "one above the other: its height") +
                    " is odd");
  }
  return {across ? width / 2 : width, down ? height / 2 : height};
}

bool two_eyes(io::Stereo stereo) {
  return stereo == io::Stereo::top_bottom || stereo == io::Stereo::left_right;
}

std::string where_of(io::Stereo stereo) {
  return stereo == io::Stereo::top_bottom ? "one above the other" : "beside each other";
}

io::Stereo stereo_from_aspect(int width, int height, double aspect) {
  const auto fits = [&](double w, double h) { return std::fabs(aspect * h - w) <= std::max(1.0, 0.01 * w); };
  if (height % 2 == 0 && fits(width, 0.5 * height)) return io::Stereo::top_bottom;
  if (width % 2 == 0 && fits(0.5 * width, height)) return io::Stereo::left_right;
  return io::Stereo::not_said;
}

void choose_eye(ChartSize picture, const ReadMapOptions& options, const std::function<double()>& aspect,
                MapFileInfo& info) {
  std::string reason = "as asked";
  info.stereo = options.stereo;
  if (info.stereo == io::Stereo::not_said && info.image.panorama) {
    info.stereo = info.image.panorama->stereo;
    reason = "as its metadata declare";
  }
  if (info.stereo == io::Stereo::not_said && options.eye) {
    info.stereo = stereo_from_aspect(picture.width, picture.height, aspect());
    if (info.stereo == io::Stereo::not_said) {
      throw Error(ErrorKind::bad_request,
                  "cannot tell how two eyes' pictures lie in " + std::to_string(picture.width) + "×" +
                      std::to_string(picture.height) + ": say stereo top-bottom or left-right");
    }
    info.image.notes.push_back("two eyes' pictures " + where_of(info.stereo) + ", by the aspect");
  }
  if (info.stereo == io::Stereo::not_said) info.stereo = io::Stereo::mono;
  if (!two_eyes(info.stereo)) {
    if (options.eye) throw Error(ErrorKind::bad_request, "holds one picture for both eyes, " + reason);
    return;
  }
  info.eye = options.eye.value_or(Eye::left);
  if (options.eye) return;
  info.image.warnings.push_back("holds two eyes' pictures " + where_of(info.stereo) + ", " + reason +
                                ": the left eye's is read; ask for the eye 'right' to have the other");
}

}  // namespace welkin::map_file
