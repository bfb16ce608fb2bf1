#include "welkin/assemble/composite_over.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

namespace welkin {
namespace {

constexpr float kRound = 1e-3f;

std::string size_of(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

void check_texels(ImageView<const float> near) {
  for (int y = 0; y < near.height; ++y) {
    for (int x = 0; x < near.width; ++x) {
      const float* texel = near.at(x, y);
      const auto where = [&] { return " at texel " + std::to_string(x) + ", " + std::to_string(y); };
      if (!(texel[3] >= -kRound && texel[3] <= 1 + kRound))
        throw Error(ErrorKind::bad_value,
                    "the near picture's alpha is " + std::to_string(texel[3]) + where() + ", not 0 … 1");
      if (!std::isfinite(texel[0]) || !std::isfinite(texel[1]) || !std::isfinite(texel[2]))
        throw Error(ErrorKind::bad_value, "the near picture is NaN or infinite" + where());
    }
  }
}

}  // namespace

void composite_over(ImageView<const float> near, ImageView<float> far, Association association) {
  if (near.width != far.width || near.height != far.height)
    throw Error(ErrorKind::mismatch, "the near picture is " + size_of(near.width, near.height) +
                                         " texels large and the far one " + size_of(far.width, far.height));
  require(near.channels == 4, "a picture that lies over another has channels R G B A");
  require(far.channels == 3 || far.channels == 4, "a picture that lies under another has channels R G B (A)");
  check_texels(near);
  const bool straight = association == Association::straight;
  parallel_for(near.height, [&](int y) {
    for (int x = 0; x < near.width; ++x) {
      const float* over = near.at(x, y);
      float* under = far.at(x, y);
      const float alpha = std::clamp(over[3], 0.0f, 1.0f);
      for (int c = 0; c < 3; ++c) under[c] = (straight ? alpha * over[c] : over[c]) + (1 - alpha) * under[c];
      if (far.channels == 4) under[3] = alpha + (1 - alpha) * under[3];
    }
  });
}

}  // namespace welkin
