#include "welkin/math/angles.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {

/// Radiance is `intensity` within half of `angle` of the sun, and `background` elsewhere, so that over the
/// sphere it integrates to 4π·background + (intensity − background)·Ω, Ω = 2π(1 − cos(angle/2)).
Radiance make_sun(const SynthOptions& options) {
  const double radius = option_or(options.angle, kSunDiameter, {"sun", "angle", 0, 360}) * kDegree / 2;
  const double disc = option_or(options.intensity, 1e5, {"sun", "intensity", 0, 1e9});
  const double background = checked_option(options.background, {"sun", "background", 0, 1e9});
  const double elevation = checked_option(options.elevation, {"sun", "elevation", -90, 90});
  const double azimuth = checked_option(options.azimuth, {"sun", "azimuth", -360, 360});
  const Vec3d sun = direction_at(azimuth, elevation);
  return [=](const Vec3d& d) {
    const double value = angle_between(d, sun) <= radius ? disc : background;
    return to_radiance({value, value, value});
  };
}

}  // namespace welkin::synth
