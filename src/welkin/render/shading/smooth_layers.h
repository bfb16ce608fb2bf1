#pragma once

#include "welkin/render/shading/shading.h"
#include "welkin/render/trace/surface.h"

namespace welkin::scene {

/// What a smooth surface's layers count, as of Bsdf: of the mirrored and the refracted direction, and of
/// diffuse light along the normal.
struct SmoothLayers {
  Rgb reflected;
  Rgb refracted;
  Rgb diffuse;
  double eta;  ///< index behind over index in front

  explicit SmoothLayers(const Surface& at);
};

/// Makes what they read, before many threads do.
void prepare_smooth_layers();

}  // namespace welkin::scene
