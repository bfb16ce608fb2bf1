#include "welkin/math/look.h"

#include <cmath>

#include "welkin/base/error.h"

namespace welkin {

Matrix3 rotation_of(const Look& look) {
  require(std::isfinite(look.yaw) && std::isfinite(look.pitch) && std::isfinite(look.roll),
          "the angles of a camera are finite");
  return rotation_from_yaw_pitch_roll(-look.yaw, -look.pitch, look.roll);
}

}  // namespace welkin
