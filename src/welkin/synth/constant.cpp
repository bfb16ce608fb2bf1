#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

namespace welkin::synth {

Radiance make_constant(const SynthOptions& options) {
  const double value = scale_option(options, "constant");
  return [value](const Vec3d&) { return to_radiance({value, value, value}); };
}

}  // namespace welkin::synth
