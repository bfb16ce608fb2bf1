#include "welkin/math/angles.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {

/// ½ + ½ cos(F θ²), θ the angle from +Z and F = `frequency`: the phase's rate is 2Fθ per radian, which is
/// Fθ/π cycles per radian, and F of them at θ = π.
Radiance make_zoneplate(const SynthOptions& options) {
  const double frequency = option_or(options.frequency, 64, {"zoneplate", "frequency", 0, 1e6});
  const double scale = scale_option(options, "zoneplate");
  return [=](const Vec3d& d) {
    const double angle = angle_between(d, {0, 0, 1});
    const double value = scale * (0.5 + 0.5 * cos(frequency * angle * angle));
    return to_radiance({value, value, value});
  };
}

}  // namespace welkin::synth
