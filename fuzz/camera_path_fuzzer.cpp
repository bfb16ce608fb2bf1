// Any bytes as a camera's key frames, CSV or JSON. Only Error may come out; what was read turns a camera by
// rotations, and zooms it within what there are fields of view for.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/camera/camera_path.h"

namespace {

void check(const welkin::CameraPath& path, double frame) {
  const welkin::CameraPath::Pose pose = path.at(frame);
  if (!welkin::is_orthonormal(pose.rotation)) __builtin_trap();
  if (pose.fov && !(*pose.fov > 0 && *pose.fov < 360)) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  try {
    const CameraPath path =
        parse_camera_path(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    const std::vector<CameraKey>& keys = path.keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      check(path, keys[i].frame);
      if (i == 0) continue;
      const double before = keys[i - 1].frame, way = keys[i].frame - before;
      for (const double part : {1e-9, 0.25, 0.5, 1 - 1e-9}) check(path, before + part * way);
    }
    for (const double frame : {-1e300, 0.0, 1e300}) check(path, frame);
  } catch (const Error&) {
  }
  return 0;
}
