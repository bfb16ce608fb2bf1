#include "welkin/math/angles.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {

/// `frequency` meridians, one through +Z, and parallels as far apart, one on the horizon. Width is measured
/// across the line on the sphere, so that meridians are as wide at a pole as on the horizon.
Radiance make_lines(const SynthOptions& options) {
  const int meridians = whole_option_or(options.frequency, 24, 1, {"lines", "frequency", 1, 100000});
  const double half_width = option_or(options.angle, 0.5, {"lines", "angle", 0, 90}) * kDegree / 2;
  const double scale = scale_option(options, "lines");
  return [=](const Vec3d& d) {
    const double step = 2 * kPi / meridians;
    const double level = sqrt(d.x * d.x + d.z * d.z);
    const double azimuth = atan2(d.x, d.z), elevation = atan2(d.y, level);
    // Sine of the distance to the nearest meridian's great circle, and distance to the nearest parallel.
    const double across = level * abs(sin(std::remainder(azimuth, step)));
    const double along = abs(std::remainder(elevation, step));
    const bool beside = abs(std::remainder(azimuth, step)) <= kPi / 2 && across <= sin(half_width);
    const double value = beside || along <= half_width ? scale : 0.0;
    return to_radiance({value, value, value});
  };
}

}  // namespace welkin::synth
