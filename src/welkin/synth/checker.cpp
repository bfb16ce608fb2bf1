#include "welkin/math/angles.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {

/// Cells of 360°/frequency both ways, the light one on the +X side of +Z and above the horizon; dark is a
/// twentieth of light.
Radiance make_checker(const SynthOptions& options) {
  const int cells = whole_option_or(options.frequency, 36, 2, {"checker", "frequency", 2, 100000});
  const double scale = scale_option(options, "checker");
  return [=](const Vec3d& d) {
    const double per_radian = cells / (2 * kPi);
    const double column = floor(atan2(d.x, d.z) * per_radian);
    const double row = floor(atan2(d.y, sqrt(d.x * d.x + d.z * d.z)) * per_radian);
    const double value = scale * (std::fmod(column + row, 2) == 0 ? 1.0 : 0.05);
    return to_radiance({value, value, value});
  };
}

}  // namespace welkin::synth
