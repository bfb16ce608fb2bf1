// Any bytes as an ICC profile, used for all that a profile is used for. Only Error may come out.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "welkin/base/error.h"
#include "welkin/io/colour/icc_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  try {
    const io::IccProfile profile(std::as_bytes(std::span(data, size)));
    static_cast<void>(profile.is_srgb());
    static_cast<void>(profile.code_points());
    if (profile.has_primaries()) static_cast<void>(profile.to_bt709());
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr std::array<float, 12> kStored = {
        0,     1,      0.5f, -0.25f,    1.5f,       0.01f,
        1e30f, -1e30f, 1,    kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
    for (const bool keep_primaries : {false, true}) {
      Image picture(2, 2, 3);
      std::copy(kStored.begin(), kStored.end(), picture.at(0, 0));
      if (profile.channels() == 1) {
        profile.to_linear(picture.view(), 0, 0, 0, keep_primaries);
      } else {
        profile.to_linear(picture.view(), 0, 1, 2, keep_primaries);
      }
    }
  } catch (const Error&) {
  }
  return 0;
}
